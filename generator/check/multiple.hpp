// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// Decides by normal form, and therefore with proof, whether an equation is a combination of the equations of
/// motion.
///
///     // r = Σ c_i (M u' − f − Aᵀλ)_i + Σ d_k (A u' − γ)_k, identically
///     is_multiple(residual, mechanism, equations)
///
/// It tries multiples of one equation by any function and, with up to three coordinates and no constraints, every
/// combination (Cramer's rule). False means only that no combination was found.

#include "model/formalism/equations.hpp"

namespace alembert {

bool is_multiple(const GiNaC::ex& residual, const Mechanism& mechanism, const Equations& equations);

}  // namespace alembert
