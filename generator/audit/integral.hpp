// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// The function whose differential a one-form is, up to a factor, where it is easily found.
///
///     integral_of({1, -r, 0}, mechanism)          // x − r·φ           (dx − r dφ)
///     integral_of({y, -x, 0}, mechanism)          // x/y               (y dx − x dy, divided by y²)
///
/// Tried as factors are 1, and reciprocals of the coefficients, of their products in pairs, of Σ xᵢ aᵢ and of x² +
/// y² (Euler's factors; Ince, Ordinary Differential Equations (1926), 2.1), sines and cosines of a coordinate and
/// their reciprocals. A closed form is integrated variable by variable, term by term: f(B)·∂B/∂x with f a power,
/// sine, cosine, exponential and the like, and by parts with a polynomial. What is given has been differentiated
/// again and compared by normal form. Nothing proves that there is no integral.

#include "audit/integrability.hpp"

namespace alembert {

/// In coordinates, parameters and t. Variables (positions in the form; t is the last) in `frozen` keep their
/// value, so that their differentials are zero.
std::optional<GiNaC::ex> integral_of(const OneForm& form, const Mechanism& mechanism,
                                     const std::vector<int>& frozen = {});

}  // namespace alembert
