// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// Motions with unilateral contacts or kicks measured: the row of the benchmark of a ball that bounces.
///
///     const Bounces bounces = measured_bounces(request, derived, start, first);
///     bounces.runs[0].error;
///
/// `error` is the largest of: |y − reference| / max(1, |reference|) at the end, and the same of the times of
/// impacts (those that both runs have: a loose run lays a ball down earlier), of releases, of comings to rest, of
/// kicks and of the end. The reference is the strictest run of one method, in doubles; the digits are those in
/// which another method agrees. Seconds: processor time of the whole run, impacts included.

#include "run/measure.hpp"
#include "run/options.hpp"

namespace alembert {

struct Bounces {
    std::vector<Measured> runs;
    std::vector<double> final;  ///< coordinates, then rates
    double end = 0;             ///< its time: an event may stop the motion
    int digits = 0;
    std::string by;
};

/// Throws IntegrationError where no run comes to the end.
Bounces measured_bounces(const RunOptions& request, const Derived& derived, const Start& start,
                         const State<double>& first);

}  // namespace alembert
