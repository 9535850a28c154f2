// SPDX-License-Identifier: GPL-2.0-or-later
// RADAU5 (order 5) and RADAU (orders 5, 9 and 13) of Hairer and Wanner, Solving Ordinary Differential Equations
// II, §IV.8, in Fortran, where the user has their sources. They get the emitted Jacobian where there is one, and
// are told that the first half of the rates is the second half of the state, where it is (parameters M1 and M2),
// which halves their linear systems.
#include <algorithm>
#include <array>

#include "peers.hpp"

namespace alembert::peers {

namespace {

extern "C" {
using Function = void (*)(const int*, const double*, const double*, double*, double*, int*);
using Jacobian = void (*)(const int*, const double*, const double*, double*, const int*, double*, int*);
using Mass = void (*)(const int*, double*, const int*, double*, int*);
using Output = void (*)(const int*, const double*, const double*, const double*, const double*, const int*,
                        const int*, double*, int*, int*);
using Solver = void(const int* n, Function, double* x, double* y, const double* end, double* h, double* relative,
                    double* absolute, const int* tolerances_are_lists, Jacobian, const int* has_jacobian,
                    const int* lower, const int* upper, Mass, const int* has_mass, const int* mass_lower,
                    const int* mass_upper, Output, const int* has_output, double* work, const int* work_size,
                    int* counts, const int* counts_size, double* reals, int* integers, int* verdict);
Solver radau5_, radau_;
}

/// What the Fortran functions call: they have no argument for it that could hold a pointer.
struct Calls {
    const Rhs* rhs = nullptr;
    long count = 0, budget = 0;
    int above = 0;  ///< rows of the Jacobian that are not handed over: those of q' = v
    std::vector<double> jacobian = {};
};
thread_local Calls calls;

void rate(const int*, const double* t, const double* y, double* out, double*, int*) {
    ++calls.count;
    (*calls.rhs)(*t, y, out);
}

void jacobian(const int* n, const double* t, const double* y, double* out, const int* rows, double*, int*) {
    const auto size = static_cast<std::size_t>(*n), above = static_cast<std::size_t>(calls.above);
    calls.rhs->jacobian(calls.rhs->context.get(), *t, y, calls.jacobian.data());
    for (std::size_t column = 0; column < size; ++column)
        std::copy_n(calls.jacobian.data() + column * size + above, size - above,
                    out + column * static_cast<std::size_t>(*rows));
}

void no_mass(const int*, double*, const int*, double*, int*) {}

void after_step(const int*, const double*, const double*, const double*, const double*, const int*, const int*,
                double*, int*, int* verdict) {
    *verdict = calls.count > calls.budget ? -1 : 0;
}

/// n/2 where y_i' = y_{i + n/2} for the first half of the components, as two arbitrary states show; otherwise 0.
int rates_among_state(const Rhs& rhs, const Task& task) {
    const std::size_t half = task.initial.size() / 2;
    if (2 * half != task.initial.size()) return 0;
    std::vector<double> y = task.initial, out(y.size());
    for (const double shift : {0.0, 0.0078125}) {
        for (std::size_t i = 0; i < y.size(); ++i) y[i] += shift * static_cast<double>(i + 1);
        rhs(task.start, y.data(), out.data());
        if (!std::equal(out.begin(), out.begin() + static_cast<std::ptrdiff_t>(half),
                        y.begin() + static_cast<std::ptrdiff_t>(half)))
            return 0;
    }
    return static_cast<int>(half);
}

Answer solve(const Task& task, Solver& solver) {
    constexpr int most_stages = 7, no = 0, yes = 1;
    const int n = static_cast<int>(task.initial.size()), half = rates_among_state(task.rhs, task),
              below = n - half;
    calls = {.rhs = &task.rhs, .count = 0, .budget = task.budget, .above = half};
    calls.jacobian.resize(task.initial.size() * task.initial.size());
    // As the sources ask for it; RADAU5 needs what three stages need.
    const int work_size = n * (n + 3 * most_stages + 3) + most_stages * n * n + 20,
              counts_size = (2 + (most_stages - 1) / 2) * n + 20;
    std::vector<double> work(static_cast<std::size_t>(work_size));
    std::vector<int> counts(static_cast<std::size_t>(counts_size));
    counts[1] = static_cast<int>(std::min(task.budget, 100'000'000L));
    counts[8] = counts[9] = half;
    const int has_jacobian = task.rhs.jacobian != nullptr ? yes : no;
    double t = task.start, h = 1e-6, relative = task.tolerance, absolute = task.tolerance,
           nothing = 0;  // both change them
    int none = 0, verdict = 0;
    Answer answer{.failed = false, .state = task.initial, .evaluations = 0, .steps = 0};
    solver(&n, rate, &t, answer.state.data(), &task.end, &h, &relative, &absolute, &no, jacobian, &has_jacobian,
           &below, &below, no_mass, &no, &below, &below, after_step, &yes, work.data(), &work_size, counts.data(),
           &counts_size, &nothing, &none, &verdict);
    answer.failed = verdict != 1;
    answer.evaluations = calls.count;
    answer.steps = counts[15];
    return answer;
}

}  // namespace

std::vector<Peer> hairer() {
    return {{"hairer", "radau5", [](const Task& task) { return solve(task, radau5_); }},
            {"hairer", "radau", [](const Task& task) { return solve(task, radau_); }}};
}

}  // namespace alembert::peers
