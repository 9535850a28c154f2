// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// Searches for poses where the rows of the constraints become dependent: dead points, flat linkages, poses in
/// which a wheel is not constrained.
///
///     for (const SingularPose& pose : singular_poses(mechanism, state, states)) pose.q, pose.rank, pose.among
///
/// The search need not find all of them. It looks at the given state, at zero, and from some dozens of random
/// poses near the state by damped Gauss-Newton steps on f(q,t) = 0, Aᵀ v = 0, |v| = 1. A pose is reported if it
/// obeys the holonomic constraints to 1e-9 and the smallest singular value of A, with each row in units of its
/// usual size, is below 1e-9. Coordinates that do not matter keep their values, and angles are reduced to ±π. t is
/// not changed. Mechanisms with more than about thirty constraints are not searched.

#include "model/mechanism.hpp"
#include "program/interpret.hpp"

namespace alembert {

struct SingularPose {
    std::vector<double> q;
    int rank = 0;
    std::vector<int> among;  ///< the constraints whose rows are dependent there
    bool given = false;      ///< whether this is the given state itself
};

/// `mechanism` must have independent constraints only; a pose at which redundant ones that are tied to them
/// (Mechanism::Constraint::tie) make up for the rank is none. `states` must obey them (they determine the usual
/// size of a row). Returns at most `most` poses, the nearest to `state` first.
std::vector<SingularPose> singular_poses(const Mechanism& mechanism, const State<double>& state,
                                         const std::vector<State<double>>& states, std::size_t most = 4);

}  // namespace alembert
