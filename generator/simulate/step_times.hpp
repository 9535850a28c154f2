// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// What steps take on this processor, beside what is predicted from counts (cost_model.hpp, taylor.hpp).
///
///     const Slowness here = slowness_here();                 // by which predicted times are multiplied
///
/// It is measured once, which takes 20 to 30 ms, on two small systems with code in memory: a double
/// pendulum, which has sines, and four bodies that attract each other, which have roots and quotients. The factors
/// are kept in the cache of compiled solvers for this processor, so that later runs choose alike. Where there is
/// no such cache or no code in memory, they are those of processors with the same registers (cost_model.hpp).

#include <functional>
#include <optional>
#include <vector>

#include "alembert/ode/options.hpp"
#include "alembert/ode/rhs.hpp"
#include "alembert/ode/trajectory.hpp"

namespace alembert {

/// Nothing is measured a second time in one process.
Slowness slowness_here();

/// The same, measured now; nothing without code in memory.
std::optional<Slowness> measured_slowness();

/// ns of processor time for each of what `count` counts, the least of runs of so many seconds in all, five at
/// least; nothing if a run fails or has less than eight steps, of which the start is too large a part.
std::optional<double> least_time(const Rhs& rhs, const std::vector<double>& state, Options options,
                                 const std::function<long(const Statistics&)>& count, double seconds);

}  // namespace alembert
