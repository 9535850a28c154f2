// SPDX-License-Identifier: MIT
// bench_sweep [--duration S] [--tolerances LIST] SCENE...: for each scene, 256 motions from states about the
// scene's start, eight side by side on one thread, by three methods and tolerances such as 1e-6,1e-9: motions in a
// second, the median of the errors at the ends, the time for each state at which a right-hand side is computed
// (taylor: a power series), and, of the explicit methods, which part of it is the right-hand side alone.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <random>
#include <string_view>

#include "alembert/base/process_time.hpp"
#include "alembert/batch/ensemble.hpp"
#include "analysis/derive/derived.hpp"
#include "codegen/machine/memory_series.hpp"
#include "codegen/machine/memory_series_packs.hpp"
#include "codegen/machine/memory_solver.hpp"
#include "pack.hpp"
#include "program/lower/lower.hpp"
#include "program/lower/start.hpp"
#include "program/recurrence.hpp"

namespace {

using namespace alembert;

constexpr int members = 256;

/// The least of so many runs, in s of processor time.
template <typename Call>
double least_time(int rounds, const Call& call) {
    double least = HUGE_VAL;
    for (int round = 0; round < rounds; ++round) {
        const double begin = process_seconds();
        call();
        least = std::min(least, process_seconds() - begin);
    }
    return least;
}

/// Of the right-hand side for one of eight states, in ns, while nothing else runs in between.
double of_right_hand_side(const Module& module, const std::vector<double>& state) {
    constexpr int states = 64, calls = 20000;
    std::vector<double> all;
    for (int k = 0; k < states; ++k)
        for (const double x : state) all.push_back(x + 0.001 * k);
    PackWalk walk(module, states, all, 1e-18);
    const double time = least_time(10, [&] {
        for (int k = 0; k < calls / 10; ++k) walk();
    });
    return 1e9 * time / (calls / 10) / states;
}

Ensemble about(const std::vector<double>& start, Module module) {
    Ensemble e{.module = std::move(module)};
    std::mt19937_64 random(7);
    std::uniform_real_distribution<double> part(-0.1, 0.1);
    for (int k = 0; k < members; ++k)
        for (const double x : start) e.states.push_back(x + part(random) * std::max(1.0, std::abs(x)));
    e.threads = 1;
    return e;
}

double median_error(const Outcomes& found, const Outcomes& exact) {
    std::vector<double> errors;
    for (std::size_t k = 0; k < found.members.size(); ++k) {
        double worst = 0;
        for (std::size_t i = 0; i < found.state(k).size(); ++i)
            worst = std::max(worst, std::abs(found.state(k)[i] - exact.state(k)[i]));
        errors.push_back(worst);
    }
    std::nth_element(errors.begin(), errors.begin() + members / 2, errors.end());
    return errors[members / 2];
}

void measure(const char* file, double duration, const std::vector<double>& tolerances) {
    const Derived derived = alembert::derived(read_scene(file), {.use = Use::run});
    const Program program = lowered(derived).program;
    const auto solver = memory_solver(program, true);
    if (!solver) {
        fmt::print(stderr, "no machine code in memory here\n");
        std::exit(1);
    }
    const State<double> start = start_of(derived.mechanism).state();
    std::vector<double> state = start.q;
    state.insert(state.end(), start.qdot.begin(), start.qdot.end());
    Ensemble e = about(state, solver->module);
    const double alone = of_right_hand_side(solver->module, state);
    const bool has_series = !obstacle_to_recurrences(program) && recurrences(program).products() < 600;
    if (has_series) {
        e.series = memory_series(program)->module;
        e.series_packs = memory_series_packs(program);
    }
    const auto options = [&](Method method, double tolerance) {
        return Options{.method = method, .start = start.t, .duration = duration, .tolerance = tolerance};
    };
    const Outcomes exact = integrate(e, options(has_series ? Method::taylor : Method::verner98, 1e-15));
    fmt::print("{}: a right-hand side alone takes {:.2f} ns\n", program.name, alone);
    for (const double tolerance : tolerances)
        for (const Method method : {Method::dop853, Method::verner98, Method::taylor}) {
            if (method == Method::taylor && !has_series) continue;
            Outcomes ends;
            const double time = least_time(3, [&] { ends = integrate(e, options(method, tolerance)); });
            long evaluations = 0, steps = 0;
            for (const Outcome& one : ends.members) evaluations += one.evaluations, steps += one.steps;
            const double each = 1e9 * time / static_cast<double>(evaluations);
            fmt::print("{:>12.0e} {:<9}{:>12.0f} motions/s{:>10.1e}{:>8.1f} steps{:>10.1f} ns", tolerance,
                       name(method), members / time, median_error(ends, exact),
                       static_cast<double>(steps) / members, each);
            if (method != Method::taylor) fmt::print("{:>8.0f} %", 100 * alone / each);
            fmt::print("{}\n", ends.packed ? "" : "  one by one");
        }
}

std::vector<double> numbers_in(const char* list) {
    std::vector<double> result;
    for (char* end = nullptr; *list != '\0'; list = *end == ',' ? end + 1 : end)
        result.push_back(std::strtod(list, &end));
    return result;
}

}  // namespace

int main(int argc, char** argv) {
    double duration = 10;
    std::vector<double> tolerances{1e-6, 1e-9, 1e-12};
    for (int i = 1; i < argc; ++i)
        if (std::string_view(argv[i]) == "--duration" && i + 1 < argc)
            duration = std::atof(argv[++i]);
        else if (std::string_view(argv[i]) == "--tolerances" && i + 1 < argc)
            tolerances = numbers_in(argv[++i]);
        else
            measure(argv[i], duration, tolerances);
}
