// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// Where a motion begins, as exactly as the scene says it: decimals and fractions are exact, and what follows from
/// expressions lies in the intervals.
///
///     const IntervalStart start = interval_start(mechanism, equations, doubles, {});
///     start.state[0];                 // contains the first coordinate

#include <optional>
#include <vector>

#include "alembert/base/interval.hpp"
#include "model/formalism/equations.hpp"
#include "program/lower/start.hpp"

namespace alembert {

struct IntervalStart {
    std::vector<Interval> parameters;  ///< the independent parameters
    Interval t, end;
    std::vector<Interval> state;  ///< (q, q'), or (q, u), then states
};

/// `doubles` is the same in numbers. Throws ModelError for initial values of speeds from which rates would have to
/// be found. `duration` is given if it is not the scene's.
IntervalStart interval_start(const Mechanism& mechanism, const Equations& equations, const Start& doubles,
                             std::optional<double> duration);

}  // namespace alembert
