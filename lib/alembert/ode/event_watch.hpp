// SPDX-License-Identifier: MIT
#pragma once

/// Finds the zeros of all events in each step of a run (events.hpp says which zeros count).
///
///     EventWatch watch(events, rhs);
///     watch.begin(t, state, rate);
///     for (const Crossing& crossing : watch.look(step)) …
///
/// The motion is smooth within a step, because the method has chosen the step so; an event may turn many times in
/// it, as cos(40 x) does. So each step is divided until five points with slopes describe the event
/// (five_points.hpp) wherever it may be zero. A piece in which the event stays away from zero by clearly more than
/// its interpolation error is not divided. Slopes come from the rates of the motion, so that an event that changes
/// fast is noticed although its values at the five points may look harmless.
///
/// The values of an event cannot tell of what happens between them. So where its bounds are known
/// (Events::bounds), a piece is also divided until they show, between each two points, that the event has no zero
/// there, or that it is monotone or convex or concave there. Bounds follow from the instructions of the event by
/// interval arithmetic and from the states, rates and their derivatives at the five points, of which the motion is
/// a smooth function. So a narrow pulse such as exp(-((x - a)/w)²) - b is found, however narrow it is. Where
/// bounds demand thousands of evaluations in a step and nothing is found, as for a conserved quantity, they are
/// soon not asked any more.
///
/// Within a piece, a zero lies between two points of different signs, or where the event turns back between two
/// points of the same sign: at the turning point of a parabola through three neighbouring points if that comes
/// near zero, and wherever slopes show that the event may reach zero and come back. If the event is convex towards
/// zero (a smooth minimum, or a kink like that of |x - a| - b), this search is complete. Pieces become shorter
/// than a millionth of the step at kinks, jumps and poles, and no shorter. Where the value turns back and comes to
/// zero but for rounding, it touches zero: that is one zero, whatever signs rounding gives its values there. Where
/// no bounds are known, a dip so narrow that the event is flat at all points is not found; shorter steps
/// (Options::longest_step, max_step of a scene) find it too. Before an event that stops the run, the step is
/// searched again up to that event.
///
/// A zero is located on the dense output to a few units in the last place of t by Chandrupatla's method (Adv. Eng.
/// Software 28 (1997) 145-149: bisection and inverse quadratic interpolation), y' being the right-hand side there.

#include <array>
#include <cmath>
#include <deque>
#include <vector>

#include "alembert/ode/events.hpp"
#include "alembert/ode/five_points.hpp"

namespace alembert {

/// +1, −1, or 0.
inline int side_of(double value) {
    return (value > 0) - (value < 0);
}

/// Follows the signs of all events along a run. Call `begin` once, then `look` for each step.
class EventWatch {
public:
    EventWatch(const Events& events, const Rhs& rhs);
    void begin(double t, const double* state, const double* rate);
    /// The zeros of the step in order, including those that do not count.
    std::vector<Crossing> look(const StepView& step);
    long evaluations() const {
        return evaluations_;
    }  ///< evaluations of the right-hand side that the search needed

private:
    struct Sample {
        double theta = 0;
        std::vector<double> state, rate;
        std::vector<double> value, slope;  ///< of all events; slopes with respect to θ
        bool has_slope = false;            ///< most samples need none
    };
    /// The numbers of five samples.
    using Piece = std::array<std::size_t, 5>;
    class BoundsOfPiece;

    std::vector<Crossing> scan(const StepView& step);
    bool look_again(const StepView& step, std::vector<Crossing>& found);
    void look_at_end(const StepView& step, std::vector<Crossing>& found);
    void divide(const StepView& step, const Piece& piece, int depth, const std::vector<int>& events,
                std::vector<Crossing>& found);
    bool stays_away(const StepView& step, const Piece& piece, const FivePoints& points, int index) const;
    bool shows_all(const StepView& step, const Piece& piece, const FivePoints& points, int index);
    bool is_bounded(const StepView& step, const Piece& piece, const FivePoints& points, int index) const;
    bool describes(const StepView& step, const Piece& piece, const FivePoints& points, int index);
    bool is_flat(const StepView& step, const Piece& piece, int index);
    double zero_size(const StepView& step, const Sample& sample, int index);
    double rounding(const StepView& step, int index);
    std::vector<double> rounding_at(const StepView& step, const Sample& sample);
    std::size_t new_sample();
    std::size_t sample_at(const StepView& step, double theta);
    void find_slopes(const StepView& step, const Piece& piece, const FivePoints& points);
    double ahead(const StepView& step) const;
    bool is_near_kink(const StepView& step) const;

    double value(const StepView& step, int index, double theta);
    void look_at_piece(const StepView& step, const Piece& piece, int index, std::vector<Crossing>& found);
    void record(const StepView& step, Crossing zero, std::vector<Crossing>& found);
    bool stops(const Crossing& crossing) const {
        return crossing.counts && events_.list[static_cast<std::size_t>(crossing.index)].stop;
    }
    /// A place where an event has turned back, and its value there; not a number if there is none. `width`: the
    /// value is zero to rounding as far as that on both sides.
    struct Turn {
        double theta = NAN, value = NAN, width = 0;
    };
    std::vector<Turn> turning_points(const StepView& step, int index);
    Turn at_the_end(const StepView& step, int index, std::size_t from, std::size_t to);
    Turn turns_between(const StepView& step, int index, std::size_t left);
    Turn between(const StepView& step, int index, const double* theta, const double* g);
    /// Two places in a step and the values of an event there.
    struct Bracket {
        double left, g_left, right, g_right;
    };
    Turn lowest(const StepView& step, int index, const Bracket& of, double middle);
    Turn touch(const StepView& step, int index, const Bracket& of, double at);
    void set_zeros(const StepView& step, int index, bool is_flat);
    double noise(const StepView& step, int index, double theta, double here);
    double band(const StepView& step, int index);
    double locate(const StepView& step, int index, const Bracket& of);

    const Events& events_;
    const Rhs& rhs_;
    double run_start_ = 0;
    double length_ = 0;                              ///< of the step that was last searched
    double stop_ = HUGE_VAL;                         ///< θ of the first zero in the step that stops the run
    long evaluations_ = 0, evaluations_before_ = 0;  ///< in the run, and before the step that is searched
    std::vector<double> state_, rate_, out_;
    std::deque<Sample> samples_;  ///< the first is the start of the step; `used_` of them are in use
    std::size_t used_ = 0;
    std::vector<double> ahead_, ahead_rate_;  ///< the motion a little later
    std::vector<int> all_;                    ///< the numbers of all events
    std::vector<std::vector<int>> open_;      ///< by depth: the events for which the pieces are divided
    std::vector<long> patience_;              ///< by event: evaluations of a step for what bounds alone demand
    std::vector<long> left_;                  ///< and how many are left in this step
    std::vector<double> rounding_;            ///< of the values of events; empty if not needed yet
    std::vector<int> sign_;  ///< the last sign that was not 0; it is 0 if there was none, or if an event has just
                             ///< been exactly 0
    FiveNumbers theta_five_{}, g_five_{}, slope_five_{};
    std::vector<double> theta_, g_, width_;  ///< points and values of the piece and the event looked at
    std::size_t middle_ = 0;                 ///< the sample in the middle of that piece
    double largest_ = 0;                     ///< the largest of the values
    double band_ = 0;                        ///< values up to this are zero there; not a number if not needed yet
};

}  // namespace alembert
