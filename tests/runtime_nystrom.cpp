// SPDX-License-Identifier: MIT
// Methods for accelerations that do not depend on rates: the conditions of their order, orbits and oscillators
// against closed forms, states within a step, and quadratures.
#include <doctest/doctest.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>
#include <vector>

#include "alembert/ode/formula_stepper.hpp"
#include "alembert/ode/integrate.hpp"
#include "alembert/ode/nystrom.hpp"
#include "runtime_systems.hpp"

namespace runtime_nystrom {

using namespace alembert;
using namespace alembert::test;

namespace {

constexpr double epsilon = std::numeric_limits<double>::epsilon();
constexpr std::size_t at(int i) {
    return static_cast<std::size_t>(i);
}

/// A tree of derivatives of a(q): so many rates v at its root, and branches, each a position in the list that it
/// is in. The order is that of its term h^order in v; along the solution it is exact·θ^(order−1).
struct Tree {
    int rates;
    std::vector<int> branches;
    int order;
    double exact;
};

/// All to an order, in the order of their size: branches from the last taken backwards, so that each multiset
/// comes once. A branch of order r enters by its position, of order r + 1, which is the double integral.
std::vector<Tree> trees_to(int most) {
    std::vector<Tree> trees;
    const auto graft = [&](auto&& self, int left, int last, const Tree& tree) -> void {
        Tree full = tree;
        full.rates = left;
        trees.push_back(full);
        for (int k = last; k >= 0; --k) {
            const Tree branch = trees[at(k)];
            if (branch.order + 1 > left) continue;
            Tree more = tree;
            more.branches.push_back(k);
            more.exact *= branch.exact / (branch.order * (branch.order + 1));
            self(self, left - branch.order - 1, k, more);
        }
    };
    for (int order = 1; order <= most; ++order)
        graft(graft, order - 1, static_cast<int>(trees.size()) - 1, {0, {}, order, 1});
    return trees;
}

/// Σ_i w_i Φ_i of each tree is what it is along the solution, for the weights of both formulas.
template <class Table>
void check_conditions(const Table& table) {
    const std::vector<Tree> trees = trees_to(table.order);
    MESSAGE(trees.size() << " trees");
    std::vector<typename Table::Row> phi, size;
    for (const Tree& tree : trees) {
        phi.emplace_back();
        size.emplace_back();
        for (std::size_t i = 0; i < table.c.size(); ++i) {
            double value = std::pow(table.c[i], tree.rates), absolute = value;
            for (const int branch : tree.branches) {
                double sum = 0, of_sizes = 0;
                for (std::size_t j = 0; j < i; ++j) {
                    sum += table.a[i][j] * phi[at(branch)][j];
                    of_sizes += std::abs(table.a[i][j]) * size[at(branch)][j];
                }
                value *= sum;
                absolute *= of_sizes;
            }
            phi.back()[i] = value;
            size.back()[i] = absolute;
        }
        const auto holds = [&](const typename Table::Row& weights, double expected) {
            double sum = 0, absolute = 0;
            for (std::size_t i = 0; i < weights.size(); ++i) {
                sum += weights[i] * phi.back()[i];
                absolute += std::abs(weights[i]) * size.back()[i];
            }
            INFO("a tree of order " << tree.order << ": " << sum << " for " << expected << ", rounding "
                                    << absolute);
            // Each order brings a rounded coefficient and a sum of some ten terms.
            CHECK(std::abs(sum - expected) <= 2 * tree.order * epsilon * (absolute + std::abs(expected)));
        };
        const int order = tree.order;
        const double of_rate = tree.exact / order, of_position = of_rate / (order + 1);
        holds(table.b_rate, of_rate);
        if (order < table.order) holds(table.b, of_position);
        // The embedded pair has two orders less.
        if (order <= table.order - 2) holds(table.e_rate, 0);
        if (order < table.order - 2) holds(table.e, 0);
    }
}

/// The error of Kepler's orbit after one turn in n equal steps.
template <const auto& tableau>
double error_after_turn(int steps) {
    const double turn = 2 * std::numbers::pi;
    const Rhs rhs = kepler();
    FormulaStepper<Nystrom<tableau>> step(rhs, 0, kepler_start, 1e-9);
    for (int i = 1; i <= steps; ++i) {
        step.attempt(turn * i / steps);
        REQUIRE(step.finish());
        step.advance();
    }
    return distance({step.state(), 4}, kepler_start);
}

template <const auto& tableau>
double observed_order(int steps, int more) {
    const double coarse = error_after_turn<tableau>(steps), fine = error_after_turn<tableau>(more);
    const double order = std::log(coarse / fine) / std::log(static_cast<double>(more) / steps);
    MESSAGE(steps << " and " << more << " steps: errors " << coarse << " " << fine << ", order " << order);
    return order;
}

/// The largest error within one step of length h from the start of Kepler's orbit, and the estimated one.
template <const auto& tableau>
std::pair<double, double> errors_within(double h) {
    const Rhs rhs = kepler();
    FormulaStepper<Nystrom<tableau>> step(rhs, 0, kepler_start, 1e-9);
    step.attempt(h);
    const double estimated = step.error_norm();
    REQUIRE(step.finish());
    const auto exact = [&](double t) {
        const Trajectory motion = integrate(
            rhs, kepler_start, {.method = Method::verner98, .duration = t, .tolerance = 1e-15, .sample = t});
        return std::vector<double>(motion.final_state().begin(), motion.final_state().end());
    };
    double worst = 0, y[4];
    for (int i = 1; i < 16; ++i) {
        step.interpolate(i / 16., y);
        worst = std::max(worst, distance({y, 4}, exact(h * i / 16)));
    }
    MESSAGE(h << ": " << worst << " within, " << distance({step.end_state(), 4}, exact(h)) << " at the end, "
              << estimated << " estimated");
    return {worst, estimated};
}

/// x″ = −x + cos 2t from rest, x = (cos t − cos 2t)/3, and the work of the load, w′ = x′ cos 2t.
Rhs driven() {
    return make_rhs(
        3,
        [](double t, const double* y, double* rate) {
            rate[0] = y[1];
            rate[1] = -y[0] + std::cos(2 * t);
            rate[2] = y[1] * std::cos(2 * t);
        },
        1);
}

/// The energy that the load has brought.
double work_until(double t) {
    const double x = (std::cos(t) - std::cos(2 * t)) / 3, v = (2 * std::sin(2 * t) - std::sin(t)) / 3;
    return (x * x + v * v) / 2;
}

constexpr Method both[] = {Method::rkn86, Method::rkn1210};

}  // namespace

TEST_CASE("nystrom: the conditions of order hold, tree by tree, for both formulas of each pair") {
    check_conditions(rkn86_tableau);
    check_conditions(rkn1210_tableau);
}

TEST_CASE("nystrom: the error of Kepler's orbit falls with the order of the method") {
    CHECK(observed_order<rkn86_tableau>(60, 120) > 7.8);
    CHECK(observed_order<rkn1210_tableau>(12, 18) > 11.5);
}

TEST_CASE("nystrom: states within a step are about as exact as is estimated, and its ends are met") {
    for (const double h : {0.1, 0.2, 0.4}) {
        const auto [within, estimated] = errors_within<rkn86_tableau>(h);
        CHECK(within < 2 * estimated);  // the polynomial adds its own error, which is a part of this
        const auto [within12, estimated12] = errors_within<rkn1210_tableau>(2 * h);
        CHECK(within12 < 2 * estimated12);
    }
    const Rhs rhs = kepler();
    FormulaStepper<Nystrom<rkn1210_tableau>> step(rhs, 0, kepler_start, 1e-9);
    step.attempt(0.3);
    REQUIRE(step.finish());
    const long before = step.evaluations();
    double y[4];
    step.interpolate(0, y);
    CHECK(distance({y, 4}, kepler_start) <= 4 * epsilon);
    step.interpolate(1, y);
    CHECK(distance({y, 4}, {step.end_state(), 4}) <= 16 * epsilon);
    CHECK(step.evaluations() == before + 2 * 8);  // two places, found once
}

TEST_CASE("nystrom: orbits close to the tolerance, few steps are rejected, and rows between steps are right") {
    for (const Method method : both)
        for (const double tolerance : {1e-7, 1e-9, 1e-11, 1e-13}) {
            const Trajectory orbit = integrate(kepler(), kepler_start,
                                               {.method = method,
                                                .duration = 20 * std::numbers::pi,
                                                .tolerance = tolerance,
                                                .sample = std::numbers::pi / 5});
            INFO(name(method) << " at " << tolerance << ": " << distance(orbit.final_state(), kepler_start));
            CHECK(distance(orbit.final_state(), kepler_start) < 1e3 * tolerance);
            CHECK(orbit.statistics.rejected <= orbit.statistics.steps / 4);
            // Ten rows a turn: each turn has those of the first.
            for (std::size_t row = 0; row + 10 < orbit.rows(); ++row)
                CHECK(distance(orbit.state(row), orbit.state(row + 10)) < 1e3 * tolerance);
        }
}

TEST_CASE("nystrom: loads of time, and their work, follow closed forms at the end and in rows") {
    for (const Method method : both) {
        const Trajectory motion =
            integrate(driven(), {0, 0, 0}, {.method = method, .duration = 5, .tolerance = 1e-11, .sample = 0.37});
        REQUIRE(motion.ending == Ending::completed);
        for (std::size_t row = 0; row < motion.rows(); ++row) {
            const double t = motion.times[row];
            INFO(name(method) << " at " << t);
            CHECK(std::abs(motion.state(row)[0] - (std::cos(t) - std::cos(2 * t)) / 3) < 1e-9);
            CHECK(std::abs(motion.state(row)[2] - work_until(t)) < 1e-9);
        }
    }
}

TEST_CASE("nystrom: an event is found where the motion has it") {
    const Events events = make_events({{.name = "round", .stop = true, .direction = 1}},
                                      [](double, const double* y, const double*, double* out) { *out = y[1]; });
    for (const Method method : both) {
        const Trajectory orbit =
            integrate(kepler(), kepler_start, {.method = method, .duration = 20, .tolerance = 1e-11}, events);
        REQUIRE(orbit.ending == Ending::stopped_by_event);
        CHECK(std::abs(orbit.times.back() - 2 * std::numbers::pi) < 1e-9);
    }
}

// Two components are summed in registers of two numbers, eighteen in registers of four, where the processor has
// them.
TEST_CASE("nystrom: copies of an orbit in one long state have the digits that one has alone") {
    const Rhs orbit = kepler();
    for (const std::size_t copies : {3UL, 9UL}) {
        const std::size_t half = 2 * copies;
        const Rhs many = make_rhs(static_cast<int>(2 * half), [&](double t, const double* y, double* rate) {
            for (std::size_t k = 0; k < copies; ++k) {
                const double one[4] = {y[2 * k], y[2 * k + 1], y[half + 2 * k], y[half + 2 * k + 1]};
                double of_one[4];
                orbit(t, one, of_one);
                for (std::size_t i = 0; i < 2; ++i)
                    rate[2 * k + i] = of_one[i], rate[half + 2 * k + i] = of_one[2 + i];
            }
        });
        std::vector<double> start(2 * half);
        for (std::size_t i = 0; i < half; ++i)
            start[i] = kepler_start[i % 2], start[half + i] = kepler_start[2 + i % 2];
        for (const Method method : both) {
            const Options options{.method = method, .duration = 10, .tolerance = 1e-10, .sample = 0.1};
            const Trajectory alone = integrate(orbit, kepler_start, options),
                             together = integrate(many, start, options);
            REQUIRE(alone.rows() == together.rows());
            CHECK(alone.statistics.evaluations == together.statistics.evaluations);
            for (std::size_t row = 0; row < alone.rows(); ++row)
                for (std::size_t i = 0; i < half; ++i) {
                    REQUIRE(together.state(row)[i] == alone.state(row)[i % 2]);
                    REQUIRE(together.state(row)[half + i] == alone.state(row)[2 + i % 2]);
                }
        }
    }
}

TEST_CASE("nystrom: a state that is not positions and their rates is refused") {
    const Rhs decay = make_rhs(1, [](double, const double* y, double* rate) { rate[0] = -y[0]; });
    CHECK_THROWS_AS(integrate(decay, {1}, {.method = Method::rkn86, .duration = 1}), std::invalid_argument);
}

}  // namespace runtime_nystrom
