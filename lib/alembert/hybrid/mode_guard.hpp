// SPDX-License-Identifier: MIT
#pragma once

/// The values that are watched during a piece of a motion with held signs (filippov_system.hpp). The piece ends
/// when one of them reaches zero.

#include <vector>

#include "alembert/hybrid/held_guard.hpp"
#include "alembert/hybrid/sliding_field.hpp"

namespace alembert {

/// How one g_k, α_k or normal force is watched in a piece; for pairs |α|, whether the direction has turned, and
/// whether v has outgrown δ.
struct ModeGuard {
    enum class What { side, bound, idle, normal, turn, smoothing } what = What::side;
    int index;
    double sign = 1;    ///< the event's value is sign·(g or α) + offset, for α with r·offset
    double offset = 0;  ///< for normal forces, α, and g of idle functions
    HeldGuard held = {};
};

/// The start of a piece, and its latest possible end.
struct PieceSpan {
    double begin, end;
};

/// One value for each g on its side, for each α between its bounds, and for each normal force. `now` has been
/// evaluated, with its bounds, at the start of the piece; `sizes` are the largest |g_k| so far.
std::vector<ModeGuard> mode_guards(const SlidingField& now, PieceSpan span, const std::vector<double>& sizes);

/// The watched value at t, positive as long as the piece goes on. `normals` are the largest normal forces so far.
double guard_value(const ModeGuard& watched, double t, const SlidingField& at, const std::vector<double>& normals);

}  // namespace alembert
