// SPDX-License-Identifier: MIT
#pragma once

/// The times at which a right-hand side changes fast by its dependence on t (a narrow pulse, a switch), and how
/// short steps have to be there.
///
///     const std::vector<InputTimeScale> quick{{.from = 4.99, .to = 5.01, .enter = 0.01, .step = 0.01}};
///     latest_end(quick, 4.0);         // 5.0: a step from t = 4 ends there at the latest
///     latest_end(quick, 4.995);       // 5.005
///
/// All times are in seconds; the list is ascending, without overlaps. A step that begins before `from` ends at
/// from + enter at the latest (a switch and the beginning of a pulse have enter = 0: a step ends where they
/// begin), a step that begins inside is at most `step` long. Nothing is thrown.

#include <algorithm>
#include <cmath>
#include <vector>

namespace alembert {

struct InputTimeScale {
    double from = 0, to = 0;
    double enter = 0;        ///< how far a step that begins earlier may reach into the interval
    double step = 0;         ///< the longest step that begins inside
    bool is_switch = false;  ///< whether something jumps there
};

/// The latest end of a step from t; infinite if no such time lies ahead.
inline double latest_end(const std::vector<InputTimeScale>& quick, double t) {
    double end = HUGE_VAL;
    const auto ahead =
        std::partition_point(quick.begin(), quick.end(), [t](const InputTimeScale& q) { return q.to <= t; });
    for (auto q = ahead; q != quick.end() && q->from < end; ++q)
        end = std::min(end, t < q->from ? q->from + q->enter : t + q->step);
    return end;
}

}  // namespace alembert
