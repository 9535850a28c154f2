// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// Checks that the equations of motion have a first derivative at a state, so that they may be linearized there.
///
///     check_differentiable(residuals, split, instant, here, mechanism, equations);
///
/// The equations R = M u' − f − Aᵀλ, A u' − γ, q' = h, φ and ν (linearize.hpp; u' and λ held) have a first
/// approximation at x₀ if for each direction d that the constraints allow
///
///     F(x₀ + ε d + ε² c) = F(x₀) + ε J d + o(ε),   ε → 0 from above,   with one matrix J for all d,
///
/// whatever c is. (c is normal to the constraints: states that obey them leave the tangent to second order.) If no
/// function of the program has its argument at a point where it is not analytic (abs, sign and roots at 0, min and
/// max of equal arguments, atan2 on its cut, a division by 0 …) this is true, and nothing else is computed.
/// Otherwise F is evaluated as a series in ε (program/puiseux_series.hpp) along ±each direction, which gives
/// one-sided derivatives, and along combinations of directions: F must not jump, must have no power of ε below 1
/// and no side without a value, opposite directions must have opposite slopes, and those of combinations must be
/// linear. So x·|x|, |x|³ and max(x, 0)² at 0 are differentiable, a kink multiplied by a factor that vanishes is
/// no kink, and √x, |x|, min(x, 2x) and the force of a spring of length zero are refused. Combinations are sums
/// and differences of two directions (of up to a dozen) and random ones; a kink inside a cone that contains none
/// of these directions is not found.

#include "stability/linear/tangent.hpp"

namespace alembert {

/// `here` is the tangent at this state. Throws ModelError with the function, its place, what is wrong on which
/// side, and what to do.
void check_differentiable(const Residuals& residuals, const Split& split, const Instant<long double>& at,
                          const Tangent<long double>& here, const Mechanism& mechanism,
                          const Equations& equations);

}  // namespace alembert
