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

/// A polynomial in values: monomial's value → coefficient. 0 stands for π, 1 for a plain number.
using ModularAngle = std::map<Prime, Rational>;

/// Node `id` as such a polynomial in the values of its leaves; nothing where it has too many terms. `values`: of
/// the nodes that it is made of; `pi`: the value of π.
std::optional<ModularAngle> angle_at(const Program& program, const std::vector<Prime>& values, Prime pi, int id);

}  // namespace alembert
