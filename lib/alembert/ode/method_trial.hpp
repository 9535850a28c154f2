// SPDX-License-Identifier: MIT
#pragma once

/// Finds out by trying which of several methods integrates a long motion in the least time: each of them takes the
/// same first stretch of it, is timed there, and its error at the end of the stretch is measured.
///
///     const std::optional<MethodTrial> trial =
///         method_trial(system, initial, options, {Method::dop853, Method::verner98, Method::taylor});
///     if (trial) options.method = trial->fastest;
///
/// Nothing is tried where the whole run with `options.method` is predicted, from counts (cost_model.hpp), to take
/// less than `shortest_run_with_trial`: what a shorter run chooses depends on no clock. A trial takes 1 to 5 % of
/// the time of the run. Times are compared at the error of `options.method`: a method of order p that was more
/// exact than that would have needed (its error/that error)^(1/p) of its time. Another method is taken only if
/// that is clearly less, so that methods which are alike do not change places from run to run.
///
/// The stretch is short beside the motion. Where a method turns out slower later on, nobody looks again.

#include <functional>
#include <optional>
#include <vector>

#include "alembert/ode/options.hpp"
#include "alembert/ode/system.hpp"

namespace alembert {

/// The predicted time of the shortest runs in which methods are tried, ns.
inline constexpr double shortest_run_with_trial = 1.5e7;

/// How a method took the stretch.
struct MethodAttempt {
    Method method;
    double seconds;
    double error;  ///< the largest |y − reference| / max(1, |reference|) at its end
    int order;     ///< its time grows with error^(−1/order)
};

/// The one that takes the least time to the error of `usual`, which must be among them, or `usual` if no other is
/// clearly faster.
Method fastest_of(const std::vector<MethodAttempt>& attempts, Method usual);

struct MethodTrial {
    Method fastest;
    double until;  ///< the end of the stretch
    std::vector<MethodAttempt> attempts;
};

/// What a trial needs besides the run. All may be empty.
struct TrialSettings {
    std::function<void()> begin = {};    ///< called before each integration from the start
    std::function<double()> clock = {};  ///< in s; if empty, the processor time of this thread
};

/// `rivals` are explicit methods and taylor, which takes part if the system has a series or can make one. Nothing
/// if the run is too short, or if `options.method` fails in the stretch.
std::optional<MethodTrial> method_trial(const System& system, const std::vector<double>& initial,
                                        const Options& options, const std::vector<Method>& rivals,
                                        const TrialSettings& settings = {});

}  // namespace alembert
