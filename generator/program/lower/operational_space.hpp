// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// Functions of operational space (Khatib, IEEE J. Robotics and Automation 3 (1987) 43) for a frame with the
/// geometric Jacobian J, along N, linear parts before angular ones:
///
///     mobility             J M⁻¹ Jᵀ, 6 × 6: the acceleration of the frame that a wrench on it causes
///     operational_inertia  (J M⁻¹ Jᵀ)⁻¹, where the frame moves in all six directions

#include "model/mechanism.hpp"
#include "program/named_function.hpp"
#include "scene/scene.hpp"

namespace alembert {

/// The names above.
const std::vector<std::string>& functions_of_operational_space();
/// `place` is a name as SceneMotion::spot takes it; the function is called `prefix`_`name`. Throws ModelError for
/// a scene with constraints, and where the inverse does not exist at any state.
FunctionProgram operational_function(const Scene& scene, const Mechanism& mechanism, const std::string& place,
                                     const std::string& prefix, const std::string& name, bool fold);

}  // namespace alembert
