// SPDX-License-Identifier: MIT
// Ensembles against the ordinary integrator, one member at a time, and against themselves: a member's result
// depends on nothing but the member.
#include <doctest/doctest.h>

#include "alembert/compile.hpp"
#include "alembert/drift.hpp"
#include "alembert/ensemble.hpp"
#include "emit/emit.hpp"
#include "formalism/formalisms.hpp"
#include "lower/choose.hpp"
#include "scenes.hpp"
#include "state/prepared.hpp"

namespace generator_ensemble {

using namespace alembert;

namespace {

Module module_of(const std::string& scene, bool batch = true) {
    const Mechanism mechanism = prepared(read_scene(test::source_path(scene))).mechanism;
    const Program program =
        choose(mechanism, formalism(mechanism.constraints.empty() ? "lagrange" : "routh").derive(mechanism))
            .program;
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

Trajectory alone(const Ensemble& e, std::size_t k, Options options, Drift* drift = nullptr) {
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
    if (drift != nullptr)
        options.on_step = [&](double t, std::span<const double> y, std::span<const double> rate) {
            (*drift)(table, par, t, y, rate);
        };
    return integrate(make_rhs(e.module, part(e.parameters, table.parameters), e.work), state, options);
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
            Drift drift(module.table().coordinates, module.table().speeds, true);
            const Trajectory one = alone(e, k, options, &drift);
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
            CHECK(std::abs(outcome.work_balance - drift.balance()) < 1e-10);
        }
    }
}

TEST_CASE("ensemble: no bit depends on the number of threads or on the neighbours") {
    const Module module = module_of("scenes/textbook/elastic_pendulum.toml");
    Ensemble e = random_members(module, 37);
    const Options options{.tolerance = 1e-10};
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
                           .durations = {e.durations[k]}};
        const Outcomes end = integrate(one, options);
        CHECK(distance(end.state(0), reference.state(k)) == 0);
        CHECK(same(end.members[0], reference.members[k]));
    }
}

TEST_CASE("ensemble: a member that fails says why, as in a single run, and changes no bit of another") {
    const Module module = module_of("scenes/textbook/elastic_pendulum.toml");
    Ensemble e = random_members(module, 20);
    const Options options{.tolerance = 1e-10, .budget = 5000};
    const Outcomes good = integrate(e, options);
    const auto width = static_cast<std::size_t>(good.dimension);
    e.states[4 * width] = std::nan("");
    e.durations[9] = 1e6;  // more than the budget
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
