// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// Searches for poses at which the coordinates of a mechanism fail, not the mechanism: M loses rank, because some
/// rates move no mass there. So it is with the angle of polar coordinates at the origin, and with two of Euler's
/// angles in gimbal lock.
///
///     for (const SingularPose& pose : description_poses(mechanism, state)) pose.q, pose.among
///
/// The search is that of singular_poses.hpp, for the rows of M. `among` are the coordinates whose rows are
/// dependent. Nothing is found in mechanisms with constraints, with more than `most_described` coordinates, or
/// whose M is singular everywhere.

#include "analysis/audit/singular_poses.hpp"

namespace alembert {

inline constexpr int most_described = 9;  // coordinates, for which the search takes well below a second

std::vector<SingularPose> description_poses(const Mechanism& mechanism, const State<double>& state);

}  // namespace alembert
