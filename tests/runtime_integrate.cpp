// SPDX-License-Identifier: MIT
#include <doctest/doctest.h>

#include <cmath>
#include <limits>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

#include "alembert/base/error.hpp"
#include "alembert/ode/integrate.hpp"

namespace runtime_integrate {

using namespace alembert;

namespace {

constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();

Rhs decay() {
    return make_rhs(1, [](double, const double* y, double* rate) { rate[0] = -y[0]; });
}

Rhs blow_up() {
    return make_rhs(2, [](double, const double* y, double* rate) {
        rate[0] = 1;
        rate[1] = y[1] * y[1];
    });
}

bool contains(const std::string& text, const std::string& part) {
    return text.find(part) != std::string::npos;
}

// The double pendulum: 2 θ₁'' + c θ₂'' = −s ω₂² − 2 g sin θ₁, c θ₁'' + θ₂'' = s ω₁² − g sin θ₂.
constexpr double g = 9.81;

Rhs double_pendulum() {
    return make_rhs(4, [](double, const double* y, double* rate) {
        const double c = std::cos(y[0] - y[1]), s = std::sin(y[0] - y[1]);
        const double f1 = -s * y[3] * y[3] - 2 * g * std::sin(y[0]);
        const double f2 = s * y[2] * y[2] - g * std::sin(y[1]);
        rate[0] = y[2];
        rate[1] = y[3];
        rate[2] = (f1 - c * f2) / (2 - c * c);
        rate[3] = (2 * f2 - c * f1) / (2 - c * c);
    });
}

double kinetic(const double* y) {
    return y[2] * y[2] + 0.5 * y[3] * y[3] + y[2] * y[3] * std::cos(y[0] - y[1]);
}

double energy(const double* y) {
    return kinetic(y) - 2 * g * std::cos(y[0]) - g * std::cos(y[1]);
}

struct Chaos {
    double error = 0;  ///< the largest of the four components
    double drift = 0;  ///< as docs/commands.md defines it, over rows and accepted steps
};

Chaos chaos(double tolerance) {
    const std::vector<double> start = {2, 2.5, 0, 0};
    const double reference[4] = {-0.75312887429491135, 1.6279330820537041, -4.0873688513441969,
                                 -8.8697025783875326};
    double drift = 0, largest = std::abs(energy(start.data()));
    const auto look = [&](const double* y) {
        drift = std::max(drift, std::abs(energy(y) - energy(start.data())));
        largest = std::max(largest, kinetic(y));
    };
    const Trajectory motion = integrate(
        double_pendulum(), start,
        {.method = Method::dop853,
         .duration = 10,
         .tolerance = tolerance,
         .on_step = [&](double, std::span<const double> y, std::span<const double>) { look(y.data()); }});
    for (std::size_t row = 0; row < motion.rows(); ++row) look(motion.state(row).data());
    Chaos result{.error = 0, .drift = drift / largest};
    for (std::size_t i = 0; i < 4; ++i)
        result.error = std::max(result.error, std::abs(motion.final_state()[i] - reference[i]));
    MESSAGE("tolerance " << tolerance << ": error " << result.error << ", drift " << result.drift);
    return result;
}

}  // namespace

// The bounds are our own; errors grow about 10⁷-fold during the motion.
TEST_CASE("dop853: the chaotic double pendulum at t = 10 agrees with 39 digits, and keeps its energy") {
    const Chaos loose = chaos(1e-13);
    CHECK(loose.error < 1e-4);
    CHECK(loose.drift < 1e-11);
    const Chaos tight = chaos(1e-14);
    CHECK(tight.error < 1e-5);
    CHECK(tight.drift < 1e-11);
}

TEST_CASE("trajectory: rows lie on the grid, and the last one is the end, once") {
    const auto times = [](double duration, double sample) {
        return integrate(decay(), {1.0}, {.start = 1, .duration = duration, .sample = sample}).times;
    };
    CHECK(times(1, 0.25) == std::vector<double>{1, 1.25, 1.5, 1.75, 2});
    CHECK(times(1, 0.4) == std::vector<double>{1, 1.4, 1.8, 2});
    CHECK(times(1, 5) == std::vector<double>{1, 2});
    CHECK(times(0, 0) == std::vector<double>{1});
    CHECK(times(0.3, 0.1).size() == 4);  // 3 · 0.1 > 0.3 in binary
    CHECK(times(0.3, 0.1).back() == 1.3);
    CHECK(times(7, 0).size() == 201);
}

TEST_CASE("trajectory: rows between steps are as good as the steps") {
    for (const Method method : {Method::rk4, Method::dopri5, Method::dop853, Method::verner76, Method::verner98}) {
        const Trajectory motion = integrate(decay(), {1.0},
                                            {.method = method,
                                             .duration = 5,
                                             .tolerance = 1e-9,
                                             .step = has_fixed_step(method) ? 0.01 : 0,
                                             .sample = 0.013});
        for (std::size_t row = 0; row < motion.rows(); ++row) {
            INFO(name(method) << " at " << motion.times[row]);
            // rk4: h⁴/384 for a cubic Hermite polynomial; else about ten steps' worth of tolerance.
            CHECK(std::abs(motion.state(row)[0] - std::exp(-motion.times[row])) < 1e-8);
        }
    }
}

TEST_CASE("statistics: evaluations and steps are counted") {
    long calls = 0, told = 0;
    double last = -1;
    const Rhs counted = make_rhs(1, [&calls](double, const double* y, double* rate) {
        ++calls;
        rate[0] = -y[0];
    });
    const Events events = make_events(
        {{.name = "half"}}, [](double, const double* y, const double*, double* out) { out[0] = y[0] - 0.5; });
    for (const Method method :
         {Method::euler, Method::rk2, Method::rk4, Method::dopri5, Method::dop853, Method::verner76,
          Method::verner98, Method::gauss, Method::abm, Method::bdf, Method::radau}) {
        calls = told = 0;
        const Trajectory motion =
            integrate(counted, {1.0},
                      {.method = method,
                       .duration = 2,
                       .step = has_fixed_step(method) ? 0.01 : 0,
                       .on_step =
                           [&](double t, std::span<const double> y, std::span<const double> rate) {
                               CHECK(rate[0] == -y[0]);
                               last = t;
                               ++told;
                           }},
                      events);
        CHECK(motion.statistics.evaluations == calls);
        CHECK(motion.statistics.steps + 1 == told);
        CHECK(last == 2);
        CHECK(motion.statistics.method == name(method));
        CHECK(method_named(motion.statistics.method) == method);
        REQUIRE(motion.events.size() == 1);
    }
    CHECK(!method_named("dop8530"));
}

TEST_CASE("taylor: a run computes one series for each step, and of the last one, at its end, the rate alone") {
    static std::vector<int> orders;  // of the series y(t) Σ (−s)^k/k! of y' = −y
    orders.clear();
    static const alembert_series_table table{
        .abi = series_abi_version,
        .coordinates = 1,
        .speeds = 0,
        .extra = 0,
        .parameters = 0,
        .constants = 0,
        .workspace = 0,
        .workspace_quad = 0,
        .order_cost = 0.05,
        .product_cost = 0,
        .scene = "decay",
        .parameter_values = nullptr,
        .prepare = nullptr,
        .series =
            [](double, const double* state, const double*, int order, double* out, double*) {
                orders.push_back(order);
                out[0] = state[0];
                for (int k = 1; k <= order; ++k) out[k] = -out[k - 1] / k;
            },
        .prepare_quad = nullptr,
        .series_quad = nullptr};
    Rhs rhs = decay();
    rhs.series = {.module = SeriesModule(&table, [](const alembert_series_table*) {}),
                  .par = std::make_shared<const std::vector<double>>(),
                  .width = 1,
                  .workspace = 0};
    double rate_at_end = 0;
    const Trajectory motion = integrate(rhs, {1.0},
                                        {.method = Method::taylor,
                                         .duration = 20,
                                         .tolerance = 1e-12,
                                         .on_step = [&](double, std::span<const double>,
                                                        std::span<const double> rate) { rate_at_end = rate[0]; }});
    REQUIRE(orders.size() == static_cast<std::size_t>(motion.statistics.steps) + 1);
    CHECK(motion.statistics.steps > 2);
    for (std::size_t k = 0; k + 1 < orders.size(); ++k) CHECK(orders[k] == orders[0]);
    CHECK(orders[0] > 14);
    CHECK(orders.back() == 1);
    CHECK(rate_at_end == -motion.final_state()[0]);
    CHECK(std::abs(motion.final_state()[0] - std::exp(-20)) < 1e-12);
}

TEST_CASE("first step: a state at rest, and one that starts at zero, take few steps to the first long one") {
    const auto moved = [](auto acceleration, double tolerance) {
        return integrate(make_rhs(2,
                                  [acceleration](double t, const double* y, double* rate) {
                                      rate[0] = y[1];
                                      rate[1] = acceleration(t);
                                  }),
                         {0.0, 0.0}, {.method = Method::dop853, .duration = 10, .tolerance = tolerance});
    };
    // 1 s, six times as much, and the rest of 10 s
    CHECK(moved([](double) { return 0.0; }, 1e-6).statistics.steps == 3);
    // (0.01 tolerance)^(1/8) = 0.1 s, then six times as much each
    const Trajectory falls = moved([](double) { return 1.0; }, 1e-6);
    CHECK(falls.statistics.steps == 4);
    CHECK(std::abs(falls.final_state()[0] - 50) < 1e-12);
    // What begins slowly is seen, though the rate is zero at first.
    const Trajectory slow = moved([](double t) { return t * t * t * std::cos(3 * t); }, 1e-10);
    const auto exact = [](double t) {  // ∫∫ t³ cos 3t
        return (t * t * t / -9 + 2 * t / 9) * std::cos(3 * t) + (2 * t * t / 9 - 8.0 / 81) * std::sin(3 * t);
    };
    CHECK(std::abs(slow.final_state()[0] - (exact(10) - exact(0) - 10 * (2.0 / 9 - 24.0 / 81))) < 1e-7);
}

TEST_CASE("quadrature: it follows the motion and does not affect its steps") {
    const Rhs wild = make_rhs(
        2,
        [](double t, const double* y, double* rate) {
            rate[0] = -y[0];
            rate[1] = std::cos(200 * t);
        },
        1);
    const Trajectory with = integrate(wild, {1.0, 0.0}, {.duration = 3});
    const Trajectory without = integrate(decay(), {1.0}, {.duration = 3});
    CHECK(with.statistics.steps == without.statistics.steps);
    CHECK(with.final_state()[0] == without.final_state()[0]);

    const Rhs tame = make_rhs(
        2,
        [](double, const double* y, double* rate) {
            rate[0] = -y[0];
            rate[1] = y[0];
        },
        1);
    const Trajectory motion = integrate(tame, {1.0, 0.0}, {.duration = 3, .tolerance = 1e-12});
    CHECK(std::abs(motion.final_state()[0] + motion.final_state()[1] - 1) < 1e-11);
}

// y' = y², y(0) = 1 is 1/(1 − t); y₀ = t does not take part.
TEST_CASE("failure: a solution that blows up ends in step size underflow at its pole") {
    for (const Method method : {Method::dopri5, Method::dop853, Method::verner76, Method::verner98}) {
        const Trajectory motion = integrate(blow_up(), {0, 1}, {.method = method, .duration = 2});
        REQUIRE(motion.failure);
        CHECK(motion.ending == Ending::failed);
        CHECK(motion.failure->kind == FailureKind::step_underflow);
        CHECK(motion.failure->component == 1);
        CHECK(std::abs(motion.failure->time - 1) <
              1e-7);  // 1/(1 − t) grows by the relative error of the run near the pole
        CHECK(motion.times.back() == motion.failure->time);
        CHECK(motion.rows() > 100);
        CHECK(contains(motion.failure->message, "step size underflow at t = "));
        CHECK(contains(motion.failure->message, "component 1"));
        CHECK_THROWS_AS(throw_failure(*motion.failure), IntegrationError);
    }
}

TEST_CASE("failure: a run ends close to where a rate stops being a number, and the component is named") {
    Rhs edge = make_rhs(2, [](double t, const double*, double* rate) {
        rate[0] = 1;
        rate[1] = std::sqrt(1 - t);
    });
    edge.names = {"x", "x'"};
    const Trajectory motion = integrate(edge, {0, 0}, {.duration = 2});
    REQUIRE(motion.failure);
    CHECK(motion.failure->kind == FailureKind::step_underflow);
    CHECK(motion.failure->component == 1);
    CHECK(contains(motion.failure->message, "x' (component 1)"));
    CHECK(contains(motion.failure->message, "not finite"));
    CHECK(std::abs(motion.failure->time - 1) < 1e-14);
    CHECK(std::abs(motion.failure->state[1] - 2. / 3) < 1e-7);  // error control hardly notices the kink
}

TEST_CASE("failure: a rate that is not a number at the start is reported at once") {
    const Rhs nowhere = make_rhs(1, [](double, const double*, double* rate) { rate[0] = not_a_number; });
    const Trajectory motion = integrate(nowhere, {1}, {.duration = 1});
    REQUIRE(motion.failure);
    CHECK(motion.failure->kind == FailureKind::not_a_number);
    CHECK(motion.rows() == 1);
    CHECK(motion.statistics.steps == 0);
    CHECK(integrate(nowhere, {1}, {.duration = 0}).failure);
}

TEST_CASE("failure: a fixed step that overflows stops at the last good state") {
    const Trajectory motion = integrate(blow_up(), {0, 1}, {.method = Method::rk4, .duration = 3, .step = 0.01});
    REQUIRE(motion.failure);
    CHECK(motion.failure->kind == FailureKind::not_a_number);
    CHECK(motion.failure->component == 1);
    CHECK(std::isfinite(motion.final_state()[1]));
    CHECK(motion.failure->time < 1.2);
}

TEST_CASE("failure: a budget that is used up keeps the rows until then") {
    for (const Method method : {Method::rk4, Method::dop853}) {
        const Trajectory motion = integrate(decay(), {1.0},
                                            {.method = method,
                                             .duration = 1e6,
                                             .step = has_fixed_step(method) ? 1.0 : 0.0,
                                             .longest_step = 1,
                                             .sample = 1,
                                             .budget = 1000});
        REQUIRE(motion.failure);
        CHECK(motion.failure->kind == FailureKind::budget_used_up);
        CHECK(motion.statistics.evaluations <= 1000);
        CHECK(motion.statistics.evaluations > 900);
        CHECK(motion.rows() > 50);
        CHECK(contains(motion.failure->message, "1000 right-hand sides"));
    }
}

TEST_CASE("options: invalid ones are refused by name") {
    const auto refusal = [](const Options& options, const std::vector<double>& initial = {1.0}) -> std::string {
        try {
            integrate(decay(), initial, options);
        } catch (const std::invalid_argument& error) {
            return error.what();
        }
        return "";
    };
    CHECK(contains(refusal({.duration = not_a_number}), "duration=nan: expected a"));
    CHECK(contains(refusal({.duration = -1}), "duration=-1: expected a"));
    CHECK(contains(refusal({.duration = HUGE_VAL}), "duration=inf: expected a"));
    CHECK(contains(refusal({.start = not_a_number, .duration = 1}), "start=nan: expected a"));
    CHECK(contains(refusal({.duration = 1, .tolerance = 0}), "tolerance=0: expected a"));
    CHECK(contains(refusal({.duration = 1, .tolerance = -1e-9}), "tolerance=-1e-09: expected a"));
    CHECK(contains(refusal({.duration = 1, .sample = -1}), "sample=-1: expected a"));
    CHECK(contains(refusal({.duration = 1, .sample = 1e-12}), "more than 1e+08 rows"));
    CHECK(contains(refusal({.duration = 1, .budget = 0}), "budget=0: expected a"));
    CHECK(contains(refusal({.method = Method::rk4, .duration = 1}), "rk4 has a fixed step"));
    CHECK(contains(refusal({.duration = 1}, {1.0, 2.0}), "1 components, 2 initial values"));
    CHECK(refusal({.duration = 1}, {not_a_number}) == "initial[0]=nan: expected a finite number");
    CHECK(refusal({.method = Method::euler, .duration = 0}).empty());
}

// x'' + x = exp(−((t − 5)/w)²) from rest: x(20) = w √π exp(−w²/4) sin 15.
TEST_CASE("quick times: steps that know of a narrow pulse do not miss it, and are no shorter elsewhere") {
    const double w = 1e-4, exact = w * std::sqrt(std::acos(-1.0)) * std::exp(-w * w / 4) * std::sin(15.0);
    const Rhs rhs = make_rhs(2, [=](double t, const double* y, double* rate) {
        rate[0] = y[1];
        rate[1] = std::exp(-(t - 5) / w * (t - 5) / w) - y[0];
    });
    for (const Method method : {Method::dopri5, Method::dop853, Method::verner76, Method::verner98, Method::abm,
                                Method::bdf, Method::radau}) {
        INFO(name(method));
        Options options{.method = method, .duration = 20, .tolerance = 1e-12};
        System system{.rhs = rhs, .quick_times = {{.from = 5 - 4 * w, .to = 5 + 4 * w, .enter = w, .step = w}}};
        const Trajectory motion = integrate(system, {0, 0}, options);
        REQUIRE_FALSE(motion.failure);
        CHECK(std::abs(motion.final_state()[0] - exact) < 1e-8);
        system.quick_times = {{.from = 5 - 4 * w, .to = 5 + 4 * w, .enter = 0, .step = w}};
        bool lands = false;
        options.on_step = [&](double t, std::span<const double>, std::span<const double>) {
            lands = lands || std::abs(t - (5 - 4 * w)) < 1e-14;
        };
        integrate(system, {0, 0}, options);
        CHECK(lands);
    }
    CHECK(latest_end({}, 3) == HUGE_VAL);
    const std::vector<InputTimeScale> quick{{.from = 1, .to = 2, .enter = 3, .step = 3},
                                            {.from = 2, .to = 2.5, .enter = 0.1, .step = 0.2}};
    CHECK(latest_end(quick, 0) == 2.1);
    CHECK(latest_end(quick, 1.5) == 2.1);
    CHECK(latest_end(quick, 2) == 2.2);
    CHECK(latest_end(quick, 2.5) == HUGE_VAL);
}

}  // namespace runtime_integrate
