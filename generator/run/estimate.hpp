// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// How good a result is, from other runs of the same motion, and whether errors grow exponentially.
///
///     const ErrorEstimate estimate = error_estimate(motion, run, options, initial, components);
///     estimate.value;          // max |error| / max(1, |y|) of coordinates, rates and speeds at the end: a bound
///     estimate.scaled;         // max |error| / (how far components of its kind move)
///
/// Both are meant as bounds: tests/bench/honesty.py counts how often the true error is larger. With d the largest
/// difference to a second run,
///
///     value = 2.5 d + (4 + √steps) ε · max(1, |y(0)|/|y|)
///
/// The factor 2.5 stands for the second run's own error, which d leaves out, in 95 % of runs (honesty.py). The
/// rest is what rounding makes of every step, like a random walk; what amplifies it amplifies d as well.
///
/// How far components of a kind move is the largest |y − y(0)| of these coordinates on the rows of the run, and
/// the largest |u| of their speeds, in the run that moves less. No motion counts as smaller than what rounding may
/// be: 1e-12 of the largest coordinate (speed), 1e-10 of the largest of its kind (for speeds: of these
/// coordinates, a duration), 1e-16.
///
/// The second run has a tenth of the tolerance (half the step); where that takes more than four times the
/// evaluations, because rounding limits the steps, it has ten times the tolerance, and the estimate is then that
/// run's error. Where it takes no more steps than the first, its errors may be the same ones, and a third run has
/// steps of at most half the mean length. What all runs have in common (rounding of initial values and of the
/// right-hand side, a wrong scene) they cannot show. Where an event stops the runs, each has its own end, and the
/// difference of these times counts as one of the state does. A run of fewer than 16 fixed steps is held against
/// one of a quarter of the step too, as two so coarse runs may agree by chance.
///
/// Where the estimate is 1000 times the tolerance or more, another run from a state 1e-8 beside the first tells
/// chaos from plain accumulation: the separation of the two grows exponentially if it gains e³ or more in the
/// second half of the time in which it is below 0.01 (a power of time, k ≤ 3, gains 2^k). The Lyapunov exponent is
/// the slope of its logarithm over that half; `horizon` is the time at which the difference of the first two runs
/// reaches 0.1, found on the rows or extrapolated with the exponent.

#include <functional>
#include <optional>
#include <span>

#include "alembert/phases.hpp"

namespace alembert {

struct ErrorEstimate {
    std::optional<double> value;  ///< nothing where no second run came to the end
    std::string by;
    std::optional<double> scaled;  ///< likewise
    double moved = 0;  ///< the largest |y − y(0)| of a coordinate on the rows; 0 where that is rounding
    std::optional<double> lyapunov, horizon;  ///< only where errors grow exponentially
};

using Rerun = std::function<PhasedMotion(const Options&, const std::vector<double>& initial)>;

/// The state's components that count, from the first.
struct Components {
    std::size_t coordinates = 0;  ///< the first of them; speeds follow
    std::vector<int> kinds = {};  ///< a number for each; equal where they have a unit in common
    /// q' of a state at a time, where the state has speeds in place of rates; may be empty.
    std::function<void(double t, std::span<const double> state, std::span<double> rates)> rates = {};
};

ErrorEstimate error_estimate(const PhasedMotion& motion, const Rerun& run, const Options& options,
                             const std::vector<double>& initial, const Components& compared);

}  // namespace alembert
