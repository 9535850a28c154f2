// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// Lagrange's equations of the first kind: particles in Cartesian coordinates, constraints by multipliers.
///
///     const Equations equations = lagrange1(build(scene));     // m x'' = X + Σ λ ∂f/∂x …
///
/// Newton's law for each component of each particle; neither T nor V is used. ([energy] potential, whose forces
/// are not known, enters as −∂V/∂x.)

#include "model/formalism/steps.hpp"

namespace alembert {

/// m r'' = F + Σ λ ∂f/∂r (Zhang & Qin, §1.6, (1-82)). Throws ModelError with the obstacle if there is one.
Equations lagrange1(const Mechanism& mechanism);
/// Why the equations do not apply to a scene: some coordinate is not, up to a constant, one Cartesian coordinate
/// of one particle, or there are bodies that turn, or the scene has [energy] kinetic.
std::optional<std::string> obstacle_to_lagrange1(const Mechanism& mechanism);
/// The steps shown: the forces along each coordinate.
OwnSteps steps_of_lagrange1(const Mechanism& mechanism, const Equations& equations);

}  // namespace alembert
