// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// Routh's equations: generalized coordinates with multipliers, for holonomic and nonholonomic constraints.
///
///     const Equations equations = routh(build(scene));
///     equations.A, equations.gamma, equations.lambda

#include "model/formalism/equations.hpp"

namespace alembert {

/// d/dt ∂L/∂q' − ∂L/∂q = Q + Aᵀλ with A q' + b = 0 (Zhang & Qin, §1.6, (1-76); also named after Ferrers). Without
/// constraints these are Lagrange's equations. Throws ModelError if the scene has no coordinates.
Equations routh(const Mechanism& mechanism);
std::optional<std::string> obstacle_to_routh(const Mechanism& mechanism);

}  // namespace alembert
