// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// Powers of sums and differences that were multiplied out, written as powers again.
///
///     x1² − 2·x1·x2 + x2² + y² − l²    ↦  (x1−x2)²,  y²,  −l²
///     u1³ − … − 3·u2·u3² …             ↦  (u1−u2)³,  (u2−u3)³

#include <vector>

#include "symbolic/polynomial.hpp"

namespace alembert {

/// Parts whose sum is `polynomial`: powers rest·(x ± s·y)ⁿ of two symbols, not both of them parameters, n from 2
/// to 6, s rational, and the terms that are left, one by one. Empty where no power makes the sum shorter by a
/// term. The powers come multiplied out, for the factorizer to find them.
std::vector<Polynomial> powers_of_differences(const Polynomial& polynomial);

}  // namespace alembert
