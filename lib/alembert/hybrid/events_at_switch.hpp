// SPDX-License-Identifier: MIT
#pragma once

/// The events of a run at the instant at which a sign or a knot changes its side (filippov_system.hpp).
///
///     const EventsAtSwitch before(place);           // with the sides that end
///     const EventsAtSwitch after(next_place);       // with those that follow
///     jumps(system, before, after)                  // forces that jump past zero, or to it
///     zeros_here(before, after)                     // values that touch zero, pass it or leave it here
///
/// The motion bends there, and so may an event: a saw tooth comes to zero at its tips and goes back. The search
/// within a step (ode/event_watch.hpp) sees only one half of that, and rounding may keep the tip away from zero.
/// It may also leave the end of one piece before a zero and the start of the next one behind it.

#include <vector>

#include "alembert/hybrid/filippov_system.hpp"
#include "alembert/ode/trajectory.hpp"

namespace alembert {

class EventsAtSwitch {
public:
    struct Place {
        const FilippovSystem& system;
        const FilippovMode& sides;
        const Events& events;
        double t;
        const std::vector<double>& state;
        double duration;  ///< of the run
    };
    EventsAtSwitch(const Place& place);

    /// Values now, and a short time earlier and later if the sides stayed as they are. Empty without events.
    std::vector<double> now, earlier, later;
    double short_time = 0;  ///< what that is
    double t = 0;
    std::vector<Event> list;
};

/// Those of the direction that counts, among the events that look at forces.
std::vector<LastZero> jumps(const FilippovSystem& system, const EventsAtSwitch& before,
                            const EventsAtSwitch& after);
/// A touch from below is one in the direction in which the value grows. What leaves a zero at which it has stayed
/// does not count.
std::vector<LastZero> zeros_here(const EventsAtSwitch& before, const EventsAtSwitch& after);

}  // namespace alembert
