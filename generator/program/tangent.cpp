// SPDX-License-Identifier: GPL-2.0-or-later
#include "program/tangent.hpp"

#include <fmt/format.h>

#include <optional>

#include "program/motion_system.hpp"
#include "program/partials.hpp"
#include "program/solve.hpp"

namespace alembert {

namespace {

/// The state, then the parameters.
std::vector<Variable> variables_of(const Program& p) {
    std::vector<Variable> all;
    const auto add = [&](Variable::Kind kind, std::size_t count) {
        for (std::size_t i = 0; i < count; ++i) all.push_back({kind, static_cast<int>(i)});
    };
    add(Variable::Kind::coordinate, p.coordinates.size());
    add(Variable::Kind::rate, speeds_of(p));
    add(Variable::Kind::parameter, p.parameters.size());
    return all;
}

class Tangent {
public:
    explicit Tangent(const Program& program)
        : p_(program), n_(program.coordinates.size()), s_(speeds_of(program)) {
        for (const Variable& x : variables_of(program)) add(x);
    }

    /// δu' by way of K; nothing if the program has no mass matrix, or none that can be solved.
    std::optional<std::vector<int>> implicit() {
        if (p_.nodes_of(Group::mass).empty()) return std::nullopt;
        const MotionSystem system = motion_system(p_);
        const auto solved = solve_for_sides(p_, system.K, {system.b}, system.speeds);
        if (!solved) return std::nullopt;
        const MotionSystem change{.K = tangents(p_, system.K, direction_),
                                  .b = tangents(p_, system.b, direction_),
                                  .speeds = system.speeds};
        std::vector<int> side;
        for (int i = 0; i < system.size(); ++i)
            side.push_back(p_.sum(
                0, {{1, change.b[static_cast<std::size_t>(i)]}, {-1, row_times(p_, change, i, (*solved)[0])}}));
        auto result = solve_for_sides(p_, system.K, {side}, system.speeds);
        if (!result) return std::nullopt;
        result->front().resize(s_);
        return std::move(result->front());
    }

    /// δu' by differentiating the solution.
    std::vector<int> direct() { return tangents(p_, p_.nodes_of(Group::acceleration), direction_); }

    Operations cost(const std::vector<int>& nodes) const {
        std::vector<int> all = p_.right_hand_side();
        all.insert(all.end(), nodes.begin(), nodes.end());
        return p_.count(all);
    }

    Program finished(const std::vector<int>& accelerations) && {
        std::vector<int> rates;
        if (p_.speeds.empty())
            for (std::size_t i = 0; i < n_; ++i) rates.push_back(direction_.at(state_[n_ + i]));
        else
            rates = tangents(p_, p_.nodes_of(Group::rate), direction_);
        keep(rates);
        keep(accelerations);
        keep(of_values(accelerations));
        return p_.canonical();
    }

private:
    void add(Variable x) {
        const int node = p_.variable(x), place = static_cast<int>(direction_.size());
        state_.push_back(node);
        direction_.emplace(node, p_.variable({Variable::Kind::unknown, place}));
    }

    std::vector<int> of_values(const std::vector<int>& accelerations) {
        std::vector<int> values;
        for (const Group group :
             {Group::kinetic, Group::potential, Group::energy, Group::power, Group::output, Group::speed})
            for (const int node : p_.nodes_of(group)) values.push_back(node);
        std::map<int, int> all = direction_;
        const std::vector<int> solved = p_.nodes_of(Group::acceleration);
        for (std::size_t i = 0; i < s_; ++i)
            for (const int node : {p_.variable({Variable::Kind::acceleration, static_cast<int>(i)}), solved[i]})
                if (!p_[node].is_number()) all.emplace(node, accelerations[i]);
        return tangents(p_, values, all);
    }

    void keep(const std::vector<int>& nodes) {
        for (const int node : nodes) p_.roots.push_back({Group::tangent, fmt::format("D{}", kept_++), node});
    }

    Program p_;
    std::size_t n_, s_;
    std::vector<int> state_;        ///< the variables of the state, then the parameters
    std::map<int, int> direction_;  ///< from each of them to its δ
    int kept_ = 0;
};

}  // namespace

Program with_tangent(const Program& program) {
    Tangent by_system(program), by_solution(program);
    const std::optional<std::vector<int>> implicit = by_system.implicit();
    const std::vector<int> direct = by_solution.direct();
    if (implicit && by_system.cost(*implicit).total() < by_solution.cost(direct).total())
        return std::move(by_system).finished(*implicit);
    return std::move(by_solution).finished(direct);
}

std::vector<int> along_direction(Program& program, const std::vector<int>& nodes) {
    std::map<int, int> direction;
    int place = 0;
    for (const Variable& x : variables_of(program))
        direction.emplace(program.variable(x), program.variable({Variable::Kind::unknown, place++}));
    return tangents(program, nodes, direction);
}

std::size_t direction_size(const Program& program) {
    return program.coordinates.size() + speeds_of(program) + program.parameters.size();
}

}  // namespace alembert
