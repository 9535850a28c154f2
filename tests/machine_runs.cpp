// SPDX-License-Identifier: MIT
// Motions by machine code in memory: they differ from those of compiled code by less than their errors, need no
// compiler, and go over to compiled code where the run is long.
#include <doctest/doctest.h>

#include <fmt/format.h>

#include <cmath>
#include <cstdlib>
#include <memory>

#include "alembert/base/error.hpp"
#include "scenes.hpp"
#include "simulate/faster_code.hpp"
#include "simulate/simulate.hpp"

namespace machine_runs {

using namespace alembert;

namespace {

/// A compiler that does not exist, as long as this object lives.
struct NoCompiler {
    NoCompiler() { setenv("CXX", "/nowhere/compiler", 1); }
    ~NoCompiler() { unsetenv("CXX"); }
};

double distance(const Run& a, const Run& b) {
    double most = 0;
    const auto look = [&](const std::vector<double>& x, const std::vector<double>& y) {
        REQUIRE(x.size() == y.size());
        for (std::size_t i = 0; i < x.size(); ++i)
            most = std::max(most, std::abs(x[i] - y[i]) / std::max(1.0, std::abs(x[i])));
    };
    look(a.final_coordinates, b.final_coordinates);
    look(a.final_rates, b.final_rates);
    return most;
}

}  // namespace

// Two codes round differently, so that their motions differ by no more than their errors.
TEST_CASE("machine: motions by code in memory and by the compiler differ by less than their estimated errors") {
    struct Case {
        const char *scene, *method;
        double duration;
    };
    for (const Case& c : {Case{"textbook/double_pendulum", "", 3}, Case{"textbook/double_pendulum", "radau", 2},
                          Case{"benchmark/andrews", "", 0.01}, Case{"benchmark/flyball_governor", "", 1},
                          Case{"benchmark/bouncing_ball", "", 1.5}, Case{"benchmark/chaplygin_sleigh", "", 3},
                          Case{"benchmark/cartesian_pendulum", "rattle8", 1},
                          Case{"benchmark/pleiades", "taylor", 0.1}, Case{"textbook/four_bar", "taylor", 1},
                          Case{"benchmark/heavy_top_fast", "dopri5", 1}, Case{"benchmark/pleiades", "bdf", 0.1}}) {
        CAPTURE(c.scene);
        CAPTURE(c.method);
        const Scene scene = read_scene(test::source_path(fmt::format("scenes/{}.toml", c.scene)));
        const auto run = [&](const char* code) {
            RunOptions wishes{.method = c.method, .code = code, .duration = c.duration};
            if (std::string_view(c.method) == "rattle8") wishes.step = 1e-3;
            return simulate(scene, wishes);
        };
        const Run memory = run("memory"), compiled = run("compiled");
        CHECK(memory.solver.code == CodeKind::memory);
        CHECK(compiled.solver.code == CodeKind::compiled);
        REQUIRE(memory.estimate);
        REQUIRE(memory.estimate->value);
        CHECK(distance(memory, compiled) <= *memory.estimate->value + *compiled.estimate->value);
    }
}

TEST_CASE("machine: a run needs no compiler, unless it is told to take one") {
    const Scene scene = read_scene(test::source_path("scenes/textbook/double_pendulum.toml"));
    const NoCompiler none;
    CHECK(simulate(scene, {.duration = 1}).solver.code == CodeKind::memory);
    CHECK_THROWS_AS(simulate(scene, {.code = "compiled", .duration = 1}), CompileError);
    CHECK_THROWS_AS(simulate(scene, {.duration = 1, .fast_math = true}), CompileError);
    CHECK_THROWS_AS(simulate(scene, {.code = "memory", .duration = 1, .fast_math = true}), ModelError);
    CHECK_THROWS_AS(simulate(scene, {.code = "fast", .duration = 1}), ModelError);
    setenv("ALEMBERT_CODE", "compiled", 1);
    CHECK_THROWS_AS(simulate(scene, {.duration = 1}), CompileError);
    CHECK(simulate(scene, {.code = "auto", .duration = 1}).solver.code == CodeKind::memory);
    unsetenv("ALEMBERT_CODE");
}

TEST_CASE("machine: of two codes the one that takes less time is told, for right-hand sides and for series") {
    struct Fake {
        alembert_solver_table table{};
        alembert_series_table series{};
        double value = 0.5;
        const char* names[2] = {"p", nullptr};
    };
    // Thousand times as long as the other one, so that no crowded machine confuses them.
    constexpr auto slow = [](double, const double* state, const double*, double* rate) {
        for (int k = 0; k < 10000; ++k) rate[0] = std::sin(rate[0] + state[0]);
    };
    constexpr auto quick = [](double, const double* state, const double*, double* rate) { rate[0] = state[0]; };
    constexpr auto slow_series = [](double, const double* state, const double*, int, double* out, double*) {
        for (int k = 0; k < 10000; ++k) out[0] = std::sin(out[0] + state[0]);
    };
    constexpr auto quick_series = [](double, const double* state, const double*, int, double* out, double*) {
        out[0] = state[0];
    };
    const auto made = [](auto rhs, auto series) {
        const auto fake = std::make_shared<Fake>();
        fake->table.coordinates = fake->table.speeds = fake->table.parameters = 1;
        fake->series.coordinates = fake->series.speeds = fake->series.parameters = 1;
        fake->table.prepare = fake->series.prepare = [](double*) {};
        fake->table.parameter_names = fake->names;
        fake->table.rhs = rhs;
        fake->series.series = series;
        fake->table.parameter_values = fake->series.parameter_values = &fake->value;
        return fake;
    };
    const auto a = made(+slow, +slow_series), b = made(+quick, +quick_series);
    const auto module_of = [](const auto& fake) {
        return Module(fake, {&fake->table, nullptr, nullptr, nullptr, nullptr, 0});
    };
    const auto series_of = [](const auto& fake) { return SeriesModule(fake, &fake->series); };
    const std::vector<double> state{0.1, 0.2}, parameters{0.5};
    const TimedPlace place{0, state, parameters};
    CHECK(is_faster(module_of(b), module_of(a), place));
    CHECK_FALSE(is_faster(module_of(a), module_of(b), place));
    CHECK(is_faster(series_of(b), series_of(a), place));
    CHECK_FALSE(is_faster(series_of(a), series_of(b), place));
}

TEST_CASE(
    "machine: a long run compiles, and the same code gives the same digits; without a compiler it stays in "
    "memory") {
    const Scene scene = read_scene(test::source_path("scenes/textbook/double_pendulum.toml"));
    const RunOptions wishes{
        .method = "rk4", .duration = 150, .step = 1e-4, .budget = 100'000'000, .estimate = false};
    const auto run = [&](const char* code) {
        RunOptions own = wishes;
        own.code = code;
        return simulate(scene, own);
    };
    const Run first = run("auto"), second = run("auto"), memory = run("memory");
    CHECK(memory.solver.code == CodeKind::memory);
    CHECK(second.solver.from_cache);
    for (const Run& one : {first, second}) {  // which code is faster depends on the processor
        CHECK(one.solver.code != CodeKind::compiled);
        if (one.solver.code == CodeKind::memory) CHECK(one.final_coordinates == memory.final_coordinates);
    }
    if (first.solver.code == second.solver.code) CHECK(first.final_coordinates == second.final_coordinates);
    const NoCompiler none;
    const Run alone = run("auto");
    CHECK(alone.solver.code == CodeKind::memory);
    CHECK(alone.final_coordinates == memory.final_coordinates);
}

}  // namespace machine_runs
