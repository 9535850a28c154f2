// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// Lagrange's equations of the second kind, for independent coordinates.
///
///     const Equations equations = lagrange(build(scene));

#include "formalism/equations.hpp"

namespace alembert {

/// d/dt ∂L/∂q' − ∂L/∂q = Q (Zhang & Qin, §1.5, equations (1-45) and (1-54)).
/// Throws ModelError if the scene has no coordinates.
Equations lagrange(const Mechanism& mechanism);

}  // namespace alembert
