// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// Dry friction for computations that do not support all of it.
///
///     need_given_normal_forces(mechanism, "linearize");
///     const Mechanism held = with_directions_held(mechanism, {0});

#include <string_view>
#include <vector>

#include "model/mechanism.hpp"

namespace alembert {

/// Throws ModelError with the friction's name if there is one. `who` names the computation in the message.
void need_given_normal_forces(const Mechanism& m, std::string_view who);

/// Whether any of these frictions acts in a plane, and may act while these contacts are closed: the normal force
/// of an open contact is 0.
std::vector<int> frictions_in_planes(const Mechanism& m, const std::vector<int>& closed);

/// The mechanism in which the directions of these frictions, which act in planes, follow from parameters: after
/// all others come a mode (0: it sticks, 1: it slides) and δ for each, then two numbers p for each. While it
/// sticks the direction is p; while it slides it is that of v + δ p, continued smoothly through v = 0 along the
/// unit vector p (alembert/hybrid/filippov_system.hpp).
Mechanism with_directions_held(Mechanism m, const std::vector<int>& frictions);

/// The values of these parameters for frictions that slide along their first component.
std::vector<double> directions_by_default(std::size_t frictions);

/// The mechanism without the forces of frictions that act in planes.
Mechanism without_plane_friction(Mechanism m);

}  // namespace alembert
