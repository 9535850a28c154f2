// SPDX-License-Identifier: MIT
// Ensembles against the ordinary integrator, one member at a time, and against themselves: a member's result
// depends on nothing but the member.
#include <doctest/doctest.h>

#include "alembert/batch/ensemble.hpp"
#include "alembert/native/compilation.hpp"
#include "alembert/ode/energy_error.hpp"
#include "analysis/state/prepared.hpp"
#include "codegen/emit/emit.hpp"
#include "codegen/machine/can_run.hpp"
#include "codegen/machine/memory_series.hpp"
#include "codegen/machine/memory_series_packs.hpp"
#include "codegen/machine/memory_solver.hpp"
#include "model/formalism/elements.hpp"
#include "model/formalism/formalisms.hpp"
#include "program/lower/choose.hpp"
#include "program/recurrence.hpp"
#include "random_scene.hpp"
#include "scenes.hpp"

namespace generator_ensemble {

using namespace alembert;

namespace {

Program program_of(const std::string& scene) {
    const Mechanism mechanism = prepared(read_scene(test::source_path(scene))).mechanism;
    return choose(mechanism, formalism(mechanism.constraints.empty() ? "lagrange" : "routh").derive(mechanism))
        .program;
}

Module module_of(const std::string& scene, bool batch = true) {
    const Program program = program_of(scene);
    return load(compile(emit(program, {.batch = batch}).text, program.name, {}).object);
}

/// `count` members about the scene's parameters, each with its own state, start and duration.
Ensemble random_members(const Module& module, int count) {
    Ensemble e{.module = module};
    std::mt19937_64 random(5);
    std::uniform_real_distribution<double> turn(-1.5, 1.5), factor(0.7, 1.4), time(0, 3);
    const alembert_solver_table& table = module.table();
    for (int k = 0; k < count; ++k) {
        for (int i = 0; i < table.coordinates + table.speeds; ++i) e.states.push_back(turn(random));
        for (int i = 0; i < table.parameters; ++i)
            e.parameters.push_back(table.parameter_values[i] * factor(random));
        e.starts.push_back(time(random));
        e.durations.push_back(k == 3 ? 0 : time(random));
    }
    return e;
}

/// A series that takes the steps of those in packs: its order follows from the costs of an order.
SeriesModule with_costs_of(const PackSeries& packs, const SeriesModule& own) {
    struct WithCosts {
        SeriesModule own;
        alembert_series_table table;
    };
    const auto series = std::make_shared<WithCosts>(WithCosts{own, *own});
    series->table.order_cost = packs.order_cost;
    series->table.product_cost = packs.product_cost;
    return {series, &series->table};
}

/// With the power series of the motions, alone and in packs; false where there is no such code.
bool add_series(Ensemble& e, const std::string& scene) {
    if (!machine::can_run()) return false;
    const Program program = program_of(scene);
    e.series_packs = memory_series_packs(program, e.work == Work::integrated);
    e.series = with_costs_of(*e.series_packs, memory_series(program, e.work == Work::integrated)->module);
    return true;
}

Trajectory alone(const Ensemble& e, std::size_t k, Options options, EnergyError* energy_error = nullptr) {
    const alembert_solver_table& table = e.module.table();
    const auto part = [&](const std::vector<double>& all, int size) {
        const auto first = all.begin() + static_cast<std::ptrdiff_t>(k) * size;
        return std::vector<double>(first, first + size);
    };
    options.start = e.starts[k];
    options.duration = e.durations[k];
    options.sample = e.durations[k];  // no row but the end: dense output costs evaluations
    std::vector<double> state = part(e.states, table.coordinates + table.speeds);
    if (e.work == Work::integrated) state.push_back(0);
    const std::vector<double> par = prepared(e.module, part(e.parameters, table.parameters));
    if (energy_error != nullptr)
        options.on_step = [&](double t, std::span<const double> y, std::span<const double> rate) {
            (*energy_error)(table, par, t, y, rate);
        };
    Rhs rhs = make_rhs(e.module, part(e.parameters, table.parameters), e.work);
    if (e.series) rhs.series = make_series(e.series, part(e.parameters, table.parameters));
    return integrate(rhs, state, options);
}

double distance(std::span<const double> a, std::span<const double> b) {
    double worst = 0;
    for (std::size_t i = 0; i < a.size(); ++i) worst = std::max(worst, std::abs(a[i] - b[i]));
    return worst;
}

bool same(const Outcome& a, const Outcome& b) {
    return a.time == b.time && a.steps == b.steps && a.rejected == b.rejected && a.evaluations == b.evaluations &&
           a.energy_drift == b.energy_drift && a.work_balance == b.work_balance && a.failure == b.failure;
}

}  // namespace

TEST_CASE(
    "ensemble: each member ends where the ordinary integrator brings it, with as many steps, by every method") {
    const Module module = module_of("scenes/textbook/double_pendulum.toml");  // driven: its energy changes
    Ensemble e = random_members(module, 21);
    e.work = Work::integrated;
    for (const Method method : {Method::euler, Method::rk2, Method::rk4, Method::dopri5, Method::dop853,
                                Method::verner76, Method::verner98, Method::gauss, Method::radau}) {
        CAPTURE(name(method));
        const Options options{.method = method, .tolerance = 1e-9, .step = has_fixed_step(method) ? 0.01 : 0};
        const Outcomes ends = integrate(e, options);
        CHECK(ends.packed == (method != Method::gauss && method != Method::radau));
        for (std::size_t k = 0; k < e.count(); ++k) {
            EnergyError energy_error(module.table().coordinates, module.table().speeds, true);
            const Trajectory one = alone(e, k, options, &energy_error);
            const Outcome& outcome = ends.members[k];
            // They differ only by rounding, which grows with the motion and changes a step's length in the same
            // ratio.
            CHECK(distance(ends.state(k), one.final_state().first(ends.state(k).size())) < 1e-10);
            CHECK(outcome.failure.empty());
            CHECK(outcome.time == e.starts[k] + e.durations[k]);
            CHECK(std::abs(outcome.steps - one.statistics.steps) <= 1);
            CHECK(std::abs(outcome.evaluations - one.statistics.evaluations) <= 13);
            // The drift of E is measured at the ends of steps, which rounding shifts a little; the balance is not
            // affected.
            CHECK(std::abs(outcome.work_balance - energy_error.balance()) < 1e-10);
        }
    }
}

// The two sum the same series in another order, so that their coefficients, and with them the lengths of steps,
// differ by rounding. A step more or less is taken where the last one ends just before or after the end.
TEST_CASE("ensemble: power series in packs take the steps of a single run, with loads, parameters and starts") {
    for (const char* scene : {"scenes/textbook/double_pendulum.toml", "scenes/textbook/elastic_pendulum.toml"}) {
        CAPTURE(scene);
        const Module module = module_of(scene);
        Ensemble e = random_members(module, 21);
        e.work = Work::integrated;
        if (!add_series(e, scene)) return;
        for (const double tolerance : {1e-6, 1e-9, 1e-12}) {
            CAPTURE(tolerance);
            const Options options{.method = Method::taylor, .tolerance = tolerance};
            const Outcomes ends = integrate(e, options);
            REQUIRE(ends.packed);
            for (std::size_t k = 0; k < e.count(); ++k) {
                CAPTURE(k);
                EnergyError energy_error(module.table().coordinates, module.table().speeds, true);
                const Trajectory one = alone(e, k, options, &energy_error);
                const Outcome& outcome = ends.members[k];
                CHECK(distance(ends.state(k), one.final_state().first(ends.state(k).size())) < tolerance);
                CHECK(outcome.failure.empty() == !one.failure);
                CHECK(outcome.time == e.starts[k] + e.durations[k]);
                CHECK(std::abs(outcome.steps - one.statistics.steps) <= 1);
                CHECK(std::abs(outcome.evaluations - one.statistics.evaluations) <= 2);
                CHECK(std::abs(outcome.work_balance - energy_error.balance()) < tolerance);
            }
        }
    }
}

// The local errors of both are below 1e-10, and a motion of a second lets a difference grow some hundred times:
// the stiffest spring, k/m = 20, may have either sign.
TEST_CASE("ensemble: power series in packs end where verner98 does, in scenes at random") {
    if (!machine::can_run()) return;
    std::mt19937_64 random(11);
    std::uniform_real_distribution<double> value(-0.8, 0.8);
    int compared = 0;
    for (unsigned seed = 0; seed < 80; ++seed) {
        CAPTURE(seed);
        const Mechanism m = build(parse_scene(test::random_scene(seed), "random.toml"));
        if (!m.constraints.empty() || !m.unilateral.empty() || (!m.speeds.empty() && !masses_are_known(m)))
            continue;
        const Program program = choose(m, formalism(m.speeds.empty() ? "lagrange" : "kane").derive(m)).program;
        if (program.singular || obstacle_to_recurrences(program)) continue;
        Ensemble e{.module = memory_solver(program, true)->module};
        e.series = memory_series(program)->module;
        e.series_packs = memory_series_packs(program);
        const int width = e.module.table().coordinates + e.module.table().speeds;
        for (int i = 0; i < 11 * width; ++i) e.states.push_back(value(random));
        const Outcomes expected = integrate(e, {.method = Method::verner98, .duration = 1, .tolerance = 1e-12}),
                       ends = integrate(e, {.method = Method::taylor, .duration = 1, .tolerance = 1e-11});
        REQUIRE(ends.packed);
        for (std::size_t k = 0; k < e.count(); ++k) {
            CAPTURE(k);
            if (!expected.members[k].failure.empty() || !ends.members[k].failure.empty()) continue;
            ++compared;
            for (int i = 0; i < width; ++i) {
                const double there = expected.state(k)[static_cast<std::size_t>(i)];
                CHECK(std::abs(ends.state(k)[static_cast<std::size_t>(i)] - there) <
                      1e-8 * std::max(1.0, std::abs(there)));
            }
        }
    }
    CHECK(compared > 200);
}

// The series knows nothing of a jump ahead: the rate at the end is not that of the polynomial, and the step is
// repeated. In each lane that comes at another time.
TEST_CASE("ensemble: power series in packs see steep changes of loads as a single run does, each lane its own") {
    if (!machine::can_run()) return;
    const Mechanism m = build(
        parse_scene("[parameters]\nwhen = 1\n[coordinates]\nx = 0.5\n[energy]\nkinetic = \"x'^2/2\"\npotential = "
                    "\"x^2/2\"\n[forces]\nx = \"0.3*tanh(400*(t - when))\"\n",
                    "jump.toml"));
    const Program program = choose(m, formalism("lagrange").derive(m)).program;
    Ensemble e{.module = memory_solver(program, true)->module};
    e.series_packs = memory_series_packs(program);
    e.series = with_costs_of(*e.series_packs, memory_series(program)->module);
    for (int k = 0; k < 19; ++k) {
        e.states.insert(e.states.end(), {0.5, 0.1 * k});
        e.parameters.push_back(0.15 * k);
        e.starts.push_back(0);
        e.durations.push_back(4);
    }
    const Options options{.method = Method::taylor, .tolerance = 1e-9};
    const Outcomes ends = integrate(e, options),
                   again = integrate(e, {.method = Method::verner98, .tolerance = 1e-11});
    REQUIRE(ends.packed);
    for (std::size_t k = 1; k < e.count(); ++k) {
        CAPTURE(k);
        const Trajectory one = alone(e, k, options);
        CHECK(ends.members[k].rejected > 0);
        CHECK(std::abs(ends.members[k].steps - one.statistics.steps) <= 1);
        CHECK(std::abs(ends.members[k].rejected - one.statistics.rejected) <= 1);
        CHECK(distance(ends.state(k), one.final_state()) < 1e-9);
        CHECK(distance(ends.state(k), again.state(k)) < 1e-7);
    }
}

TEST_CASE("ensemble: no bit depends on the number of threads or on the neighbours") {
    const char* const scene = "scenes/textbook/elastic_pendulum.toml";
    const Module module = module_of(scene);
    Ensemble e = random_members(module, 37);
    Options options{.tolerance = 1e-10};
    SUBCASE("dop853") {}
    SUBCASE("taylor") {
        if (!add_series(e, scene)) return;
        options.method = Method::taylor;
    }
    e.threads = 1;
    const Outcomes reference = integrate(e, options);
    for (const int threads : {2, 3, 7}) {
        e.threads = threads;
        const Outcomes ends = integrate(e, options);
        CHECK(ends.states == reference.states);
        CHECK(std::equal(ends.members.begin(), ends.members.end(), reference.members.begin(), same));
    }
    for (const std::size_t k : {0UL, 5UL, 36UL}) {  // by itself in a pack
        const auto width = static_cast<std::ptrdiff_t>(reference.dimension),
                   p = static_cast<std::ptrdiff_t>(module.table().parameters);
        const auto at = static_cast<std::ptrdiff_t>(k);
        const Ensemble one{.module = module,
                           .states = {e.states.begin() + at * width, e.states.begin() + (at + 1) * width},
                           .parameters = {e.parameters.begin() + at * p, e.parameters.begin() + (at + 1) * p},
                           .starts = {e.starts[k]},
                           .durations = {e.durations[k]},
                           .series = e.series,
                           .series_packs = e.series_packs};
        const Outcomes end = integrate(one, options);
        CHECK(distance(end.state(0), reference.state(k)) == 0);
        CHECK(same(end.members[0], reference.members[k]));
    }
}

TEST_CASE("ensemble: a member that fails says why, as in a single run, and changes no bit of another") {
    const char* const scene = "scenes/textbook/elastic_pendulum.toml";
    const Module module = module_of(scene);
    Ensemble e = random_members(module, 20);
    Options options{.tolerance = 1e-10, .budget = 5000};
    SUBCASE("dop853") {}
    SUBCASE("taylor") {
        if (!add_series(e, scene)) return;
        options.method = Method::taylor;
    }
    const Outcomes good = integrate(e, options);
    const auto width = static_cast<std::size_t>(good.dimension);
    e.states[4 * width] = 0;  // the spring has no length, and its direction no value
    e.durations[9] = 1e6;     // more than the budget
    const Outcomes ends = integrate(e, options);
    for (const std::size_t k : {4UL, 9UL}) {
        const Trajectory one = alone(e, k, options);
        REQUIRE(one.failure);
        CHECK(ends.members[k].failure == one.failure->message);
        CHECK(ends.members[k].time == one.failure->time);
    }
    for (std::size_t k = 0; k < e.count(); ++k)
        if (k != 4 && k != 9) {
            CHECK(distance(ends.state(k), good.state(k)) == 0);
            CHECK(same(ends.members[k], good.members[k]));
        }
}

TEST_CASE("ensemble: constraints, and modules without packs, are integrated one member at a time") {
    const Module bar = module_of("scenes/textbook/cartesian_pendulum.toml");
    const std::vector<double> y{0.6, -0.8, 0, 0};
    Ensemble e{.module = bar};
    for (int k = 0; k < 5; ++k) e.states.insert(e.states.end(), y.begin(), y.end());
    const Options options{.duration = 2, .tolerance = 1e-10};
    if (bar.table().coordinates == 2) {
        const Outcomes ends = integrate(e, options);
        CHECK(!ends.packed);
        CHECK(ends.members[4].energy_drift < 1e-8);
    }
    const Module plain = module_of("scenes/textbook/elastic_pendulum.toml", false);
    const Ensemble other = random_members(plain, 4);
    const Outcomes ends = integrate(other, options);
    CHECK(!ends.packed);
    for (std::size_t k = 0; k < 4; ++k)
        CHECK(distance(ends.state(k), alone(other, k, options).final_state()) == 0);
}

TEST_CASE("ensemble: sizes and options that do not fit are refused") {
    const Module module = module_of("scenes/textbook/elastic_pendulum.toml");
    Ensemble e = random_members(module, 3);
    CHECK_THROWS_AS(integrate(e, {.tolerance = 0}), std::invalid_argument);
    CHECK_THROWS_AS(integrate(e, {.method = Method::rk4}), std::invalid_argument);
    e.durations.pop_back();
    CHECK_THROWS_AS(integrate(e, {}), std::invalid_argument);
    e.durations.push_back(-1);
    CHECK_THROWS_AS(integrate(e, {}), std::invalid_argument);
    e.durations.clear();
    e.states.pop_back();
    CHECK_THROWS_AS(integrate(e, {}), std::invalid_argument);
}

}  // namespace generator_ensemble
