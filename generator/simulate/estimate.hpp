// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// Estimates the error of a result from other runs of the same motion, and finds out whether errors grow
/// exponentially.
///
///     const ErrorEstimate estimate = error_estimate(motion, run, options, initial, components);
///     estimate.value;          // max |error| / max(1, |y|) of coordinates, rates and speeds at the end: a bound
///     estimate.scaled;         // max |error| / (how far components of its kind move)
///
/// Both are meant as bounds; tests/bench/honesty.py counts how often the true error is larger. With d the largest
/// difference from other runs,
///
///     value = 2.5 d + (4 + √steps) ε · max(1, |y(0)|/|y|)
///
/// The factor 2.5 covers the second run's own error, which d does not contain, in 95 % of runs (honesty.py). The
/// second term is the rounding of all steps, which adds up like a random walk. What amplifies rounding, such as a
/// narrow pulse or a strong force that is switched on, amplifies d as well: all other runs are disturbed by a few
/// roundings (alembert/ode/disturbance.hpp). Where d is unusually small or large beside the tolerance, so that it
/// may consist of rounding, d contains a run that differs from the first in such disturbances alone.
///
/// The distance that components of a kind move is the largest |y − y(0)| of these coordinates on the rows of the
/// run and at the ends of its steps, or the largest |u| of their speeds, in the run that moves less. Rows alone
/// may stand in step with a periodic motion, and all show it at the same place. It counts as at least the size of
/// possible rounding: 1e-12 of the largest coordinate (speed), 1e-10 of the largest of its kind (for speeds: of
/// these coordinates, divided by the duration), and 1e-16.
///
/// The second run has a tenth of the tolerance (half the step); if that takes more than four times the
/// evaluations, because rounding limits the steps, it has ten times the tolerance, and the estimate is then that
/// run's error. But for taylor its first step is half as long (twice as long): where nothing but the first steps
/// has an error, as those of abm in a free fall from rest, the same first step would leave the same error in both
/// runs. If the second run takes no more steps than the first, its errors may be the same, and a third run has
/// steps of at most half the mean length. Errors that all runs have in common (rounding of initial values and of
/// parameters, a wrong scene) remain unseen. If one of two runs ends with an impact, or an impulse, and the other
/// just before it, both are the same instant for all that is known, and the states on the same side of it are
/// compared (`at_jump`). If an event stops the runs, each has its own end, and the
/// difference of these times counts like a difference of the state. A run of fewer than 16 fixed steps is also
/// compared with one of a quarter of the step, because two such coarse runs may agree by chance.
///
/// If the estimate is 1000 times the tolerance or more, another run from an initial state at a distance of 1e-8
/// distinguishes chaos from plain accumulation: the separation of the two grows exponentially if it gains e³ or
/// more in the second half of the time in which it is below 0.01 (a power of time, k ≤ 3, gains 2^k). The Lyapunov
/// exponent is the slope of its logarithm over that half; `horizon` is the time at which the difference of the
/// first two runs reaches 0.1, found on the rows or extrapolated with the exponent.

#include <functional>
#include <optional>
#include <span>

#include "alembert/base/interval.hpp"
#include "alembert/hybrid/hybrid_motion.hpp"

namespace alembert {

struct ErrorEstimate {
    std::optional<double> value;  ///< nothing if no second run reached the end
    std::string by;
    std::optional<double> scaled;  ///< likewise
    bool at_jump = false;  ///< whether the motion ends at the instant of an impact or impulse, on one side of it
    double moved = 0;      ///< the largest |y − y(0)| of a coordinate on the rows; 0 if that is only rounding
    std::optional<double> lyapunov, horizon;  ///< only if errors grow exponentially
};

using Rerun = std::function<HybridMotion(const Options&, const std::vector<double>& initial)>;

/// The components of the state that count; they come first in the state.
struct Components {
    std::size_t coordinates = 0;  ///< the number of coordinates, which come first; speeds follow
    std::vector<int> kinds = {};  ///< a number for each component, equal for components with the same unit
    /// q' of a state at a time, if the state has speeds in place of rates; may be empty.
    std::function<void(double t, std::span<const double> state, std::span<double> rates)> rates = {};
    /// The values of all components at the ends of the steps of the last run; may be empty.
    std::function<std::vector<Interval>()> reached = {};
};

ErrorEstimate error_estimate(const HybridMotion& motion, const Rerun& run, const Options& options,
                             const std::vector<double>& initial, const Components& compared);

}  // namespace alembert
