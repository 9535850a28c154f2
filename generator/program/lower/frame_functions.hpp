// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// Functions that tell where a frame of a robot is and how it moves, each as a program of its own.
///
///     for (const FunctionProgram& f : frame_functions(scene, mechanism, "hand", {.prefix = "hand"}))
///         f.name;      // "hand_pose", "hand_jacobian", …
///
/// All is along N, linear parts before angular ones, and velocities and accelerations are those of the point:
///
///     pose          3 × 4, [R r]: the columns of R are the frame's axes
///     jacobian      6 × n, J: (v, ω) = J q' in scenes where nothing moves by itself
///     velocity      (v, ω)
///     acceleration  (a, α), J q'' + J' q'
///     drift         (a, α) at q'' = 0, J' q'
///
/// and of the whole system
///
///     com           the mass centre, 3 values
///     com_jacobian  3 × n
///     momentum      linear momentum, and angular momentum about the mass centre, 6 values
///     centroidal    6 × n, A: momentum = A q' in scenes where nothing moves by itself
///     centroidal_drift   A' q', 6 values

#include "model/mechanism.hpp"
#include "program/named_function.hpp"
#include "scene/scene.hpp"

namespace alembert {

/// `place` is a name as SceneMotion::spot takes it; the names of the functions begin with `prefix`. Throws
/// ModelError for names that the scene does not have.
std::vector<FunctionProgram> frame_functions(const Scene& scene, const Mechanism& mechanism,
                                             const std::string& place, const std::string& prefix, bool fold);

/// Throws ModelError for such names at once.
void check_place(const Scene& scene, const std::string& place);

/// The names above of functions of the whole system.
const std::vector<std::string>& functions_of_masses();
/// Whether there is a mass at all; those of parameters count.
bool weighs(const Mechanism& m);
/// Throws ModelError for a scene that gives energies in place of masses, or none.
FunctionProgram mass_function(const Scene& scene, const Mechanism& mechanism, const std::string& name, bool fold);

}  // namespace alembert
