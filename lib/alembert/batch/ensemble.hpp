// SPDX-License-Identifier: MIT
#pragma once

/// Many motions of one system at once: from many initial states, with many sets of parameters, or both.
///
///     Ensemble ensemble{.module = load(compile(emit(program, {.batch = true}).text, "pendulum", {}).object)};
///     for (double angle : angles) ensemble.states.insert(ensemble.states.end(), {angle, 0.0});
///     const Outcomes ends = integrate(ensemble, {.duration = 10, .tolerance = 1e-12});
///     ends.state(3)[0]; ends.members[3].steps;
///
/// Explicit Runge-Kutta methods take eight members side by side (pack_driver.hpp), each with its own time, step
/// and end; a member that has ended makes room for the next. So does `taylor` without a given step, where there
/// are series in packs. Other methods, a module emitted without `batch`, and systems with constraints (each step
/// is projected) or with events that stop go through `integrate`, one member at a time. All cores are used. A
/// member's result does not depend on its neighbours or on the number of threads, not even in the last bit.
///
/// Members that are too many for memory come one after the other (EnsembleFeed):
///
///     integrate(ensemble, EnsembleFeed{.next = [&] { return more(); }, .done = [&](auto& m, auto& o, auto y) { …
///     }}, options);
///
/// The step control is that of `integrate`, so that a member differs from a single run only by rounding; the order
/// of `taylor` side by side is the one that is best there, so that its steps are others. If a member fails, its
/// own Outcome says why and holds its last good state; the others are not affected. Events that do not stop, rows
/// and Options::on_step are not supported. Throws std::invalid_argument for sizes that do not fit and for options
/// that make no sense.

#include <cstddef>
#include <functional>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "alembert/batch/pack_series.hpp"
#include "alembert/native/module.hpp"
#include "alembert/ode/ended_events.hpp"
#include "alembert/ode/integrate.hpp"

namespace alembert {

struct Member;
struct Outcome;

struct Ensemble {
    Module module;
    std::vector<double> states = {};  ///< count × (n + s), member by member
    /// count × p; or p, the same for all; or empty for the scene's own values.
    std::vector<double> parameters = {};
    std::vector<double> starts = {};     ///< one time for each member; if empty, Options::start
    std::vector<double> durations = {};  ///< one for each member; if empty, Options::duration
    /// `integrated` gives the work balance, for systems whose energy is not conserved.
    Work work = Work::left_out;
    SeriesModule series = {};  ///< for the method taylor; with the work of loads if that is integrated
    std::shared_ptr<const PackSeries> series_packs = {};  ///< the same for eight members; may be null
    std::shared_ptr<const EventCode> event_code = {};     ///< of the module's events; may be null
    std::shared_ptr<const EventCode> place_code = {};     ///< QuickPlaces::code; may be null
    std::vector<bool> stops = {};  ///< which of the module's events end a motion; if empty, none does
    /// One list for each member; if empty, none has any.
    std::vector<std::vector<InputTimeScale>> quick_times = {};
    /// The directions in which zeros of the events count (Event); if empty, both.
    std::vector<int> directions = {};
    bool along = false;  ///< whether outcomes have extremes and means along the motion
    int threads = 0;     ///< 0 means as many as there are cores
    /// Takes the place of `integrate` where motions are not smooth, for one member at a time on each thread.
    /// `state` is that at the start, and is to become that at the end. May be empty.
    std::function<Outcome(const Member& member, std::vector<double>& state)> by = {};
    std::function<void(double fraction)> progress =
        {};  ///< called now and then on the calling thread with the share that is done

    std::size_t count() const;
};

struct Outcome {
    double time = 0;  ///< the end, the event that stopped it, or the last good time
    long steps = 0, rejected = 0, evaluations = 0;
    double energy_drift = 0,
           work_balance = 0;         ///< see energy_error.hpp; the balance is given only with Work::integrated
    bool stopped = false;            ///< whether an event stopped the motion
    std::string failure = {};        ///< empty: none
    std::vector<double> along = {};  ///< RunningExtrema::values, with Ensemble::along
    std::vector<EndedEvents::One> ended = {};  ///< where there are events, those whose functions end
};

struct Outcomes {
    int dimension = 0;
    std::vector<double> states;  ///< at the end, member by member
    std::vector<Outcome> members;
    std::string method;
    bool packed = false;  ///< whether eight members ran side by side
    int threads = 0;      ///< the number of threads that were used

    std::span<const double> state(std::size_t member) const {
        const auto width = static_cast<std::size_t>(dimension);
        return std::span(states).subspan(member * width, width);
    }
};

Outcomes integrate(const Ensemble& ensemble, const Options& options);

/// One member by itself.
struct Member {
    std::size_t index = 0;  ///< for who gives and takes it
    std::vector<double> state, parameters;
    double start = 0, duration = 0;
    /// Null for none; it must live until the member is done.
    const std::vector<InputTimeScale>* quick_times = nullptr;
};

inline const std::vector<InputTimeScale>& quick_times_of(const Member& member) {
    static const std::vector<InputTimeScale> none;
    return member.quick_times == nullptr ? none : *member.quick_times;
}

/// Gives members one after the other and takes their results. All threads call `next` and `done` at once.
struct EnsembleFeed {
    std::function<std::optional<Member>()> next;  ///< nothing: there are no more. It may wait.
    std::function<void(const Member&, const Outcome&, std::span<const double> state)> done;
    std::function<void()> breathe = {};  ///< called now and then on the calling thread
    /// How many come at the most: fewer than eight for each thread are spread evenly.
    std::size_t most = std::numeric_limits<std::size_t>::max();
};

struct Feeding {
    bool packed = false;  ///< whether eight members ran side by side
    int threads = 0;      ///< the number of threads that were used
};

/// Integrates all members of the feed. Of the ensemble the states, parameters, starts, durations, quick times and
/// `progress` are not used. What `next` and `done` throw ends the work and is thrown again.
Feeding integrate(const Ensemble& ensemble, const EnsembleFeed& feed, const Options& options);

}  // namespace alembert
