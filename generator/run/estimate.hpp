// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// How good a result is: its distance from a second run, and whether errors grow exponentially.
///
///     const ErrorEstimate estimate = error_estimate(motion, run, options, initial, compared);
///     estimate.value;          // max |y − y₂| / max(1, |y₂|) of coordinates and speeds at the end
///
/// The second run has a tenth of the tolerance (half the step); where that takes more than four times the evaluations, because
/// rounding limits the steps, it has ten times the tolerance, and the estimate is then that run's error. What both runs have in common
/// (rounding of initial values and of the right-hand side, a wrong scene) it cannot see. Where an event stops both runs, each has its own end,
/// and the difference of these times counts as one of the state does.
///
/// Where the estimate is 1000 times the tolerance or more, a third run from a state 1e-8 beside the first tells chaos from plain
/// accumulation: the separation of the two grows exponentially if it gains e³ or more in the second half of the time in which
/// it is below 0.01 (a power of time, k ≤ 3, gains 2^k). The Lyapunov exponent is the slope of its logarithm over that half;
/// `horizon` is the time at which the difference of the first two runs reaches 0.1, found on the rows or extrapolated with the exponent.

#include <functional>
#include <optional>

#include "alembert/phases.hpp"

namespace alembert {

struct ErrorEstimate {
    std::optional<double> value;  ///< nothing where no second run came to the end
    std::string by;
    std::optional<double> lyapunov, horizon;  ///< only where errors grow exponentially
    bool trusted = true;                      ///< two digits at least, as far as can be told
};

using Rerun = std::function<PhasedMotion(const Options&, const std::vector<double>& initial)>;

/// `compared`: how many of the state's components, from the first, count.
ErrorEstimate error_estimate(const PhasedMotion& motion, const Rerun& run, const Options& options, const std::vector<double>& initial,
                             std::size_t compared);

}  // namespace alembert
