// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// The scene while dry friction sticks. What sticks is held like a constraint: the sliding velocity is zero, and
/// the force of the friction is the multiplier `friction_NAME` (in a plane `friction_NAME_1` and
/// `friction_NAME_2`, along its two directions).
///
///     const Scene stuck = with_sticking(scene, {"slope"});
///
/// How large that force may become is not part of it.

#include "scene/names.hpp"

namespace alembert {

/// Without the frictions of these names, which the scene has, and with constraints in their places. Rates at the
/// start are guesses, as they need not stick there. Generalized speeds become definitions: the number of speeds
/// that a scene may have depends on its constraints.
Scene with_sticking(Scene scene, const std::vector<std::string>& frictions);

/// The names of the multipliers that take the place of a friction.
std::vector<std::string> sticking_forces(const FrictionRule& friction);

/// Those of them that stand for something else in the scene, whose names these are. Nothing can be said then of
/// the motion while this friction sticks.
std::vector<std::string> taken_forces(const FrictionRule& friction, const NameSpaces& names);

/// The frictions that stick according to a claim at `sticking`, in the order of the scene.
std::vector<std::string> sticking_in(const Claim& claim, const Scene& scene);

}  // namespace alembert
