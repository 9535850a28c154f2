// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// Intervals that contain exact numbers.
///
///     interval_of(Rational(1) / 3);                    // two neighbouring doubles
///     intervals_of_constants(program, parameters);     // of each node that depends on parameters alone

#include <vector>

#include "alembert/base/interval.hpp"
#include "program/program.hpp"
#include "program/quad.hpp"

namespace alembert {

Interval interval_of(const Rational& number);
/// Of a number that has been computed with 34 digits, unless it is a double itself.
Interval interval_of(Quad number);

/// Of the nodes that depend on parameters alone; of the others the whole line.
std::vector<Interval> intervals_of_constants(const Program& program, const std::vector<Interval>& parameters);

}  // namespace alembert
