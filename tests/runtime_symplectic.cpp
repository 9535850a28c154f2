// SPDX-License-Identifier: MIT
// Methods that keep the structure of mechanics: orders, energies over long runs, Newton's method where steps are
// long.
#include <doctest/doctest.h>

#include <cmath>
#include <complex>
#include <limits>
#include <numbers>
#include <vector>

#include "alembert/ode/gauss.hpp"
#include "alembert/ode/integrate.hpp"
#include "alembert/ode/symplectic_composition.hpp"
#include "runtime_systems.hpp"

namespace runtime_symplectic {

using namespace alembert;
using namespace alembert::test;

namespace {

/// log₂ of the ratio of the errors after one turn in n and 2n steps.
double order_on_kepler(Method method, int steps) {
    const auto error = [&](int n) {
        const double turn = 2 * std::numbers::pi;
        return distance(integrate(kepler(), kepler_start, {.method = method, .duration = turn, .step = turn / n})
                            .final_state(),
                        kepler_start);
    };
    const double coarse = error(steps), fine = error(2 * steps);
    MESSAGE(name(method) << ", " << steps << " steps: errors " << coarse << " " << fine << ", order "
                         << std::log2(coarse / fine));
    return std::log2(coarse / fine);
}

/// The largest |H − H(0)| in the first and in the last tenth of a run.
std::pair<double, double> energy_errors(const Rhs& rhs, const std::vector<double>& start, Method method,
                                        double step, double (*energy)(std::span<const double>)) {
    const double duration = 1e5 * step, at_start = energy(start);
    double first = 0, last = 0;
    const Trajectory motion =
        integrate(rhs, start,
                  {.method = method,
                   .duration = duration,
                   .step = step,
                   .on_step = [&](double t, std::span<const double> y, std::span<const double>) {
                       double& worst = t < duration / 2 ? first : last;
                       if (t < 0.1 * duration || t > 0.9 * duration)
                           worst = std::max(worst, std::abs(energy(y) - at_start));
                   }});
    CHECK(motion.ending == Ending::completed);
    MESSAGE(name(method) << ": energy off by " << first << " at first, " << last << " at last");
    return {first, last};
}

}  // namespace

TEST_CASE("symplectic methods: the error of Kepler's orbit falls with the order of the method") {
    CHECK(std::abs(order_on_kepler(Method::verlet, 2000) - 2) < 0.1);
    CHECK(std::abs(order_on_kepler(Method::kahanli8, 60) - 8) < 0.1);
    CHECK(std::abs(order_on_kepler(Method::gauss, 60) - 6) < 0.1);
}

// A method that is not symplectic loses energy in proportion to time: the error at last would be ten times that at
// first, as rk4 shows.
TEST_CASE("symplectic methods: the energy does not drift in 10⁵ steps") {
    for (const auto& [method, step] : {std::pair(Method::verlet, 0.05), std::pair(Method::kahanli8, 0.3)}) {
        const auto errors = energy_errors(kepler(), kepler_start, method, step, kepler_energy);
        CHECK(errors.second < 1.1 * errors.first);
        CHECK(errors.first > 1e-12);  // far above rounding, or nothing is shown
    }
    const auto errors = energy_errors(kepler(), kepler_start, Method::rk4, 0.05, kepler_energy);
    CHECK(errors.second > 5 * errors.first);
}

// H = p²(1 + q²)/2 + q⁴/4 is not separable: q' = p (1 + q²), p' = −q p² − q³.
TEST_CASE("gauss: the energy of a system that is not separable does not drift in 10⁵ steps") {
    const Rhs rhs = make_rhs(2, [](double, const double* y, double* rate) {
        rate[0] = y[1] * (1 + y[0] * y[0]);
        rate[1] = -y[0] * y[1] * y[1] - y[0] * y[0] * y[0];
    });
    const auto errors = energy_errors(rhs, {0.0, 1.0}, Method::gauss, 0.3, [](std::span<const double> y) {
        return y[1] * y[1] * (1 + y[0] * y[0]) / 2 + std::pow(y[0], 4) / 4;
    });
    CHECK(errors.second < 1.1 * errors.first);
    CHECK(errors.first > 1e-12);
}

TEST_CASE("gauss: short steps keep the energy to rounding") {
    const auto errors = energy_errors(kepler(), kepler_start, Method::gauss, 0.01, kepler_energy);
    CHECK(errors.second < 1e-14);  // 10⁵ roundings of 1e-16 that do not add up
}

// Coefficients rounded once obey b_i a_ij + b_j a_ji = b_i b_j by 1e-17 only: then the energy drifts by 1e-13
// here.
TEST_CASE("gauss: the rounding of its coefficients does not make the energy of an oscillator drift") {
    const Rhs oscillator = make_rhs(2, [](double, const double* y, double* rate) {
        rate[0] = y[1];
        rate[1] = -y[0];
    });
    const auto errors = energy_errors(oscillator, {1.0, 0.0}, Method::gauss, 0.3,
                                      [](std::span<const double> y) { return (y[0] * y[0] + y[1] * y[1]) / 2; });
    CHECK(errors.second < 2e-14);
}

// Fixed-point iteration ends on the side from which it comes: the energy then drifts by 8e-13 here. Rounding at
// random gives 10^2.5 · ε/2 times a few.
TEST_CASE("gauss: the rounding of its iteration does not make the energy drift in steps of a sixth of a period") {
    const Rhs oscillator = make_rhs(2, [](double, const double* y, double* rate) {
        rate[0] = y[1];
        rate[1] = -y[0];
    });
    for (const double step : {0.5, 1.0}) {
        const auto errors =
            energy_errors(oscillator, {1.0, 0.0}, Method::gauss, step,
                          [](std::span<const double> y) { return (y[0] * y[0] + y[1] * y[1]) / 2; });
        CHECK(errors.second < 2e-13);
    }
}

TEST_CASE("verlet: a state that is not coordinates and their rates is refused") {
    const Rhs decay = make_rhs(2, [](double, const double* y, double* rate) {
        rate[0] = -y[0];
        rate[1] = -y[1];
    });
    for (const Method method : {Method::verlet, Method::kahanli8})
        CHECK_THROWS_WITH_AS(integrate(decay, {1.0, 1.0}, {.method = method, .duration = 1, .step = 0.1}),
                             doctest::Contains("coordinates followed by their rates"), std::invalid_argument);
}

// W' = q v and so W = (q² − q₀²)/2, which the trapezoidal rule of each substep carries along in its order.
TEST_CASE("symplectic methods: a quadrature has their order") {
    const Rhs rhs = make_rhs(
        3,
        [](double, const double* y, double* rate) {
            rate[0] = y[1];
            rate[1] = -std::sin(y[0]);
            rate[2] = y[0] * y[1];
        },
        1);
    for (const auto& [method, bound] : {std::pair(Method::verlet, 1e-3), std::pair(Method::kahanli8, 1e-11)}) {
        const Trajectory motion =
            integrate(rhs, {2.0, 0.3, 0.0}, {.method = method, .duration = 10, .step = 0.05, .sample = 0.7});
        const auto end = motion.final_state();
        CHECK(std::abs(end[2] - (end[0] * end[0] - 4) / 2) < bound);
    }
}

// R(z) is the Padé approximant (120 + 60z + 12z² + z³)/(120 − 60z + 12z² − z³) of eᶻ; at z = −1000 fixed-point
// iteration diverges.
TEST_CASE("gauss: a stiff decay is stepped by its stability function, Newton's method taking over") {
    const Rhs stiff = make_rhs(1, [](double, const double* y, double* rate) { rate[0] = -1e4 * y[0]; });
    const Trajectory motion = integrate(stiff, {1.0}, {.method = Method::gauss, .duration = 1, .step = 0.1});
    REQUIRE(motion.ending == Ending::completed);
    const double z = -1e3, R = (120 + z * (60 + z * (12 + z))) / (120 - z * (60 - z * (12 - z)));
    CHECK(std::abs(motion.final_state()[0] - std::pow(R, 10)) < 1e-12);
}

// A mass on a spring of ω = 1000 that swings slowly besides: with hω = 20 the fast part is not resolved, and its
// energy stays.
TEST_CASE("gauss: in steps far beyond the period of a stiff spring the energy does not drift") {
    const Rhs rhs = make_rhs(4, [](double, const double* y, double* rate) {
        const double r = std::hypot(y[0], y[1]), pull = 1e6 * (r - 1) / r;
        rate[0] = y[2];
        rate[1] = y[3];
        rate[2] = -pull * y[0];
        rate[3] = -pull * y[1] - 9.81;
    });
    const auto energy = [](std::span<const double> y) {
        const double r = std::hypot(y[0], y[1]);
        return (y[2] * y[2] + y[3] * y[3]) / 2 + 5e5 * (r - 1) * (r - 1) + 9.81 * y[1];
    };
    const std::vector<double> start = {1, 0, 0, 0};
    double worst = 0;
    const Trajectory motion =
        integrate(rhs, start,
                  {.method = Method::gauss,
                   .duration = 100,
                   .step = 0.02,
                   .on_step = [&](double, std::span<const double> y, std::span<const double>) {
                       worst = std::max(worst, std::abs(energy(y) - energy(start)));
                   }});
    REQUIRE(motion.ending == Ending::completed);
    MESSAGE("energy off by " << worst << ", " << motion.statistics.evaluations << " evaluations");
    CHECK(worst < 0.01);  // of 9.81 J that go to and fro
}

TEST_CASE("gauss: a step whose equations have no solution is reported") {
    // y' = y² from 1 is infinite at t = 1.
    const Rhs square = make_rhs(1, [](double, const double* y, double* rate) { rate[0] = y[0] * y[0]; });
    const Trajectory motion = integrate(square, {1.0}, {.method = Method::gauss, .duration = 10, .step = 5});
    REQUIRE(motion.failure);
    MESSAGE(motion.failure->message);
    CHECK(motion.failure->message.find("the equations of gauss could not be solved") == 0);
}

}  // namespace runtime_symplectic
