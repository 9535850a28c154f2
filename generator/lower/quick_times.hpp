// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// The times at which a program's inputs change fast, found before it runs, so that no step passes over a narrow
/// pulse.
///
///     Options options{.duration = 10, .quick_times = quick_times(program, parameters, 0, 10)};
///
/// What the right-hand side and events contain of t alone (with parameters) is evaluated by itself: on some 2000
/// instants of the run, and at the zeros and turning points of every intermediate value, so that exp(-((t -
/// 5)/w)^2) is met at t = 5, where t - 5 is zero, however small w is. Times are then halved until a cubic
/// polynomial describes each value to 2 % of its range (a Gaussian of width w: pieces of about 1.3 w; a sine:
/// about 2 rad), or, at a switch, until 1e-11 of the run is left. A step may be as long as two pieces, and ends
/// where much shorter ones begin; where an input matters, adaptive methods take no longer steps anyway. Programs
/// that do not contain t cost nothing.
///
/// What is not found: pulses narrower than a 2000th of the run whose place no zero or turning point tells, and
/// those whose time depends on the state too, as in exp(-((t - x/c)/w)^2). For these there is max_step. Where more
/// than some 10⁴ pieces would be needed the result is empty: such an input changes everywhere, and steps see it.

#include <vector>

#include "alembert/quick_times.hpp"
#include "program/program.hpp"

namespace alembert {

/// From `start` to `end` (s), `parameters` as Program counts them. Throws nothing.
std::vector<QuickTime> quick_times(const Program& program, const std::vector<double>& parameters, double start,
                                   double end);

/// Parameters on which these times depend: one flag for each of Program::parameters that is independent.
std::vector<bool> parameters_of_inputs(const Program& program, std::size_t count);

}  // namespace alembert
