// SPDX-License-Identifier: MIT
// The time of one lookup in a table beside GSL's interpolation: lookup.sh compiles and runs it.
//
// Points lie on [0, 1], even or uneven (each moved by up to 0.4 of the distance), with values sin 7x + x².
// Arguments grow by the hundredth part of a piece, as a run that follows its time asks, or are random. GSL
// searches with an accelerator (gsl_interp_accel), which keeps the last piece. Before it is timed, the largest
// difference of both is looked at. The lookups are timed alternately, and the smallest time of each counts.
#include <gsl/gsl_spline.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <random>
#include <vector>

#include "alembert/base/tabulated_function.hpp"

namespace {

using alembert::TabulatedFunction;
using Interpolation = TabulatedFunction::Interpolation;

constexpr int lookups = 200'000, rounds = 15;
constexpr unsigned seed = 20261130;

double seconds() {
    return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

struct Kind {
    const char* name;
    Interpolation ours;
    const gsl_interp_type* theirs;
    bool is_same;  ///< both interpolate by the same formula
};

void compare(const Kind& kind, int points, bool is_even, bool is_random) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> part(0, 1);
    std::vector<double> x(static_cast<std::size_t>(points)), y(x.size());
    for (std::size_t k = 0; k < x.size(); ++k) {
        const double away = is_even || k == 0 || k + 1 == x.size() ? 0 : 0.4 * (2 * part(random) - 1);
        x[k] = (static_cast<double>(k) + away) / (points - 1);
        y[k] = std::sin(7 * x[k]) + x[k] * x[k];
    }
    const TabulatedFunction ours({.axes = {{.at = x}}, .values = y, .interpolation = kind.ours});
    gsl_spline* const theirs = gsl_spline_alloc(kind.theirs, x.size());
    gsl_spline_init(theirs, x.data(), y.data(), x.size());
    gsl_interp_accel* const accelerator = gsl_interp_accel_alloc();
    std::vector<double> at(lookups);
    double place = 0;
    for (double& one : at) {
        place += 0.01 / (points - 1);
        one = is_random ? part(random) : place - std::floor(place);
    }
    double difference = 0, sum = 0, best[2] = {HUGE_VAL, HUGE_VAL};
    for (const double one : at)
        difference = std::max(difference, std::abs(ours.value<double>({0, 0}, {&one, nullptr}) -
                                                   gsl_spline_eval(theirs, one, accelerator)));
    if (kind.is_same && difference > 1e-9) std::printf("DIFFERENT by %g: ", difference);
    const double call = bits_for_code(ours.call({0, 0}, false));  // what code in memory calls
    for (int round = 0; round < rounds; ++round) {
        double begin = seconds();
        for (const double one : at) sum += alembert::value_for_code(call, one);
        best[0] = std::min(best[0], seconds() - begin);
        begin = seconds();
        for (const double one : at) sum += gsl_spline_eval(theirs, one, accelerator);
        best[1] = std::min(best[1], seconds() - begin);
    }
    std::printf("| %s | %d | %s | %s | %.1f | %.1f |%s\n", kind.name, points, is_even ? "even" : "uneven",
                is_random ? "random" : "in order", best[0] / lookups * 1e9, best[1] / lookups * 1e9,
                std::isfinite(sum) ? "" : " no numbers");
    gsl_spline_free(theirs);
    gsl_interp_accel_free(accelerator);
}

}  // namespace

int main() {
    std::printf(
        "| table | points | grid | arguments | ns, ours | ns, GSL |\n| --- | --- | --- | --- | --- | --- |\n");
    for (const Kind& kind : {Kind{"linear", Interpolation::linear, gsl_interp_linear, true},
                             Kind{"cubic", Interpolation::cubic, gsl_interp_cspline, true},
                             Kind{"pchip (GSL: Steffen)", Interpolation::pchip, gsl_interp_steffen, false}})
        for (const int points : {10, 1000, 100'000})
            for (const bool is_even : {true, false})
                for (const bool is_random : {false, true}) compare(kind, points, is_even, is_random);
}
