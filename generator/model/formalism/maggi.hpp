// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// Maggi's equations: Lagrange's expressions, projected on the motions that nonholonomic constraints allow.
///
///     const Equations equations = maggi(build(scene));
///
/// The rates are q' = B u + b with as many speeds as the constraints leave free. The columns of B span the kernel
/// of the constraints' rows, A B = 0, so that multiplication by Bᵀ removes the multipliers from Lagrange's
/// equations with multipliers. Only the energies are needed; the bodies need not be known. The speeds are those of
/// the scene, or the rates that remain (kinematics.hpp); holonomic constraints that they do not eliminate enter
/// with their multipliers.

#include "model/formalism/steps.hpp"

namespace alembert {

/// Σ_i (d/dt ∂L/∂q'_i − ∂L/∂q_i − Q_i) ∂q'_i/∂u_k = 0 (Neimark & Fufaev, Dynamics of Nonholonomic Systems (1972)).
/// Throws ModelError with the obstacle if there is one.
Equations maggi(const Mechanism& mechanism);
/// Why the equations do not apply to a scene: it has no coordinates, or `kinematics` has an obstacle.
std::optional<std::string> obstacle_to_maggi(const Mechanism& mechanism);
/// The steps shown: B and Lagrange's expressions.
OwnSteps steps_of_maggi(const Mechanism& mechanism, const Equations& equations);

}  // namespace alembert
