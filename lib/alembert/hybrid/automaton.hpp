// SPDX-License-Identifier: MIT
#pragma once

/// The one driver of motions in modes. In a mode the motion is that of a smooth system, until one of the mode's
/// guards becomes zero; then it is decided in which mode the motion goes on, and from which state.
///
///     struct Bouncing {                                      // what differs from one kind of modes to the next
///         MotionState& now();                                     // time and state, which next_mode may change
///         Mode enter(Options rest, RunPiece piece);             // the mode of now, for the rest of the run
///         void collect(Trajectory part);                     // what was integrated in it
///         bool next_mode(const Hit& hit);                    // false: the run ends here
///         std::string changes() const;                       // for messages: ", with 3 impacts"
///     };
///     run_modes(bouncing, options, piece);
///
/// Such are contacts and impulsive events (hybrid_motion.cpp), dry friction and other switches
/// (filippov_system.cpp), the change from a method to another (integrate.cpp), and angles that give way to a
/// quaternion near gimbal lock (generator/simulate/charts.cpp). They nest: within one contact mode friction sticks
/// and slides, and within one piece of that the method changes.
///
/// What is the same for all of them is here alone: the rest of the run's budget and time, the rows, which all fall
/// on one grid, what a disturbed run adds after a jump, which guards have ended a piece and whether an event of
/// the run has ended all, and the message of a budget that is used up. All guards are events (events.hpp), and
/// one search looks at them all (event_watch.hpp). A value that is zero where a mode begins is held by HeldGuard.

#include <concepts>
#include <string>
#include <utility>
#include <vector>

#include "alembert/ode/integrate.hpp"

namespace alembert {

/// Where a motion is.
struct MotionState {
    double t = 0;
    std::vector<double> state = {};
    std::vector<double> late =
        {};  ///< of a disturbed run: what the next piece begins too late by (disturbance.hpp)
};

/// A mode, as it is integrated until it ends.
struct Mode {
    System system = {};
    Events guards = {};      ///< the events of the run, then the mode's own, which end it
    int own = 0;             ///< how many the latter are
    const Events* run = {};  ///< the events of the run as they were given; null: there are none
    Options options = {};    ///< the rest of the run, with what the mode changes
    RunPiece piece = {};
    Integrator integrate = {};  ///< takes the place of `integrate`; may be empty
};

/// What has ended a mode.
struct Hit {
    std::vector<int> guards = {};       ///< the mode's own that are zero, in the order in which they were found
    std::vector<LastZero> passed = {};  ///< all events of the run that are zero, each listed once
    bool stops = false;                 ///< whether one of the latter ends the run
};

template <class M>
concept Modes = requires(M& modes, const M& same, Options rest, RunPiece piece, Trajectory part, const Hit& hit) {
    { modes.now() } -> std::same_as<MotionState&>;
    { modes.enter(std::move(rest), std::move(piece)) } -> std::same_as<Mode>;
    modes.collect(std::move(part));
    { modes.next_mode(hit) } -> std::same_as<bool>;
    { same.changes() } -> std::same_as<std::string>;
};

/// What has ended this part of a motion, which then has the events of the run alone.
Hit take_hit(Trajectory& part, const Mode& mode);

/// Completes a part that ends at the end of the run but for rounding, and says why it has failed if the budget is
/// used up.
void settle_end(Trajectory& part, const Options& options, const std::string& changes);

/// The motion from `modes.now()` to the end of the run, an event that stops it, or a failure. `work` is what the
/// run has done before.
template <Modes M>
void run_modes(M& modes, const Options& options, const RunPiece& first = {}, long work = 0) {
    RunPiece piece = first;
    piece.grid = grid_of(options, first);
    for (;;) {
        MotionState& now = modes.now();
        piece.late = std::exchange(now.late, {});
        const Mode mode = modes.enter(rest_of(options, now.t, work), piece);
        Trajectory part = mode.integrate
                              ? mode.integrate(mode.system, now.state, mode.options, mode.guards, mode.piece)
                              : integrate(mode.system, now.state, mode.options, mode.guards, mode.piece);
        work += part.statistics.work;
        const Hit hit = take_hit(part, mode);
        settle_end(part, options, modes.changes());
        now.t = part.times.back();
        now.state.assign(part.final_state().begin(), part.final_state().end());
        const bool failed = part.ending == Ending::failed;
        modes.collect(std::move(part));
        if (failed || !modes.next_mode(hit)) return;
    }
}

}  // namespace alembert
