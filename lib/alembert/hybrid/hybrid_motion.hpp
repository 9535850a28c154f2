// SPDX-License-Identifier: MIT
#pragma once

/// A motion with unilateral contacts and kicks: smooth phases, joined by impacts, releases, contacts that come to
/// rest, and impulses. The phases are modes of the automaton (automaton.hpp).
///
///     const HybridMotion motion = follow(contacts, mode_of, {1.0, 0.0}, {.duration = 3});
///     motion.contacts[0].time;                 // the first impact
///     motion.phases.back().closed;             // {0}: the ball lies
///
/// In a phase the closed contacts are constraints like any other and the open ones are watched. A phase ends where
/// a gap or a reaction falls to zero, which is located on the dense output (events.hpp); contact_transition.hpp
/// says how the next phase begins. If a gap or a reaction is zero when a phase begins, rounding must not end the
/// phase at once. A gap that opens with a speed after an impact is watched only after the time that it needs to
/// rise above rounding. A gap with zero speed, or a reaction that is zero, is compared with a small negative
/// threshold, because its sign is uncertain.
///
/// An event of the scene with impulses (Contacts::kicks) ends a phase too. The impulses of all events that are
/// zero at the instant are added and make one impact, in which closed contacts take part; then the motion goes on,
/// or ends if one of the events stops it. The zero then counts as passed: until the event's value rises above
/// rounding, it is held on the side to which its rate after the kick takes it. So rounding does not repeat the
/// event, and a return through zero is found however soon it comes. Infinitely many kicks in a finite time are a
/// failure.
///
/// Before the impulses act, the events set states. That may take the values of other events past zero, or to it
/// where they change in no other way; and multipliers jump with whatever happens (jump_zeros.hpp). These events
/// then happen at the same instant in a round of their own, which acts on what the one before has left: its
/// states, its rates after all impacts, its contacts. Each event happens once in an instant.

#include "alembert/hybrid/contact_transition.hpp"
#include "alembert/hybrid/filippov_system.hpp"
#include "alembert/ode/integrate.hpp"

namespace alembert {

/// The equations for one choice of closed contacts, ready to run.
struct ContactMode {
    System system = {};
    Events events = {};   ///< the scene's events, then one for each contact: its reaction if it is closed, its gap
                          ///< if it is open
    OnStep on_step = {};  ///< takes the place of that of the options
    std::shared_ptr<const FilippovSystem> switching = {};  ///< set if the right-hand side has jumps or kinks
};

/// Called once for each phase. The reference must stay valid.
using ContactModes = std::function<const ContactMode&(const std::vector<int>& closed)>;

struct Phase {
    std::vector<int> closed = {};
    Trajectory motion = {};  ///< with the scene's events only
};

struct HybridMotion {
    std::vector<Phase> phases = {};  ///< at least one
    std::vector<ContactEvent> contacts = {};
    std::vector<EventRecord> events = {};
    Statistics statistics = {};
    Ending ending = Ending::completed;
    std::optional<Failure> failure = {};

    double final_time() const { return phases.back().motion.times.back(); }
    std::span<const double> final_state() const { return phases.back().motion.final_state(); }
};

/// `initial` holds q, q' and the quadratures of the right-hand sides. Without contacts this is `integrate` in the
/// mode {}. The rows of all phases fall on one grid; each phase also has a row at its first and at its last
/// instant. If something fails during the run, `failure` says what, and the phases until then are kept. The
/// message of FailureKind::no_contact_mode names the contacts, those of impossible_event and endless_kicks the
/// event.
HybridMotion follow(const Contacts& contacts, const ContactModes& modes, std::vector<double> initial,
                    const Options& options);

}  // namespace alembert
