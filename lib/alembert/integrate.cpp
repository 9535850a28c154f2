// SPDX-License-Identifier: MIT
#include "alembert/integrate.hpp"

#include <ctime>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <stdexcept>

#include <fmt/format.h>

#include "alembert/abm.hpp"
#include "alembert/bdf.hpp"
#include "alembert/canonical.hpp"
#include "alembert/dop853.hpp"
#include "alembert/error.hpp"
#include "alembert/gauss.hpp"
#include "alembert/radau.hpp"
#include "alembert/rattle.hpp"
#include "alembert/run.hpp"
#include "alembert/symplectic.hpp"
#include "alembert/tableau.hpp"
#include "alembert/taylor.hpp"
#include "alembert/verner.hpp"

namespace alembert {
namespace {

constexpr double most_rows = 1e8;
constexpr double most_steps = 1e15;  // more steps could not be distinguished in t

double thread_seconds() {
    timespec now{};
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
    return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

void check(bool good, const std::string& message) {
    if (!good) throw std::invalid_argument(message);
}

}  // namespace

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
    number("longest_step (max_step of a scene)", options.longest_step, options.longest_step >= 0,
           "a finite number, zero or more, is needed");
    number("sample", options.sample, options.sample >= 0, "a finite number, zero or more, is needed");
    check(!needs_series(options.method) || rhs.series.width == rhs.dimension,
          fmt::format("{} needs the Taylor series of the system (emit_taylor, make_series), which this right-hand "
                      "side has not got",
                      name(options.method)));
    check(!needs_canonical(options.method) || (rhs.canonical && 2 * rhs.canonical->coordinates <= rhs.dimension),
          fmt::format("{} needs the momenta and constraints of the system (canonical.hpp), which this right-hand "
                      "side has not got",
                      name(options.method)));
    check(options.budget > 0, fmt::format("budget = {}: at least one right-hand side is needed", options.budget));
    check(!has_fixed_step(options.method) || options.step > 0 || options.duration == 0,
          fmt::format("{} has a fixed step: give it, for example step = {:g}", name(options.method),
                      options.duration / 1000));
    check(!has_fixed_step(options.method) || options.duration == 0 || options.duration / options.step < most_steps,
          fmt::format("step = {}: more than {:g} steps", options.step, most_steps));
    check(options.duration == 0 || options.duration / sample_interval(options) < most_rows,
          fmt::format("sample = {}: more than {:g} rows", options.sample, most_rows));
}

namespace {

template <class AnyStep>
Trajectory run(const Rhs& rhs, const std::vector<double>& initial, const Options& options, const Events& events) {
    return StepLoop<AnyStep>(rhs, initial, options, events).go();
}

/// Integrates the rest of a run that was found to be stiff, with rows on the same grid.
void go_on(Trajectory& first, const Rhs& rhs, const Options& options, const Events& events) {
    const double end = options.start + options.duration, interval = sample_interval(options);
    Options rest = options;
    rest.method = *options.when_stiff;
    rest.when_stiff = {};
    rest.rhs_when_stiff = {};
    rest.start = first.times.back();
    rest.duration = end - rest.start;
    rest.step = 0;
    rest.sample = interval;
    rest.grid = options.grid.value_or(options.start);
    rest.budget = std::max(1L, options.budget - first.statistics.evaluations);
    const std::vector<double> state(first.final_state().begin(), first.final_state().end());
    Trajectory second = integrate(options.rhs_when_stiff ? options.rhs_when_stiff() : rhs, state, rest, events);
    append(first, std::move(second), *rest.grid, interval);
    if (first.failure && first.failure->kind == FailureKind::budget_used_up)
        first.failure->message = fmt::format(
            "{} right-hand sides were not enough to come further than t = {}; raise the budget, loosen "
            "the "
            "tolerance or shorten the duration",
            options.budget, first.failure->time);
}

struct MethodEntry {
    Method method;
    std::string_view name;
    bool fixed_step;
    Trajectory (*run)(const Rhs&, const std::vector<double>&, const Options&, const Events&);
};

/// In the order of Method.
constexpr MethodEntry methods[] = {{Method::euler, "euler", true, run<Step<euler_tableau>>},
                                   {Method::rk2, "rk2", true, run<Step<rk2_tableau>>},
                                   {Method::rk4, "rk4", true, run<Step<rk4_tableau>>},
                                   {Method::dopri5, "dopri5", false, run<Step<dopri5_tableau>>},
                                   {Method::dop853, "dop853", false, run<Step<dop853_tableau>>},
                                   {Method::verner76, "verner76", false, run<Step<verner76_tableau>>},
                                   {Method::verner98, "verner98", false, run<Step<verner98_tableau>>},
                                   {Method::verlet, "verlet", true, run<Stepper<Verlet>>},
                                   {Method::kahanli8, "kahanli8", true, run<Stepper<KahanLi8>>},
                                   {Method::gauss, "gauss", true, run<Stepper<Gauss>>},
                                   {Method::rattle, "rattle", true, run<Stepper<Rattle>>},
                                   {Method::rattle8, "rattle8", true, run<Stepper<Rattle8>>},
                                   {Method::abm, "abm", false, run<Stepper<Abm>>},
                                   {Method::bdf, "bdf", false, run<Stepper<Bdf>>},
                                   {Method::radau, "radau", false, run<Stepper<RadauOfAnyOrder>>},
                                   {Method::radau5, "radau5", false, run<Stepper<Radau5>>},
                                   {Method::radau9, "radau9", false, run<Stepper<Radau9>>},
                                   {Method::radau13, "radau13", false, run<Stepper<Radau13>>},
                                   {Method::taylor, "taylor", false, run<Stepper<Taylor>>}};

const MethodEntry& entry(Method method) {
    return methods[static_cast<std::size_t>(method)];
}

}  // namespace

std::string_view name(Method method) {
    return entry(method).name;
}

std::optional<Method> method_named(std::string_view name) {
    const auto found =
        std::find_if(std::begin(methods), std::end(methods), [&](const auto& one) { return one.name == name; });
    return found != std::end(methods) ? std::optional(found->method) : std::nullopt;
}

bool has_fixed_step(Method method) {
    return entry(method).fixed_step;
}

std::vector<Method> all_methods() {
    std::vector<Method> list;
    for (const MethodEntry& one : methods) list.push_back(one.method);
    return list;
}

std::string method_names() {
    std::string names;
    for (const MethodEntry& one : methods)
        names += fmt::format("{}{}",
                             &one == std::begin(methods)     ? ""
                             : &one + 1 == std::end(methods) ? " or "
                                                             : ", ",
                             one.name);
    return names;
}

bool uses_jacobian(Method method) {
    return (method >= Method::radau && method <= Method::radau13) || method == Method::bdf ||
           method == Method::gauss;
}

bool needs_series(Method method) {
    return method == Method::taylor;
}

bool needs_canonical(Method method) {
    return method == Method::rattle || method == Method::rattle8;
}

bool needs_separable(Method method) {
    return method == Method::verlet || method == Method::kahanli8;
}

Trajectory integrate(const Rhs& rhs, const std::vector<double>& initial, const Options& options,
                     const Events& events) {
    check_options(rhs, initial, options);
    const double start = thread_seconds();
    if (options.by && !events.list.empty())
        throw std::invalid_argument("an integrator from elsewhere does not look for events");
    Trajectory result =
        options.by ? options.by(rhs, initial, options) : entry(options.method).run(rhs, initial, options, events);
    if (result.statistics.switched && result.ending == Ending::completed) go_on(result, rhs, options, events);
    result.statistics.seconds = thread_seconds() - start;
    return result;
}

void throw_failure(const Failure& failure) {
    throw IntegrationError(failure.message, failure.time, failure.state);
}

}  // namespace alembert
