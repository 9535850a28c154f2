// SPDX-License-Identifier: MIT
// Runs in a time of their own, held against Kepler's equation and a published motion.
#include <doctest/doctest.h>

#include <array>
#include <cmath>
#include <numbers>
#include <vector>

#include "alembert/ode/integrate.hpp"
#include "runtime_systems.hpp"

namespace runtime_regularized {

using namespace alembert;
using namespace alembert::test;

namespace {

Rhs kepler_with_energies() {
    Rhs rhs = kepler();
    rhs.energies = [](const void*, double, const double* y, double* out) {
        out[0] = (y[2] * y[2] + y[3] * y[3]) / 2;
        out[1] = -1 / std::hypot(y[0], y[1]);
    };
    return rhs;
}

/// The far end of an orbit, where rounding of the state changes its period by 1e-16 only.
std::vector<double> far_end(double e) {
    return {1 + e, 0, 0, std::sqrt((1 - e) / (1 + e))};
}

/// By Kepler's equation in long double, for the orbit that passes through these doubles.
std::array<long double, 4> exact(const std::vector<double>& far, long double t) {
    const long double r = far[0], v = far[3], a = 1 / (2 / r - v * v), e = r / a - 1, n = 1 / std::sqrt(a * a * a);
    const long double turn = 2 * std::numbers::pi_v<long double>;
    const long double M = std::fmod(n * t + turn / 2, turn);
    long double low = 0, high = turn;
    for (int round = 0; round < 80; ++round) {  // u − e sin u grows
        const long double u = (low + high) / 2;
        (u - e * std::sin(u) > M ? high : low) = u;
    }
    const long double u = (low + high) / 2, b = a * std::sqrt(1 - e * e), rate = n / (1 - e * std::cos(u));
    return {-a * (std::cos(u) - e), -b * std::sin(u), a * std::sin(u) * rate, -b * std::cos(u) * rate};
}

double error(std::span<const double> state, const std::array<long double, 4>& truth) {
    long double worst = 0;
    for (std::size_t i = 0; i < 4; ++i)
        worst = std::max(worst, std::abs(state[i] - truth[i]) / std::max(1.0L, std::abs(truth[i])));
    return static_cast<double>(worst);
}

constexpr double sharp = 0.9999;
constexpr double hundred_turns = 200 * std::numbers::pi + 0.7;

/// Where the potential is U₀ times 1/r and γ = 3/2, a turn of the orbit takes this time of its own:
/// ∫ (U/U₀)^(3/2) dt = (1 + e)^(3/2) ∫ du / √(1 − e cos u).
double own_turn(double e) {
    constexpr int pieces = 100'000;
    double sum = 0;
    for (int k = 0; k < pieces; ++k)
        sum += 1 / std::sqrt(1 - e * std::cos((k + 0.5) * 2 * std::numbers::pi / pieces));
    return std::pow(1 + e, 1.5) * sum * 2 * std::numbers::pi / pieces;
}

double error_after(double duration, double e, const Options& given) {
    Options options = given;
    options.duration = duration;
    const Trajectory motion = integrate(kepler_with_energies(), far_end(e), options);
    REQUIRE(motion.ending == Ending::completed);
    CHECK(motion.times.back() == duration);
    const double result = error(motion.final_state(), exact(far_end(e), duration));
    MESSAGE(name(options.method) << ": error " << result << " after " << duration << " s, "
                                 << motion.statistics.evaluations << " evaluations");
    return result;
}

}  // namespace

/// Rounding changes the energy by ε/(2√3) of itself in each step, at random. The period has 1.5 times the relative
/// error of the energy: the orbit gathers 1.5 · 200π times the mean of that sum, √(steps/3) of it. Three times
/// this is allowed for.
double rounded_in_hundred_turns(long steps) {
    return 1.5 * 200 * std::numbers::pi * 1.1e-16 * std::sqrt(static_cast<double>(steps));
}

// In t the near end, 1e-4 from the middle, costs all its digits: 10⁴ times as large an error.
TEST_CASE("regularized: a hundred turns with 1 - e = 1e-4 end with eleven digits") {
    Options options{.method = Method::verner98, .tolerance = 1e-12, .regularization = Regularization::canonical};
    const double own = error_after(hundred_turns, sharp, options);
    CHECK(own < rounded_in_hundred_turns(100 * 140));
    options.regularization = Regularization::none;
    CHECK(error_after(hundred_turns, sharp, options) > 1e4 * own);
}

// Half as long steps make the error 2^order times smaller; a tenth more is allowed for, as higher orders are left.
TEST_CASE("regularized: symplectic methods follow the same orbit in 400 steps a turn") {
    for (const auto& [method, order] : {std::pair(Method::kahanli8, 8), std::pair(Method::gauss, 6)}) {
        const auto at = [m = method](int steps) {
            return error_after(
                hundred_turns, sharp,
                {.method = m, .step = own_turn(sharp) / steps, .regularization = Regularization::canonical});
        };
        CHECK(at(400) < 1.1 * std::ldexp(at(200), -order) + 2 * rounded_in_hundred_turns(100 * 400));
    }
}

TEST_CASE("regularized: the error falls with the order of the method") {
    const auto order = [](Method method, double turn, int steps) {
        const auto at = [&](int n) {
            return error_after(2 * std::numbers::pi + 0.7, sharp,
                               {.method = method, .step = turn / n, .regularization = Regularization::canonical});
        };
        return std::log2(at(steps) / at(2 * steps));
    };
    const double turn = own_turn(sharp);
    CHECK(std::abs(order(Method::kahanli8, turn, 60) - 8) < 0.3);
    CHECK(std::abs(order(Method::gauss, turn, 60) - 6) < 0.1);
    CHECK(std::abs(order(Method::rk4, turn, 400) - 4) < 0.3);
    CHECK(std::abs(order(Method::verlet, 2 * std::numbers::pi * (1 + sharp), 1000) - 2) < 0.1);
}

// The logarithmic leapfrog stays on the ellipse: energy, angular momentum and the direction of the long axis are
// those of the start to rounding, however long its steps are.
TEST_CASE("regularized: verlet stays on Kepler's ellipse in any steps") {
    const std::vector<double> start = far_end(0.9);
    double worst = 0;
    const auto orbit = [](std::span<const double> y) {
        const double r = std::hypot(y[0], y[1]), L = y[0] * y[3] - y[1] * y[2];
        return std::array{kepler_energy(y), L, y[3] * L - y[0] / r, -y[2] * L - y[1] / r};
    };
    const auto first = orbit(start);
    const Trajectory motion = integrate(kepler_with_energies(), start,
                                        {.method = Method::verlet,
                                         .duration = 50,
                                         .step = 0.5,
                                         .on_step =
                                             [&](double, std::span<const double> y, std::span<const double>) {
                                                 const auto now = orbit(y);
                                                 for (std::size_t i = 0; i < now.size(); ++i)
                                                     worst = std::max(worst, std::abs(now[i] - first[i]));
                                             },
                                         .regularization = Regularization::canonical});
    REQUIRE(motion.ending == Ending::completed);
    MESSAGE(motion.statistics.steps << " steps, the orbit changes by " << worst);
    CHECK(worst < 1e-13);  // ε times the kinetic energy at the near end, 10, and 200 steps
}

TEST_CASE("regularized: the energy does not drift in 10⁴ turns") {
    const double turn = own_turn(sharp);
    for (const Method method : {Method::kahanli8, Method::gauss}) {
        const std::vector<double> start = far_end(sharp);
        const double duration = 2e4 * std::numbers::pi, at_start = kepler_energy(start);
        double first = 0, last = 0;
        const Trajectory motion =
            integrate(kepler_with_energies(), start,
                      {.method = method,
                       .duration = duration,
                       .step = turn / 60,
                       .budget = 100'000'000,
                       .on_step =
                           [&](double t, std::span<const double> y, std::span<const double>) {
                               if (y[0] < 1) return;  // near the far end the energy has all its digits
                               double& worst = t < duration / 2 ? first : last;
                               if (t < 0.1 * duration || t > 0.9 * duration)
                                   worst = std::max(worst, std::abs(kepler_energy(y) - at_start));
                           },
                       .regularization = Regularization::canonical});
        CHECK(motion.ending == Ending::completed);
        MESSAGE(name(method) << ": energy off by " << first << " at first, " << last << " at last");
        CHECK(last < 1.2 * first);
        CHECK(first > 1e-14);  // above rounding, or nothing is shown
    }
}

// r and φ as coordinates: the mass matrix depends on r, so that only dy/ds = g f is left, with its order: an error
// that steps twice as long, or a tolerance 1000 times as large, make 2^order or 1000^(order/(order + 1)) times as
// large. Twice the power is allowed for the choice of steps. Rounding acts where the kinetic energy is 199 times
// the whole one.
TEST_CASE("regularized: any system can run in a time of its own, with the same motion") {
    Rhs polar = make_rhs(4, [](double, const double* y, double* rate) {
        rate[0] = y[2];
        rate[1] = y[3];
        rate[2] = y[0] * y[3] * y[3] - 1 / (y[0] * y[0]);
        rate[3] = -2 * y[2] * y[3] / y[0];
    });
    polar.energies = [](const void*, double, const double* y, double* out) {
        out[0] = (y[2] * y[2] + y[0] * y[0] * y[3] * y[3]) / 2;
        out[1] = -1 / y[0];
    };
    const std::vector<double> far = far_end(0.99);
    const double duration = 2 * std::numbers::pi + 0.7, turn = own_turn(0.99);
    const auto off = [&](Options own) {
        own.duration = duration;
        own.regularization = Regularization::rescaled;
        const Trajectory motion = integrate(polar, {far[0], 0, 0, far[3] / far[0]}, own);
        REQUIRE(motion.ending == Ending::completed);
        const auto y = motion.final_state();
        const double x[] = {y[0] * std::cos(y[1]), y[0] * std::sin(y[1]),
                            y[2] * std::cos(y[1]) - y[0] * y[3] * std::sin(y[1]),
                            y[2] * std::sin(y[1]) + y[0] * y[3] * std::cos(y[1])};
        const double result = error(x, exact(far, duration));
        MESSAGE(name(own.method) << ": error " << result << " in " << motion.statistics.steps << " steps");
        return result;
    };
    const double rounded = 199 * rounded_in_hundred_turns(600) / 100;
    CHECK(off({.method = Method::dop853, .tolerance = 1e-12}) <
          2 * std::pow(1e-3, 8.0 / 9) * off({.method = Method::dop853, .tolerance = 1e-9}) + rounded);
    CHECK(off({.method = Method::gauss, .step = turn / 600}) <
          1.1 * std::ldexp(off({.method = Method::gauss, .step = turn / 300}), -6) + rounded);
    CHECK_THROWS_WITH_AS(
        integrate(
            polar, {far[0], 0, 0, far[3] / far[0]},
            {.method = Method::verlet, .duration = 1, .step = 0.1, .regularization = Regularization::rescaled}),
        doctest::Contains("canonical form"), std::invalid_argument);
}

namespace {

/// How late a state is that should be that of a time t: its error, in parts of the change of state in a second.
double late(const std::vector<double>& start, std::span<const double> state, double t) {
    const std::array<long double, 4> truth = exact(start, t);
    const long double cube = std::pow(std::hypot(truth[0], truth[1]), 3.0L);
    const long double rate[] = {truth[2], truth[3], -truth[0] / cube, -truth[1] / cube};
    long double fastest = 0;
    for (std::size_t i = 0; i < 4; ++i)
        fastest = std::max(fastest, std::abs(rate[i]) / std::max(1.0L, std::abs(truth[i])));
    return error(state, truth) / static_cast<double>(fastest);
}

}  // namespace

// Each row and each event is a state of the motion at the time that is told. Half as long steps make what is late
// 2^order times smaller, a tenth more allowed for, and a tolerance 1000 times smaller 1000^(8/9) times, twice that
// for the choice of steps; to which rounding adds, of ten seconds and 200 steps a turn, and of the times of
// events.
TEST_CASE("regularized: rows and events are at their times") {
    const std::vector<double> start = far_end(0.99);
    Events crossing = make_events({{.name = "axis"}, {.name = "enough"}},
                                  [](double t, const double* y, const double*, double* g) {
                                      g[0] = y[1];
                                      g[1] = t - 9;
                                  });
    Events stopping = crossing;
    stopping.list[1].stop = true;
    for (Events* events : {&crossing, &stopping}) {
        const bool stops = events == &stopping;
        const auto latest = [&](Method method, double precision) {  // steps a turn, or the tolerance
            Options options{.method = method,
                            .start = 0,
                            .duration = 10,
                            .tolerance = precision,
                            .sample = 0.4,
                            .regularization = Regularization::canonical};
            if (has_fixed_step(method)) options.step = own_turn(0.99) / precision;
            const Trajectory motion = integrate(kepler_with_energies(), start, options, *events);
            CHECK(motion.ending == (stops ? Ending::stopped_by_event : Ending::completed));
            REQUIRE(motion.rows() == (stops ? 24 : 26));
            double worst = 0;
            for (std::size_t k = 0; k < motion.rows(); ++k) {
                const double t = stops && k == 23 ? 9 : 0.4 * static_cast<double>(k);
                CHECK(motion.times[k] == doctest::Approx(t).epsilon(1e-14));
                worst = std::max(worst, late(start, motion.state(k), motion.times[k]));
            }
            // The axis is crossed at the near end after half a turn, and at the far end after each turn.
            REQUIRE(motion.events.size() == 3 + (stops ? 0 : 1));
            worst = std::max(worst, std::abs(motion.events[0].time - std::numbers::pi));
            worst = std::max(worst, std::abs(motion.events[1].time - 2 * std::numbers::pi));
            CHECK(std::abs(motion.events[2].time - 9) < 1e-14 * 9);
            for (const EventRecord& event : motion.events) {
                REQUIRE(event.state.size() == 4);
                worst = std::max(worst, late(start, event.state, event.time));
            }
            MESSAGE(name(method) << " with " << precision << ": late by " << worst);
            return worst;
        };
        const double rounded = rounded_in_hundred_turns(400) * 10 / (200 * std::numbers::pi) + 16 * 2.2e-16 * 10;
        CHECK(latest(Method::verner98, 1e-12) <
              2 * std::pow(1e-3, 8.0 / 9) * latest(Method::verner98, 1e-9) + rounded);
        CHECK(latest(Method::kahanli8, 200) < 1.1 * std::ldexp(latest(Method::kahanli8, 100), -8) + rounded);
        CHECK(latest(Method::gauss, 200) < 1.1 * std::ldexp(latest(Method::gauss, 100), -6) + rounded);
    }
}

TEST_CASE("regularized: what has no negative potential, no energies or a series is refused; a budget ends a run") {
    const Options options{.method = Method::dop853, .duration = 10, .regularization = Regularization::canonical};
    CHECK_THROWS_WITH_AS(integrate(kepler(), far_end(0.5), options), doctest::Contains("T and V"),
                         std::invalid_argument);
    Rhs spring = pendulum();
    spring.energies = [](const void*, double, const double* y, double* out) {
        out[0] = y[1] * y[1] / 2;
        out[1] = 1 - std::cos(y[0]);
    };
    CHECK_THROWS_WITH_AS(integrate(spring, pendulum_start, options), doctest::Contains("negative"),
                         std::invalid_argument);
    Options poor = options;
    poor.budget = 500;
    const Trajectory motion = integrate(kepler_with_energies(), far_end(sharp), poor);
    REQUIRE(motion.failure);
    CHECK(motion.failure->kind == FailureKind::budget_used_up);
    CHECK(motion.failure->state.size() == 4);
    CHECK(motion.times.back() == motion.failure->time);
    CHECK(motion.failure->time > 0);
    CHECK(motion.failure->time < 10);
}

}  // namespace runtime_regularized
