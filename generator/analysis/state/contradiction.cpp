// SPDX-License-Identifier: GPL-2.0-or-later
// The constraints are left out one after the other. A constraint stays if leaving it out makes a state possible (a
// deletion filter; Chinneck, Feasibility and Infeasibility in Optimization (2008), §6.1).
#include "analysis/state/contradiction.hpp"

#include <algorithm>
#include <cmath>

#include "alembert/base/random.hpp"
#include "analysis/state/assemble.hpp"
#include "analysis/state/redundancy.hpp"
#include "program/lower/lower.hpp"

namespace alembert {

std::vector<State<double>> states_that_obey(const Mechanism& mechanism, const Start& from, int wanted) {
    Mechanism loose = mechanism;
    loose.q_is_guess.assign(mechanism.q.size(), true);
    loose.qdot_is_guess.assign(mechanism.q.size(), true);
    const Program program = lower_constraints(loose);
    const LeftOut left_out(loose);
    std::mt19937_64 random(1);
    const UniformReal<> away(-1, 1);
    std::vector<State<double>> result;
    for (int k = 0; k < places_tried && static_cast<int>(result.size()) < wanted; ++k) {
        Start start = from;
        const double reach = k == 0 ? 0 : k < places_tried / 2 ? 0.3 : 3;
        for (double& q : start.q) q += reach * away(random) * (1 + std::abs(q));
        for (double& u : start.qdot) u += reach * away(random);
        try {
            assemble(start, loose, program, {}, left_out);
            result.push_back(start.state());
        } catch (const std::runtime_error&) {
            continue;
        }
    }
    return result;
}

std::vector<int> contradictory_constraints(const Mechanism& mechanism, const Start& start) {
    std::vector<int> clash;
    for (std::size_t k = 0; k < mechanism.constraints.size(); ++k) clash.push_back(static_cast<int>(k));
    for (auto k = static_cast<std::ptrdiff_t>(clash.size()) - 1; k >= 0 && clash.size() > 1; --k) {
        std::vector<int> fewer = clash;
        fewer.erase(fewer.begin() + k);
        if (states_that_obey(with_constraints(mechanism, fewer), start, 1).empty()) clash = fewer;
    }
    return clash;
}

Mechanism with_constraints(const Mechanism& mechanism, const std::vector<int>& positions) {
    std::vector<int> others;
    for (int k = 0; k < static_cast<int>(mechanism.constraints.size()); ++k)
        if (std::find(positions.begin(), positions.end(), k) == positions.end()) others.push_back(k);
    Mechanism result = without_constraints(mechanism, others);
    result.redundant = mechanism.redundant;
    return result;
}

}  // namespace alembert
