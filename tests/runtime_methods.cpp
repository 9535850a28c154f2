// SPDX-License-Identifier: MIT
#include <doctest/doctest.h>

#include <cmath>
#include <complex>
#include <limits>
#include <numbers>
#include <vector>

#include "alembert/abm.hpp"
#include "alembert/dop853.hpp"
#include "alembert/gauss.hpp"
#include "alembert/integrate.hpp"
#include "alembert/radau.hpp"
#include "alembert/shifted.hpp"
#include "alembert/step.hpp"
#include "alembert/symplectic.hpp"
#include "alembert/tableau.hpp"
#include "alembert/verner.hpp"

using namespace alembert;

namespace {

constexpr double epsilon = std::numeric_limits<double>::epsilon();

/// Σ_j w_j c_j^q, and Σ |w_j| c_j^q as the measure of its rounding.
template <class Table>
void check_moment(const Table& table, const typename Table::Row& weights, int q, double expected) {
    double sum = 0, size = 0;
    for (std::size_t j = 0; j < weights.size(); ++j) {
        sum += weights[j] * std::pow(table.c[j], q);
        size += std::abs(weights[j]) * std::pow(table.c[j], q);
    }
    // A rounded weight and a rounded power each are off by half a unit in the last place, times q for the power.
    INFO("power " << q);
    CHECK(std::abs(sum - expected) <= (2 + q) * epsilon * (size + std::abs(expected)));
}

/// Rows sum to c, the solution integrates t^(order−1), an error row vanishes for all that its two formulas
/// integrate.
template <class Table>
void check_conditions(const Table& table, std::vector<int> exact_for_error_row) {
    for (std::size_t i = 0; i < table.a.size(); ++i) {
        CAPTURE(i);
        check_moment(table, table.a[i], 0, table.c[i]);
    }
    for (int q = 0; q < table.order; ++q) check_moment(table, table.a[Table::stages], q, 1. / (q + 1));
    for (std::size_t row = 0; row < table.e.size(); ++row)
        for (int q = 0; q < exact_for_error_row[row]; ++q) check_moment(table, table.e[row], q, 0);
}

/// A rooted tree by the branches at its root, each a position in the list that it is in.
struct Tree {
    std::vector<int> branches;
    int nodes;
    double gamma;
};

/// All of at most `most` nodes, in the order of their size: branches from the last taken backwards, so that each
/// multiset comes once.
std::vector<Tree> rooted_trees(int most) {
    std::vector<Tree> trees;
    const auto graft = [&](auto&& self, int left, int last, const Tree& tree) -> void {
        if (left == 0) return trees.push_back({tree.branches, tree.nodes, tree.gamma * tree.nodes});
        for (int k = last; k >= 0; --k) {
            const int nodes = trees[static_cast<std::size_t>(k)].nodes;
            const double gamma = trees[static_cast<std::size_t>(k)].gamma;
            if (nodes > left) continue;
            Tree more = tree;
            more.branches.push_back(k);
            more.gamma *= gamma;
            self(self, left - nodes, k, more);
        }
    };
    for (int nodes = 1; nodes <= most; ++nodes)
        graft(graft, nodes - 1, static_cast<int>(trees.size()) - 1, {{}, nodes, 1});
    return trees;
}

/// Φ_i of each tree at each stage; the second time with |a_ij|, as the measure of rounding.
template <class Table>
void check_trees(const Table& table, std::vector<int> exact_for_error_row) {
    const std::vector<Tree> trees = rooted_trees(table.order);
    std::vector<typename Table::Row> phi, size;  // one for each tree: of its stages; of |a|
    for (const Tree& tree : trees) {
        phi.emplace_back().fill(1);
        size.emplace_back().fill(1);
        for (std::size_t i = 0; i < table.a.size(); ++i)
            for (const int branch : tree.branches) {
                double sum = 0, absolute = 0;
                for (std::size_t j = 0; j < i; ++j) {
                    sum += table.a[i][j] * phi[static_cast<std::size_t>(branch)][j];
                    absolute += std::abs(table.a[i][j]) * size[static_cast<std::size_t>(branch)][j];
                }
                phi.back()[i] *= sum;
                size.back()[i] *= absolute;
            }
        const auto holds = [&](const typename Table::Row& weights, double expected) {
            double sum = 0, absolute = 0;
            for (std::size_t i = 0; i < weights.size(); ++i) {
                sum += weights[i] * phi.back()[i];
                absolute += std::abs(weights[i]) * size.back()[i];
            }
            INFO("tree of " << tree.nodes << " nodes: " << sum << " for " << expected << ", rounding " << absolute);
            // Each of the nodes brings a rounded coefficient and a sum of some twenty terms.
            CHECK(std::abs(sum - expected) <= 2 * tree.nodes * epsilon * absolute);
        };
        holds(table.a[Table::stages], 1 / tree.gamma);
        for (std::size_t row = 0; row < table.e.size(); ++row)
            if (tree.nodes <= exact_for_error_row[row]) holds(table.e[row], 0);
    }
}

Rhs pendulum() {
    return make_rhs(2, [](double, const double* y, double* rate) {
        rate[0] = y[1];
        rate[1] = -std::sin(y[0]);
    });
}

const std::vector<double> pendulum_start = {2.0, 0.3};

/// The logistic equation y' = y (1 − y), y(0) = 1/10: the error after equal steps, by the closed form
/// y = 1/(1 + 9 e⁻ᵗ).
template <const auto& tableau>
double logistic_error(double duration, int steps) {
    const Rhs rhs = make_rhs(1, [](double, const double* y, double* rate) { rate[0] = y[0] * (1 - y[0]); });
    Step<tableau> step(rhs, 0, std::vector<double>{0.1});
    for (int i = 1; i <= steps; ++i) {
        step.attempt(duration * i / steps);
        step.finish();
        step.advance();
    }
    return std::abs(step.state()[0] - 1 / (1 + 9 * std::exp(-duration)));
}

/// The largest error of dense output over one step of length h, against tiny steps of dop853.
template <const auto& tableau>
double dense_error(double h) {
    const Rhs rhs = pendulum();
    Step<tableau> step(rhs, 0, pendulum_start);
    step.attempt(h);
    step.finish();
    double worst = 0;
    for (int i = 1; i < 16; ++i) {
        const double theta = i / 16.;
        const std::vector<double> exact =
            integrate(rhs, pendulum_start, {.duration = theta * h, .tolerance = 1e-15}).states;
        double y[2];
        step.interpolate(theta, y);
        for (std::size_t c = 0; c < 2; ++c) worst = std::max(worst, std::abs(y[c] - exact[exact.size() - 2 + c]));
    }
    return worst;
}

double distance(std::span<const double> a, std::span<const double> b) {
    double worst = 0;
    for (std::size_t i = 0; i < a.size(); ++i) worst = std::max(worst, std::abs(a[i] - b[i]));
    return worst;
}

template <const auto& tableau>
double observed_order(double duration, int steps) {
    const double coarse = logistic_error<tableau>(duration, steps);
    const double fine = logistic_error<tableau>(duration, 2 * steps);
    MESSAGE(steps << " steps: errors " << coarse << " " << fine << ", order " << std::log2(coarse / fine));
    return std::log2(coarse / fine);
}

template <const auto& tableau>
double observed_dense_order(double h) {
    const double coarse = dense_error<tableau>(h), fine = dense_error<tableau>(h / 2);
    MESSAGE("h " << h << ": errors " << coarse << " " << fine << ", order " << std::log2(coarse / fine));
    return std::log2(coarse / fine) - 1;
}

}  // namespace

TEST_CASE("tableaux: rows sum to c, and the quadrature conditions hold up to the order") {
    check_conditions(euler_tableau, {});
    check_conditions(rk2_tableau, {});
    check_conditions(rk4_tableau, {});
    check_conditions(dopri5_tableau, {4});
    check_conditions(dop853_tableau, {5, 3});
    check_conditions(verner76_tableau, {6});
    check_conditions(verner98_tableau, {8});
}

// Hairer, Nørsett, Wanner I, §II.2, theorem 2.13: Σ b_i Φ_i(τ) = 1/γ(τ) for the trees τ of at most p nodes. There are
// 85 of at most 7 nodes and 486 of at most 9.
TEST_CASE("tableaux: the order conditions hold, tree by tree, with one order less for what is estimated with") {
    CHECK(rooted_trees(9).size() == 486);
    check_trees(rk2_tableau, {});
    check_trees(rk4_tableau, {});
    check_trees(dopri5_tableau, {4});
    check_trees(dop853_tableau, {5, 3});
    check_trees(verner76_tableau, {6});
    check_trees(verner98_tableau, {8});
}

// Steps short enough for the leading term of the error to dominate, at times when that term is not near a zero of
// its own; the errors, 3e-13 at the least, are far above rounding.
TEST_CASE("methods: the error of the logistic equation falls with the order of the method") {
    const auto is_near = [](double order, double theory) { return std::abs(order - theory) < 0.1; };
    CHECK(is_near(observed_order<euler_tableau>(5, 20000), 1));
    CHECK(is_near(observed_order<rk2_tableau>(5, 4000), 2));
    CHECK(is_near(observed_order<rk4_tableau>(5, 400), 4));
    CHECK(is_near(observed_order<dopri5_tableau>(8, 80), 5));
    CHECK(is_near(observed_order<dop853_tableau>(5, 8), 8));
    // Verner made the leading terms so small (1.7e-6 in the norm of 7(6)) that the next ones are seen with them as
    // long as rounding is not; that the leading ones are there is for the trees to say.
    CHECK(observed_order<verner76_tableau>(5, 16) > 6.9);
    CHECK(observed_order<verner98_tableau>(5, 8) > 8.9);
}

TEST_CASE("dense output: the error within a step falls with the order of the continuous extension") {
    const auto is_near = [](double order, double theory) { return std::abs(order - theory) < 0.1; };
    CHECK(is_near(observed_dense_order<rk4_tableau>(0.05), 3));
    CHECK(is_near(observed_dense_order<dopri5_tableau>(0.1), 4));
    CHECK(is_near(observed_dense_order<dop853_tableau>(0.4), 7));
    CHECK(std::abs(observed_dense_order<verner76_tableau>(0.15) - 6) < 0.15);  // at 0.1 rounding begins
    CHECK(is_near(observed_dense_order<verner98_tableau>(0.6), 8));
}

TEST_CASE("dense output: the ends of a step are met exactly and its stages are evaluated once") {
    const Rhs rhs = pendulum();
    Step<dop853_tableau> step(rhs, 0, pendulum_start);
    step.attempt(0.3);
    step.finish();
    const long before = step.evaluations();
    double y[2];
    step.interpolate(0, y);
    CHECK(distance({y, 2}, {step.state(), 2}) == 0);
    step.interpolate(1, y);
    CHECK(distance({y, 2}, {step.end_state(), 2}) <= 4 * epsilon);  // y + (y₁ − y), |y| about 2
    CHECK(step.evaluations() == before + 3);
}

// The result is ‖y − y(t)‖ with y from Kepler's equation: after whole periods the orbit is where it began. An
// error δ of the semi-major axis a becomes 3π k δ/a in the position after k periods; about 100 steps of local
// error ≤ tol, each multiplied by the speed at the pericentre (√3 for e = 0.5) on the way.
TEST_CASE("dop853: Kepler's orbit closes after ten periods to the tolerance") {
    const Rhs kepler = make_rhs(4, [](double, const double* y, double* rate) {
        const double r = std::hypot(y[0], y[1]);
        rate[0] = y[2];
        rate[1] = y[3];
        rate[2] = -y[0] / (r * r * r);
        rate[3] = -y[1] / (r * r * r);
    });
    const std::vector<double> start = {0.5, 0, 0, std::sqrt(3.0)};
    double last = HUGE_VAL;
    for (const double tolerance : {1e-7, 1e-9, 1e-11, 1e-13}) {
        for (const Method method : {Method::dopri5, Method::dop853, Method::verner76, Method::verner98}) {
            const Trajectory orbit = integrate(
                kepler, start, {.method = method, .duration = 20 * std::numbers::pi, .tolerance = tolerance});
            const double error = distance(orbit.final_state(), start);
            INFO(name(method) << " at " << tolerance << ": " << error);
            CHECK(error < 1e4 * tolerance);
            if (method == Method::dop853) {
                CHECK(error < last / 10);
                last = error;
            }
        }
    }
}

TEST_CASE("step size: a smaller tolerance gives a smaller error, and few steps are rejected") {
    const Trajectory exact = integrate(pendulum(), pendulum_start, {.duration = 30, .tolerance = 1e-15});
    for (const Method method : {Method::dopri5, Method::dop853, Method::verner76, Method::verner98}) {
        double last = HUGE_VAL;
        for (double tolerance = 1e-4; tolerance > 1e-13; tolerance /= 100) {
            const Trajectory motion =
                integrate(pendulum(), pendulum_start, {.method = method, .duration = 30, .tolerance = tolerance});
            const double error = distance(motion.final_state(), exact.final_state());
            INFO(name(method) << " at " << tolerance << ": " << error);
            CHECK(error < last / 3);  // 100 for an error proportional to the tolerance
            CHECK(motion.statistics.rejected <= motion.statistics.steps / 4);
            last = error;
        }
    }
}

TEST_CASE("tolerance: 1e-14 is used as given, and what it buys is there") {
    const double period = 4 * std::comp_ellint_1(std::sin(0.5));  // of θ'' = −sin θ from 1 rad at rest
    const auto error = [&](double tolerance) {
        const Trajectory motion = integrate(pendulum(), {1.0, 0.0}, {.duration = period, .tolerance = tolerance});
        CHECK(motion.ending == Ending::completed);
        return distance(motion.final_state(), std::vector<double>{1.0, 0.0});
    };
    // About 60 steps; rounding alone gives some 1e-15.
    CHECK(error(1e-14) < 2e-14);
    CHECK(error(1e-15) < 1e-14);
}

TEST_CASE("state: what short steps add to a large state is not lost") {
    // 1e6 + t in steps of 1e-6: each sum would lose up to 5.8e-11, in the same direction every time.
    const Rhs drift = make_rhs(1, [](double, const double*, double* rate) { rate[0] = 1; });
    const Trajectory motion = integrate(drift, {1e6}, {.method = Method::rk4, .duration = 1, .step = 1e-6});
    CHECK(std::abs(motion.final_state()[0] - 1000001) <= 1.2e-10);  // one unit in the last place
}

namespace {

/// Kepler's orbit of eccentricity 1/5 from the pericentre; rest after one turn, and H = −1/2.
Rhs kepler() {
    return make_rhs(4, [](double, const double* y, double* rate) {
        const double r = std::hypot(y[0], y[1]);
        rate[0] = y[2];
        rate[1] = y[3];
        rate[2] = -y[0] / (r * r * r);
        rate[3] = -y[1] / (r * r * r);
    });
}

const std::vector<double> kepler_start = {0.8, 0, 0, std::sqrt(1.5)};

double kepler_energy(std::span<const double> y) {
    return (y[2] * y[2] + y[3] * y[3]) / 2 - 1 / std::hypot(y[0], y[1]);
}

/// log₂ of the ratio of the errors after one turn in n and 2n steps.
double order_on_kepler(Method method, int steps) {
    const auto error = [&](int n) {
        const double turn = 2 * std::numbers::pi;
        return distance(
            integrate(kepler(), kepler_start, {.method = method, .duration = turn, .step = turn / n}).final_state(),
            kepler_start);
    };
    const double coarse = error(steps), fine = error(2 * steps);
    MESSAGE(name(method) << ", " << steps << " steps: errors " << coarse << " " << fine << ", order "
                         << std::log2(coarse / fine));
    return std::log2(coarse / fine);
}

/// The largest |H − H(0)| in the first and in the last tenth of a run.
std::pair<double, double> energy_errors(const Rhs& rhs, const std::vector<double>& start, Method method, double step,
                                        double (*energy)(std::span<const double>)) {
    const double duration = 1e5 * step, at_start = energy(start);
    double first = 0, last = 0;
    const Trajectory motion = integrate(rhs, start,
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

// R(z) is the Padé approximant (120 + 60z + 12z² + z³)/(120 − 60z + 12z² − z³) of eᶻ; at z = −1000 fixed-point iteration diverges.
TEST_CASE("gauss: a stiff decay is stepped by its stability function, Newton's method taking over") {
    const Rhs stiff = make_rhs(1, [](double, const double* y, double* rate) { rate[0] = -1e4 * y[0]; });
    const Trajectory motion = integrate(stiff, {1.0}, {.method = Method::gauss, .duration = 1, .step = 0.1});
    REQUIRE(motion.ending == Ending::completed);
    const double z = -1e3, R = (120 + z * (60 + z * (12 + z))) / (120 - z * (60 - z * (12 - z)));
    CHECK(std::abs(motion.final_state()[0] - std::pow(R, 10)) < 1e-12);
}

// A mass on a spring of ω = 1000 that swings slowly besides: with hω = 20 the fast part is not resolved, and its energy stays.
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
    const Trajectory motion = integrate(rhs, start,
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

TEST_CASE("gauss: a step in which its equations have no solution says so") {
    // y' = y² from 1 is infinite at t = 1.
    const Rhs square = make_rhs(1, [](double, const double* y, double* rate) { rate[0] = y[0] * y[0]; });
    const Trajectory motion = integrate(square, {1.0}, {.method = Method::gauss, .duration = 10, .step = 5});
    REQUIRE(motion.failure);
    MESSAGE(motion.failure->message);
    CHECK(motion.failure->message.find("the equations of gauss could not be solved") == 0);
}

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
    Stepper<Formula> step(rhs, 0, std::vector<double>{0.1}, 1e-14);
    for (int i = 1; i <= steps; ++i) {
        step.attempt(5. * i / steps);
        step.misfit();
        step.finish();
        step.advance();
    }
    return std::abs(step.state()[0] - 1 / (1 + 9 * std::exp(-5.)));
}

/// The same of a method that begins with order 1: steps of h³ at first, and twice as long ones after each five, until there is h.
template <class Formula>
double equal_steps_error_from_short_ones(int steps) {
    const Rhs rhs = make_rhs(1, [](double, const double* y, double* rate) { rate[0] = y[0] * (1 - y[0]); });
    Stepper<Formula> step(rhs, 0, std::vector<double>{0.1}, 1e-14);
    const auto go_to = [&](double t) {
        step.attempt(t);
        step.misfit();
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
    Stepper<Formula> step(rhs, 0, pendulum_start, 1e-14);
    step.attempt(h);
    step.misfit();
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

/// The same on x'' = −x in steps so long that order 13 leaves an error; a linear equation is solved however long they are.
template <class Formula>
double order_on_the_oscillator(int steps, int more) {
    const auto error = [](int count) {
        const Rhs rhs = make_rhs(2, [](double, const double* y, double* rate) {
            rate[0] = y[1];
            rate[1] = -y[0];
        });
        Stepper<Formula> step(rhs, 0, std::vector<double>{1, 0}, 1e-14);
        for (int i = 1; i <= count; ++i) {
            step.attempt(24. * i / count);
            step.misfit();
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
    MESSAGE("h " << h << ": errors within a step " << coarse << " " << fine << ", order " << std::log2(coarse / fine));
    return std::log2(coarse / fine);
}

}  // namespace

// Hairer & Wanner II, §IV.5: c_s = 1, Σ b_i c_i^k = 1/(k+1) for k ≤ 2s − 2, C(s), and b = last row of A; the known eigenvalue for
// s = 3 is λ = 3 + 3^{2/3} − 3^{1/3}.
TEST_CASE("radau: the computed coefficients integrate polynomials of degree 2s − 2, and stages those of degree s − 1") {
    for (const int s : {3, 5, 7}) {
        const RadauTable& table = radau_table(s);
        const Eigen::MatrixXd A = table.inverse.inverse();
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
        CHECK((table.inverse * table.v_real - table.lambda * table.v_real).norm() < 1e-13 * table.lambda * table.v_real.norm());
        CHECK(static_cast<int>(table.mu.size()) == (s - 1) / 2);
    }
    CHECK(std::abs(radau_table(3).lambda - (3 + std::cbrt(9.) - std::cbrt(3.))) < 1e-14);
}

TEST_CASE("radau: the error falls with orders 5, 9 and 13, and within a step with those of the collocation polynomials") {
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
        const Trajectory a = integrate(van_der_pol(mu), {2.0, 0.0}, options), b = integrate(with, {2.0, 0.0}, options);
        INFO(name(method) << ": " << a.statistics.evaluations << " by differences, " << b.statistics.evaluations);
        CHECK(b.statistics.evaluations < a.statistics.evaluations);
        CHECK(distance(a.final_state(), b.final_state()) < 1e-7);
    }
}

// The length of steps goes with tolerance^(1/(k+1)) and local errors with the tolerance, so that the global one goes
// with steps^(−k); that the control keeps a step until it can be much longer makes the observation rough.
TEST_CASE("abm: the error of Kepler's orbit falls with order 4 against the number of steps") {
    CHECK(std::abs(order_by_steps(Method::abm, 1e-7, 1e-11) - 4) < 0.5);
    const double coarse = equal_steps_error_from_short_ones<Abm>(400), fine = equal_steps_error_from_short_ones<Abm>(800);
    MESSAGE("in equal steps: errors " << coarse << " " << fine << ", order " << std::log2(coarse / fine));
    CHECK(std::abs(std::log2(coarse / fine) - 4) < 0.1);
}

TEST_CASE("bdf: orders up to 5 are reached, and errors follow the tolerance") {
    CHECK(order_by_steps(Method::bdf, 1e-6, 1e-10) > 4);
}

TEST_CASE("stiff methods: Prothero and Robinson's equation takes steps for its solution, not for its stiffness") {
    for (const Method method : stiff_methods)
        for (const double lambda : {-1e3, -1e6}) {
            const Trajectory motion = integrate(
                prothero_robinson(lambda), {0.0}, {.method = method, .duration = 10, .tolerance = 1e-8, .sample = 0.01});
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

// A mass on a stiff spring with critical damping, pushed slowly: x'' = −k (x − sin t) − 2 √k x'. The particular solution
// is x = Im(H e^{it}), H = k/(k − 1 + 2i√k). At k = 1e8 only radau: see bdf.hpp.
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
            const Eigen::MatrixXcd A = Eigen::MatrixXcd::Identity(size, size) * sigma - J.cast<std::complex<double>>();
            const Eigen::VectorXcd b = Eigen::VectorXcd::Random(size), expected = A.partialPivLu().solve(b);
            Shifted<std::complex<double>> system(size);
            system.factor(J, second_order(J), sigma);
            Eigen::VectorXcd x(size);
            system.solve(b, x);
            CHECK((x - expected).norm() < 1e-11 * expected.norm());
            Shifted<double> real(size);
            real.factor(J, second_order(J), 50.0);
            Eigen::VectorXd y(size);
            real.solve(b.real(), y);
            CHECK((50 * y - J * y - b.real()).norm() < 1e-11 * (J.norm() * y.norm() + 1));
        }
    }
}

TEST_CASE("stiff methods: a stiff spring with a damper follows what pushes it") {
    for (const auto& choice : {std::pair(Method::bdf, 1e4), std::pair(Method::radau, 1e4), std::pair(Method::radau, 1e8)}) {
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

TEST_CASE("multistep and implicit methods: a smaller tolerance gives a smaller error, and few steps are rejected") {
    const auto end = [](std::vector<double> start) {
        return integrate(pendulum(), start, {.duration = 30, .tolerance = 1e-15});
    };
    const Trajectory exact = end(pendulum_start);
    // What an error of 1 in one component at the start is at the end: some ten, since another energy is another period.
    const double growth = 1e6 * std::max(distance(end({2.0 + 1e-6, 0.3}).final_state(), exact.final_state()),
                                         distance(end({2.0, 0.3 + 1e-6}).final_state(), exact.final_state()));
    MESSAGE("growth " << growth);
    for (const Method method : {Method::abm, Method::bdf, Method::radau, Method::radau5, Method::radau9, Method::radau13}) {
        double last = HUGE_VAL, bound = 0;
        for (double tolerance = 1e-4; tolerance > 1e-11; tolerance /= 100) {
            const Trajectory motion =
                integrate(pendulum(), pendulum_start, {.method = method, .duration = 30, .tolerance = tolerance});
            const double error = distance(motion.final_state(), exact.final_state());
            INFO(name(method) << " at " << tolerance << ": " << error << ", " << motion.statistics.steps << " steps, "
                              << motion.statistics.rejected << " rejected " << motion.statistics.evaluations);
            CHECK(error < last / 3);
            CHECK(motion.statistics.rejected <= motion.statistics.steps / 4);
            last = error;
            bound = static_cast<double>(motion.statistics.steps) * tolerance * growth;
        }
        CHECK(last < bound);  // each step may be off by the tolerance
    }
}
