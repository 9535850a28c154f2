// SPDX-License-Identifier: MIT
// bench_memory_code SCENE...: for each scene the operations of a right-hand side, the time in which its solver is
// written as machine code into memory, and the time of one right-hand side by this code and by the compiler's, at
// the start, moved by a little; the least of 25 runs of at least a millisecond.
#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>

#include "alembert/compile.hpp"
#include "derive/derived.hpp"
#include "emit/emit.hpp"
#include "lower/lower.hpp"
#include "lower/start.hpp"
#include "machine/memory_solver.hpp"

namespace {

using namespace alembert;

double seconds() {
    return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

/// Each call begins when the one before has ended: its state depends on the rates.
double nanoseconds(const Module& module, const std::vector<double>& par, std::vector<double> state) {
    std::vector<double> rate(state.size());
    double least = HUGE_VAL;
    for (int round = 0; round < 25; ++round)
        for (long count = 1;; count *= 2) {
            const double begin = seconds();
            for (long k = 0; k < count; ++k) {
                module.table().rhs(0.1, state.data(), par.data(), rate.data());
                state[0] += 1e-18 * rate[0];
            }
            const double time = seconds() - begin;
            if (time < 1e-3) continue;
            least = std::min(least, 1e9 * time / static_cast<double>(count));
            break;
        }
    return least;
}

}  // namespace

int main(int argc, char** argv) {
    fmt::print("{:<28}{:>12}{:>12}{:>12}{:>12}{:>8}\n", "", "operations", "written, ms", "memory, ns", "g++, ns",
               "ratio");
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
        const Module compiled = load(compile(emit(program).text, program.name, {}).object);
        const State<double> start = start_of(derived.mechanism).state();
        std::vector<double> state = start.q;
        state.insert(state.end(), start.qdot.begin(), start.qdot.end());
        state.resize(static_cast<std::size_t>(compiled.table().coordinates + compiled.table().speeds), 0.3);
        for (std::size_t k = 0; k < state.size(); ++k) state[k] += 0.01 * static_cast<double>(k);
        const double memory = nanoseconds(solver->module, prepared(solver->module, start.parameters), state),
                     other = nanoseconds(compiled, prepared(compiled, start.parameters), state);
        fmt::print("{:<28}{:>12}{:>12.2f}{:>12.1f}{:>12.1f}{:>8.2f}\n", program.name,
                   program.count(program.right_hand_side()).total(), written, memory, other, memory / other);
    }
}
