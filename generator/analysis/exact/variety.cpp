// SPDX-License-Identifier: GPL-2.0-or-later
#include "analysis/exact/variety.hpp"

#include <algorithm>
#include <set>

#include "analysis/exact/quadratic_residue_points.hpp"
#include "analysis/exact/solve_condition.hpp"
#include "analysis/exact/solving_order.hpp"

namespace alembert {

namespace {

using Key = std::pair<Variable::Kind, int>;

class VarietySearch {
public:
    VarietySearch(const Program& program, const std::vector<int>& positions, std::vector<int> all,
                  const std::map<Key, Prime>& given)
        : program_(program), positions_(positions), all_(std::move(all)), given_(given) {
        std::set<Key> fixed, solved;
        for (const auto& [key, value] : given) fixed.insert(key);
        order_ = solving_order(program, positions_, {}, nullptr, fixed);
        for (const SolvingStep& step : order_.steps) {
            solved.insert({step.variable.kind, step.variable.index});
            if (step.second) solved.insert({step.second->variable.kind, step.second->variable.index});
        }
        usable_.emplace(std::vector{QuadraticResiduePoints::Part{&program_, all_}}, solved);
    }

    bool has_order() const { return order_.left.empty(); }

    /// Whether an angle is solved for, which then is given by its part by 2^halves.
    bool turns() const {
        return std::any_of(order_.steps.begin(), order_.steps.end(), [](const SolvingStep& step) {
            return step.turned || (step.second && step.second->turned);
        });
    }

    Variety points(int count, int halves) const {
        constexpr std::uint64_t trials = 400;
        constexpr int most_failures = 60;
        Variety result;
        result.conditions = static_cast<double>(order_.steps.size());
        int failures = 0;
        for (std::uint64_t seed = 1; seed < trials && static_cast<int>(result.points.size()) < count; ++seed) {
            std::optional<ExactState> state = point(seed, halves);
            if (!state && result.points.empty() && ++failures == most_failures) break;
            if (!state) continue;
            result.degree = std::max(result.degree, state->degree);
            result.points.push_back(std::move(state->point));
        }
        return result;
    }

private:
    std::optional<ExactState> point(std::uint64_t seed, int halves) const {
        const int finer = std::max(0, halvings(program_, all_) - halves);
        auto start = usable_->at({.seed = seed, .given = given_, .halves = halves, .finer = finer});
        if (!start) return std::nullopt;
        ExactState state{.point = std::move(*start)};
        for (const SolvingStep& step : order_.steps)
            if (!solve_condition(program_, step, state).found) return std::nullopt;
        const auto on = evaluate_mod(program_, state.point, positions_);
        const bool obeys = on && on->exact && std::all_of(positions_.begin(), positions_.end(), [&](int f) {
                               return on->value[f].is_zero();
                           });
        return obeys && evaluate_mod(program_, state.point, all_) ? std::optional(std::move(state)) : std::nullopt;
    }

    const Program& program_;
    std::vector<int> positions_, all_;
    std::map<Key, Prime> given_;
    SolvingOrder order_;
    std::optional<QuadraticResiduePoints> usable_;
};

}  // namespace

Variety variety_points(const Program& program, const std::vector<int>& positions, const std::vector<int>& others,
                       int count, const std::map<std::pair<Variable::Kind, int>, Prime>& given) {
    constexpr int most_halves = 2;
    std::vector<int> all = positions;
    all.insert(all.end(), others.begin(), others.end());
    std::vector<int> conditions = positions;
    std::erase_if(conditions, [&](int f) { return program.is_zero(f); });
    const VarietySearch search(program, conditions, all, given);
    if (search.has_order())
        for (int halves = search.turns() ? 0 : most_halves; halves <= most_halves; ++halves)
            if (Variety found = search.points(count, halves); static_cast<int>(found.points.size()) == count)
                return found;
    Variety beside = VarietySearch(program, {}, all, given).points(count, most_halves);
    beside.on_variety = conditions.empty();
    return beside;
}

}  // namespace alembert
