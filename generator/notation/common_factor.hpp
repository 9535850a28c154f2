// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// What all coefficients of an equation have in common: parameters and sums of parameters, never the state.
///
///     (m1+m2)·l1²·θ1″ + m2·l1·l2·θ2″·cos(θ1−θ2) + … = l1·F·cos θ1    ↦  l1

#include "notation/factor.hpp"
#include "symbolic/fourier.hpp"

namespace alembert {

struct CommonFactor {
    Monomial monomial;
    std::vector<std::pair<Polynomial, int>> sums;
};

CommonFactor common_factor(const Fourier& lhs, const Fourier& rhs, Factorizer& factorizer);
Fourier divide(const Fourier& f, const CommonFactor& factor, Factorizer& factorizer);
Polynomial polynomial(const CommonFactor& factor);

/// Divides both sides by the sums of even powers, of the state too, that all coefficients of rates, accelerations
/// and forces share and that are positive everywhere: 1 + tan²φ, l² + x². Gives their product, or 1.
Polynomial divide_by_positive(Fourier& lhs, Fourier& rhs, Factorizer& factorizer);

}  // namespace alembert
