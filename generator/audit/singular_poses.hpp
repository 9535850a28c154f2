// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// Poses where the constraints' rows become dependent: dead points, flat linkages, instants at which a wheel is
/// not held.
///
///     for (const SingularPose& pose : singular_poses(mechanism, state, states)) pose.q, pose.rank, pose.among
///
/// Searched, not proved to be all: at the state given, at zero, and from some dozens of random poses near the
/// state by damped Gauss-Newton steps on f(q,t) = 0, Aᵀ v = 0, |v| = 1. A pose is told if it obeys the holonomic
/// constraints to 1e-9 and the smallest singular value of A, each row in units of its usual size, is below 1e-9.
/// Coordinates that do not matter keep their values, angles are brought into ±π. t stays as it is. Mechanisms
/// beyond some thirty constraints are not searched.

#include "model/mechanism.hpp"
#include "program/interpret.hpp"

namespace alembert {

struct SingularPose {
    std::vector<double> q;
    int rank = 0;
    std::vector<int> among;  ///< constraints whose rows are dependent there
    bool given = false;      ///< the state given itself
};

/// `mechanism` has independent constraints alone, `states` obey them (they tell the usual size of a row). At most
/// `most` poses, the nearest to `state` first.
std::vector<SingularPose> singular_poses(const Mechanism& mechanism, const State<double>& state,
                                         const std::vector<State<double>>& states, std::size_t most = 4);

}  // namespace alembert
