// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// Converts functions of multiple angles and of sums of angles back to products, where these are shorter to read.
///
///     ½·sin(2θ)                   ↦  sin θ · cos θ
///     m1 + ½·m2 − ½·m2·cos(2θ)    ↦  m1 + m2·sin²θ
///     ½·sin(θ+ψ) + ½·sin(θ−ψ)     ↦  sin θ · cos ψ
///     cos(θ1−θ2)                  ↦  itself
///
/// The result is a polynomial in which sines and cosines count as variables.

#include <functional>

#include "algebra/symbolic/polynomial.hpp"

namespace alembert {

/// The form of a normal form (at most one sine or cosine in a term) with the least `cost`. If costs are equal, the
/// first of these is taken: products of the same degree; the sum of multiple angles; a form in which sin² or cos²
/// is eliminated.
Polynomial unfold(const Polynomial& normal_form, const std::function<int(const Polynomial&)>& cost);

}  // namespace alembert
