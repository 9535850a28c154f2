// SPDX-License-Identifier: MIT
#pragma once

/// What is watched during a piece of a motion with held signs (switching.hpp): where one of it comes to zero, the
/// piece ends.

#include <cmath>
#include <vector>

#include "alembert/switch_sides.hpp"

namespace alembert {

/// How one g_k, α_k or normal force is watched in a piece.
struct Watched {
    enum class What { side, bound, normal } what = What::side;
    int index;
    double sign = 1;  ///< the event's value is sign·(g or α) + offset, for α with r·offset
    double offset = 0;
    double open_until = -HUGE_VAL;  ///< before, it counts as positive, whatever rounding says
};

/// From when to when a piece may last at most.
struct PieceSpan {
    double begin, end;
};

/// Each g on its side, each α between its bounds, and each normal force. `now`: evaluated, with its bounds, where
/// the piece begins; `sizes`: the largest |g_k| so far.
std::vector<Watched> watches(const SwitchSides& now, PieceSpan span, const std::vector<double>& sizes);

/// Positive as long as the piece goes on. `normals`: the largest normal forces so far.
double watched_value(const Watched& watched, const SwitchSides& at, const std::vector<double>& normals);

}  // namespace alembert
