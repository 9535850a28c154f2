// SPDX-License-Identifier: MIT
// Every method ends for any input, with a result or with a message, within its budget.
#include <doctest/doctest.h>

#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "alembert/ode/hamiltonian_system.hpp"
#include "alembert/ode/integrate.hpp"

namespace runtime_limits {

using namespace alembert;

namespace {

struct Hard {
    std::string name;
    bool separable;  ///< q' = v, v' = a(q, t)
    Rhs rhs;
    std::vector<double> initial;
};

std::vector<Hard> hard_cases() {
    constexpr double nan = std::numeric_limits<double>::quiet_NaN();
    std::vector<Hard> list;
    const auto add = [&](const std::string& name, std::vector<double> initial, auto f, bool separable = false) {
        Rhs rhs = make_rhs(static_cast<int>(initial.size()), f);
        if (separable)  // M = 1, p = v, F = a
            rhs.canonical = std::make_shared<const HamiltonianSystem>(
                HamiltonianSystem{.coordinates = 1,
                                  .constraints = 0,
                                  .form =
                                      [f](double t, const double* y, double* out) {
                                          double rate[2];
                                          f(t, y, rate);
                                          out[0] = 1, out[1] = y[1], out[2] = rate[1];
                                      },
                                  .held = {}});
        list.push_back({name, separable, std::move(rhs), std::move(initial)});
    };
    add("stiff decay", {1, 0},
        [](double t, const double* y, double* f) { f[0] = -1e8 * (y[0] - std::cos(t)), f[1] = y[0]; });
    add("van der Pol, 1e6", {2, 0},
        [](double, const double* y, double* f) { f[0] = y[1], f[1] = 1e6 * ((1 - y[0] * y[0]) * y[1] - y[0]); });
    add(
        "stiff spring", {1.0001, 0},
        [](double, const double* y, double* f) { f[0] = y[1], f[1] = -1e10 * (y[0] - 1); }, true);
    add("a pole", {1, 0}, [](double, const double* y, double* f) { f[0] = y[0] * y[0], f[1] = 1; });
    add(
        "a collision", {1, 0},
        [](double, const double* y, double* f) { f[0] = y[1], f[1] = -1 / (y[0] * std::abs(y[0])); }, true);
    add("the end of a square root", {1, 0},
        [](double, const double* y, double* f) { f[0] = -std::sqrt(y[0]) - 0.1, f[1] = 1; });
    add(
        "a wall of not-a-number", {0, 1},
        [](double, const double* y, double* f) { f[0] = y[1], f[1] = y[0] > 0.5 ? nan : 0; }, true);
    add("chattering", {1, 0}, [](double, const double* y, double* f) { f[0] = y[0] > 0 ? -1 : 1, f[1] = y[0]; });
    add("dry friction on a spring", {1, 0}, [](double, const double* y, double* f) {
        f[0] = y[1], f[1] = -y[0] - (y[1] > 0 ? 0.3 : y[1] < 0 ? -0.3 : 0);
    });
    add("noise", {0, 0}, [](double t, const double* y, double* f) {
        f[0] = std::sin(1e15 * (t + y[0])), f[1] = std::cos(3e14 * y[0]);
    });
    add("growth to infinity", {1, 1},
        [](double, const double* y, double* f) { f[0] = 1e3 * y[0], f[1] = y[0] * y[1]; });
    return list;
}

}  // namespace

TEST_CASE(
    "no hang: every method ends hard cases within its budget, and says why where it did not come to the end") {
    constexpr long budget = 20000;
    for (const Hard& hard : hard_cases())
        for (const Method method : all_methods()) {
            if (needs_series(method) || ((needs_separable(method) || needs_canonical(method)) && !hard.separable))
                continue;
            for (const double tolerance : {1e-6, 1e-14}) {
                INFO(hard.name << ", " << name(method) << ", " << tolerance);
                const Trajectory run =
                    integrate(hard.rhs, hard.initial,
                              {.method = method,
                               .duration = 3,
                               .tolerance = tolerance,
                               .step = has_fixed_step(method) ? 1e-3 : 0,
                               .budget = budget,
                               .when_stiff = uses_jacobian(method) ? std::optional<Method>() : Method::radau});
                CHECK(run.statistics.evaluations <= budget);
                CHECK(run.rows() >= 1);
                CHECK(run.failure.has_value() == (run.ending == Ending::failed));
                if (run.failure) {
                    CHECK(run.failure->message.size() > 20);
                    CHECK(run.failure->time < 3);
                } else {
                    CHECK(run.times.back() == 3);
                    for (const double y : run.final_state()) CHECK(std::isfinite(y));
                }
            }
        }
}

// If the error of a step is only rounding, a shorter step is no better.
TEST_CASE("limits: tolerances below rounding take a few times the evaluations of 1e-13, not thousands") {
    const Rhs pendulum =
        make_rhs(2, [](double, const double* y, double* f) { f[0] = y[1], f[1] = -9.81 * std::sin(y[0]); });
    const Rhs planet = make_rhs(4, [](double, const double* y, double* f) {
        const double r2 = y[0] * y[0] + y[1] * y[1], r3 = r2 * std::sqrt(r2);
        f[0] = y[2], f[1] = y[3], f[2] = -y[0] / r3, f[3] = -y[1] / r3;
    });
    for (const Method method :
         {Method::dop853, Method::verner76, Method::verner98, Method::radau9, Method::radau13, Method::radau})
        for (const auto& one : {std::pair(&pendulum, std::vector<double>{2, 0}),
                                std::pair(&planet, std::vector<double>{0.5, 0, 0, 1.7})}) {
            INFO(name(method));
            const auto evaluations = [&](double tolerance) {
                const Trajectory run =
                    integrate(*one.first, one.second,
                              {.method = method, .duration = 20, .tolerance = tolerance, .budget = 3000000});
                CHECK(!run.failure);
                return run.statistics.evaluations;
            };
            const long usual = evaluations(1e-13);
            for (const double tolerance : {1e-14, 1e-15, 1e-16, 1e-20}) CHECK(evaluations(tolerance) < 12 * usual);
        }
}

}  // namespace runtime_limits
