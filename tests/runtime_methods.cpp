// SPDX-License-Identifier: MIT
#include <doctest/doctest.h>

#include <cmath>
#include <complex>
#include <limits>
#include <numbers>
#include <utility>
#include <vector>

#include "alembert/ode/abm.hpp"
#include "alembert/ode/dop853.hpp"
#include "alembert/ode/explicit_rk.hpp"
#include "alembert/ode/integrate.hpp"
#include "alembert/ode/tableau.hpp"
#include "alembert/ode/verner.hpp"
#include "runtime_systems.hpp"

namespace runtime_methods {

using namespace alembert;
using namespace alembert::test;

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
            INFO("tree of " << tree.nodes << " nodes: " << sum << " for " << expected << ", rounding "
                            << absolute);
            // Each of the nodes brings a rounded coefficient and a sum of some twenty terms.
            CHECK(std::abs(sum - expected) <= 2 * tree.nodes * epsilon * absolute);
        };
        holds(table.a[Table::stages], 1 / tree.gamma);
        for (std::size_t row = 0; row < table.e.size(); ++row)
            if (tree.nodes <= exact_for_error_row[row]) holds(table.e[row], 0);
    }
}

/// The logistic equation y' = y (1 − y), y(0) = 1/10: the error after equal steps, by the closed form
/// y = 1/(1 + 9 e⁻ᵗ).
template <const auto& tableau>
double logistic_error(double duration, int steps) {
    const Rhs rhs = make_rhs(1, [](double, const double* y, double* rate) { rate[0] = y[0] * (1 - y[0]); });
    ExplicitRK<tableau> step(rhs, 0, std::vector<double>{0.1});
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
    ExplicitRK<tableau> step(rhs, 0, pendulum_start);
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

/// A stepper that never gets to the next step.
struct Standing : ExplicitRK<rk4_tableau> {
    using ExplicitRK<rk4_tableau>::ExplicitRK;
    void advance() = delete;
};
static_assert(SomeStepper<ExplicitRK<rk4_tableau>> && !SomeStepper<Standing>);
static_assert(!KnowsSeries<ExplicitRK<dop853_tableau>> && !ChoosesLength<ExplicitRK<dop853_tableau>>);
static_assert(SomeStepper<FormulaStepper<Abm>> && !SomeStepper<Abm> && StepFormula<Abm> &&
              !KnowsSeries<FormulaStepper<Abm>>);
static_assert(ChoosesLength<FormulaStepper<Abm>> && MovesOn<Abm> && !FindsEndRate<Abm> && !KeepsConstraints<Abm>);

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

// Hairer, Nørsett, Wanner I, §II.2, theorem 2.13: Σ b_i Φ_i(τ) = 1/γ(τ) for the trees τ of at most p nodes. There
// are 85 of at most 7 nodes and 486 of at most 9.
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
    ExplicitRK<dop853_tableau> step(rhs, 0, pendulum_start);
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

TEST_CASE("tolerance: 1e-14 is used as given, and the result is that accurate") {
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

TEST_CASE("state: the small changes of short steps to a large state are not lost") {
    // 1e6 + t in steps of 1e-6: each sum would lose up to 5.8e-11, in the same direction every time.
    const Rhs drift = make_rhs(1, [](double, const double*, double* rate) { rate[0] = 1; });
    const Trajectory motion = integrate(drift, {1e6}, {.method = Method::rk4, .duration = 1, .step = 1e-6});
    CHECK(std::abs(motion.final_state()[0] - 1000001) <= 1.2e-10);  // one unit in the last place
}

TEST_CASE("steps: a run that may go over to a power series, but has none, keeps its steps") {
    const Options alone{.method = Method::verner98, .duration = 200, .tolerance = 1e-9};
    Options may_change = alone;
    may_change.when_cheaper = Method::taylor;
    const Trajectory motion = integrate(kepler(), kepler_start, alone),
                     other = integrate(kepler(), kepler_start, may_change);
    CHECK(!other.statistics.switched);
    CHECK(other.statistics.steps == motion.statistics.steps);
    CHECK(distance(other.final_state(), motion.final_state()) == 0);
}

// 4 components are summed in registers of two numbers, 12 and 36 in registers of four, where the processor has
// them; past 16 the distance from stage to stage is no constant.
TEST_CASE("state: copies of an orbit in one long state have the digits that one has alone") {
    constexpr std::size_t one = 4;
    const Rhs orbit = kepler();
    for (const std::size_t copies : {3UL, 9UL}) {
        const std::size_t size = copies * one;
        const Rhs many = make_rhs(static_cast<int>(size), [&](double t, const double* y, double* rate) {
            for (std::size_t k = 0; k < size; k += one) orbit(t, y + k, rate + k);
        });
        std::vector<double> start;
        for (std::size_t k = 0; k < copies; ++k)
            start.insert(start.end(), kepler_start.begin(), kepler_start.end());
        for (const Method method :
             {Method::rk4, Method::dopri5, Method::dop853, Method::verner76, Method::verner98}) {
            CAPTURE(name(method));
            const Options options{.method = method,
                                  .duration = 10,
                                  .tolerance = 1e-10,
                                  .step = method == Method::rk4 ? 0.01 : 0,
                                  .sample = 0.1};
            const Trajectory alone = integrate(orbit, kepler_start, options),
                             together = integrate(many, start, options);
            REQUIRE(alone.rows() == together.rows());
            CHECK(alone.statistics.evaluations == together.statistics.evaluations);
            for (std::size_t row = 0; row < alone.times.size(); ++row)
                for (std::size_t i = 0; i < size; ++i)
                    REQUIRE(together.states[row * size + i] == alone.states[row * one + i % one]);
        }
    }
}

TEST_CASE("state: a projection that moves nothing costs no evaluation and changes no bit") {
    for (const Method method :
         {Method::rk4, Method::dopri5, Method::dop853, Method::verner98, Method::abm, Method::radau5}) {
        CAPTURE(name(method));
        const Options options{.method = method,
                              .duration = 10,
                              .tolerance = 1e-10,
                              .step = has_fixed_step(method) ? 0.01 : 0,
                              .sample = 0.5};
        const Trajectory without = integrate(kepler(), kepler_start, options);
        int asked = 0;
        const auto project = [&](double, double*) { ++asked; };
        const Trajectory with = integrate(System{.rhs = kepler(), .project = project}, kepler_start, options);
        CHECK(with.states == without.states);
        CHECK(with.statistics.evaluations == without.statistics.evaluations);
        CHECK(asked > 10);
    }
}

}  // namespace runtime_methods
