// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// The equilibria, with the verdict of `stability` where others meet one and its state is known exactly: the first
/// approximation at its numbers would decide by their last digits.
///
///     const Equilibria found = judged_equilibria(scene, options);
///     found.list[0].judgement.because;      // "one eigenvalue is zero … c' = -12.8 c^4"

#include "stability/equilibrium/equilibria.hpp"

namespace alembert {

/// Throws what `equilibria` throws.
Equilibria judged_equilibria(const Scene& scene, const EquilibriumOptions& options = {});

}  // namespace alembert
