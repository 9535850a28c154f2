// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// A quick proof that a polynomial has no factors. Most sums in the equations of a mechanism have none.
///
///     is_surely_irreducible(a²·x² + b·x + 1, x, 1)

#include "algebra/symbolic/polynomial.hpp"

namespace alembert {

/// Is it irreducible over the rationals? `false` means that this test cannot tell. `primitive` has no monomial
/// factor and no exponent below zero, and each exponent of `variable` is a whole multiple of `unit`.
///
/// With random whole numbers for the other atoms the polynomial becomes one in `variable` only, over GF(p). If
/// that keeps its degree and is irreducible (Rabin's test: SIAM J. Comput. 9 (1980) 273), no two factors contain
/// the variable; and a factor without it would divide every coefficient, which is impossible where one of them is
/// a single term.
bool is_surely_irreducible(const Polynomial& primitive, const Atom& variable, const Rational& unit);

}  // namespace alembert
