// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// A small linear system K x = b over rational functions of symbols, for results that are to be read.
///
///     solve_exactly({{4/3, 1/2}, {1/2, 1/3}}, {S, S/2}, number)      // x = {3/7*S, 6/7*S}
///
/// Gaussian elimination; every quotient is in lowest terms at once. Sines and cosines count as independent but
/// for sin² = 1 − cos²: give all entries in single angles.

#include <ginac/ginac.h>

#include <functional>
#include <optional>
#include <vector>

namespace alembert {

using ExactRows = std::vector<GiNaC::exvector>;

/// `number` gives the value of an expression where the system stands; pivots are chosen by it, the simplest
/// expression among those that are not small. Nothing where no pivot is left (a singular system), or where an
/// expression grows beyond what anybody reads.
std::optional<GiNaC::exvector> solve_exactly(ExactRows K, GiNaC::exvector b,
                                             const std::function<double(const GiNaC::ex&)>& number);

/// Sines and cosines of sums and multiples as polynomials in those of single angles: cos(a − b), sin 2a, tan a.
GiNaC::ex in_single_angles(const GiNaC::ex& e);

/// In lowest terms, numerator and denominator expanded, or as it is where it is too large for that.
GiNaC::ex lowest_terms(const GiNaC::ex& e);

}  // namespace alembert
