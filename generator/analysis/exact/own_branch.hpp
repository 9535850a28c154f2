// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// The branch of the constraints on which the scene is, given by some places on it.
///
///     const OwnSlopes slopes(program, branch);
///     slopes.determine({condition, angle});     // does this condition determine the angle there?
///
/// Constraints may hold on several branches: x² = l² at x = l and at x = −l, sin a + sin(a + b) = 0 at b = π and
/// at b = −2a, a parallelogram as such and crossed.

#include <functional>
#include <optional>
#include <vector>

#include "analysis/exact/real_values.hpp"
#include "analysis/exact/solving_step.hpp"
#include "program/interpret.hpp"

namespace alembert {

struct OwnBranch {
    std::vector<State<double>> places;   ///< t, parameters and positions; no two branches meet there
    std::vector<State<double>> farther;  ///< likewise, along the branch as far as no other comes near
};

/// The slopes of conditions in variables, at the places of the branch.
class OwnSlopes {
public:
    /// The arguments must outlive it.
    OwnSlopes(const Program& program, const OwnBranch& branch) : program_(program), branch_(branch) {}

    /// Whether the condition has a slope in the variable, so that its value follows from those of the others. With
    /// b = π on the branch, sin a + sin(a + b) = 0 has none in a.
    bool determine(const SolvedUnknown& one) const;
    /// The same for two conditions and two variables.
    bool determine(const SolvedUnknown& one, const SolvedUnknown& other) const;

    /// Coordinates that the conditions determine together at a place; fewer than conditions where these have no
    /// full rank there.
    std::vector<RealState::Key> determined(const std::vector<int>& conditions, const State<double>& place) const;

private:
    const Program& program_;
    const OwnBranch& branch_;
};

inline RealState::Key key_of(const SolvedUnknown& unknown) {
    return {unknown.variable.kind, unknown.variable.index};
}

/// The value of a coordinate, a parameter or the time at a place.
double value_at(const State<double>& place, const RealState::Key& key);

/// The variables of the conditions, with the numbers of fifty digits that they have at a state beside a place.
/// `solved` get the values with which the conditions hold, on the same branch; `put` gives all others their
/// values, at most `reach` (times 1 + |x|) away from those at the place. Nothing if the conditions do not
/// determine the solved ones, or these change by much more than the others.
using PutFree = std::function<void(RealState& state, const RealState::Key& key, double value_at_place)>;
std::optional<RealState> state_beside(const Program& program, const std::vector<int>& conditions,
                                      const State<double>& place, const std::vector<RealState::Key>& solved,
                                      double reach, const PutFree& put);

}  // namespace alembert
