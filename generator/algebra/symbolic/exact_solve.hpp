// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// A small linear system K x = b over rational functions of symbols, for results that are to be read.
///
///     solve_exactly({{4/3, 1/2}, {1/2, 1/3}}, {S, S/2}, number)      // x = {3/7*S, 6/7*S}
///
/// The method is Gaussian elimination in which every quotient is reduced to lowest terms at once. Sines and
/// cosines count as independent except for sin² = 1 − cos², so give all entries in single angles.

#include <ginac/ginac.h>

#include <functional>
#include <optional>
#include <vector>

namespace alembert {

using ExactRows = std::vector<GiNaC::exvector>;

/// `number` gives the value of an expression at the state in question. The pivot is the simplest expression among
/// those whose value is not small. The result is empty if no pivot is left (a singular system), or if an
/// expression grows too long to be read.
std::optional<GiNaC::exvector> solve_exactly(ExactRows K, GiNaC::exvector b,
                                             const std::function<double(const GiNaC::ex&)>& number);

/// Writes functions of sums and multiples of angles, such as cos(a − b), sin 2a, tan a, in sines and cosines of
/// single angles.
GiNaC::ex in_single_angles(const GiNaC::ex& e);

/// The quotient in lowest terms, numerator and denominator expanded; unchanged if it is too large for that.
GiNaC::ex lowest_terms(const GiNaC::ex& e);

}  // namespace alembert
