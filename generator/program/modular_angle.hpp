// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// The argument of a sine, cosine or exponential as a sum Σ c·x, c rational, for evaluation modulo a prime
/// (program/modular.hpp).

#include <map>
#include <optional>
#include <vector>

#include "program/prime.hpp"
#include "program/program.hpp"

namespace alembert {

/// A polynomial in values: monomial's value → coefficient. The key 0 stands for π, and 1 for a plain number.
using ModularAngle = std::map<Prime, Rational>;

/// Whether an angle of so many radians would be a high multiple of a common part with others, so that it counts as
/// an angle of its own.
inline bool is_long_angle(const Rational& radians) {
    constexpr int longest = 1000;
    return cln::denominator(radians) > longest || cln::abs(cln::numerator(radians)) > longest;
}

/// A value that is no sum or product, as an angle. One that is 0, as a constraint may hold a coordinate, is no
/// angle at all: the key 0 is taken.
ModularAngle angle_of_value(Prime value);

/// Node `id` as such a polynomial in the values of its leaves; nothing if it has too many terms. `values` are
/// those of the nodes on which it depends, `pi` the value of π. `sums` keeps the polynomials of sums for further
/// calls with the same values: in a chain, the angle of each link is that of the one before and one more.
std::optional<ModularAngle> angle_at(const Program& program, const std::vector<Prime>& values, Prime pi, int id,
                                     std::map<int, ModularAngle>& sums);

}  // namespace alembert
