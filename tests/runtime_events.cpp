// SPDX-License-Identifier: MIT
#include <doctest/doctest.h>

#include <cmath>
#include <numbers>
#include <vector>

#include "alembert/ode/integrate.hpp"

namespace runtime_events {

using namespace alembert;

namespace {

constexpr double g = 9.81;

/// y'' = −g.
Rhs free_fall() {
    return make_rhs(2, [](double, const double* y, double* rate) {
        rate[0] = y[1];
        rate[1] = -g;
    });
}

/// y'' = −y.
Rhs oscillator() {
    return make_rhs(2, [](double, const double* y, double* rate) {
        rate[0] = y[1];
        rate[1] = -y[0];
    });
}

/// y' = 1: a step of an adaptive method can be arbitrarily long.
Rhs stopwatch() {
    return make_rhs(1, [](double, const double*, double* rate) { rate[0] = 1; });
}

Options options_for(Method method, double duration) {
    return {.method = method, .duration = duration, .tolerance = 1e-12, .step = has_fixed_step(method) ? 1e-3 : 0};
}

template <class Function>
Events one_event(Function function, bool stop = false) {
    return make_events({{.name = "event", .stop = stop}}, function);
}

}  // namespace

// y = h − g t²/2: every method but euler, and its dense output, is exact up to rounding.
TEST_CASE("events: a falling body reaches the ground at √(2h/g), and the run ends there") {
    for (const Method method : {Method::rk4, Method::dopri5, Method::dop853, Method::verner76, Method::verner98,
                                Method::gauss, Method::abm, Method::bdf, Method::radau}) {
        const Trajectory motion =
            integrate(free_fall(), {10, 0}, options_for(method, 5),
                      one_event([](double, const double* y, const double*, double* out) { out[0] = y[0]; }, true));
        const double landing = std::sqrt(2 * 10 / g);
        INFO(name(method));
        CHECK(motion.ending == Ending::stopped_by_event);
        REQUIRE(motion.events.size() == 1);
        CHECK(std::abs(motion.events[0].time / landing - 1) < 1e-12);
        CHECK(std::abs(motion.events[0].state[1] + g * landing) < 1e-10);
        CHECK(motion.times.back() == motion.events[0].time);
        CHECK(motion.times[motion.rows() - 2] < motion.times.back());
        CHECK(std::abs(motion.final_state()[0]) < 1e-11);
    }
}

// abm and bdf are left out, because their own error in a hundred seconds is about 1e-8, which does not concern
// events.
TEST_CASE("events: every zero of a sine is found, in both directions, and the zero at the start is none") {
    for (const Method method : {Method::rk4, Method::dopri5, Method::dop853, Method::verner76, Method::verner98,
                                Method::gauss, Method::radau}) {
        const Trajectory motion =
            integrate(oscillator(), {0, 1}, options_for(method, 100),
                      one_event([](double, const double* y, const double*, double* out) { out[0] = y[0]; }));
        INFO(name(method));
        REQUIRE(motion.events.size() == 31);  // 31 π < 100 < 32 π
        for (std::size_t k = 0; k < 31; ++k)
            // 1e-12 a step, some hundred steps; phase errors add up
            CHECK(std::abs(motion.events[k].time - (static_cast<double>(k) + 1) * std::numbers::pi) < 1e-9);
        CHECK(motion.ending == Ending::completed);
    }
}

TEST_CASE("events: two zeros close together in one long step are both found") {
    for (const double gap : {0.5, 0.01, 1e-4}) {
        const Trajectory motion = integrate(stopwatch(), {0}, {.duration = 10, .step = 10},
                                            one_event([gap](double, const double* y, const double*, double* out) {
                                                out[0] = (y[0] - 4.1) * (y[0] - 4.1 - gap);
                                            }));
        INFO("gap " << gap);
        CHECK(motion.statistics.steps == 1);
        REQUIRE(motion.events.size() == 2);
        CHECK(std::abs(motion.events[0].time - 4.1) < 1e-11);
        CHECK(std::abs(motion.events[1].time - 4.1 - gap) < 1e-11);
    }
}

TEST_CASE("events: two zeros in one step are found where the function is no parabola") {
    // zeros of cos t + 0.999 around π: t = π ∓ 0.0447…
    const Trajectory motion = integrate(
        stopwatch(), {0}, {.duration = 6, .step = 6},
        one_event([](double, const double* y, const double*, double* out) { out[0] = std::cos(y[0]) + 0.999; }));
    REQUIRE(motion.events.size() == 2);
    CHECK(std::abs(motion.events[0].time - std::acos(-0.999)) < 1e-11);
    CHECK(std::abs(motion.events[1].time - (2 * std::numbers::pi - std::acos(-0.999))) < 1e-11);
}

TEST_CASE("events: in one step they come in the order of time, simultaneous ones as declared, and stop stops") {
    const Events events = make_events({{.name = "late"},
                                       {.name = "first"},
                                       {.name = "second"},
                                       {.name = "end", .stop = true},
                                       {.name = "never"}},
                                      [](double, const double* y, const double*, double* out) {
                                          out[0] = y[0] - 3;
                                          out[1] = std::exp(y[0]) - std::exp(2);
                                          out[2] = y[0] * y[0] - 4;
                                          out[3] = y[0] - 5;
                                          out[4] = y[0] - 5.5;
                                      });
    const Trajectory motion = integrate(stopwatch(), {0}, {.duration = 10, .step = 10, .sample = 1}, events);
    REQUIRE(motion.events.size() == 4);
    CHECK(motion.events[0].name == "first");
    CHECK(motion.events[1].name == "second");
    CHECK(motion.events[2].name == "late");
    CHECK(motion.events[3].name == "end");
    CHECK(motion.events[3].index == 3);
    CHECK(motion.rows() == 6);
    CHECK(motion.times.back() == doctest::Approx(5).epsilon(1e-14));
}

TEST_CASE("events: those simultaneous with the one that stops are reported, whichever is declared first") {
    const Events events = make_events({{.name = "end", .stop = true}, {.name = "mark"}, {.name = "later"}},
                                      [](double, const double* y, const double*, double* out) {
                                          out[0] = y[0] - 5;
                                          out[1] = y[0] * y[0] - 25;
                                          out[2] = y[0] - 5.001;
                                      });
    const Trajectory motion = integrate(stopwatch(), {0}, {.duration = 10, .step = 10, .sample = 1}, events);
    REQUIRE(motion.events.size() == 2);
    CHECK(motion.events[0].name == "end");
    CHECK(motion.events[1].name == "mark");
    CHECK(motion.times.back() == doctest::Approx(5).epsilon(1e-14));
}

TEST_CASE("events: they may contain accelerations") {
    // y'' + y = 0 with y = cos t: y'' = −1/2 at t = π/3
    const Trajectory motion = integrate(
        oscillator(), {1, 0}, {.duration = 2, .tolerance = 1e-13},
        one_event([](double, const double*, const double* rate, double* out) { out[0] = rate[1] + 0.5; }));
    REQUIRE(motion.events.size() == 1);
    CHECK(std::abs(motion.events[0].time - std::numbers::pi / 3) < 1e-12);
}

TEST_CASE("events: a value that is exactly zero where a step ends counts once") {
    const Trajectory motion =
        integrate(stopwatch(), {0}, {.method = Method::euler, .duration = 2, .step = 0.25},
                  one_event([](double, const double* y, const double*, double* out) { out[0] = y[0] - 1; }));
    REQUIRE(motion.events.size() == 1);
    CHECK(motion.events[0].time == 1);
}

TEST_CASE("events: rounding at the start is no event") {
    const Trajectory motion = integrate(
        stopwatch(), {0.3}, {.duration = 1},
        one_event([](double, const double* y, const double*, double* out) { out[0] = y[0] - 0.3 - 1e-16; }));
    CHECK(motion.events.empty());
}

TEST_CASE("events: a pole is no event, and neither is the edge of the domain") {
    const Trajectory motion = integrate(
        stopwatch(), {0}, {.duration = 10, .step = 10},
        make_events({{.name = "pole"}, {.name = "edge"}}, [](double, const double* y, const double*, double* out) {
            out[0] = 1 / (y[0] - 4.1);
            out[1] = std::sqrt(y[0] - 1) - 2;  // from 1 on; zero at 5
        }));
    REQUIRE(motion.events.size() == 1);
    CHECK(motion.events[0].name == "edge");
    CHECK(std::abs(motion.events[0].time - 5) < 1e-11);
}

// A particle flies through a thin disc, then through a wall that ends the run; one step goes far beyond both.
TEST_CASE("events: in a step that goes far beyond an event that stops, an earlier one is not missed") {
    const Trajectory motion =
        integrate(stopwatch(), {0}, {.duration = 100, .step = 100},
                  make_events({{.name = "wall", .stop = true}, {.name = "disc", .stop = true}},
                              [](double, const double* y, const double*, double* out) {
                                  out[0] = 1 - y[0];
                                  out[1] = std::abs(y[0] - 0.48) - 0.1;
                              }));
    REQUIRE(motion.events.size() == 1);
    CHECK(motion.events[0].name == "disc");
    CHECK(std::abs(motion.times.back() - 0.38) < 1e-11);
}

TEST_CASE("events: two that stop the run at the same instant are both reported, and all zeros there are listed") {
    const Events events = make_events({{.name = "one", .stop = true},
                                       {.name = "wrong way", .stop = true, .direction = -1},
                                       {.name = "mark"},
                                       {.name = "two", .stop = true}},
                                      [](double, const double* y, const double*, double* out) {
                                          out[0] = y[0] - 5;
                                          out[1] = y[0] * y[0] * y[0] - 125;
                                          out[2] = y[0] * y[0] - 25;
                                          out[3] = std::exp(y[0]) - std::exp(5);
                                      });
    const Trajectory motion = integrate(stopwatch(), {0}, {.duration = 10, .step = 10, .sample = 1}, events);
    REQUIRE(motion.events.size() == 3);
    CHECK(motion.events[0].name == "one");
    CHECK(motion.events[1].name == "mark");
    CHECK(motion.events[2].name == "two");
    REQUIRE(motion.last_zeros.size() == 4);
    for (int k = 0; k < 4; ++k) {
        const LastZero& zero = motion.last_zeros[static_cast<std::size_t>(k)];
        CHECK(zero.event == k);
        CHECK(zero.direction == 1);
        CHECK(zero.counts == (k != 1));
    }
}

// x = cos t falls through zero at π/2 and rises at 3π/2.
TEST_CASE("events: direction distinguishes zeros where the value grows from those where it falls") {
    const auto times = [](int direction, double offset) {
        const Trajectory motion = integrate(oscillator(), {1, 0}, {.duration = 12, .tolerance = 1e-13},
                                            make_events({{.name = "x", .direction = direction}},
                                                        [offset](double, const double* y, const double*,
                                                                 double* out) { out[0] = y[0] + offset; }));
        std::vector<double> list;
        for (const EventRecord& event : motion.events) list.push_back(event.time / std::numbers::pi);
        return list;
    };
    const auto near = [](const std::vector<double>& list, const std::vector<double>& expected) {
        REQUIRE(list.size() == expected.size());
        for (std::size_t k = 0; k < list.size(); ++k) CHECK(std::abs(list[k] - expected[k]) < 1e-12);
    };
    near(times(0, 0), {0.5, 1.5, 2.5, 3.5});
    near(times(1, 0), {1.5, 3.5});
    near(times(-1, 0), {0.5, 2.5});
    const double late = std::acos(-0.5) / std::numbers::pi;  // x = −1/2
    near(times(-1, 0.5), {late, 2 + late});
    near(times(1, 0.5), {2 - late, 4 - late});
}

// g = |x − a| − b has zeros at a − b and a + b; a projectile goes through such a slab at both of its walls, twice
// where it comes back.
TEST_CASE("events: a step through a thin slab finds both walls, wherever in the step the slab is") {
    for (const double b : {1e-2, 1e-4, 1e-6})
        for (const double a : {0.13, 1.23, 2.5, 3.7, 4.98, 5.6, 6.26, 7.44, 8.89, 9.9}) {
            CAPTURE(a);
            CAPTURE(b);
            const Trajectory motion = integrate(stopwatch(), {0}, {.duration = 10, .step = 10, .sample = 1},
                                                one_event([=](double, const double* y, const double*,
                                                              double* out) { out[0] = std::abs(y[0] - a) - b; }));
            REQUIRE(motion.events.size() == 2);
            CHECK(std::abs(motion.events[0].time - (a - b)) < 1e-13);
            CHECK(std::abs(motion.events[1].time - (a + b)) < 1e-13);
        }
    // y = 20 t − g t²/2 is at the height h at (20 ∓ √(400 − 2 g h))/g.
    for (const double h : {3.0, 11.0, 17.0}) {
        const double b = 1e-5;
        const Trajectory motion =
            integrate(free_fall(), {0, 20}, {.duration = 4, .tolerance = 1e-3, .step = 4, .sample = 1},
                      one_event([=](double, const double* y, const double*, double* out) {
                          out[0] = std::abs(y[0] - h) - b;
                      }));
        REQUIRE(motion.events.size() == 4);
        const auto when = [&](double height, int side) {
            return (20 + side * std::sqrt(400 - 2 * g * height)) / g;
        };
        CHECK(std::abs(motion.events[0].time - when(h - b, -1)) < 1e-9);
        CHECK(std::abs(motion.events[1].time - when(h + b, -1)) < 1e-9);
        CHECK(std::abs(motion.events[2].time - when(h + b, 1)) < 1e-9);
        CHECK(std::abs(motion.events[3].time - when(h - b, 1)) < 1e-9);
    }
}

// A body at rest at y = 1 and a spike that rises from the ground at 50 m/s and goes back: 1.1 − 50 |t − c| reaches
// it at c − 0.002.
TEST_CASE(
    "events: a spike that touches a resting body between two points of a long step stops the run at its first "
    "touch") {
    for (const double c : {0.03, 1.013, 2.4, 4.99, 6.2, 8.77, 9.93}) {
        CAPTURE(c);
        const Trajectory motion = integrate(
            free_fall(), {1 + g * 50, 0}, {.duration = 10, .tolerance = 1e-3, .step = 10},
            one_event([=](double t, const double* y, const double*,
                          double* out) { out[0] = y[0] - g * 50 + g * t * t / 2 - 1.1 + 50 * std::abs(t - c); },
                      true));
        CHECK(motion.ending == Ending::stopped_by_event);
        CHECK(std::abs(motion.times.back() - (c - 0.002)) < 1e-9);
    }
}

// Functions without instructions have no bounds; their slopes along the motion tell that they turn within a step.
// y = sin(w t) in y'' = −w² y from y = 0: sin(k y) has zeros where y = π j/k; a quarter of a period holds ⌊k/π⌋ of
// them besides y = 0.
TEST_CASE("events: a function without bounds that turns many times in a step has all its zeros") {
    for (const Method method :
         {Method::taylor, Method::dop853, Method::verner98, Method::radau, Method::gauss, Method::rk4})
        for (const double k : {3.3, 12.0, 41.0, 77.7}) {
            if (needs_series(method)) continue;  // they come with emitted code
            CAPTURE(k);
            INFO(name(method));
            const Trajectory motion = integrate(oscillator(), {0, 1},
                                                {.method = method,
                                                 .duration = 10.5 * std::numbers::pi,
                                                 .tolerance = 1e-10,
                                                 .step = has_fixed_step(method) ? 0.05 : 0},
                                                one_event([=](double, const double* y, const double*,
                                                              double* out) { out[0] = std::sin(k * y[0]); }));
            const int quarter = static_cast<int>(k / std::numbers::pi);
            CHECK(static_cast<int>(motion.events.size()) == 21 * quarter + 10);
        }
}

TEST_CASE("events: smooth ones cost three evaluations in each step and those that locate a zero") {
    const auto evaluations = [](const Events& events) {
        return integrate(oscillator(), {1, 0}, {.duration = 100, .tolerance = 1e-10}, events).statistics;
    };
    const Statistics without = evaluations({});
    const Statistics with = evaluations(make_events({{.name = "place"}, {.name = "turn"}, {.name = "far"}},
                                                    [](double, const double* y, const double* rate, double* out) {
                                                        out[0] = y[0] - 0.3;
                                                        out[1] = y[1];
                                                        out[2] = rate[1] * y[0] + 1.5;
                                                    }));
    CHECK(with.steps == without.steps);
    const long zeros = 31 + 32, dense = 3;  // dop853 needs three more for its dense output
    CHECK(with.evaluations - without.evaluations <= (3 + dense) * with.steps + 12 * zeros);
}

TEST_CASE("events: a function that is zero but for rounding does not have its steps divided") {
    const Trajectory motion = integrate(oscillator(), {1, 0}, {.duration = 20, .tolerance = 1e-10},
                                        one_event([](double, const double* y, const double*, double* out) {
                                            out[0] = (1 + y[0] + y[1]) - y[1] - y[0] - 1;
                                        }));
    CHECK(motion.statistics.evaluations <
          40 * motion.statistics.steps + 40 * static_cast<long>(motion.events.size()));
}

}  // namespace runtime_events
