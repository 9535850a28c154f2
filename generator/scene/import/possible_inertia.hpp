// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// Whether a link of a robot's description has an inertia that a body may have.
///
///     if (const auto why = impossible_inertia("arm", I, 1.5)) remark(place, *why);

#include <optional>
#include <string>

#include "scene/import/robot_pose.hpp"

namespace alembert {

/// What is told of a tensor about the mass centre that no distribution of mass has: a principal moment is
/// negative, or one is larger than the sum of the others. The moment of a body of a micrometre counts as rounding.
std::optional<std::string> impossible_inertia(const std::string& link, const Real33& own, double mass);

}  // namespace alembert
