// SPDX-License-Identifier: MIT
// Multistep and implicit methods: coefficients, orders, stiff problems with known solutions.
#include <doctest/doctest.h>

#include <cmath>
#include <complex>
#include <limits>
#include <numbers>
#include <vector>

#include "alembert/ode/abm.hpp"
#include "alembert/ode/dop853.hpp"
#include "alembert/ode/explicit_rk.hpp"
#include "alembert/ode/integrate.hpp"
#include "alembert/ode/radau.hpp"
#include "alembert/ode/shifted_linear_solver.hpp"
#include "runtime_systems.hpp"
#include "solved.hpp"

namespace runtime_stiff {

using namespace alembert;
using namespace alembert::test;

namespace {

/// Prothero & Robinson 1974: y' = λ (y − φ) + φ' with φ = sin t and y(0) = φ(0), so that y = φ, however stiff.
Rhs prothero_robinson(double lambda) {
    return make_rhs(1, [lambda](double t, const double* y, double* rate) {
        rate[0] = lambda * (y[0] - std::sin(t)) + std::cos(t);
    });
}

/// y'' = μ ((1 − y²) y' − y), the stiff form of Hairer & Wanner II, §IV.10, in the time of the slow motion.
Rhs van_der_pol(double mu) {
    return make_rhs(2, [mu](double, const double* y, double* rate) {
        rate[0] = y[1];
        rate[1] = mu * ((1 - y[0] * y[0]) * y[1] - y[0]);
    });
}

/// Errors at the end against steps, for two tolerances: −d ln error/d ln steps, the order that the steps show.
double order_by_steps(Method method, double coarse, double fine) {
    double error[2], steps[2];
    for (int i = 0; i < 2; ++i) {
        const Trajectory motion =
            integrate(kepler(), kepler_start,
                      {.method = method, .duration = 20 * std::numbers::pi, .tolerance = i == 0 ? coarse : fine});
        CHECK(motion.ending == Ending::completed);
        error[i] = distance(motion.final_state(), kepler_start);
        steps[i] = static_cast<double>(motion.statistics.steps);
    }
    const double order = std::log(error[0] / error[1]) / std::log(steps[1] / steps[0]);
    MESSAGE(name(method) << ": errors " << error[0] << " in " << steps[0] << ", " << error[1] << " in " << steps[1]
                         << " steps, order " << order);
    return order;
}

/// The error after `steps` equal steps of an adaptive formula, on y' = y (1 − y).
template <class Formula>
double equal_steps_error(int steps) {
    const Rhs rhs = make_rhs(1, [](double, const double* y, double* rate) { rate[0] = y[0] * (1 - y[0]); });
    FormulaStepper<Formula> step(rhs, 0, std::vector<double>{0.1}, 1e-14);
    for (int i = 1; i <= steps; ++i) {
        step.attempt(5. * i / steps);
        step.error_norm();
        step.finish();
        step.advance();
    }
    return std::abs(step.state()[0] - 1 / (1 + 9 * std::exp(-5.)));
}

/// The same of a method that begins with order 1: steps of h³ at first, and twice as long ones after each five,
/// until there is h.
template <class Formula>
double equal_steps_error_from_short_ones(int steps) {
    const Rhs rhs = make_rhs(1, [](double, const double* y, double* rate) { rate[0] = y[0] * (1 - y[0]); });
    FormulaStepper<Formula> step(rhs, 0, std::vector<double>{0.1}, 1e-14);
    const auto go_to = [&](double t) {
        step.attempt(t);
        step.error_norm();
        step.finish();
        step.advance();
    };
    const double h = 5. / steps;
    for (double length = h * h * h; length < h; length *= 2)
        for (int k = 0; k < 5; ++k) go_to(step.time() + length);
    const double start = step.time();
    const int left = static_cast<int>(std::lround((5 - start) / h));
    for (int i = 1; i <= left; ++i) go_to(start + (5 - start) * i / left);
    return std::abs(step.state()[0] - 1 / (1 + 9 * std::exp(-5.)));
}

constexpr Method stiff_methods[] = {Method::bdf, Method::radau, Method::radau5, Method::radau9, Method::radau13};

}  // namespace

namespace {

/// The largest error of the collocation polynomial within a step of length h.
template <class Formula>
double within_step(double h) {
    const Rhs rhs = pendulum();
    FormulaStepper<Formula> step(rhs, 0, pendulum_start, 1e-14);
    step.attempt(h);
    step.error_norm();
    step.finish();
    double worst = 0;
    for (int i = 1; i < 16; ++i) {
        double y[2];
        step.interpolate(i / 16., y);
        const Trajectory exact = integrate(rhs, pendulum_start, {.duration = i / 16. * h, .tolerance = 1e-15});
        worst = std::max(worst, distance({y, 2}, exact.final_state()));
    }
    return worst;
}

template <class Formula>
double order_in_equal_steps(int steps) {
    const double coarse = equal_steps_error<Formula>(steps), fine = equal_steps_error<Formula>(2 * steps);
    MESSAGE(steps << " steps: errors " << coarse << " " << fine << ", order " << std::log2(coarse / fine));
    return std::log2(coarse / fine);
}

/// The same on x'' = −x in steps so long that order 13 leaves an error; a linear equation is solved however long
/// they are.
template <class Formula>
double order_on_the_oscillator(int steps, int more) {
    const auto error = [](int count) {
        const Rhs rhs = make_rhs(2, [](double, const double* y, double* rate) {
            rate[0] = y[1];
            rate[1] = -y[0];
        });
        FormulaStepper<Formula> step(rhs, 0, std::vector<double>{1, 0}, 1e-14);
        for (int i = 1; i <= count; ++i) {
            step.attempt(24. * i / count);
            step.error_norm();
            CHECK(step.solved());
            step.finish();
            step.advance();
        }
        return std::hypot(step.state()[0] - std::cos(24.), step.state()[1] + std::sin(24.));
    };
    const double coarse = error(steps), fine = error(more);
    const double order = std::log(coarse / fine) / std::log(static_cast<double>(more) / steps);
    MESSAGE(steps << " and " << more << " steps: errors " << coarse << " " << fine << ", order " << order);
    return order;
}

template <class Formula>
double order_within_step(double h) {
    const double coarse = within_step<Formula>(h), fine = within_step<Formula>(h / 2);
    MESSAGE("h " << h << ": errors within a step " << coarse << " " << fine << ", order "
                 << std::log2(coarse / fine));
    return std::log2(coarse / fine);
}

}  // namespace

// Hairer & Wanner II, §IV.5: c_s = 1, Σ b_i c_i^k = 1/(k+1) for k ≤ 2s − 2, C(s), and b = last row of A; the known
// eigenvalue for s = 3 is λ = 3 + 3^{2/3} − 3^{1/3}.
TEST_CASE(
    "radau: the computed coefficients integrate polynomials of degree 2s − 2, and stages those of degree s − 1") {
    for (const int s : {3, 5, 7}) {
        const RadauTable& table = radau_table(s);
        const Eigen::MatrixXd A = test::inverse_of(table.inverse);
        CHECK(table.c[s - 1] == 1);
        for (int k = 0; k <= 2 * s - 2; ++k) {
            double sum = 0;
            for (int j = 0; j < s; ++j) sum += A(s - 1, j) * std::pow(table.c[j], k);
            INFO(s << " stages, degree " << k);
            CHECK(std::abs(sum - 1. / (k + 1)) < 1e-14);
        }
        for (int i = 0; i < s; ++i)
            for (int k = 0; k < s; ++k) {
                double sum = 0;
                for (int j = 0; j < s; ++j) sum += A(i, j) * std::pow(table.c[j], k);
                CHECK(std::abs(sum - std::pow(table.c[i], k + 1) / (k + 1)) < 1e-14);
            }
        const Eigen::VectorXd v = table.coupling.col(0);
        CHECK((table.inverse * v - table.lambda * v).norm() < 1e-13 * table.lambda * v.norm());
        CHECK((table.coupling * table.decoupling - Eigen::MatrixXd::Identity(s, s)).norm() <
              1e-13 * table.coupling.norm());
        CHECK(static_cast<int>(table.mu.size()) == (s - 1) / 2);
    }
    CHECK(std::abs(radau_table(3).lambda - (3 + std::cbrt(9.) - std::cbrt(3.))) < 1e-14);
}

TEST_CASE(
    "radau: the error falls with orders 5, 9 and 13, and within a step with those of the collocation "
    "polynomials") {
    CHECK(std::abs(order_in_equal_steps<Radau5>(40) - 5) < 0.1);
    CHECK(std::abs(order_in_equal_steps<Radau9>(8) - 9) < 0.1);
    CHECK(std::abs(order_on_the_oscillator<Radau13>(14, 21) - 13) < 0.1);
    CHECK(std::abs(order_within_step<Radau5>(0.05) - 4) < 0.1);  // h⁴ within a step
    CHECK(std::abs(order_within_step<Radau9>(0.1) - 6) < 0.1);
    CHECK(std::abs(order_within_step<Radau13>(0.8) - 8) < 0.1);
}

TEST_CASE("implicit methods: with the exact Jacobian a stiff run takes fewer evaluations and comes to the same") {
    const double mu = 1e3;
    const auto rate = [mu](double, const double* y, double* out) {
        out[0] = y[1];
        out[1] = mu * ((1 - y[0] * y[0]) * y[1] - y[0]);
    };
    const Rhs with = make_rhs(2, rate, [mu](double, const double* y, double* J) {
        J[0] = 0;
        J[1] = mu * (-2 * y[0] * y[1] - 1);
        J[2] = 1;
        J[3] = mu * (1 - y[0] * y[0]);
    });
    for (const Method method : stiff_methods) {
        const Options options{.method = method, .duration = 2, .tolerance = 1e-9};
        const Trajectory a = integrate(van_der_pol(mu), {2.0, 0.0}, options),
                         b = integrate(with, {2.0, 0.0}, options);
        INFO(name(method) << ": " << a.statistics.evaluations << " by differences, " << b.statistics.evaluations);
        CHECK(b.statistics.evaluations < a.statistics.evaluations);
        CHECK(distance(a.final_state(), b.final_state()) < 1e-7);
    }
}

// The length of steps goes with tolerance^(1/(k+1)) and local errors with the tolerance, so that the global one
// goes with steps^(−k); that the control keeps a step until it can be much longer makes the observation rough.
TEST_CASE("abm: the error of Kepler's orbit falls with order 4 against the number of steps") {
    CHECK(std::abs(order_by_steps(Method::abm, 1e-7, 1e-11) - 4) < 0.5);
    const double coarse = equal_steps_error_from_short_ones<Abm>(400),
                 fine = equal_steps_error_from_short_ones<Abm>(800);
    MESSAGE("in equal steps: errors " << coarse << " " << fine << ", order " << std::log2(coarse / fine));
    CHECK(std::abs(std::log2(coarse / fine) - 4) < 0.1);
}

TEST_CASE("bdf: orders up to 5 are reached, and errors follow the tolerance") {
    CHECK(order_by_steps(Method::bdf, 1e-6, 1e-10) > 4);
}

TEST_CASE("stiff methods: Prothero and Robinson's equation takes steps for its solution, not for its stiffness") {
    for (const Method method : stiff_methods)
        for (const double lambda : {-1e3, -1e6}) {
            const Trajectory motion =
                integrate(prothero_robinson(lambda), {0.0},
                          {.method = method, .duration = 10, .tolerance = 1e-8, .sample = 0.01});
            REQUIRE(motion.ending == Ending::completed);
            INFO(name(method) << " " << lambda << ": " << motion.statistics.steps << " steps, "
                              << motion.statistics.evaluations << " evaluations");
            CHECK(std::abs(motion.final_state()[0] - std::sin(10)) < 1e-6);
            CHECK(motion.statistics.steps < 1500);  // dop853 needs 10 |λ|/6
        }
}

TEST_CASE("stiff methods: van der Pol's oscillator agrees with dop853 at a tight tolerance") {
    const double mu = 1e3;
    const Trajectory exact = integrate(van_der_pol(mu), {2.0, 0.0}, {.duration = 2, .tolerance = 1e-13});
    for (const Method method : stiff_methods) {
        const Trajectory motion =
            integrate(van_der_pol(mu), {2.0, 0.0}, {.method = method, .duration = 2, .tolerance = 1e-9});
        REQUIRE(motion.ending == Ending::completed);
        const double error = distance(motion.final_state(), exact.final_state());
        MESSAGE(name(method) << ": error " << error << ", " << motion.statistics.steps << " steps, "
                             << motion.statistics.rejected << " rejected, " << motion.statistics.evaluations
                             << " evaluations; dop853 " << exact.statistics.evaluations);
        CHECK(error < 1e-5);  // y' is some thousand while y jumps, and an error in the time of a jump remains
        CHECK(motion.statistics.evaluations < exact.statistics.evaluations / 2);
    }
}

// A mass on a stiff spring with critical damping, pushed slowly: x'' = −k (x − sin t) − 2 √k x'. The particular
// solution is x = Im(H e^{it}), H = k/(k − 1 + 2i√k). At k = 1e8 only radau: see bdf.hpp.
TEST_CASE("radau: shifted systems of first and of second order are solved as Eigen does, work included") {
    const unsigned seed = 64;
    std::srand(seed);
    for (const int size : {1, 2, 5, 6, 7, 24, 25}) {
        CAPTURE(size);
        for (const bool is_second : {false, true}) {
            Eigen::MatrixXd J = Eigen::MatrixXd::Random(size, size) * 30;
            const int n = size / 2;
            if (is_second) {
                J.topRows(n).setZero();
                J.block(0, n, n, n).setIdentity();
                J.rightCols(size - 2 * n).setZero();
            }
            CHECK(second_order(J) == (is_second ? n : 0));
            const std::complex<double> sigma(7, 40);
            const Eigen::MatrixXcd A =
                Eigen::MatrixXcd::Identity(size, size) * sigma - J.cast<std::complex<double>>();
            const Eigen::VectorXcd b = Eigen::VectorXcd::Random(size), expected = A.partialPivLu().solve(b);
            ShiftedLinearSolver<std::complex<double>> system(size);
            system.factor(J, second_order(J), sigma);
            Eigen::VectorXcd x(size);
            system.solve(b.data(), x.data());
            CHECK((x - expected).norm() < 1e-11 * expected.norm());
            ShiftedLinearSolver<double> real(size);
            real.factor(J, second_order(J), 50.0);
            const Eigen::VectorXd side = b.real();
            Eigen::VectorXd y(size);
            real.solve(side.data(), y.data());
            CHECK((50 * y - J * y - side).norm() < 1e-11 * (J.norm() * y.norm() + 1));
        }
    }
}

TEST_CASE("stiff methods: a stiff spring with a damper follows what pushes it") {
    for (const auto& choice :
         {std::pair(Method::bdf, 1e4), std::pair(Method::radau, 1e4), std::pair(Method::radau, 1e8)}) {
        const Method method = choice.first;
        const double stiffness = choice.second, damping = 2 * std::sqrt(stiffness);
        const Rhs spring = make_rhs(2, [=](double t, const double* y, double* rate) {
            rate[0] = y[1];
            rate[1] = -stiffness * (y[0] - std::sin(t)) - damping * y[1];
        });
        const std::complex<double> H = stiffness / std::complex<double>(stiffness - 1, damping);
        const Trajectory motion = integrate(spring, {H.imag(), H.real()},
                                            {.method = method, .duration = 10, .tolerance = 1e-9, .sample = 0.1});
        INFO(name(method) << " " << stiffness << ": " << motion.statistics.steps << " steps");
        REQUIRE(motion.ending == Ending::completed);
        for (std::size_t row = 0; row < motion.rows(); ++row)
            CHECK(std::abs(motion.state(row)[0] - (H * std::polar(1.0, motion.times[row])).imag()) < 1e-7);
        CHECK(motion.statistics.steps < 4000);  // an explicit method needs 10 √k/6 at the least: 17000 for k = 1e8
    }
}

// A ball on a stiff, damped rod that swings: roundings of the force, 1e-10 of the weight, are larger than the
// strictest tolerances allow for an error.
TEST_CASE("radau: at tolerances beyond rounding a stiff run takes about as many steps as at the limit") {
    const Rhs ball = make_rhs(4, [](double, const double* y, double* rate) {
        const double length = std::hypot(y[0], y[1]);
        const double speed = (y[0] * y[2] + y[1] * y[3]) / length;
        const double pull = (8e5 * (length - 1) + 4e4 * speed) / length / 5;
        rate[0] = y[2];
        rate[1] = y[3];
        rate[2] = -pull * y[0];
        rate[3] = -pull * y[1] - 9.81;
    });
    const std::vector<double> start{0.8, -0.6, 0, 0};
    const auto motion = [&](Method method, double tolerance) {
        return integrate(ball, start, {.method = method, .duration = 2, .tolerance = tolerance});
    };
    const Trajectory exact = motion(Method::dop853, 1e-12), limit = motion(Method::radau, 1e-11);
    for (const double tolerance : {1e-13, 1e-14, 1e-15}) {
        const Trajectory strict = motion(Method::radau, tolerance);
        INFO(tolerance << ": " << strict.statistics.steps << " steps, " << limit.statistics.steps << " at 1e-11");
        REQUIRE(strict.ending == Ending::completed);
        CHECK(strict.statistics.steps < 5 * limit.statistics.steps);
        CHECK(distance(strict.final_state(), exact.final_state()) < 1e-10);
    }
}

// λ is 1e5 until about t = 2 and again from about t = 28 on; x follows sin t.
TEST_CASE(
    "a run that was found stiff comes back to the explicit method where the motion is mild, and changes again") {
    const Rhs rhs = make_rhs(2, [](double t, const double* y, double* rate) {
        const double push = 1 / (1 + std::exp(4 * (t - 2))) + 1 / (1 + std::exp(-4 * (t - 28)));
        rate[0] = -1e5 * push * (y[0] - std::sin(t)) + std::cos(t);
        rate[1] = -y[0];
    });
    const Trajectory motion = integrate(
        rhs, {0, 1}, {.method = Method::verner98, .duration = 30, .tolerance = 1e-9, .when_stiff = Method::radau});
    REQUIRE(motion.ending == Ending::completed);
    REQUIRE(motion.statistics.switched);
    CHECK(motion.statistics.switched->method == "radau");
    REQUIRE(!motion.statistics.later_switches.empty());
    CHECK(motion.statistics.later_switches[0].method == "verner98");
    CHECK(motion.statistics.later_switches[0].why == Switch::Why::mild);
    CHECK(motion.statistics.later_switches.back().method == "radau");
    CHECK(motion.statistics.later_switches.size() < 20);
    CHECK(motion.statistics.evaluations <
          20000);  // verner98 alone: 4 s of 1e5/s in steps of 16 within 4.5, 1 400 000
    CHECK(std::abs(motion.final_state()[0] - std::sin(30)) < 1e-7);
    CHECK(std::abs(motion.final_state()[1] - std::cos(30)) < 1e-7);
    for (std::size_t row = 1; row < motion.rows(); ++row) CHECK(motion.times[row] > motion.times[row - 1]);
    CHECK(motion.rows() == 201);
}

TEST_CASE(
    "multistep and implicit methods: a smaller tolerance gives a smaller error, and few steps are rejected") {
    const auto end = [](std::vector<double> start) {
        return integrate(pendulum(), start, {.duration = 30, .tolerance = 1e-15});
    };
    const Trajectory exact = end(pendulum_start);
    // What an error of 1 in one component at the start is at the end: some ten, since another energy is another
    // period.
    const double growth = 1e6 * std::max(distance(end({2.0 + 1e-6, 0.3}).final_state(), exact.final_state()),
                                         distance(end({2.0, 0.3 + 1e-6}).final_state(), exact.final_state()));
    MESSAGE("growth " << growth);
    for (const Method method :
         {Method::abm, Method::bdf, Method::radau, Method::radau5, Method::radau9, Method::radau13}) {
        double last = HUGE_VAL, bound = 0;
        for (double tolerance = 1e-4; tolerance > 1e-11; tolerance /= 100) {
            const Trajectory motion =
                integrate(pendulum(), pendulum_start, {.method = method, .duration = 30, .tolerance = tolerance});
            const double error = distance(motion.final_state(), exact.final_state());
            INFO(name(method) << " at " << tolerance << ": " << error << ", " << motion.statistics.steps
                              << " steps, " << motion.statistics.rejected << " rejected "
                              << motion.statistics.evaluations);
            CHECK(error < last / 3);
            CHECK(motion.statistics.rejected <= motion.statistics.steps / 4);
            last = error;
            bound = static_cast<double>(motion.statistics.steps) * tolerance * growth;
        }
        CHECK(last < bound);  // each step may be off by the tolerance
    }
}

}  // namespace runtime_stiff
