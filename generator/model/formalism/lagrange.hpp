// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// Lagrange's equations of the second kind, for independent coordinates.
///
///     const Equations equations = lagrange(build(scene));

#include "model/formalism/equations.hpp"

namespace alembert {

/// d/dt ∂L/∂q' − ∂L/∂q = Q (Zhang & Qin, §1.5, equations (1-45) and (1-54)). Throws ModelError with the obstacle
/// if there is one.
Equations lagrange(const Mechanism& mechanism);

/// Why the equations do not apply to a scene: it has no coordinates, or it has constraints, so that its
/// coordinates are not independent.
std::optional<std::string> obstacle_to_lagrange(const Mechanism& mechanism);

/// The left side and the forces of Lagrange's equations, whether the coordinates are independent or not.
Equations lagrange_operator(const Mechanism& mechanism);

}  // namespace alembert
