// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// The common factor of all coefficients of an equation. It consists of parameters and sums of parameters, never
/// of the state.
///
///     (m1+m2)·l1²·θ1″ + m2·l1·l2·θ2″·cos(θ1−θ2) + … = l1·F·cos θ1    ↦  l1

#include "algebra/notation/factor.hpp"
#include "algebra/symbolic/fourier.hpp"

namespace alembert {

struct CommonFactor {
    Monomial monomial;
    std::vector<std::pair<Polynomial, int>> sums;
};

CommonFactor common_factor(const Fourier& lhs, const Fourier& rhs, Factorizer& factorizer);
Fourier divide(const Fourier& f, const CommonFactor& factor, Factorizer& factorizer);
Polynomial polynomial(const CommonFactor& factor);

/// Divides both sides by sums of even powers that all coefficients of rates, accelerations and forces share and
/// that are positive everywhere, such as 1 + tan²φ and l² + x²; these may depend on the state. Returns the product
/// of the divisors, or 1.
Polynomial divide_by_positive(Fourier& lhs, Fourier& rhs, Factorizer& factorizer);

}  // namespace alembert
