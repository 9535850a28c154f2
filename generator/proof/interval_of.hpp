// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// Intervals that contain exact numbers.
///
///     interval_of(Rational(1) / 3);                    // two neighbouring doubles
///     intervals_of(program, {.parameters = parameters});   // of each node that depends on parameters alone

#include <vector>

#include "alembert/base/interval.hpp"
#include "program/program.hpp"

namespace alembert {

Interval interval_of(const Rational& number);

/// A function of one or two arguments, with bounds of its derivative; without bounds where it has no value
/// somewhere in its arguments, as a root of what may be negative, or jumps.
Bounds bounds_of(Op op, const Bounds& a, const Bounds& b = {});

/// Where the variables of a program lie.
struct IntervalState {
    std::vector<Interval> parameters;
    Interval t = Interval::whole();
    std::vector<Interval> q = {}, qdot = {};
};

/// Of all nodes; the whole line for what has no value, and for what depends on a variable that is not given.
std::vector<Interval> intervals_of(const Program& program, const IntervalState& state);

}  // namespace alembert
