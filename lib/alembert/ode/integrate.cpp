// SPDX-License-Identifier: MIT
#include "alembert/ode/integrate.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <utility>

#include <fmt/format.h>

#include "alembert/base/argument.hpp"
#include "alembert/base/error.hpp"
#include "alembert/base/process_time.hpp"
#include "alembert/ode/driver.hpp"
#include "alembert/ode/hamiltonian.hpp"
#include "alembert/ode/method_table.hpp"
#include "alembert/ode/time_transformation.hpp"

namespace alembert {
namespace {

constexpr double most_rows = 1e8;
constexpr double most_steps = 1e15;  // more steps could not be distinguished in t

void check(bool good, const std::string& message) {
    if (!good) throw std::invalid_argument(message);
}

}  // namespace

void check_options(const Rhs& rhs, const std::vector<double>& initial, const Options& options) {
    using namespace argument;
    check(rhs.call != nullptr, "the right-hand side has no function");
    check(initial.size() == static_cast<std::size_t>(rhs.dimension),
          fmt::format("the state has {} components, {} initial values were given", rhs.dimension, initial.size()));
    for (std::size_t k = 0; k < initial.size(); ++k)
        if (!std::isfinite(initial[k]))
            need_finite(k < rhs.names.size() ? rhs.names[k] : fmt::format("initial[{}]", k), initial[k]);
    need_finite("start", options.start);
    need_nonnegative("duration", options.duration);
    need_finite("start + duration", options.start + options.duration);
    need_positive("tolerance", options.tolerance);
    need_positive_if_given("step", options.step);
    need_positive_if_given("max_step", options.longest_step);
    need_positive_if_given("sample", options.sample);
    need_positive("budget", static_cast<double>(options.budget));
    check(!needs_series(options.method) || rhs.series.width == rhs.dimension,
          fmt::format("{} needs the Taylor series of the system (emit_taylor, make_series), which this right-hand "
                      "side does not have",
                      name(options.method)));
    check(
        !needs_canonical(options.method) || (rhs.canonical && 2 * rhs.canonical->coordinates <= rhs.dimension),
        fmt::format("{} needs the momenta and constraints of the system (hamiltonian.hpp), which this right-hand "
                    "side does not have",
                    name(options.method)));
    check(!has_fixed_step(options.method) || options.step > 0 || options.duration == 0,
          fmt::format("{} has a fixed step: give it, for example step = {:g}", name(options.method),
                      options.duration / 1000));
    check(!has_fixed_step(options.method) || options.duration == 0 || options.duration / options.step < most_steps,
          fmt::format("step = {}: more than {:g} steps", options.step, most_steps));
    check(has_fixed_step(options.method) || options.longest_step == 0 ||
              options.duration / options.longest_step < most_steps,
          fmt::format("longest_step (max_step of a scene) = {}: more than {:g} steps", options.longest_step,
                      most_steps));
    check(options.duration == 0 || options.duration / sample_interval(options) < most_rows,
          fmt::format("sample = {}: more than {:g} rows", options.sample, most_rows));
}

namespace {

template <class AnyStep>
Trajectory run(const Rhs& rhs, const std::vector<double>& initial, const Options& options, const Events& events) {
    return Driver<AnyStep>(rhs, initial, options, events).go();
}

constexpr std::array by_method =
    for_each_method([](const auto& row) { return &run<typename std::remove_cvref_t<decltype(row)>::Steps>; });

/// Integrates the rest of a run whose method was changed, with rows on the same grid: if it was found to be stiff,
/// by turns of both methods. The longer a run has come back in vain, the longer it does not look for stiffness.
void go_on(Trajectory& whole, const Rhs& rhs, const Options& options, const Events& events) {
    constexpr long first_patience = 50;
    const double end = options.start + options.duration, interval = sample_interval(options);
    std::optional<Rhs> implicit, series;
    const auto once = [&rhs](std::optional<Rhs>& made, const std::function<Rhs()>& make) -> const Rhs& {
        if (!made) made = make ? make() : rhs;
        return *made;
    };
    Method usual = options.method;
    std::optional<Method> when_stuck = options.when_stuck, when_cheaper = options.when_cheaper;
    long patience = first_patience;
    for (std::optional<Switch> next = whole.statistics.switched; next && whole.ending == Ending::completed;) {
        const bool is_stiff = next->why == Switch::Why::stiff, is_stuck = next->why == Switch::Why::stuck;
        const bool is_cheaper = next->why == Switch::Why::cheaper;
        if (is_cheaper) when_stuck = std::exchange(usual, *when_cheaper);
        if (is_stuck) usual = *std::exchange(when_stuck, {});
        if (is_stuck || is_cheaper) when_cheaper = {};
        Options rest = options;
        rest.method = usual;
        rest.when_stuck = when_stuck;
        rest.when_cheaper = when_cheaper;
        rest.start = whole.times.back();
        rest.duration = end - rest.start;
        rest.step = 0;
        rest.disturbed.late = {};
        rest.sample = interval;
        rest.grid = options.grid.value_or(options.start);
        rest.budget = std::max(1L, options.budget - whole.statistics.work);
        if (is_stiff) {
            rest.turns.effort_per_time = next->effort_per_time;
            rest.method = *options.when_stiff;
            rest.when_stiff = {};
            rest.turns.back = usual;
            rest.step = next->step;
        } else if (!is_stuck && !is_cheaper) {
            rest.turns.patience = patience;
            patience *= 4;
        }
        const std::vector<double> state(whole.final_state().begin(), whole.final_state().end());
        const Rhs& system = is_stiff                                   ? once(implicit, options.rhs_when_stiff)
                            : needs_series(rest.method) && !rhs.series ? once(series, options.rhs_when_cheaper)
                                                                       : rhs;
        if (options.on_method) options.on_method(rest.method);
        Trajectory piece = by_method[static_cast<std::size_t>(rest.method)](system, state, rest, events);
        next = std::exchange(piece.statistics.switched, {});
        if (next) whole.statistics.later_switches.push_back(*next);
        append(whole, std::move(piece), *rest.grid, interval);
    }
    if (whole.failure && whole.failure->kind == FailureKind::budget_used_up)
        whole.failure->message = fmt::format(
            "{} right-hand sides were not enough to come further than t = {}; raise the budget, loosen the "
            "tolerance or shorten the duration",
            options.budget, whole.failure->time);
}

}  // namespace

Trajectory integrate(const Rhs& rhs, const std::vector<double>& initial, const Options& options,
                     const Events& events) {
    check_options(rhs, initial, options);
    const double start = thread_seconds();
    if (options.on_method) options.on_method(options.method);
    if (options.regularization != Regularization::none) {
        Trajectory result = integrate_regularized(rhs, initial, options, events);
        result.statistics.seconds = thread_seconds() - start;
        return result;
    }
    Trajectory result = options.by
                            ? options.by(rhs, initial, options, events)
                            : by_method[static_cast<std::size_t>(options.method)](rhs, initial, options, events);
    if (result.statistics.switched && result.ending == Ending::completed) go_on(result, rhs, options, events);
    result.statistics.seconds = thread_seconds() - start;
    return result;
}

void throw_failure(const Failure& failure) {
    throw IntegrationError(failure.message, failure.time, failure.state);
}

}  // namespace alembert
