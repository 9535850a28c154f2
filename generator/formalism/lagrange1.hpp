// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// Lagrange's equations of the first kind: particles in Cartesian coordinates, constraints by multipliers.
///
///     const Equations equations = lagrange1(build(scene));     // m x'' = X + Σ λ ∂f/∂x …
///
/// Newton's law for each component of each particle; neither T nor V is used. ([energy] potential, of which no
/// force is known, enters as −∂V/∂x.)

#include "formalism/steps.hpp"

namespace alembert {

/// m r'' = F + Σ λ ∂f/∂r (Zhang & Qin, §1.6, (1-82)). Throws ModelError with the obstacle where there is one.
Equations lagrange1(const Mechanism& mechanism);
/// What is missing, unless each coordinate is one Cartesian coordinate, up to a constant, of one particle; bodies
/// that turn; [energy] kinetic.
std::optional<std::string> obstacle_to_lagrange1(const Mechanism& mechanism);
/// The forces along each coordinate.
OwnSteps steps_of_lagrange1(const Mechanism& mechanism, const Equations& equations);

}  // namespace alembert
