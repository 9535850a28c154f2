// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// Measures motions with unilateral contacts or kicks, such as the benchmark of a bouncing ball.
///
///     const Bounces bounces = measured_bounces(request, derived, start, first);
///     bounces.runs[0].error;
///
/// `error` is the largest of: |y − reference| / max(1, |reference|) at the end, and the same for the times of
/// impacts (those that both runs have, because with a loose tolerance a ball is brought to rest earlier), of
/// releases, of contacts that come to rest, of kicks and of the end. The reference is the strictest run of one
/// method, in doubles; its digits are those in which another method agrees. `seconds` is processor time of the
/// whole run, impacts included.

#include "simulate/measure.hpp"
#include "simulate/options.hpp"

namespace alembert {

struct Bounces {
    std::vector<Measured> runs;
    std::vector<double> final;  ///< coordinates, then rates
    double end = 0;             ///< the time of the end; an event may stop the motion
    int digits = 0;
    std::string by;
};

/// Throws IntegrationError if no run reaches the end.
Bounces measured_bounces(const RunOptions& request, const Derived& derived, const Start& start,
                         const State<double>& first);

}  // namespace alembert
