// SPDX-License-Identifier: MIT
#pragma once

/// Where along t a right-hand side changes fast by itself (a narrow pulse, a switch), and how short steps have to
/// be there.
///
///     const std::vector<QuickTime> quick{{.from = 4.99, .to = 5.01, .enter = 0.01, .step = 0.01}};
///     latest_end(quick, 4.0);         // 5.0: a step from t = 4 ends there at the latest
///     latest_end(quick, 4.995);       // 5.005
///
/// All in seconds; ascending, without overlaps. A step that begins before `from` ends at from + enter at the
/// latest (a switch and the beginning of a pulse have enter = 0: a step ends where they begin), one that begins
/// inside is no longer than `step`. Throws nothing.

#include <algorithm>
#include <cmath>
#include <vector>

namespace alembert {

struct QuickTime {
    double from = 0, to = 0;
    double enter = 0;        ///< how far a step from before may reach into it
    double step = 0;         ///< the longest step from inside
    bool is_switch = false;  ///< something jumps there
};

/// The latest end of a step from t; infinite where nothing lies ahead.
inline double latest_end(const std::vector<QuickTime>& quick, double t) {
    double end = HUGE_VAL;
    const auto ahead =
        std::partition_point(quick.begin(), quick.end(), [t](const QuickTime& q) { return q.to <= t; });
    for (auto q = ahead; q != quick.end() && q->from < end; ++q)
        end = std::min(end, t < q->from ? q->from + q->enter : t + q->step);
    return end;
}

}  // namespace alembert
