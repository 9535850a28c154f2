// SPDX-License-Identifier: MIT
// The trial of methods before a long run, with times that no clock has measured.
#include "alembert/ode/method_trial.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <memory>

#include "alembert/ode/cost_model.hpp"
#include "alembert/ode/integrate.hpp"

namespace runtime_trial {

using namespace alembert;

namespace {

constexpr double pi = 3.14159265358979323846;

MethodAttempt dop853(double microseconds, double error) {
    return {.method = Method::dop853, .seconds = 1e-6 * microseconds, .error = error, .order = 8};
}
MethodAttempt verner98(double microseconds, double error) {
    return {.method = Method::verner98, .seconds = 1e-6 * microseconds, .error = error, .order = 9};
}
MethodAttempt taylor(double microseconds, double error) {
    return {.method = Method::taylor, .seconds = 1e-6 * microseconds, .error = error, .order = 20};
}

/// Kepler's orbit of eccentricity 0.6 and period 2π, from the near end.
struct Orbit {
    std::shared_ptr<long> calls = std::make_shared<long>(0);
    std::vector<double> initial = {0.4, 0, 0, 2};

    System system() const {
        Rhs rhs = make_rhs(4, [calls = calls](double, const double* y, double* rate) {
            ++*calls;
            const double r2 = y[0] * y[0] + y[1] * y[1], r3 = r2 * std::sqrt(r2);
            rate[0] = y[2];
            rate[1] = y[3];
            rate[2] = -y[0] / r3;
            rate[3] = -y[1] / r3;
        });
        rhs.effort = 300;
        return {.rhs = std::move(rhs)};
    }
};

Options orbits(double count, Method method, double tolerance) {
    return {.method = method, .duration = 2 * pi * count, .tolerance = tolerance};
}

}  // namespace

TEST_CASE(
    "trial: of a table of times and errors the least time to the same error is taken, if it is clearly less") {
    CHECK(fastest_of({dop853(100, 1e-9), verner98(60, 1e-9)}, Method::dop853) == Method::verner98);
    CHECK(fastest_of({dop853(100, 1e-9), verner98(95, 1e-9)}, Method::dop853) == Method::dop853);
    CHECK(fastest_of({dop853(95, 1e-9), verner98(100, 1e-9)}, Method::verner98) == Method::verner98);
    // To the error 1e-9 taylor would take 110 · 1e-4^(1/20) = 69, and the time of verner98 grows to 50 ·
    // 1e4^(1/9).
    CHECK(fastest_of({dop853(100, 1e-9), taylor(110, 1e-13)}, Method::dop853) == Method::taylor);
    CHECK(fastest_of({dop853(100, 1e-9), verner98(50, 1e-5)}, Method::dop853) == Method::dop853);
    CHECK(fastest_of({dop853(100, 1e-9), verner98(80, 1e-9), taylor(70, 1e-9)}, Method::dop853) == Method::taylor);
    // What lies below rounding is alike, and an error of zero is no advantage without end.
    CHECK(fastest_of({dop853(100, 3e-16), taylor(120, 0)}, Method::dop853) == Method::dop853);
}

TEST_CASE("trial: a long run takes the method that needs the fewest evaluations, if these are its time") {
    const Orbit orbit;
    const TrialSettings counted{.begin = {}, .clock = [&] { return 1e-6 * static_cast<double>(*orbit.calls); }};
    const auto trial = [&](Method usual, double tolerance) {
        return method_trial(orbit.system(), orbit.initial, orbits(3000, usual, tolerance),
                            {Method::dopri5, Method::dop853, Method::verner98}, counted);
    };
    for (const Method usual : {Method::dopri5, Method::dop853, Method::verner98}) {
        CAPTURE(name(usual));
        const auto found = trial(usual, 1e-11);
        REQUIRE(found);
        CHECK(found->fastest == Method::verner98);
        CHECK(found->attempts.front().method == usual);
        CHECK(found->until < 2 * pi * 300);
        // The same run to the same error: evaluations of the whole, by each method alone.
        const auto evaluations = [&](Method method) {
            return integrate(orbit.system(), orbit.initial, orbits(30, method, 1e-11)).statistics.evaluations;
        };
        CHECK(evaluations(Method::verner98) < evaluations(Method::dop853));
        CHECK(evaluations(Method::dop853) < evaluations(Method::dopri5));
        // By counts there is nothing that could differ from one time to the next.
        CHECK(trial(usual, 1e-11)->attempts.front().seconds == doctest::Approx(found->attempts.front().seconds));
    }
}

TEST_CASE("trial: errors are those at the end of the stretch, as a closed form has them") {
    const Orbit orbit;
    const auto found =
        method_trial(orbit.system(), orbit.initial, orbits(3000, Method::dop853, 1e-9), {Method::verner98});
    REQUIRE(found);
    for (const MethodAttempt& attempt : found->attempts) {
        CAPTURE(name(attempt.method));
        const auto end = integrate(orbit.system(), orbit.initial,
                                   {.method = attempt.method, .duration = found->until, .tolerance = 1e-9})
                             .final_state();
        // Kepler's equation t = E − e sin E, with a = 1.
        double anomaly = found->until;
        for (int k = 0; k < 60; ++k)
            anomaly -= (anomaly - 0.6 * std::sin(anomaly) - found->until) / (1 - 0.6 * std::cos(anomaly));
        const double rate = 1 / (1 - 0.6 * std::cos(anomaly));
        const double exact[] = {std::cos(anomaly) - 0.6, 0.8 * std::sin(anomaly), -std::sin(anomaly) * rate,
                                0.8 * std::cos(anomaly) * rate};
        double error = 0;
        for (std::size_t i = 0; i < 4; ++i)
            error = std::max(error, std::abs(end[i] - exact[i]) / std::max(1.0, std::abs(exact[i])));
        // The reference has a part of 1e-4 of the tolerance, and the orbit enlarges errors with time.
        CHECK(attempt.error == doctest::Approx(error).epsilon(0.05));
    }
}

TEST_CASE("trial: a short run tries nothing and looks at no clock") {
    const Orbit orbit;
    long looks = 0;
    const TrialSettings settings{.begin = {}, .clock = [&] { return 1e-6 * static_cast<double>(++looks); }};
    for (const double count : {0.1, 1.0, 5.0}) {
        const Options options = orbits(count, Method::dop853, 1e-9);
        CHECK(!method_trial(orbit.system(), orbit.initial, options, {Method::verner98}, settings));
        CHECK(*orbit.calls < integrate(orbit.system(), orbit.initial, options).statistics.evaluations + 200);
        *orbit.calls = 0;
    }
    CHECK(looks == 0);
    CHECK(!method_trial(orbit.system(), orbit.initial, orbits(3000, Method::dop853, 1e-9), {}, settings));
    CHECK(looks == 0);
}

// Ten orbits of eccentricity 0.99 look like thousands by their first steps. To follow a third of one orbit before
// that is seen is enough; all of it was followed once, which doubled the time of the run.
TEST_CASE(
    "trial: a run that begins where the motion is quickest is given up as too short within a few of its steps") {
    Orbit orbit;
    orbit.initial = {0.01, 0, 0, std::sqrt(1.99 / 0.01)};
    for (const Method usual : {Method::dop853, Method::verner98}) {
        const Options run = orbits(10, usual, 1e-9);
        *orbit.calls = 0;
        REQUIRE(integrate(orbit.system(), orbit.initial, run).ending == Ending::completed);
        const long whole = *orbit.calls;
        *orbit.calls = 0;
        CHECK_FALSE(method_trial(orbit.system(), orbit.initial, run, {Method::dop853, Method::verner98}));
        CAPTURE(name(usual));
        CAPTURE(whole);
        CAPTURE(*orbit.calls);
        CHECK(*orbit.calls > 50);  // it was followed for some steps
        CHECK(*orbit.calls < whole / 10);
    }
}

TEST_CASE("trial: of a very long run of cheap evaluations no more than a part of the budget is looked at") {
    const Orbit orbit;
    System system = orbit.system();
    system.rhs.effort = 1;
    const Options options = orbits(1e6, Method::dop853, 1e-9);
    const auto found = method_trial(system, orbit.initial, options, {Method::verner98});
    REQUIRE(found);
    CHECK(*orbit.calls < options.budget / 10);
}

TEST_CASE("trial: taylor is no rival where there is no power series") {
    const Orbit orbit;
    const auto found = method_trial(orbit.system(), orbit.initial, orbits(3000, Method::dop853, 1e-9),
                                    {Method::taylor, Method::verner98});
    REQUIRE(found);
    REQUIRE(found->attempts.size() == 2);
    CHECK(found->attempts[0].method == Method::dop853);
    CHECK(found->attempts[1].method == Method::verner98);
}

TEST_CASE("slowness: predicted times of evaluations are multiplied by that of the processor") {
    Rhs rhs = Orbit().system().rhs;
    const double here = effort_of_evaluation(rhs, false), implicit = effort_of_evaluation(rhs, true);
    rhs.slowness = slowness_of(Registers::wide);
    CHECK(effort_of_evaluation(rhs, false) == doctest::Approx(rhs.slowness.evaluation * here));
    CHECK(effort_of_evaluation(rhs, true) == doctest::Approx(rhs.slowness.evaluation * implicit));
    CHECK(slowness_of(Registers::widest).series == 1);
    CHECK(rhs.slowness.series > rhs.slowness.evaluation);
}

}  // namespace runtime_trial
