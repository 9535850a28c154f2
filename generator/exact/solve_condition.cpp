// SPDX-License-Identifier: GPL-2.0-or-later
#include "exact/solve_condition.hpp"

#include <array>

#include "exact/angle_sum.hpp"
#include "exact/common_zeros.hpp"

namespace alembert {

namespace {

std::optional<Prime> value_of(const Program& p, int node, const ExactState& state) {
    const std::array<int, 1> root{node};
    const auto at = evaluate_mod(p, state.point, root);
    if (!at) return std::nullopt;
    return at->value[node];
}

Solved solve_two(const Program& program, const SolvingStep& step, ExactState& state) {
    const std::array<SolvedUnknown, 2> both{step, *step.second};
    std::array<Prime, 2> plain;
    for (std::size_t k = 0; k < 2; ++k) {
        plain[k] = state.point.variable(both[k].variable);
        state.point.given[{both[k].variable.kind, both[k].variable.index}] = plain[k];
    }
    const auto put = [&](std::size_t k, Prime x) {
        if (both[k].turned)
            state.point.given_angles[plain[k]] = PrimeTurn::rational(x);
        else
            state.point.given[{both[k].variable.kind, both[k].variable.index}] = x;
    };
    const CommonZeros zeros = common_zeros(
        [&](Prime x, Prime y) -> std::optional<std::array<Prime, 2>> {
            put(0, x), put(1, y);
            const std::array<int, 2> nodes{both[0].node, both[1].node};
            const auto at = evaluate_mod(program, state.point, nodes);
            if (!at) return std::nullopt;
            return std::array{at->value[nodes[0]], at->value[nodes[1]]};
        },
        {.turned = {both[0].turned, both[1].turned}, .seed = state.point.seed});
    if (zeros.list.empty()) return {false, zeros.degree};
    const auto& zero =
        zeros.list[state.point.random(700, static_cast<std::uint64_t>(step.node)).bits() % zeros.list.size()];
    put(0, zero[0]), put(1, zero[1]);
    state.degree *= static_cast<double>(zeros.degree + 1);
    return {true, zeros.degree};
}

}  // namespace

Solved solve_condition(const Program& program, const SolvingStep& step, ExactState& state) {
    if (step.second) return solve_two(program, step, state);
    const std::pair key{step.variable.kind, step.variable.index};
    const Prime plain = state.point.variable(step.variable);
    state.point.given[key] = plain;
    const auto put = [&](Prime x) {
        if (step.turned)
            state.point.given_angles[plain] = PrimeTurn::rational(x);
        else
            state.point.given[key] = x;
    };
    // Polynomials of growing degree are tried until one passes through further points.
    for (const std::size_t degree : {2UL, 4UL, 8UL, 16UL, 24UL}) {
        std::vector<Prime> x, y;
        for (std::size_t k = 0; k < degree + 3; ++k) {
            x.push_back(state.point.random(600 + k, static_cast<std::uint64_t>(step.node)));
            put(x.back());
            const std::optional<Prime> value = value_of(program, step.node, state);
            if (!value) return {};
            y.push_back(step.turned ? *value * (x.back() * x.back() + 1).power(degree / 2) : *value);
        }
        const PrimePolynomial f = interpolate(x, y);
        if (f.size() > degree + 1) continue;
        if (f.empty()) {
            put(x.back());  // the condition holds for every value
            return {true, 1};
        }
        std::vector<Prime> found = roots(f, state.point.seed);
        std::vector<std::optional<Prime>> all(found.begin(), found.end());
        if (step.turned) {  // a half turn corresponds to a root at infinity
            state.point.given_angles[plain] = PrimeTurn{-1, 0};
            if (value_of(program, step.node, state) == Prime(0)) all.emplace_back();
        }
        const std::size_t count = f.size() - 1 + (all.size() > found.size() ? 1 : 0);
        if (all.empty()) return {false, count};
        const std::size_t pick =
            state.point.random(700, static_cast<std::uint64_t>(step.node)).bits() % all.size();
        if (all[pick])
            put(*all[pick]);
        else
            state.point.given_angles[plain] = PrimeTurn{-1, 0};
        if (!step.turned)
            if (const auto sum = angle_sum(program, step.node, step.variable))
                set_angle(state.point, *sum, *all[pick]);
        state.degree *= static_cast<double>(f.size() - 1);
        return {value_of(program, step.node, state) == Prime(0), count};
    }
    return {};
}

}  // namespace alembert
