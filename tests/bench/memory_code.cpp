// SPDX-License-Identifier: MIT
// bench_memory_code SCENE...: for each scene the operations of a right-hand side, the time in which its solver is
// written as machine code into memory, and the time of one right-hand side by this code and by the compiler's, at
// the start, moved by a little; then the time for one of eight states side by side, and for one power series of
// order 20.
#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>

#include "alembert/native/compilation.hpp"
#include "analysis/derive/derived.hpp"
#include "codegen/emit/taylor.hpp"
#include "codegen/machine/memory_series.hpp"
#include "codegen/machine/memory_solver.hpp"
#include "pack.hpp"
#include "program/lower/lower.hpp"
#include "program/lower/start.hpp"
#include "program/recurrence.hpp"

namespace {

using namespace alembert;

double seconds() {
    return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

/// The time of one of so many calls, the least of 25 runs of at least a millisecond.
template <typename Calls>
double nanoseconds(long calls, const Calls& all) {
    double least = HUGE_VAL;
    for (int round = 0; round < 25; ++round)
        for (long count = 1;; count *= 2) {
            const double begin = seconds();
            for (long k = 0; k < count; ++k) all();
            const double time = seconds() - begin;
            if (time < 1e-3) continue;
            least = std::min(least, 1e9 * time / static_cast<double>(count * calls));
            break;
        }
    return least;
}

/// Each call begins when the one before has ended: its state depends on the rates.
double of_one(const Module& module, const std::vector<double>& par, std::vector<double> state) {
    std::vector<double> rate(state.size());
    return nanoseconds(1, [&] {
        module.table().rhs(0.1, state.data(), par.data(), rate.data());
        state[0] += 1e-18 * rate[0];
    });
}

/// Of one of eight states side by side, as rhs.cpp walks over them.
double of_packs(const Module& module, const std::vector<double>& state) {
    constexpr int states = 64;
    std::vector<double> all;
    for (int k = 0; k < states; ++k)
        for (const double x : state) all.push_back(x + 0.001 * k);
    PackWalk walk(module, states, all, 1e-18);
    return nanoseconds(states, [&] { walk(); });
}

/// Each begins when the one before has ended.
double of_series(const SeriesModule& module, std::vector<double> state) {
    constexpr int order = 20;
    const Series series = make_series(module);
    const auto width = static_cast<std::size_t>(series.width);
    std::vector<double> out((order + 1) * width), work(static_cast<std::size_t>(series.workspace) + 8);
    void* start = work.data();
    std::size_t room = work.size() * sizeof(double);
    const auto aligned = static_cast<double*>(std::align(64, room - 64, start, room));
    return nanoseconds(1, [&] {
        series(0.1, state.data(), order, out.data(), aligned);
        state[0] += 1e-30 * out[width];
    });
}

}  // namespace

int main(int argc, char** argv) {
    fmt::print("{:<28}{:>12}{:>12}{:>12}{:>12}{:>8}{:>14}{:>12}{:>8}{:>17}{:>10}{:>10}{:>8}\n", "", "operations",
               "written, ms", "memory, ns", "g++, ns", "ratio", "of 8: memory", "g++, ns", "ratio",
               "series: written", "memory", "g++", "ratio");
    for (int i = 1; i < argc; ++i) {
        const Derived derived = alembert::derived(read_scene(argv[i]), {.use = Use::run});
        const Program program = lowered(derived).program;
        double written = HUGE_VAL;
        std::optional<MemorySolver> solver;
        for (int round = 0; round < 5; ++round) {
            const double begin = seconds();
            solver = memory_solver(program);
            written = std::min(written, 1e3 * (seconds() - begin));
        }
        if (!solver) {
            fmt::print(stderr, "no machine code in memory here\n");
            return 1;
        }
        const Module compiled = load(compile(emit(program, {.batch = true}).text, program.name, {}).object);
        const State<double> start = start_of(derived.mechanism).state();
        std::vector<double> state = start.q;
        state.insert(state.end(), start.qdot.begin(), start.qdot.end());
        state.resize(static_cast<std::size_t>(compiled.table().coordinates + compiled.table().speeds), 0.3);
        for (std::size_t k = 0; k < state.size(); ++k) state[k] += 0.01 * static_cast<double>(k);
        const double memory = of_one(solver->module, prepared(solver->module, start.parameters), state),
                     other = of_one(compiled, prepared(compiled, start.parameters), state);
        fmt::print("{:<28}{:>12}{:>12.2f}{:>12.1f}{:>12.1f}{:>8.2f}", program.name,
                   program.count(program.right_hand_side()).total(), written, memory, other, memory / other);
        if (const auto packs = memory_solver(program, true)) {
            const double eight = of_packs(packs->module, state), by_compiler = of_packs(compiled, state);
            fmt::print("{:>14.2f}{:>12.2f}{:>8.2f}", eight, by_compiler, eight / by_compiler);
        }
        if (!obstacle_to_recurrences(program) && recurrences(program).products() < 300) {
            const SeriesModule file =
                load_series(compile(emit_taylor(program).text, program.name + "_taylor", {}).object);
            const double begin = seconds();
            const auto series = memory_series(program);
            const double made = 1e3 * (seconds() - begin), own = of_series(series->module, state),
                         by_compiler = of_series(file, state);
            fmt::print("{:>17.2f}{:>10.1f}{:>10.1f}{:>8.2f}", made, own, by_compiler, own / by_compiler);
        }
        fmt::print("\n");
    }
}
