// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// A polynomial as a product: number · monomial · Π sumᵉ, with sums irreducible over the rationals.
///
///     ½·m1·l1·g + ½·m2·l1·g  ↦  ½, g·l1, (m1 + m2)¹
///
/// Every atom counts as an independent variable, a sine and a cosine too. The sums have coprime whole
/// coefficients, the first of them positive, and come in canonical order, whatever order GiNaC found them in.

#include <map>
#include <utility>
#include <vector>

#include "symbolic/polynomial.hpp"

namespace alembert {

struct Factorization {
    Rational unit = 1;
    Monomial monomial;
    std::vector<std::pair<Polynomial, int>> sums;  ///< at least two terms each; exponents ≥ 1
};

/// Remembers what it has factored.
class Factorizer {
public:
    /// `polynomial` is not zero. Beyond 60 terms only number and monomial are taken out. Sums that are linear in
    /// nothing stay whole where their degree is high, or when very many have been searched for factors before.
    Factorization operator()(const Polynomial& polynomial);

private:
    Factorization irreducible_factors(const Polynomial& primitive);
    void split_linear(const Polynomial& primitive, const AtomNode& linear, Factorization& result);

    int searches_ = 0;                                          ///< that went to GiNaC
    std::map<Polynomial, Factorization, PolynomialLess> memo_;  // of primitive polynomials without monomial factor
};

}  // namespace alembert
