// SPDX-License-Identifier: MIT
#pragma once

/// Events: zeros along a motion of functions g_k(t, y, y').
///
///     const Events landing = make_events({{.name = "ground", .stop = true}},
///                                        [](double, const double* y, const double*, double* g) { g[0] = y[0]; });
///     const Events from_scene = make_events(module, {}, {true, false});     // stop flags in the scene's order
///
/// An event occurs where g changes its sign, other than through a pole, or becomes exactly zero. A zero at the
/// very start (closer to it than 1e-12 of the step, or of the time) does not count. The interior of every step is
/// searched too, so that two zeros in one step are found. The search looks at three points; at the turning point
/// of a parabola through three neighbouring points if that comes near zero; and wherever the values, or the slopes
/// at the ends of the step, show that g turns back between two points after it approached zero steeply enough to
/// reach it. If g is convex towards zero (a smooth minimum, or a kink like that of |x - a| - b), this search is
/// complete. Two cases are not found: two zeros in a dip that is narrower than a quarter of the step and has flat
/// shoulders, so that neither values nor slopes show it, and a touch that rounding keeps away from zero. Shorter
/// steps (Options::longest_step, max_step of a scene) find these too. Before an event that stops the run, the step
/// is searched again up to that event, because a long step may have passed over an earlier one.
///
/// A zero is located on the dense output to a few units in the last place of t by Chandrupatla's method (Adv. Eng.
/// Software 28 (1997) 145-149: bisection and inverse quadratic interpolation), y' being the right-hand side there.
/// Events of one step come in the order of time; simultaneous ones (to 1e-12) in the order of declaration. All
/// events that are simultaneous with one that stops the run are reported. `direction` restricts the zeros to those
/// where the value grows, or falls; a touch from below counts as growing.

#include <concepts>
#include <functional>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "alembert/rhs.hpp"

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
struct Stretch {
    double start = 0;
    double end = 0;
    const double* end_state = nullptr;
    const double* end_rate = nullptr;
    const double* start_state = nullptr;  ///< these two are known for a step of adaptive methods
    const double* start_rate = nullptr;
    std::function<void(double theta, double* state)> interpolate = {};
};

/// A zero of event `index`.
struct Crossing {
    int index = 0;
    double time = 0;
    double theta = 0;    ///< (time − start) / (end − start) of the stretch
    int direction = 0;   ///< +1: the value grows through zero; −1: it falls
    bool counts = true;  ///< whether the zero has the direction of its event
};

/// In a step from `start` to `end`, events are simultaneous if their zeros are nearer to each other than this.
double simultaneous(double start, double end);

/// Follows the signs of all events along a run. Call `begin` once, then `look` for each step.
class EventWatch {
public:
    EventWatch(const Events& events, const Rhs& rhs);
    void begin(double t, const double* state, const double* rate);
    /// The zeros of the step in order, including those that do not count.
    std::vector<Crossing> look(const Stretch& step);
    long evaluations() const {
        return evaluations_;
    }  ///< evaluations of the right-hand side that the search needed

private:
    std::vector<Crossing> scan(const Stretch& step);
    bool look_again(const Stretch& step, std::vector<Crossing>& found);
    double value(const Stretch& step, int index, double theta);
    void look_at_one(const Stretch& step, int index, std::vector<Crossing>& found);
    void record(const Stretch& step, int index, double theta, int direction, std::vector<Crossing>& found) const;
    bool stops(const Crossing& crossing) const {
        return crossing.counts && events_.list[static_cast<std::size_t>(crossing.index)].stop;
    }
    void slopes_at(double t, const double* state, const double* rate, const std::vector<double>& values,
                   double length);
    std::vector<double> turning_points(const Stretch& step, int index);
    double between(const Stretch& step, int index, const double* theta, const double* g);
    double lowest(const Stretch& step, int index, double left, double g_left, double middle, double right,
                  double g_right);
    double locate(const Stretch& step, int index, double left, double g_left, double right, double g_right);

    const Events& events_;
    const Rhs& rhs_;
    double run_start_ = 0;
    long evaluations_ = 0;
    std::vector<double> state_, rate_, out_;
    std::vector<double> last_;                  ///< values at the start of the step
    std::vector<double> slope_, first_slope_;   ///< dg/dt at the end of the last step; dg/dt at the start of the
                                                ///< step that is being searched
    std::vector<double> ahead_, ahead_values_;  ///< a state a little later, and the values at it
    std::vector<int> sign_;  ///< the last sign that was not 0; it is 0 if there was none, or if an event has just
                             ///< been exactly 0
    std::vector<double> grid_;       ///< values at the points of the step, by point
    std::vector<double> theta_, g_;  ///< points and values of the event looked at
};

}  // namespace alembert
