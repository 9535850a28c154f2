// SPDX-License-Identifier: MIT
#pragma once

/// A zero of an event whose value jumps.
///
///     zero_of_jump(3, event, 14.6, -5.0)->direction     // -1: it falls through zero

#include <algorithm>
#include <cmath>
#include <optional>

#include "alembert/base/tolerances.hpp"
#include "alembert/ode/events.hpp"
#include "alembert/ode/trajectory.hpp"

namespace alembert {

/// A time after t in which a value shows that it is more than rounding, and nothing bends.
inline double soon_after(double t, double duration) {
    constexpr double soon = 1e-9;  // of the duration
    return std::max(soon * duration, 64 * tolerance::epsilon * std::abs(t));
}

struct ZeroOfJump {
    double rounding = 0;     ///< values up to this are zero, besides 1e-9 of the jump
    bool may_arrive = true;  ///< whether it counts that the value comes to zero, as that of a force that ends does
};

/// Nothing where the value does not pass zero.
inline std::optional<LastZero> zero_of_jump(int index, const Event& event, double before, double after,
                                            const ZeroOfJump& rule = {}) {
    constexpr double rounding_of_jump = 1e-9;  // values of constraints are zero to rounding
    const double zero = std::max(rule.rounding, rounding_of_jump * std::abs(after - before));
    LastZero passed{.event = index, .direction = before > 0 ? -1 : 1};
    const double beyond = passed.direction * after;
    if (!(std::abs(before) > zero) || (rule.may_arrive ? beyond < -zero : !(beyond > zero))) return {};
    passed.counts = event.direction == 0 || event.direction == passed.direction;
    return passed;
}

}  // namespace alembert
