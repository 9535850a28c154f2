// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// A polynomial as a product number · monomial · Π sumᵉ, in which the sums are irreducible over the rationals.
///
///     ½·m1·l1·g + ½·m2·l1·g  ↦  ½, g·l1, (m1 + m2)¹
///
/// Every atom counts as an independent variable, also a sine or a cosine. The sums have coprime whole
/// coefficients, the first of them positive, and come in canonical order, independent of the order in which GiNaC
/// finds them.

#include <map>
#include <utility>
#include <vector>

#include "algebra/symbolic/polynomial.hpp"

namespace alembert {

struct Factorization {
    Rational unit = 1;
    Monomial monomial;
    std::vector<std::pair<Polynomial, int>> sums;  ///< sums of at least two terms, with exponents ≥ 1
};

/// Factors polynomials and remembers the results.
class Factorizer {
public:
    /// `polynomial` is not zero. If it has more than 60 terms, only a number and a monomial are taken out. A sum
    /// that is linear in no variable stays whole if its degree is high or if very many sums have been searched for
    /// factors before.
    Factorization operator()(const Polynomial& polynomial);

private:
    Factorization irreducible_factors(const Polynomial& primitive);
    void split_linear(const Polynomial& primitive, const AtomNode& linear, Factorization& result);

    int searches_ = 0;  ///< the number of searches with GiNaC
    // Results for primitive polynomials without a monomial factor.
    std::map<Polynomial, Factorization, PolynomialLess> memo_;
};

}  // namespace alembert
