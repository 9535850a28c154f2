// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// The criteria of Routh and Hurwitz with symbolic coefficients.
///
///     hurwitz_conditions({1, a1, a2, a3})        // a1, a1*a2 - a3, a3: each > 0
///     real_frequency_conditions({1, 0, b, 0, c}) // of an even polynomial: simple roots on the axis
///     routh_array({1, a1, a2, a3})
///
/// For s^n + a₁ s^(n−1) + … + a_n Liénard and Chipart's criterion asks for a_n > 0, a_(n−2) > 0 … and for every
/// second Hurwitz determinant Δ_(n−1), Δ_(n−3) …, which halves the number of determinants (Gantmacher, The Theory
/// of Matrices II (1959), chapter XV, §13). An even polynomial e(s²) has distinct roots on the axis if and only if
/// e(u) has distinct negative roots, which is so if and only if e(s²) + s e'(s²) obeys Hurwitz's criterion
/// (Hermite and Biehler; Gantmacher, §14).

#include <ginac/ginac.h>

#include <vector>

#include "model/formalism/equations.hpp"

namespace alembert {

using SymbolicPolynomial = std::vector<GiNaC::ex>;  ///< highest power first

/// The rows of Routh's array; entries are rational functions. The array ends before a row whose first entry is
/// zero.
std::vector<std::vector<GiNaC::ex>> routh_array(const SymbolicPolynomial& polynomial);

/// Δ₁ … Δ_n of the polynomial divided by its first coefficient.
std::vector<GiNaC::ex> hurwitz_determinants(const SymbolicPolynomial& polynomial);

/// Expressions that are positive together if and only if all roots have negative real parts. The first coefficient
/// must not be zero. The expressions are numerators without squares and without factors that are positive anyway,
/// because they are in another condition or in `positive`.
std::vector<GiNaC::ex> hurwitz_conditions(const SymbolicPolynomial& polynomial,
                                          const std::vector<GiNaC::ex>& positive = {});

/// The same for the condition that the roots of a polynomial without odd powers are distinct and all on the
/// imaginary axis.
std::vector<GiNaC::ex> real_frequency_conditions(const SymbolicPolynomial& polynomial,
                                                 const std::vector<GiNaC::ex>& positive = {});

/// det(M s² + D s + P), highest power that occurs first, without the zero roots of the last `zeros` powers.
SymbolicPolynomial characteristic(const GiNaC::matrix& M, const GiNaC::matrix& D, const GiNaC::matrix& P,
                                  int zeros);

}  // namespace alembert
