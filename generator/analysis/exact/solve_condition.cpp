// SPDX-License-Identifier: GPL-2.0-or-later
#include "analysis/exact/solve_condition.hpp"

#include <array>

#include "analysis/exact/angle_sum.hpp"
#include "analysis/exact/common_zeros.hpp"
#include "analysis/exact/counted_angle.hpp"

namespace alembert {

namespace {

/// Whether roots are on the own branch.
class IsOwn {
public:
    IsOwn(const OwnRoot* own, const ExactState& state) : own_(own) {
        if (own == nullptr || own->theta.empty()) return;
        for (const auto& [unknown, weight] : own->theta) {
            weights_[{unknown.variable.kind, unknown.variable.index}] = weight;
            const auto found = state.roots.find({unknown.variable.kind, unknown.variable.index});
            if (found != state.roots.end()) before_ += weight * found->second;
        }
    }
    bool operator()(const std::vector<std::pair<SolvedUnknown, Prime>>& roots) const {
        if (own_ == nullptr) return true;
        if (own_->factor.empty()) return true;
        Prime theta = before_;
        for (const auto& [unknown, x] : roots)
            theta += weights_.at({unknown.variable.kind, unknown.variable.index}) * x;
        return value_at(own_->factor, theta).is_zero();
    }

private:
    const OwnRoot* own_;
    std::map<std::pair<Variable::Kind, int>, Prime> weights_;
    Prime before_ = 0;  ///< what the roots of the steps before add
};

/// Which of `count` roots is taken.
std::size_t drawn(const SolvingStep& step, const ExactState& state, std::size_t count, std::size_t after) {
    const std::uint64_t number = state.point.random(700, static_cast<std::uint64_t>(step.node)).bits();
    return (number % count + after) % count;
}

Solved solve_two(const Program& program, const SolvingStep& step, ExactState& state, const OwnRoot* own,
                 std::size_t after) {
    const std::array<SolvedUnknown, 2> both{step, *step.second};
    std::array<Prime, 2> plain;
    for (std::size_t k = 0; k < 2; ++k) {
        plain[k] = state.point.variable(both[k].variable);
        state.point.given[{both[k].variable.kind, both[k].variable.index}] = plain[k];
    }
    const auto put = [&](std::size_t k, Prime x) {
        if (both[k].turned)
            state.point.given_angles[plain[k]] = counted_angle::turn_at(x);
        else
            state.point.given[{both[k].variable.kind, both[k].variable.index}] = x;
    };
    ModularFunction conditions(program, {both[0].node, both[1].node}, {both[0].variable, both[1].variable});
    CommonZeros zeros = common_zeros(
        [&](Prime x, Prime y) -> std::optional<std::array<Prime, 2>> {
            put(0, x), put(1, y);
            const auto at = conditions(state.point);
            if (!at) return std::nullopt;
            return std::array{(*at)[0], (*at)[1]};
        },
        {.turned = {both[0].turned, both[1].turned}, .seed = state.point.seed});
    const IsOwn is_own(own, state);
    std::erase_if(zeros.list, [&](const std::array<Prime, 2>& zero) {
        return !is_own({{both[0], zero[0]}, {both[1], zero[1]}});
    });
    if (zeros.list.empty()) return {false, zeros.degree};
    const auto& zero = zeros.list[drawn(step, state, zeros.list.size(), after)];
    put(0, zero[0]), put(1, zero[1]);
    for (std::size_t k = 0; k < 2; ++k) state.roots[{both[k].variable.kind, both[k].variable.index}] = zero[k];
    state.degree *= static_cast<double>(zeros.degree + 1);
    return {true, zeros.degree, zeros.list.size()};
}

}  // namespace

Solved solve_condition(const Program& program, const SolvingStep& step, ExactState& state, const OwnRoot* own,
                       std::size_t after) {
    if (step.second) return solve_two(program, step, state, own, after);
    const IsOwn is_own(own, state);
    const std::pair key{step.variable.kind, step.variable.index};
    const Prime plain = state.point.variable(step.variable);
    state.point.given[key] = plain;
    const auto put = [&](Prime x) {
        if (step.turned)
            state.point.given_angles[plain] = counted_angle::turn_at(x);
        else
            state.point.given[key] = x;
    };
    ModularFunction condition(program, {step.node}, {step.variable});
    const auto value = [&]() -> std::optional<Prime> {
        const auto at = condition(state.point);
        return at ? std::optional(at->front()) : std::nullopt;
    };
    // Polynomials of growing degree are tried until one passes through further points.
    for (const std::size_t degree : {2UL, 4UL, 8UL, 16UL, 24UL}) {
        std::vector<Prime> x, y;
        for (std::size_t k = 0; k < degree + 3; ++k) {
            x.push_back(state.point.random(600 + k, static_cast<std::uint64_t>(step.node)));
            put(x.back());
            const std::optional<Prime> here = value();
            if (!here) return {};
            y.push_back(step.turned ? *here * (x.back() * x.back() + 1).power(degree / 2) : *here);
        }
        const PrimePolynomial f = interpolate(x, y);
        if (f.size() > degree + 1) continue;
        if (f.empty()) {
            put(x.back());  // the condition holds for every value
            return {true, 1};
        }
        const std::size_t count = f.size() - 1;
        if (own != nullptr && own->factor.empty() && count > 1) return {false, count};
        std::vector<Prime> found = roots(f, state.point.seed);
        std::erase_if(found, [&](Prime root) { return !is_own({{step, root}}); });
        if (found.empty()) return {false, count};
        const Prime root = found[drawn(step, state, found.size(), after)];
        put(root);
        state.roots[key] = root;
        if (!step.turned)
            if (const auto sum = angle_sum(program, step.node, step.variable)) set_angle(state.point, *sum, root);
        state.degree *= static_cast<double>(f.size() - 1);
        const auto at_root = evaluate_mod(program, state.point, std::array{step.node});
        return {at_root && at_root->value[step.node].is_zero(), count, found.size()};
    }
    return {};
}

}  // namespace alembert
