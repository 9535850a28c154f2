// SPDX-License-Identifier: MIT
#pragma once

/// Many motions of one system at once: from many initial states, with many sets of parameters, or both.
///
///     Ensemble ensemble{.module = load(compile(emit(program, {.batch = true}).text, "pendulum", {}).object)};
///     for (double angle : angles) ensemble.states.insert(ensemble.states.end(), {angle, 0.0});
///     const Outcomes ends = integrate(ensemble, {.duration = 10, .tolerance = 1e-12});
///     ends.state(3)[0]; ends.members[3].steps;
///
/// Explicit Runge-Kutta methods take eight members side by side (pack_run.hpp), each with its own time, step and
/// end; who is done makes room for the next. Everything else goes through `integrate` one member at a time: other
/// methods, a module emitted without `batch`, systems with constraints (each step is projected) or with events
/// that stop. All cores work. A member's result depends on nothing but the member: not on its neighbours, nor on
/// the number of threads, by any bit.
///
/// The step control is that of `integrate`, so that a member and a run by itself differ by what rounding differs.
/// A member that fails says why in its own Outcome and disturbs no other; its state is the last good one. Events
/// that do not stop, rows and Options::on_step have no place here. Throws std::invalid_argument for sizes that do
/// not fit and for options that make no sense.

#include <cstddef>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "alembert/integrate.hpp"
#include "alembert/module.hpp"

namespace alembert {

struct Ensemble {
    Module module;
    std::vector<double> states = {};      ///< count × (n + s), member by member
    std::vector<double> parameters = {};  ///< count × p; or p, for all the same; or none, the scene's own
    std::vector<double> starts = {};      ///< a time for each; empty: Options::start
    std::vector<double> durations = {};   ///< likewise
    Work work = Work::left_out;           ///< integrated: for the work balance, where energy is not conserved
    std::vector<bool> stops = {};         ///< which of the module's events end a motion; empty: none
    std::vector<std::vector<QuickTime>> quick_times = {};  ///< for each; empty: Options::quick_times
    std::vector<int> directions = {};                      ///< in which their zeros count (Event); empty: both
    int threads = 0;                                       ///< 0: as many as there are cores
    std::function<void(double fraction)> progress =
        {};  ///< told now and then how much is done, on the calling thread

    std::size_t count() const;
};

struct Outcome {
    double time = 0;  ///< the end, the event that stopped it, or the last good time
    long steps = 0, rejected = 0, evaluations = 0;
    double energy_drift = 0, work_balance = 0;  ///< drift.hpp; the second only with Work::integrated
    bool stopped = false;                       ///< by an event
    std::string failure = {};                   ///< empty: none
};

struct Outcomes {
    int dimension = 0;
    std::vector<double> states;  ///< at the end, member by member
    std::vector<Outcome> members;
    std::string method;
    bool packed = false;  ///< eight side by side
    int threads = 0;      ///< that worked

    std::span<const double> state(std::size_t member) const {
        const auto width = static_cast<std::size_t>(dimension);
        return std::span(states).subspan(member * width, width);
    }
};

Outcomes integrate(const Ensemble& ensemble, const Options& options);

}  // namespace alembert
