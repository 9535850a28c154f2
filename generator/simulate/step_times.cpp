// SPDX-License-Identifier: GPL-2.0-or-later
#include "simulate/step_times.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <string>
#include <utility>

#include "alembert/native/compilation.hpp"
#include "alembert/native/registers.hpp"
#include "alembert/ode/cost_model.hpp"
#include "alembert/ode/integrate.hpp"
#include "alembert/ode/taylor.hpp"
#include "codegen/machine/memory_series.hpp"
#include "codegen/machine/memory_solver.hpp"
#include "program/program.hpp"
#include "simulate/method.hpp"

namespace alembert {

namespace {

/// A system, and where its motion begins.
struct Sample {
    Program program;
    std::vector<double> state;
};

int coordinate(Program& p, int i) {
    return p.variable({Variable::Kind::coordinate, i});
}
int rate(Program& p, int i) {
    return p.variable({Variable::Kind::rate, i});
}

/// Two particles on rods of length 1 in a plane, of equal mass, by the angles from the vertical.
Sample double_pendulum() {
    Program p;
    p.name = "double_pendulum";
    p.coordinates = {{.name = "a", .unit = "rad"}, {.name = "b", .unit = "rad"}};
    const Rational g = Rational(981) / 100;
    const int a = coordinate(p, 0), b = coordinate(p, 1), between = p.sum(0, {{1, a}, {-1, b}});
    const int sine = p.call(Op::sin, {between}), cosine = p.call(Op::cos, {between});
    const int pull = p.sum(0, {{-1, p.product(1, {{sine, 1}, {rate(p, 1), 2}})}, {-2 * g, p.call(Op::sin, {a})}});
    const int pull_b = p.sum(0, {{1, p.product(1, {{sine, 1}, {rate(p, 0), 2}})}, {-g, p.call(Op::sin, {b})}});
    const int over = p.power(p.sum(2, {{-1, p.product(1, {{cosine, 2}})}}), -1);
    const int first = p.sum(0, {{1, pull}, {-1, p.product(1, {{cosine, 1}, {pull_b, 1}})}});
    const int second = p.sum(0, {{2, pull_b}, {-1, p.product(1, {{cosine, 1}, {pull, 1}})}});
    p.roots = {{Group::acceleration, "a", p.product(1, {{first, 1}, {over, 1}})},
               {Group::acceleration, "b", p.product(1, {{second, 1}, {over, 1}})}};
    return {.program = std::move(p), .state = {0.5, 0.8, 0, 0}};
}

/// Four bodies in a plane, each of mass 1, in a slowly turning square that is not quite one.
Sample four_bodies() {
    constexpr int bodies = 4;
    Program p;
    p.name = "four_bodies";
    std::vector<std::vector<Program::Term>> forces(2 * bodies);
    for (int i = 0; i < 2 * bodies; ++i) p.coordinates.push_back({.name = fmt::format("x{}", i), .unit = "m"});
    for (int i = 0; i < bodies; ++i)
        for (int j = i + 1; j < bodies; ++j) {
            int apart[2];
            for (int k = 0; k < 2; ++k)
                apart[k] = p.sum(0, {{1, coordinate(p, 2 * j + k)}, {-1, coordinate(p, 2 * i + k)}});
            const int square = p.sum(0, {{1, p.product(1, {{apart[0], 2}})}, {1, p.product(1, {{apart[1], 2}})}});
            const int pull = p.power(square, Rational(-3) / 2);
            for (int k = 0; k < 2; ++k) {
                const int force = p.product(1, {{apart[k], 1}, {pull, 1}});
                forces[static_cast<std::size_t>(2 * i + k)].emplace_back(1, force);
                forces[static_cast<std::size_t>(2 * j + k)].emplace_back(-1, force);
            }
        }
    for (const auto& terms : forces) p.roots.push_back({Group::acceleration, "x", p.sum(0, terms)});
    return {.program = std::move(p), .state = {1, 0, 0, 1.1, -1.2, 0, 0, -0.9, 0, 0.8, -0.8, 0, 0, -0.8, 0.8, 0}};
}

/// The factors of evaluations and of power series on one system.
std::optional<Slowness> slowness_on(const Sample& sample) {
    constexpr double seconds = 0.4e-3;  // for each of three methods
    const auto solver = memory_solver(sample.program);
    const auto series = memory_series(sample.program);
    if (!solver || !series) return std::nullopt;
    Rhs rhs = make_rhs(solver->module);
    rhs.series = make_series(series->module, {});
    rhs.effort = effort_of(sample.program);
    const auto evaluations = [](const Statistics& done) { return done.evaluations; };
    const auto steps = [](const Statistics& done) { return done.steps + done.rejected; };
    Options options{.method = Method::verner98, .duration = 20, .tolerance = 1e-9, .budget = 100000};
    const auto explicit_time = least_time(rhs, sample.state, options, evaluations, seconds);
    options.method = Method::dop853;
    const auto other_time = least_time(rhs, sample.state, options, evaluations, seconds);
    options.method = Method::taylor;
    const auto series_time = least_time(rhs, sample.state, options, steps, seconds);
    if (!explicit_time || !other_time || !series_time) return std::nullopt;
    const alembert_series_table& costs = *series->module;
    const int order = taylor_order(options.tolerance, costs.order_cost, costs.product_cost);
    return Slowness{
        .evaluation = std::sqrt(*explicit_time * *other_time) / effort_of_evaluation(rhs, false),
        .series = *series_time / taylor_effort(costs.order_cost, costs.product_cost, order, rhs.dimension)};
}

constexpr const char* kept_name = "step_times-2";  // another number for other laws

std::optional<Slowness> kept_slowness() {
    const auto text = kept_about_processor(kept_name);
    if (!text) return std::nullopt;
    char* rest = nullptr;
    const double evaluation = std::strtod(text->c_str(), &rest), series = std::strtod(rest, nullptr);
    return evaluation > 0 && series > 0 ? std::optional(Slowness{.evaluation = evaluation, .series = series})
                                        : std::nullopt;
}

Slowness found() {
    if (const auto kept = kept_slowness()) return *kept;
    const auto measured = measured_slowness();
    if (!measured) return slowness_of(registers());
    keep_about_processor(kept_name, fmt::format("{:.3g} {:.3g}\n", measured->evaluation, measured->series));
    return kept_slowness().value_or(slowness_of(registers()));
}

}  // namespace

std::optional<double> least_time(const Rhs& rhs, const std::vector<double>& state, Options options,
                                 const std::function<long(const Statistics&)>& count, double seconds) {
    double least = HUGE_VAL, all = 0;
    options.sample = options.duration;
    for (int round = 0; round < 400 && (round < 5 || all < seconds); ++round) {
        const Trajectory motion = integrate(rhs, state, options);
        if (motion.failure && motion.failure->kind != FailureKind::budget_used_up) return std::nullopt;
        if (motion.statistics.steps < 8) return std::nullopt;
        least = std::min(least, 1e9 * motion.statistics.seconds / static_cast<double>(count(motion.statistics)));
        all += motion.statistics.seconds;
    }
    return least;
}

std::optional<Slowness> measured_slowness() {
    if (registers() == Registers::usual) return std::nullopt;  // WebAssembly too, where nothing is kept
    const auto one = slowness_on(double_pendulum()), other = slowness_on(four_bodies());
    if (!one || !other) return std::nullopt;
    return Slowness{.evaluation = std::sqrt(one->evaluation * other->evaluation),
                    .series = std::sqrt(one->series * other->series)};
}

Slowness slowness_here() {
    static const Slowness here = found();
    return here;
}

}  // namespace alembert
