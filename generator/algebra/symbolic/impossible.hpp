// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// Proves that expressions cannot all be positive at once: a sum of them, with positive factors, and of what is
/// never negative, is a number that is not positive (a certificate of Farkas; its factors are found by the simplex
/// method in exact numbers).
///
///     is_impossible({x - a, -x - a}, {a})          // true: their sum is -2 a

#include <ginac/ginac.h>

#include <vector>

namespace alembert {

/// `above_zero`: symbols that are positive. Squares, absolute values, roots and exponentials are never negative,
/// and sines and cosines lie between -1 and 1. False where no proof of this kind was found.
bool is_impossible(const std::vector<GiNaC::ex>& positive, const std::vector<GiNaC::symbol>& above_zero);

}  // namespace alembert
