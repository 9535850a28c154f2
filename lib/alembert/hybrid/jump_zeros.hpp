// SPDX-License-Identifier: MIT
#pragma once

/// Zeros of events that are passed in no time, where states are set or forces jump.
///
///     zeros_of_jump(kicks, {.t = t, .before = {mode, y}, .after = {next, z}, .set = s})   // those that pass here
///     zero_along(kicks, next, event, t, z, duration).side                              // where it goes from here
///
/// States that events set take the values of others past zero. Rates that impulses and impacts change do not:
/// `when = "x'"` is about the motion between these. A multiplier is a force, which has nothing before a jump but
/// the value before it and nothing after it but the next, whatever makes it jump: set states, a contact that
/// closes or opens, or rates. So its jump past zero, or to it, is a zero.

#include "alembert/hybrid/hybrid_motion.hpp"

namespace alembert {

/// A mode with a state, as it is integrated.
struct ModeAt {
    const ContactMode& mode;
    const std::vector<double>& state;
};

struct EventJump {
    double t = 0;
    ModeAt before, after;
    const std::vector<double>& set;  ///< the state after what events have set, before their impulses
    double duration = 0;             ///< of the run
};

/// All that pass zero, those in the direction that does not count included, in the order of the scene.
std::vector<LastZero> zeros_of_jump(const ImpulsiveEvents& kicks, const EventJump& jump);

/// The first `events` events whose values pass zero at this very instant, on whatever side of it rounding has left
/// them.
std::vector<LastZero> zeros_at(const ModeAt& here, std::size_t events, double t, double duration);

/// What becomes of the zero of an event whose value is known along the motion alone, because it holds multipliers.
PassedZero zero_along(const ModeAt& here, std::size_t event, double t, double duration);

}  // namespace alembert
