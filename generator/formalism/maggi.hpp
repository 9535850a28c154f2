// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// Maggi's equations: Lagrange's expressions, taken along the motions that nonholonomic constraints leave.
///
///     const Equations equations = maggi(build(scene));
///
/// The rates are q' = B u + b with as many speeds as the constraints leave; the columns of B span the kernel of
/// the constraints' rows, A B = 0, so that Bᵀ takes the multipliers out of Lagrange's equations with multipliers.
/// Energies alone are enough: bodies need not be known. The speeds are those of the scene, or the rates that
/// remain (kinematics.hpp); holonomic constraints that they do not leave out enter with their multipliers.

#include "formalism/steps.hpp"

namespace alembert {

/// Σ_i (d/dt ∂L/∂q'_i − ∂L/∂q_i − Q_i) ∂q'_i/∂u_k = 0 (Neimark & Fufaev, Dynamics of Nonholonomic Systems (1972)).
/// Throws ModelError with the obstacle where there is one.
Equations maggi(const Mechanism& mechanism);
/// A scene without coordinates, and those of `kinematics`.
std::optional<std::string> obstacle_to_maggi(const Mechanism& mechanism);
/// B, and Lagrange's expressions.
OwnSteps steps_of_maggi(const Mechanism& mechanism, const Equations& equations);

}  // namespace alembert
