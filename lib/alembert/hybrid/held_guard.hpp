// SPDX-License-Identifier: MIT
#pragma once

/// A guard whose value is zero, or nearly so, where a mode begins. Rounding must not decide at once that it is
/// passed.
///
///     const HeldGuard opening{.until = t + 1e-9};      // open until the gap has risen above rounding
///     const HeldGuard resting{.bound = 1e-12};         // zero where the value has fallen to −1e-12
///     with_guards_held(events, list, {opening, resting})

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include "alembert/ode/events.hpp"

namespace alembert {

struct HeldGuard {
    double bound = 0;          ///< is added to the value
    int side = 1;              ///< the sign of the value,
    double until = -HUGE_VAL;  ///< which it counts as having up to this time, whatever rounding says
    double band = -1;          ///< values up to this size count as zero; negative: none do

    double operator()(double t, double value) const {
        value += bound;
        if (t <= until) value = side * std::max(side * value, std::numeric_limits<double>::min());
        return std::abs(value) <= band ? 0 : value;
    }
};

/// The same events, the first of which are held.
inline Events with_guards_held(const Events& events, std::vector<Event> list, const std::vector<HeldGuard>& held) {
    Events result =
        make_events(std::move(list), [events, held](double t, const double* y, const double* rates, double* out) {
            events(t, y, rates, out);
            for (std::size_t k = 0; k < held.size(); ++k) out[k] = held[k](t, out[k]);
        });
    if (!events.bounds.exist) return result;
    result.bounds = {.exist = events.bounds.exist,
                     .of = [bounds = events.bounds, held](int k, const MotionBounds& motion) {
                         Bounds of = bounds.of(k, motion);
                         const auto i = static_cast<std::size_t>(k);
                         if (i >= held.size() || held[i].bound == 0) return of;
                         of.value = of.value + Interval{held[i].bound, held[i].bound};
                         return of;
                     }};
    return result;
}

}  // namespace alembert
