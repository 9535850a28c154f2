// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// External wrenches on named points as parameters of a scene, and so of all functions that are emitted from it.
///
///     with_wrench(scene, "hand", "hand");     // parameters hand_fx hand_fy hand_fz hand_mx hand_my hand_mz

#include "scene/scene.hpp"

namespace alembert {

/// Adds a force at the point and a torque on its frame, along N, whose components are parameters with the value 0
/// and names that begin with `prefix`. `place` is "P" or "P@F" (program/lower/scene_motion.hpp). Throws ModelError
/// for names that the scene does not have, and for parameters that it has already.
void with_wrench(Scene& scene, const std::string& place, const std::string& prefix);

}  // namespace alembert
