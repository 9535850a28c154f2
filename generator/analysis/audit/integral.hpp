// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// Finds, if that is easy, the function whose differential is a one-form up to a factor.
///
///     integral_of({1, -r, 0}, mechanism)          // x − r·φ           (dx − r dφ)
///     integral_of({y, -x, 0}, mechanism)          // x/y               (y dx − x dy, divided by y²)
///
/// The factors that are tried are 1, the reciprocals of the coefficients, of their products in pairs, of Σ xᵢ aᵢ
/// and of x² + y² (Euler's factors; Ince, Ordinary Differential Equations (1926), 2.1), sines and cosines of a
/// coordinate and their reciprocals. A closed form is integrated variable by variable, term by term: f(B)·∂B/∂x
/// with f a power, sine, cosine, exponential and the like, and by parts with a polynomial. A result is
/// differentiated again and compared by normal form. If none is found, that is no proof that there is no integral.

#include "analysis/audit/integrability.hpp"

namespace alembert {

/// The integral in coordinates, parameters and t. Variables in `frozen` (positions in the form; t is the last) are
/// constant, so that their differentials are zero.
std::optional<GiNaC::ex> integral_of(const OneForm& form, const Mechanism& mechanism,
                                     const std::vector<int>& frozen = {});

}  // namespace alembert
