// SPDX-License-Identifier: MIT
#pragma once

/// Events: zeros along a motion of functions g_k(t, y, y').
///
///     const Events landing = make_events({{.name = "ground", .stop = true}},
///                                        [](double, const double* y, const double*, double* g) { g[0] = y[0]; });
///     const Events from_scene = make_events(module, {}, {true, false});     // stop flags in the scene's order
///
/// An event occurs where g changes its sign, other than through a pole, or comes to zero. A zero at the very start
/// (closer to it than 1e-12 of the step, or of the time) does not count. One at the very end of the run does, also
/// where rounding leaves it a little beyond. event_watch.hpp says how the zeros within a step are found. Events of
/// one step come in the order of time; simultaneous ones (to 1e-12) in the order of declaration. All events that
/// are simultaneous with one that stops the run are reported.
/// `direction` restricts the zeros to those where the value grows, or falls; a touch from below counts as growing.

#include <concepts>
#include <functional>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "alembert/ode/event_code.hpp"
#include "alembert/ode/rhs.hpp"

namespace alembert {

struct Event {
    std::string name;
    bool stop = false;     ///< whether the run ends there
    bool at_once = false;  ///< a zero counts however soon after the start it comes, because the value at the start
                           ///< is more than rounding
    int direction = 0;  ///< +1: only zeros where the value grows count; −1: only those where it falls; 0: both
};

struct Events {
    using Call = void (*)(const void* context, double t, const double* state, const double* rate, double* out);
    std::vector<Event> list = {};
    std::shared_ptr<const void> context = {};
    Call call = nullptr;
    EventBounds bounds = {};  ///< where they are known: nothing that an event does within a step remains unseen

    void operator()(double t, const double* state, const double* rate, double* out) const {
        call(context.get(), t, state, rate, out);
    }
};

/// The emitted events. `stop` and `direction` have one entry for each event or are empty; otherwise
/// std::invalid_argument is thrown.
Events make_events(const Module& module, const std::vector<double>& values, const std::vector<bool>& stop,
                   const std::vector<int>& direction = {});

/// Events from any function (t, state, rate, out); `out` has a place for each event in the list.
template <std::invocable<double, const double*, const double*, double*> Function>
Events make_events(std::vector<Event> list, Function function) {
    const Events::Call call = [](const void* context, double t, const double* state, const double* rate,
                                 double* out) { (*static_cast<const Function*>(context))(t, state, rate, out); };
    return {
        .list = std::move(list), .context = std::make_shared<const Function>(std::move(function)), .call = call};
}

/// A finished step, with what the search needs to know about it.
struct StepView {
    double start = 0;
    double end = 0;
    const double* end_state = nullptr;
    const double* end_rate = nullptr;
    const double* start_state = nullptr;  ///< these two are known for a step of adaptive methods
    const double* start_rate = nullptr;
    std::function<void(double theta, double* state)> interpolate = {};
    bool ends_run = false;  ///< whether no step follows
};

/// A zero of event `index`.
struct Crossing {
    int index = 0;
    double time = 0;
    double theta = 0;    ///< (time − start) / (end − start) of the stretch
    int direction = 0;   ///< +1: the value grows through zero; −1: it falls
    bool counts = true;  ///< whether the zero has the direction of its event
    double width = 0;    ///< of a touch: the value is zero to rounding as long as that before and after it
};

/// In a step from `start` to `end`, events are simultaneous if their zeros are nearer to each other than this.
double simultaneous(double start, double end);
/// How far rounding may move the time of a zero that is at t.
double uncertain_time(double t);

}  // namespace alembert
