// SPDX-License-Identifier: MIT
#pragma once

/// One integration by steps of one kind, from options that have been checked to a trajectory. `integrate` is made
/// of this; call that function.
///
///     Trajectory motion = Driver<ExplicitRK<dop853_tableau>>(system, initial, options, events, piece).go();
///     Trajectory motion = Driver<FormulaStepper<Gauss>>(system, initial, options, events, piece).go();
///
/// stepper.hpp says what a step must have, and what it may have besides.
///
/// In an accepted step, events are found first and recorded with the rows before them; an event that stops ends
/// the run. Then the other rows are recorded, and the end of the step becomes the start of the next. This class
/// throws nothing itself; failures are recorded in the trajectory.

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "alembert/base/interrupt.hpp"
#include "alembert/ode/cost_model.hpp"
#include "alembert/ode/disturbance.hpp"
#include "alembert/ode/event_watch.hpp"
#include "alembert/ode/integrate.hpp"
#include "alembert/ode/missed_feature_check.hpp"
#include "alembert/ode/recorder.hpp"
#include "alembert/ode/rounding_watch.hpp"
#include "alembert/ode/step_collapse.hpp"
#include "alembert/ode/step_size.hpp"
#include "alembert/ode/stepper.hpp"
#include "alembert/ode/stiffness_watch.hpp"
#include "alembert/ode/taylor_switch.hpp"

namespace alembert {

/// A run with one method: its step and the trajectory that it collects.
template <SomeStepper AnyStep>
class Driver {
public:
    Driver(const System& system, const std::vector<double>& initial, const Options& options, const Events& events,
           const RunPiece& piece)
        : system_(system),
          options_(options),
          piece_(piece),
          end_(options.start + options.duration),
          grid_(grid_of(options, piece)),
          events_(events),
          tolerance_(tolerance_within_rounding(options.tolerance)),
          step_(system.rhs, options.start, initial, tolerance_),
          watch_(events, system.rhs),
          places_(system.quick_places, system.rhs,
                  has_fixed_steps() ? passed_by_fixed_step : terms_left_out * tolerance_),
          rounding_(tolerance_),
          stiffness_(stable_interval(), dearer(), piece.switching.patience),
          recorder_(result_, events, sample_interval(options)),
          row_(initial.size()),
          event_rate_(initial.size()) {
        if constexpr (PlansToTheEnd<AnyStep>) step_.end_run_at(end_);
        result_.dimension = system.rhs.dimension;
        result_.names = system.rhs.names;
        result_.statistics.method = name(options.method);
        if (options.duration > 0)
            result_.times.reserve(static_cast<std::size_t>(options.duration / sample_interval(options)) + 2);
        result_.states.reserve(result_.times.capacity() * initial.size());
        if (options.when_cheaper && !AnyStep::has_fixed_step && !needs_series(options.method))
            series_.emplace(system.rhs, system.with_series, system.effort_of_series, options.tolerance);
        if (options.disturbed.seed != 0) disturbance_.emplace(options.disturbed.seed, piece.late, options.start);
        if (piece.grid && options.duration > 0)
            rows_on_grid_ +=
                static_cast<long>(std::floor((options.start - grid_) / sample_interval(options) + 1e-9));
    }

    Trajectory go() && {
        recorder_.row(options_.start, step_.state());
        if (!step_.starts_finite()) {
            const int bad = step_.worst_component();
            fail(FailureKind::not_a_number, bad,
                 fmt::format("the rate of {} is not finite at the start, t = {}; look at its equation, and at the "
                             "initial values and parameters",
                             step_.rhs().describe(bad), options_.start));
        } else {
            watch_.begin(step_.time(), step_.state(), step_.rate());
            tell(step_.time(), step_.state(), step_.rate());
            if (options_.duration > 0) steps();
        }
        result_.statistics.evaluations = evaluations();
        result_.statistics.work = work();
        return std::move(result_);
    }

private:
    static constexpr double clearly = 1.3;  ///< how much more radau must cost before the other method takes over

    long evaluations() const {
        return step_.evaluations() + watch_.evaluations() + stiffness_.evaluations() + rounding_.evaluations() +
               places_.evaluations() + further_evaluations_ + (series_ ? series_->evaluations() : 0) +
               (disturbance_ ? disturbance_->evaluations() : 0);
    }

    /// What the budget bounds: a power series counts as the evaluations that take as long.
    long work() const {
        if constexpr (KnowsSeries<AnyStep>) return evaluations() + (of_series() - 1) * step_.evaluations();
        return evaluations();
    }
    long of_series() const {
        if constexpr (KnowsSeries<AnyStep>) {
            const double times = step_.effort() / effort_of_evaluation(step_.rhs(), false);
            return std::max(1L, static_cast<long>(std::min(times, 1e6)));
        }
        return 1;
    }

    /// The predicted effort of the steps so far (cost_model.hpp), without events.
    double effort() const { return static_cast<double>(step_.evaluations()) * effort_of_call(); }
    double effort_of_call() const {
        if constexpr (KnowsSeries<AnyStep>) return step_.effort();
        return effort_of_evaluation(step_.rhs(), uses_jacobian(options_.method));
    }

    /// How many steps of this method cost as much as one of radau.
    double dearer() const {
        if (!options_.when_stiff) return 0;
        return evaluations_of_radau * effort_of_evaluation(step_.rhs(), true) /
               (step_.most_evaluations() * effort_of_call());
    }
    bool ended() const { return result_.ending != Ending::completed || result_.statistics.switched; }

    void steps() {
        if constexpr (AnyStep::has_fixed_step)
            fixed_steps();
        else if (has_fixed_steps())
            fixed_steps();
        else
            adaptive_steps();
    }

    /// An error estimate that consists of rounding does not get smaller with the step. A Taylor series has no such
    /// estimate.
    static double tolerance_within_rounding(double tolerance) {
        if constexpr (KnowsSeries<AnyStep>) return tolerance;
        return std::max(tolerance, 2 * std::numeric_limits<double>::epsilon());
    }

    double stable_interval() const {
        if constexpr (KnowsStableInterval<AnyStep>) return step_.stable_interval();
        return traits(options_.method).stable_interval;
    }

    bool has_fixed_steps() const {
        if constexpr (KnowsSeries<AnyStep>) return options_.step > 0;
        return AnyStep::has_fixed_step;
    }

    void fixed_steps() {
        const long count = std::max(1L, std::lround(std::ceil(options_.duration / options_.step * (1 - 1e-12))));
        for (long i = 1; i <= count && !ended(); ++i) {
            if (is_over_budget()) return;
            step_.attempt(i == count ? end_ : options_.start + static_cast<double>(i) * options_.step);
            if (!finish()) return fail_fixed();
            accept();
        }
    }

    void adaptive_steps() {
        const double longest = options_.longest_step > 0 ? options_.longest_step : options_.duration;
        StepSize control(AnyStep::estimate_order, PredictsLength<AnyStep>);
        double h = options_.step;
        if constexpr (KnowsSeries<AnyStep>) {
            h = step_.first_length();
        } else if (h == 0) {
            h = options_.disturbed.first_step * starting_step(step_.rhs(),
                                                              {step_.time(), step_.state(), step_.rate()},
                                                              tolerance_, AnyStep::estimate_order, longest);
            ++further_evaluations_;
        }
        double error_norm = 0;
        bool was_foreseen = true;  // the end of the try before
        while (step_.time() < end_ && !ended()) {
            ask_whether_wanted();
            const double wish = std::min(h, longest);
            h = within_quick_times(wish);
            const bool is_held = h < wish;
            if (is_over_budget()) return;
            if (h < shortest() || step_.time() + h == step_.time()) return fail_underflow(error_norm, h);
            const double reach = step_.time() + std::min(1.01 * h, longest * (1 + 1e-9));
            step_.attempt(reach < end_ ? step_.time() + h : end_);
            error_norm = step_.error_norm();
            const double noise = rounding(), allowed = std::max(tolerance_, noise);
            bool is_foreseen = true;
            if (error_norm <= allowed && !(finish() && (is_foreseen = is_foreseen_after(error_norm))))
                error_norm = HUGE_VAL;
            const bool good = error_norm <= allowed;
            if (good)
                accept();
            else
                ++result_.statistics.rejected;
            if (step_.time() < end_)
                h = next_length(control, good, error_norm / allowed * certainty(error_norm, noise));
            if (good && !ended() && is_shrinking(std::min(h, longest)))
                return change_to(*options_.when_stuck, Switch::Why::stuck, 0);
            if (good && !was_foreseen) h = std::min(h, 2 * step_.length());  // what is ahead is still there
            if (clear_part_ < 1) h = std::exchange(clear_part_, 1) * step_.length();
            was_foreseen = is_foreseen;
            if constexpr (!ChoosesLength<AnyStep>)
                if (is_held && good) h = std::max(h, wish);  // a step that was shortened on request is no forecast
        }
    }

    bool is_shrinking(double h) {
        if constexpr (!KnowsSeries<AnyStep>) return false;
        if (!options_.when_stuck || step_.time() >= end_) return false;
        if (!system_.project && !piece_.switching.may_leave_series) return false;
        double fastest = 0;
        for (int i = 0; i < result_.dimension; ++i) fastest = std::max(fastest, std::abs(step_.rate()[i]));
        return shrinking_.shrinks(h, fastest);
    }

    /// An estimate that is smaller than its rounding says nothing of the error but that it is not larger. A step
    /// length that followed it would stay where rounding has brought it by chance.
    double certainty(double error_norm, double noise) const {
        return error_norm < noise && noise > 0.01 * tolerance_ ? error_norm / noise : 1;
    }

    /// The part of the error estimate of the step that may be rounding.
    double rounding() const {
        if constexpr (KnowsRounding<AnyStep>) return step_.rounding();
        return rounding_.level(step_.length());
    }

    /// Of a step that t can distinguish.
    double shortest() const { return 16 * std::numeric_limits<double>::epsilon() * std::abs(step_.time()); }

    /// h, or less where an input changes fast.
    double within_quick_times(double h) {
        const double t = step_.time();
        if (t + h <= latest_end_) return h;  // the latest end only grows with t
        latest_end_ = latest_end(system_.quick_times, t);
        return std::min(h, std::max(latest_end_ - t, 64 * std::numeric_limits<double>::epsilon() * std::abs(t)));
    }

    double next_length(StepSize& control, bool accepted, double ratio) {
        if constexpr (ChoosesLength<AnyStep>)
            return step_.next_length(accepted, ratio);
        else
            return accepted ? control.after_accepted(step_.length(), ratio)
                            : control.after_rejected(step_.length(), ratio);
    }

    bool finish() {
        if (disturbance_)
            step_.correct([this](double t, double* state) {
                (*disturbance_)(step_.rhs(),
                                {.t = step_.time(),
                                 .h = step_.length() * share_of_changes(),
                                 .rounds_time = !needs_series(options_.method),
                                 .state = step_.state(),
                                 .rate = step_.rate()},
                                state);
                if (system_.project) system_.project(t, state);
            });
        else if (system_.project)
            step_.correct(system_.project);
        return step_.finish();
    }

    /// Whether the step has passed over nothing that the method cannot have seen, as far as that can be told. A
    /// step that is a good part of the run and has next to no error is looked at.
    bool is_foreseen_after(double error_norm) {
        if (places_.watches() && step_.length() > 64 * shortest()) {
            clear_part_ = places_.clear_part(stretch());
            if (clear_part_ < 1) return false;
        }
        if constexpr (KnowsSeries<AnyStep>) return step_.foresees_end();
        if (error_norm > next_to_none * tolerance_) return true;  // so it is for most steps
        const int places = places_within(step_.length(), options_.duration);
        return places <= 1 || is_clear(stretch(), places, step_.rhs(), tolerance_, further_evaluations_);
    }

    /// A step of fixed length cannot be divided where it passes over something; it is noted once.
    void look_for_passed_place() {
        if (!places_.watches() || result_.statistics.passed_place) return;
        if (const double part = places_.clear_part(stretch()); part < 1)
            result_.statistics.passed_place = step_.time() + part * step_.length();
    }

    /// Records rows and events of the step that has just been finished; then its end becomes the new start.
    void accept() {
        ++result_.statistics.steps;
        if (disturbance_) disturbance_->accept();
        if (has_fixed_steps()) look_for_passed_place();
        const bool is_last = piece_.on_step_view && piece_.on_step_view(stretch());
        const std::vector<Crossing> crossings = events_.list.empty() ? std::vector<Crossing>() : look_for_events();
        const auto reach = [this](const Crossing& crossing) -> const std::vector<double>& {
            add_rows_before(crossing.time);
            step_.interpolate(crossing.theta, row_.data());
            return row_;
        };
        if (const std::optional<double> time =
                recorder_.crossings(crossings, step_.time(), step_.end_time(), reach))
            return stop_at(*time);
        add_rows_before(step_.end_time());
        step_.advance();
        tell(step_.time(), step_.state(), step_.rate());
        if (step_.time() == end_) return recorder_.row(end_, step_.state());
        if (is_last) {
            result_.ending = Ending::stopped_by_event;
            return recorder_.row(step_.time(), step_.state());
        }
        look_at_cost();
    }

    /// Keeps account of what steps cost, and ends this piece of the run where the other method is likely to be
    /// faster.
    void look_at_cost() {
        if constexpr (!AnyStep::has_fixed_step && !KnowsSeries<AnyStep> && !KnowsRounding<AnyStep>)
            rounding_.look(step_.rhs(), step_.time(), step_.state(), step_.rate());
        if (!options_.when_stiff && !piece_.switching.back && !series_) return;
        cost_.add(step_.time(), effort());
        if (work() >= options_.budget) return;
        if (series_ && series_->finds_cheaper({.t = step_.time(),
                                               .y = step_.state(),
                                               .h = step_.length(),
                                               .spent = effort(),
                                               .left = end_ - step_.time()},
                                              cost_.effort_per_time()))
            return change_to(*options_.when_cheaper, Switch::Why::cheaper, 0);
        if (options_.when_stiff) {
            if (stiffness_.finds_stiff(step_.rhs(), step_.time(), step_.state(), step_.rate(), step_.length()))
                change_to(*options_.when_stiff, Switch::Why::stiff, stiffness_.largest_eigenvalue());
        } else if (piece_.switching.back) {
            if (const std::optional<Switch::Why> why = reason_to_come_back())
                change_to(*piece_.switching.back, *why, largest_eigenvalue());
        }
    }

    double largest_eigenvalue() const {
        if constexpr (KnowsEigenvalue<AnyStep>) return step_.largest_eigenvalue();
        return 0;
    }

    /// Looks at the last steps, unless they have become longer: a run with radau begins with few stages and short
    /// steps.
    std::optional<Switch::Why> reason_to_come_back() {
        constexpr double of_a_series = 8;  // of the usual orders
        constexpr long window = CostModel::window;
        const double known = traits(*piece_.switching.back).stable_interval;
        const double border = (known > 0 ? known : of_a_series) / 2;
        mild_steps_ = step_.length() * largest_eigenvalue() < border ? mild_steps_ + 1 : 0;
        if (result_.statistics.steps % window != 0) return std::nullopt;
        const double earlier = std::exchange(earlier_length_, step_.length());
        if (!(step_.length() < 1.5 * earlier)) return std::nullopt;
        if (mild_steps_ >= window) return Switch::Why::mild;
        if (piece_.switching.effort_per_time > 0 &&
            cost_.effort_per_time() > clearly * piece_.switching.effort_per_time)
            return Switch::Why::dear;
        return std::nullopt;
    }

    void change_to(Method method, Switch::Why why, double eigenvalue) {
        result_.statistics.switched = Switch{.time = step_.time(),
                                             .method = std::string(name(method)),
                                             .largest_eigenvalue = eigenvalue,
                                             .step = step_.length(),
                                             .why = why,
                                             .effort_per_time = cost_.effort_per_time()};
        recorder_.last_row(step_.time(), step_.state());
    }

    /// The part of a change of the rate, times h, that enters a step: implicit methods damp what is stiff.
    double share_of_changes() const { return 1 / (1 + step_.length() * largest_eigenvalue()); }

    StepView stretch() {
        return {.start = step_.time(),
                .end = step_.end_time(),
                .end_state = step_.end_state(),
                .end_rate = step_.end_rate(),
                .start_state = step_.state(),
                .start_rate = step_.rate(),
                .interpolate = [this](double theta, double* state) { step_.interpolate(theta, state); },
                .ends_run = step_.end_time() == end_};
    }

    std::vector<Crossing> look_for_events() { return watch_.look(stretch()); }

    /// The state there is in row_.
    void stop_at(double time) {
        step_.rhs()(time, row_.data(), event_rate_.data());
        ++further_evaluations_;
        tell(time, row_.data(), event_rate_.data());
        recorder_.stop_at(time, row_.data());
    }

    /// Records the rows of the grid up to `time`, including one at the end of a step, but not the last row of the
    /// run.
    void add_rows_before(double time) {
        const double interval = sample_interval(options_);
        for (;;) {
            const double next = grid_ + static_cast<double>(rows_on_grid_) * interval;
            if (next > time || next >= end_ - 1e-9 * interval) return;
            if (next == step_.end_time())
                std::copy_n(step_.end_state(), row_.size(), row_.begin());
            else
                step_.interpolate((next - step_.time()) / step_.length(), row_.data());
            recorder_.row(next, row_.data());
            ++rows_on_grid_;
        }
    }

    void tell(double time, const double* state, const double* rate) const {
        const auto size = static_cast<std::size_t>(result_.dimension);
        if (options_.on_step) options_.on_step(time, {state, size}, {rate, size});
    }

    bool is_over_budget() {
        const int watched = options_.when_stiff ? 1 : 0;
        if (work() + of_series() * step_.most_evaluations() + watched <= options_.budget) return false;
        fail(FailureKind::budget_used_up, -1, budget_is_used_up(options_.budget, step_.time()));
        return true;
    }

    void fail_fixed() {
        const int bad = step_.worst_component();
        if constexpr (SolvesEquations<AnyStep>)
            if (!step_.solved() && std::isfinite(step_.rate()[bad]))
                return fail(
                    FailureKind::not_a_number, -1,
                    fmt::format("the equations of {} could not be solved for the step after t = {}; take a "
                                "shorter step, or radau for a stiff system",
                                name(options_.method), step_.time()));
        fail(FailureKind::not_a_number, bad,
             fmt::format("{} is no longer finite after t = {}; take a shorter step, or an adaptive method such as "
                         "dop853",
                         step_.rhs().describe(bad), step_.time()));
    }

    void fail_underflow(double error_norm, double h) {
        if (options_.when_stuck) return change_to(*options_.when_stuck, Switch::Why::stuck, 0);
        const int worst = step_.worst_component();
        const std::string where = fmt::format("step size underflow at t = {} (step {:.3g})", step_.time(), h);
        const std::string component = step_.rhs().describe(worst);
        fail(
            FailureKind::step_underflow, worst,
            std::isfinite(error_norm)
                ? fmt::format(
                      "{}: {} is the stiffest component, its error was {:.3g} times the tolerance; there may be a "
                      "singularity here, or the tolerance is beyond double precision",
                      where, component, error_norm / tolerance_)
                : fmt::format(
                      "{}: {} or its rate is not finite, however short the step; there is a singularity here",
                      where, component));
    }

    /// Ends the run at the start of the step that failed, which becomes the last row.
    void fail(FailureKind kind, int component, std::string message) {
        const double* const state = step_.state();
        recorder_.last_row(step_.time(), state);
        result_.ending = Ending::failed;
        result_.failure = Failure{.kind = kind,
                                  .message = std::move(message),
                                  .time = step_.time(),
                                  .state = {state, state + result_.dimension},
                                  .component = component};
    }

    const System& system_;
    const Options& options_;
    const RunPiece& piece_;
    const double end_;
    const double grid_;  ///< the time from which rows are counted
    const Events& events_;
    const double tolerance_;
    AnyStep step_;
    EventWatch watch_;
    PlaceWatch places_;
    double clear_part_ = 1;  ///< of the step that was just tried
    RoundingWatch rounding_;
    StiffnessWatch stiffness_;
    CostModel cost_;
    long mild_steps_ = 0;  ///< the last steps with which the other method would be stable
    std::optional<TaylorSwitch> series_ = {};
    std::optional<Disturbance> disturbance_ = {};
    StepCollapse shrinking_;     ///< of a power series
    double earlier_length_ = 0;  ///< of the step before the last that was looked at
    Trajectory result_;
    Recorder recorder_;
    std::vector<double> row_;
    std::vector<double> event_rate_;
    long rows_on_grid_ = 1;  ///< the number of the next row; the row at the start exists already
    long further_evaluations_ = 0;
    double latest_end_ = -HUGE_VAL;  ///< the latest end of a step, as it was last computed
};

}  // namespace alembert
