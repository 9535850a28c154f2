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

}  // namespace alembert
