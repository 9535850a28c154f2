// SPDX-License-Identifier: MIT
#pragma once

/// A motion with unilateral contacts and kicks: smooth phases, strung together by impacts, releases, the coming to
/// rest, and impulses.
///
///     const PhasedMotion motion = follow(contacts, mode_of, {1.0, 0.0}, {.duration = 3});
///     motion.contacts[0].time;                 // the first impact
///     motion.phases.back().closed;             // {0}: the ball lies
///
/// In a phase the closed contacts are constraints like any other and the open ones are watched. It ends where a
/// gap comes down to zero, or a reaction from above, located on the dense output (events.hpp); settle.hpp says how
/// the next begins. A gap or a reaction that is zero when a phase begins is watched so that rounding does not end
/// it at once: a gap that has just been struck open after the time in which it rises above rounding, one without
/// speed, or a reaction without size, against a bound as far below zero as it may be uncertain.
///
/// An event of the scene with impulses (Contacts::kicks) ends a phase too. The impulses of all events that are
/// zero at the instant are added and make one impact, in which closed contacts take part; then the motion goes on,
/// or ends where one of them stops it. The zero has been passed: until it rises above rounding, the event's value
/// is on the side to which it goes by its rate after the kick. So no rounding brings the event back, and a return
/// through zero is seen however soon it comes. Kicks that come without end are a failure.

#include "alembert/integrate.hpp"
#include "alembert/settle.hpp"
#include "alembert/switching.hpp"

namespace alembert {

/// One choice of closed contacts, ready to run.
struct ContactMode {
    Rhs rhs = {};
    Events events = {};  ///< the scene's; then one for each contact: its reaction where closed, its gap where open
    std::function<Rhs()> rhs_when_stiff = {};                   ///< with the Jacobian (Options); may be empty
    std::function<void(double t, double* state)> project = {};  ///< to the constraints of the mode; may be empty
    OnStep on_step = {};                                        ///< may be empty
    Integrator by = {};                                         ///< Options::by; may be empty
    std::shared_ptr<const Switching> switching = {};            ///< where the right-hand side has jumps or kinks
};

/// Asked once for each phase. The reference stays good.
using ContactModes = std::function<const ContactMode&(const std::vector<int>& closed)>;

struct Phase {
    std::vector<int> closed = {};
    Trajectory motion = {};  ///< its events are the scene's alone
};

struct PhasedMotion {
    std::vector<Phase> phases = {};  ///< one at least
    std::vector<ContactEvent> contacts = {};
    std::vector<EventRecord> events = {};
    Statistics statistics = {};
    Ending ending = Ending::completed;
    std::optional<Failure> failure = {};

    double final_time() const { return phases.back().motion.times.back(); }
    std::span<const double> final_state() const { return phases.back().motion.final_state(); }
};

/// `initial`: q, q' and what the right-hand sides have beyond. Without contacts this is `integrate` in the mode
/// {}. Rows of all phases fall on one grid; each phase has its first and last instant besides. What fails while it
/// runs is in `failure`, with the phases until then; FailureKind::no_contact_mode names the contacts,
/// endless_kicks the event.
PhasedMotion follow(const Contacts& contacts, const ContactModes& modes, std::vector<double> initial,
                    const Options& options);

}  // namespace alembert
