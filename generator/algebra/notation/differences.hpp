// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// Writes powers of sums and differences that were multiplied out as powers again.
///
///     x1² − 2·x1·x2 + x2² + y² − l²    ↦  (x1−x2)²,  y²,  −l²
///     u1³ − … − 3·u2·u3² …             ↦  (u1−u2)³,  (u2−u3)³
///     x² − 10·x + y² + 26              ↦  (x−5)²,  y²,  1
///
/// and differences of sines, as springs between two turning bodies give them, as products:
///
///     k·sin θ·cos θ − k·sin φ·cos θ + m·g·sin θ    ↦  k·cos θ·(sin θ−sin φ),  m·g·sin θ

#include <vector>

#include "algebra/symbolic/polynomial.hpp"

namespace alembert {

/// Parts whose sum is `polynomial`: powers rest·(x ± s·y)ⁿ of two symbols that are not both parameters, with n
/// from 2 to 6 and s rational, squares of a symbol and a number, and the remaining terms one by one. The list is
/// empty if no power makes the sum shorter by a term. The powers are given multiplied out; the factorizer will
/// find them.
std::vector<Polynomial> powers_of_differences(const Polynomial& polynomial);

/// Parts whose sum is `polynomial`: pairs of terms that differ in sign and in the argument of one sine or one
/// cosine, and the remaining terms one by one. The list is empty if there is no such pair.
std::vector<Polynomial> differences_of_waves(const Polynomial& polynomial);

/// sin θ − sin φ or cos θ − cos φ of two variables, or the opposite.
bool is_difference_of_waves(const Polynomial& polynomial);

}  // namespace alembert
