// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// The times at which a program's inputs change fast, found before it runs, so that no step passes over a narrow
/// pulse.
///
///     Options options{.duration = 10, .quick_times = quick_times(program, parameters, 0, 10)};
///
/// The parts of the right-hand side and of events that depend only on t and parameters are evaluated separately:
/// at about 2000 instants of the run, and at the zeros and turning points of every intermediate value. So
/// exp(-((t-5)/w)^2) is evaluated at t = 5, where t - 5 is zero, however small w is. The intervals between these
/// instants are then halved until a cubic polynomial describes each value to 2 % of its range (a Gaussian of width
/// w: pieces of about 1.3 w; a sine: about 2 rad), or, at a switch, until their length is 1e-11 of the run. A step
/// may be as long as two pieces, and must end where much shorter pieces begin; if an input matters, adaptive
/// methods take no longer steps anyway. Programs that do not contain t cost nothing.
///
/// Two kinds of pulses are not found: those narrower than a 2000th of the run that have no zero or turning point
/// of an intermediate value near them, and those whose time depends on the state, as in exp(-((t - x/c)/w)^2). For
/// these, use max_step. If more than about 10⁴ pieces would be needed, the result is empty: such an input changes
/// everywhere, and the step control notices it.

#include <vector>

#include "alembert/ode/input_time_scale.hpp"
#include "program/program.hpp"

namespace alembert {

/// The times between `start` and `end` (s); `parameters` are in the order of Program. Throws nothing.
std::vector<InputTimeScale> quick_times(const Program& program, const std::vector<double>& parameters,
                                        double start, double end);

/// The sudden ones, and those next to them in which the motion does not yet show what has begun: what a step
/// control needs that sees everything else by itself.
std::vector<InputTimeScale> sudden_times(const std::vector<InputTimeScale>& quick);

/// The parameters on which these times depend: one flag for each independent one of Program::parameters.
std::vector<bool> parameters_of_inputs(const Program& program, std::size_t count);

}  // namespace alembert
