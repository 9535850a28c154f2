// SPDX-License-Identifier: MIT
/// The strongest plain rival: Verner's 9(8) pair in one inlined function for each system, with right-hand sides
/// that are written by hand, and nothing else: no events, rows, constraints, or watch over stiffness and rounding.
///
///     verner_peer CASE [PER_DECADE]     # pleiades, kepler … (verner_systems.hpp)
///
/// prints JSON: for tolerances from 1e-3 to 1e-14 the steps, rejected steps, seconds of processor time (the median
/// of runs within 20 ms, as `bench` takes it), and the end: coordinates, then rates, in the order of the scene of
/// that name.
///
/// The pair is that of lib/alembert/ode/verner.hpp. The controller is that of Hairer, Nørsett, Wanner I, §II.4,
/// and of OrdinaryDiffEq.jl for this method: the root mean square of error_i / (ε + ε max(|y_i|, |y1_i|)), PI
/// control with β₂ = 2/(5·9), β₁ = 7/(10·9), safety 0.9, factors from 0.2 to 10.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <ctime>
#include <utility>
#include <vector>

#include "alembert/ode/verner.hpp"
#include "verner_systems.hpp"

namespace {

constexpr auto& pair = alembert::verner98_tableau;
constexpr int stages = pair.stages;

struct Run {
    long steps = 0, rejected = 0;
    std::vector<double> end = {};
};

template <int n>
using State = std::array<double, static_cast<std::size_t>(n)>;

/// y + h Σ_j a_ij k_j, unrolled over the weights that are not zero.
template <int i, int n, std::size_t... j>
[[gnu::always_inline]] inline void stage_state(const State<n>& y, const std::array<State<n>, stages + 1>& k,
                                               double h, State<n>& out, std::index_sequence<j...>) {
    for (std::size_t m = 0; m < static_cast<std::size_t>(n); ++m) {
        double sum = 0;
        const auto add = [&]<std::size_t s>() __attribute__((always_inline)) {
            if constexpr (pair.a[i][s] != 0) sum += pair.a[i][s] * k[s][m];
        };
        (add.template operator()<j>(), ...);
        out[m] = y[m] + h * sum;
    }
}

template <class System, std::size_t... i>
[[gnu::always_inline]] inline void all_stages(const System& f, double t, const State<System::size>& y,
                                              std::array<State<System::size>, stages + 1>& k, double h,
                                              State<System::size>& next, std::index_sequence<i...>) {
    const auto one = [&]<std::size_t s>() __attribute__((always_inline)) {
        stage_state<static_cast<int>(s), System::size>(y, k, h, next, std::make_index_sequence<s>());
        f(t + pair.c[s] * h, next.data(), k[s].data());
    };
    (one.template operator()<i + 1>(), ...);
}

template <class System, std::size_t... j>
[[gnu::always_inline]] inline double misfit_of(const State<System::size>& y, const State<System::size>& next,
                                               const std::array<State<System::size>, stages + 1>& k, double h,
                                               double tolerance, std::index_sequence<j...>) {
    double squares = 0;
    for (std::size_t m = 0; m < static_cast<std::size_t>(System::size); ++m) {
        double sum = 0;
        const auto add = [&]<std::size_t s>() __attribute__((always_inline)) {
            if constexpr (pair.e[0][s] != 0) sum += pair.e[0][s] * k[s][m];
        };
        (add.template operator()<j>(), ...);
        const double part = h * sum / (tolerance * (1 + std::max(std::abs(y[m]), std::abs(next[m]))));
        squares += part * part;
    }
    return std::sqrt(squares / System::size);
}

/// Hairer, Nørsett, Wanner I, §II.4, "Starting step size".
template <class System>
double first_step(const System& f, const State<System::size>& y, const State<System::size>& rate,
                  double tolerance) {
    const auto norm = [&](auto&& at) {
        double squares = 0;
        for (std::size_t m = 0; m < y.size(); ++m) {
            const double part = at(m) / (tolerance * (1 + std::abs(y[m])));
            squares += part * part;
        }
        return std::sqrt(squares / System::size);
    };
    const double size = norm([&](std::size_t m) { return y[m]; }),
                 slope = norm([&](std::size_t m) { return rate[m]; });
    const double first = size < 1e-5 || slope < 1e-5 ? 1e-6 : 0.01 * size / slope;
    State<System::size> ahead, rate_ahead;
    for (std::size_t m = 0; m < y.size(); ++m) ahead[m] = y[m] + first * rate[m];
    f(first, ahead.data(), rate_ahead.data());
    const double bend = norm([&](std::size_t m) { return rate_ahead[m] - rate[m]; }) / first;
    return std::min(100 * first, std::pow(0.01 / std::max(slope, bend), 1. / 9));
}

template <class System>
Run run(double tolerance) {
    constexpr double beta2 = 2. / (5 * 9), beta1 = 7. / (10 * 9), safety = 0.9, least = 0.2, most = 10;
    const System f;
    State<System::size> y = f.start(), next;
    std::array<State<System::size>, stages + 1> k;
    f(0, y.data(), k[0].data());
    double t = 0, h = first_step(f, y, k[0], tolerance), before = 1e-4;
    Run result;
    while (t < System::end) {
        const bool last = t + h * (1 + 1e-10) >= System::end;
        if (last) h = System::end - t;
        all_stages(f, t, y, k, h, next, std::make_index_sequence<stages>());
        const double misfit = misfit_of<System>(y, next, k, h, tolerance, std::make_index_sequence<stages + 1>());
        const double now = std::pow(misfit, beta1);
        if (!(misfit <= 1)) {
            ++result.rejected;
            h *= misfit < HUGE_VAL ? std::max(least, safety / now) : least;
            continue;
        }
        ++result.steps;
        t = last ? System::end : t + h;
        y = next;
        k[0] = k[stages];
        h *= std::clamp(safety * std::pow(before, beta2) / now, least, most);
        before = std::max(misfit, 1e-4);
    }
    result.end.assign(y.begin(), y.end());
    return result;
}

double thread_seconds() {
    timespec now;
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
    return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

template <class System>
void measure(int per_decade) {
    const char* between = "";
    std::printf("{\"runs\": [");
    for (int i = 3 * per_decade; i <= 14 * per_decade; ++i) {
        const double tolerance = std::pow(10, -static_cast<double>(i) / per_decade);
        std::vector<double> seconds;
        double sum = 0;
        Run found;
        do {
            const double begin = thread_seconds();
            found = run<System>(tolerance);
            seconds.push_back(thread_seconds() - begin);
            sum += seconds.back();
        } while (seconds.size() < 200 && sum < 0.3 && (seconds.size() < 3 || sum < 0.02));
        std::nth_element(seconds.begin(), seconds.begin() + static_cast<long>(seconds.size() / 2), seconds.end());
        std::printf("%s\n{\"tolerance\": %.3g, \"steps\": %ld, \"rejected\": %ld, \"seconds\": %.9g, \"final\": [",
                    between, tolerance, found.steps, found.rejected, seconds[seconds.size() / 2]);
        for (std::size_t m = 0; m < found.end.size(); ++m) std::printf("%s%.17g", m > 0 ? ", " : "", found.end[m]);
        std::printf("]}");
        between = ",";
    }
    std::printf("]}\n");
}

}  // namespace

int main(int count, char** arguments) {
    const char* const name = count > 1 ? arguments[1] : "";
    const int per_decade = count > 2 ? std::atoi(arguments[2]) : 2;
    if (std::strcmp(name, "double_pendulum_chaotic") == 0)
        return measure<verner_peer::DoublePendulum>(per_decade), 0;
    if (std::strcmp(name, "kepler") == 0) return measure<verner_peer::Kepler>(per_decade), 0;
    if (std::strcmp(name, "outer_solar_system") == 0) return measure<verner_peer::OuterSolarSystem>(per_decade), 0;
    if (std::strcmp(name, "pleiades") == 0) return measure<verner_peer::Pleiades>(per_decade), 0;
    if (std::strcmp(name, "andrews") == 0) return measure<verner_peer::Andrews>(per_decade), 0;
    std::fprintf(stderr,
                 "usage: %s double_pendulum_chaotic|kepler|outer_solar_system|pleiades|andrews [PER_DECADE]\n",
                 arguments[0]);
    return 3;
}
