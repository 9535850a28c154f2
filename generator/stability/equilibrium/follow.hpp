// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// One branch from end to end, with the special points on it.
///
///     const Followed followed = follow(tracer, start, {.from = 0, .to = 10}, judged);

#include <functional>

#include "stability/equilibrium/branches.hpp"

namespace alembert {

struct FollowRange {
    double from = 0, to = 1;
};

struct FollowedPoint {
    TracedPoint point;
    StabilityHint judgement;
    std::optional<PointKind> kind = {};
};

struct Followed {
    std::vector<FollowedPoint> points;
    std::vector<std::pair<TracedPoint, BranchCrossing>> crossings;
    bool closed = false, cut = false;
};

/// Follows a branch from the start in both directions until the parameter leaves the range, or once around a
/// closed curve.
Followed follow(const Tracer& tracer, const TracedPoint& start, const FollowRange& range,
                const std::vector<bool>& is_angle, EnergyRate energy);

}  // namespace alembert
