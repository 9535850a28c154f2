// SPDX-License-Identifier: MIT
#include "alembert/integrate.hpp"

#include <ctime>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <stdexcept>

#include <fmt/format.h>

#include "alembert/dop853.hpp"
#include "alembert/error.hpp"
#include "alembert/step.hpp"
#include "alembert/step_size.hpp"
#include "alembert/tableau.hpp"

namespace alembert {
namespace {

constexpr double epsilon = std::numeric_limits<double>::epsilon();
constexpr double most_rows = 1e8;
constexpr double most_steps = 1e15;  // what is told apart in t

double thread_seconds() {
    timespec now{};
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
    return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

double sample_interval(const Options& options) {
    return options.sample > 0 ? options.sample : options.duration / 200;
}

void check(bool good, const std::string& message) {
    if (!good) throw std::invalid_argument(message);
}

void check_options(const Rhs& rhs, const std::vector<double>& initial, const Options& options) {
    const auto number = [](const char* key, double value, bool good, const char* wanted) {
        check(std::isfinite(value) && good, fmt::format("{} = {}: {}", key, value, wanted));
    };
    check(initial.size() == static_cast<std::size_t>(rhs.dimension),
          fmt::format("the state has {} components, {} initial values were given", rhs.dimension, initial.size()));
    number("start", options.start, true, "a finite number is needed");
    number("duration", options.duration, options.duration >= 0, "a finite number, zero or more, is needed");
    number("end", options.start + options.duration, true, "start + duration must be finite");
    number("tolerance", options.tolerance, options.tolerance > 0, "a finite positive number is needed");
    number("step", options.step, options.step >= 0, "a finite number, zero or more, is needed");
    number("longest_step", options.longest_step, options.longest_step >= 0,
           "a finite number, zero or more, is needed");
    number("sample", options.sample, options.sample >= 0, "a finite number, zero or more, is needed");
    check(options.budget > 0, fmt::format("budget = {}: at least one right-hand side is needed", options.budget));
    check(!has_fixed_step(options.method) || options.step > 0 || options.duration == 0,
          fmt::format("{} has a fixed step: give it, for example step = {:g}", name(options.method),
                      options.duration / 1000));
    check(!has_fixed_step(options.method) || options.duration == 0 || options.duration / options.step < most_steps,
          fmt::format("step = {}: more than {:g} steps", options.step, most_steps));
    check(options.duration == 0 || options.duration / sample_interval(options) < most_rows,
          fmt::format("sample = {}: more than {:g} rows", options.sample, most_rows));
}

/// A run with one method: its step, and what is collected on the way.
template <const auto& tableau>
class Run {
public:
    Run(const Rhs& rhs, const std::vector<double>& initial, const Options& options, const Events& events)
        : options_(options),
          end_(options.start + options.duration),
          events_(events),
          step_(rhs, options.start, initial),
          watch_(events, rhs),
          row_(initial.size()),
          event_rate_(initial.size()) {
        result_.dimension = rhs.dimension;
        result_.names = rhs.names;
        result_.statistics.method = name(options.method);
        if (options.duration > 0)
            result_.times.reserve(static_cast<std::size_t>(options.duration / sample_interval(options)) + 2);
        result_.states.reserve(result_.times.capacity() * initial.size());
    }

    Trajectory go() && {
        add_row(options_.start, step_.state());
        if (!step_.starts_finite()) {
            const int bad = step_.worst_component();
            fail(FailureKind::not_a_number, bad,
                 fmt::format(
                     "the rate of {} is not finite at the start, t = {:.17g}; look at its equation, and at the "
                     "initial values and parameters",
                     step_.rhs().describe(bad), options_.start));
        } else if (options_.duration > 0) {
            watch_.begin(step_.time(), step_.state(), step_.rate());
            tell(step_.time(), step_.state(), step_.rate());
            if constexpr (tableau.error_rows == 0)
                fixed_steps();
            else
                adaptive_steps();
        }
        result_.statistics.evaluations = evaluations();
        return std::move(result_);
    }

private:
    long evaluations() const { return step_.evaluations() + watch_.evaluations() + further_evaluations_; }
    bool ended() const { return result_.ending != Ending::completed; }

    void fixed_steps() {
        const long count = std::max(1L, std::lround(std::ceil(options_.duration / options_.step * (1 - 1e-12))));
        for (long i = 1; i <= count && !ended(); ++i) {
            if (is_over_budget()) return;
            step_.attempt(i == count ? end_ : options_.start + static_cast<double>(i) * options_.step);
            if (!step_.finish()) return fail_fixed();
            accept();
        }
    }

    void adaptive_steps() {
        const double longest = options_.longest_step > 0 ? options_.longest_step : options_.duration;
        StepSize control(tableau.estimate_order);
        double h = options_.step;
        if (h == 0) {
            h = starting_step(step_.rhs(), step_.time(), step_.state(), step_.rate(), options_.tolerance,
                              tableau.estimate_order, longest);
            ++further_evaluations_;
        }
        double misfit = 0;
        while (step_.time() < end_ && !ended()) {
            h = std::min(h, longest);
            if (is_over_budget()) return;
            if (h < 16 * epsilon * std::abs(step_.time()) || step_.time() + h == step_.time())
                return fail_underflow(misfit, h);
            step_.attempt(step_.time() + 1.01 * h < end_ ? step_.time() + h : end_);
            misfit = step_.misfit();
            if (misfit <= options_.tolerance && !step_.finish()) misfit = HUGE_VAL;
            if (misfit <= options_.tolerance) {
                h = control.after_accepted(step_.length(), misfit / options_.tolerance);
                accept();
            } else {
                h = control.after_rejected(step_.length(), misfit / options_.tolerance);
                ++result_.statistics.rejected;
            }
        }
    }

    /// Rows and events of the step that has just been finished; then its end is the new start.
    void accept() {
        ++result_.statistics.steps;
        const std::vector<Crossing> crossings = events_.list.empty() ? std::vector<Crossing>() : look_for_events();
        for (const Crossing& crossing : crossings) {
            add_rows_before(crossing.time);
            step_.interpolate(crossing.theta, row_.data());
            const Event& event = events_.list[static_cast<std::size_t>(crossing.index)];
            result_.events.push_back(
                {.index = crossing.index, .name = event.name, .time = crossing.time, .state = row_});
            if (event.stop) return stop_at(crossing.time);
        }
        add_rows_before(step_.end_time());
        step_.advance();
        tell(step_.time(), step_.state(), step_.rate());
        if (step_.time() == end_) add_row(end_, step_.state());
    }

    std::vector<Crossing> look_for_events() {
        return watch_.look(
            {.start = step_.time(),
             .end = step_.end_time(),
             .end_state = step_.end_state(),
             .end_rate = step_.end_rate(),
             .interpolate = [this](double theta, double* state) { step_.interpolate(theta, state); }});
    }

    /// The state there is in row_.
    void stop_at(double time) {
        step_.rhs()(time, row_.data(), event_rate_.data());
        ++further_evaluations_;
        tell(time, row_.data(), event_rate_.data());
        if (rows_on_grid_ > 1 && result_.times.back() > time - 1e-9 * sample_interval(options_)) drop_row();
        if (result_.times.back() < time) add_row(time, row_.data());
        result_.ending = Ending::stopped_by_event;
    }

    /// Rows of the grid up to `time`, the end of a step included; the very last row is not one of them.
    void add_rows_before(double time) {
        const double interval = sample_interval(options_);
        for (;;) {
            const double next = options_.start + static_cast<double>(rows_on_grid_) * interval;
            if (next > time || next >= end_ - 1e-9 * interval) return;
            if (next == step_.end_time())
                std::copy_n(step_.end_state(), row_.size(), row_.begin());
            else
                step_.interpolate((next - step_.time()) / step_.length(), row_.data());
            add_row(next, row_.data());
            ++rows_on_grid_;
        }
    }

    void add_row(double time, const double* state) {
        result_.times.push_back(time);
        result_.states.insert(result_.states.end(), state, state + result_.dimension);
    }

    void drop_row() {
        result_.times.pop_back();
        result_.states.resize(result_.states.size() - row_.size());
    }

    void tell(double time, const double* state, const double* rate) const {
        const auto size = static_cast<std::size_t>(result_.dimension);
        if (options_.on_step) options_.on_step(time, {state, size}, {rate, size});
    }

    bool is_over_budget() {
        if (evaluations() + tableau.all_stages <= options_.budget) return false;
        fail(FailureKind::budget_used_up, -1,
             fmt::format("{} right-hand sides were not enough to come further than t = {:.17g}; raise the budget "
                         "(--budget), loosen the tolerance or shorten the duration",
                         options_.budget, step_.time()));
        return true;
    }

    void fail_fixed() {
        const int bad = step_.worst_component();
        fail(FailureKind::not_a_number, bad,
             fmt::format(
                 "{} is no longer finite after t = {:.17g}; take a shorter step, or an adaptive method such as "
                 "dop853",
                 step_.rhs().describe(bad), step_.time()));
    }

    void fail_underflow(double misfit, double h) {
        const int worst = step_.worst_component();
        const std::string where = fmt::format("step size underflow at t = {:.17g} (step {:.3g})", step_.time(), h);
        const std::string component = step_.rhs().describe(worst);
        fail(
            FailureKind::step_underflow, worst,
            std::isfinite(misfit)
                ? fmt::format(
                      "{}: {} is the stiffest component, its error was {:.3g} times the tolerance; there may be a "
                      "singularity here, or the tolerance is beyond double precision",
                      where, component, misfit / options_.tolerance)
                : fmt::format(
                      "{}: {} or its rate is not finite, however short the step; there is a singularity here",
                      where, component));
    }

    /// Ends the run at the start of the step that failed, which becomes the last row.
    void fail(FailureKind kind, int component, std::string message) {
        const double* const state = step_.state();
        if (result_.times.back() < step_.time()) add_row(step_.time(), state);
        result_.ending = Ending::failed;
        result_.failure = Failure{.kind = kind,
                                  .message = std::move(message),
                                  .time = step_.time(),
                                  .state = {state, state + result_.dimension},
                                  .component = component};
    }

    const Options& options_;
    const double end_;
    const Events& events_;
    Step<tableau> step_;
    EventWatch watch_;
    Trajectory result_;
    std::vector<double> row_;
    std::vector<double> event_rate_;
    long rows_on_grid_ = 1;  ///< the start is there
    long further_evaluations_ = 0;
};

template <const auto& tableau>
Trajectory run(const Rhs& rhs, const std::vector<double>& initial, const Options& options, const Events& events) {
    return Run<tableau>(rhs, initial, options, events).go();
}

struct MethodEntry {
    Method method;
    std::string_view name;
    bool fixed_step;
    Trajectory (*run)(const Rhs&, const std::vector<double>&, const Options&, const Events&);
};

constexpr std::array<MethodEntry, 4> methods = {{{Method::euler, "euler", true, run<euler_tableau>},
                                                 {Method::rk4, "rk4", true, run<rk4_tableau>},
                                                 {Method::dopri5, "dopri5", false, run<dopri5_tableau>},
                                                 {Method::dop853, "dop853", false, run<dop853_tableau>}}};

const MethodEntry& entry(Method method) {
    return methods[static_cast<std::size_t>(method)];
}

}  // namespace

std::string_view name(Method method) {
    return entry(method).name;
}

std::optional<Method> method_named(std::string_view name) {
    const auto found =
        std::find_if(methods.begin(), methods.end(), [&](const auto& one) { return one.name == name; });
    return found != methods.end() ? std::optional(found->method) : std::nullopt;
}

bool has_fixed_step(Method method) {
    return entry(method).fixed_step;
}

Trajectory integrate(const Rhs& rhs, const std::vector<double>& initial, const Options& options,
                     const Events& events) {
    check_options(rhs, initial, options);
    const double start = thread_seconds();
    Trajectory result = entry(options.method).run(rhs, initial, options, events);
    result.statistics.seconds = thread_seconds() - start;
    return result;
}

void throw_failure(const Failure& failure) {
    throw IntegrationError(failure.message, failure.time, failure.state);
}

}  // namespace alembert
