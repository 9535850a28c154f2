// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// Which of the proved claims are relations of kinematics: they hold for every motion that the constraints allow,
/// whatever the forces.
///
///     tell_kinematics(now);     // sets now.verdicts[k].kinematic

#include "check/comparison.hpp"

namespace alembert {

void tell_kinematics(Comparison& now);

}  // namespace alembert
