// SPDX-License-Identifier: MIT
// Events whose values come to zero and go back, stay at zero, or turn at the knots of tables: each zero happens
// once, and its direction is that in which the value comes to it.
#include <doctest/doctest.h>

#include <fmt/format.h>

#include <cmath>
#include <numbers>
#include <random>

#include "contacts.hpp"

namespace commands_event_touches {

using namespace alembert::test;

namespace {

struct Touch {
    const char* when;  ///< in x, which is 1 at the touch
    bool from_above;
    double known = 1e-7;  ///< to what time it is known, relative: a flat one is zero to rounding over a while
};

const std::vector<Touch> touches = {
    {"(x-1)^2", true},
    {"(x-1)^4", true, 1e-3},
    {"1-cos(x-1)", true},
    {"cos(x-1)-1", false},
    {"abs(x-1)", true},
    {"-(x-1)^2", false},
    {"x^2-2*x+1", true},
    {"sin(x-1)^2", true},
    {"tanh((x-1)^2)", true},
    {"(x-1)^2/(1+x^2)", true},
    {"max(0.5*(1-x),0.5*(x-1))", true},
    {"sqrt((x-1)^2)", true},
    {"(x-1)^2*(2+sin(t))", true},
    {"l(x)", true},
    {"-l(x)", false},
    {"p(x)", true},
    {"-p(x)", false},
};

/// A particle with two coordinates at constant rates, unless forces act, and the event `zero`.
struct Passage {
    std::string when;
    std::string more = "set = { n = \"n + 1\" }";  ///< keys of the event
    double x = 0, rate = 1, duration = 1;
    std::string tables = "";  ///< lines of [tables], and tables of the scene that follow
    double y = 0, y_rate = 0;
    const char* tolerance = "1e-10";
};

std::string scene_of(const Passage& passage) {
    return fmt::format(R"toml([coordinates]
x = {{ initial = {}, rate = {} }}
y = {{ initial = {}, rate = {} }}
[states]
n = {{}}
[energy]
kinetic = "x'^2/2 + y'^2/2"
[[event]]
name = "zero"
when = "{}"
{}
[simulation]
duration = {}
tolerance = {}
{}{}
)toml",
                       passage.x, passage.rate, passage.y, passage.y_rate, passage.when, passage.more,
                       passage.duration, passage.tolerance, passage.tables.empty() ? "" : "[tables]\n",
                       passage.tables);
}

/// What `simulate` tells of it.
auto run_of(const Passage& passage, const std::string& method = "auto") {
    return simulated(temporary("passage.toml", scene_of(passage)), {"--method", method});
}

std::vector<double> times_of(const Passage& passage, const std::string& method = "auto") {
    std::vector<double> result;
    const auto run = run_of(passage, method);
    for (const auto& event : run["events"]) result.push_back(event["time"].get<double>());
    if (passage.more.find("set =") != std::string::npos)
        CHECK(number(run["final"], "states", "n") == static_cast<double>(result.size()));
    return result;
}

const std::string tip_and_bowl =
    R"(l = { arguments = ["x"], points = [[-1, 1], [0, 0.5], [1, 0], [2, 0.5], [3, 1]], outside = "line" }
p = { arguments = ["x"], interpolation = "pchip", outside = "line", points = [[-1, 1], [0, 0.5], [1, 0], [2, 0.5], [3, 1]] })";

}  // namespace

TEST_CASE("touches: each happens once, in the direction from which the value comes, whatever rounding says") {
    std::mt19937 draw(20);
    const auto between = [&](double low, double high) {
        return low + (high - low) * static_cast<double>(draw() % 1000) / 1000;
    };
    const std::vector<std::string> methods = {"auto", "dop853", "verner98", "radau"};
    for (const Touch& touch : touches)
        for (const char* const direction : {"both", "up", "down"}) {
            const double x = between(-0.9, 0.9), rate = between(0.3, 2);
            const std::string act = draw() % 2 == 0 ? "set = { n = \"n + 1\" }" : "record = [\"t\"]",
                              method = methods[draw() % methods.size()];
            const Passage passage{.when = touch.when,
                                  .more = fmt::format("direction = \"{}\"\n{}", direction, act),
                                  .x = x,
                                  .rate = rate,
                                  .duration = 2.7 / rate,
                                  .tables = tip_and_bowl};
            CAPTURE(scene_of(passage));
            CAPTURE(method);
            const bool counts =
                std::string(direction) == "both" || (std::string(direction) == "down") == touch.from_above;
            const std::vector<double> times = times_of(passage, method);
            REQUIRE(times.size() == (counts ? 1u : 0u));
            const double when = (1 - x) / rate;
            if (counts) CHECK(std::abs(times[0] - when) <= touch.known * std::max(1.0, when));
        }
}

TEST_CASE("touches: a value that is clearly kept from zero, or passes it twice, is no touch") {
    const auto zeros = [](const char* when) {
        return times_of({.when = when, .x = 0.2, .rate = 0.7, .duration = 3, .tables = tip_and_bowl}).size();
    };
    CHECK(zeros("(x-1)^2 + 1e-11") == 0);
    CHECK(zeros("(x-1)^2 - 1e-11") == 2);
    CHECK(zeros("abs(x-1) + 1e-8") == 0);
    CHECK(zeros("abs(x-1) - 1e-7") == 2);
    CHECK(zeros("l(x) + 1e-9") == 0);
    CHECK(zeros("p(x) - 1e-9") == 2);
}

TEST_CASE("touches: two events at one zero have each its direction") {
    const auto run = run_of(
        {.when = "v(x)",
         .duration = 9.5,
         .tables =
             R"toml(v = { arguments = ["x"], points = [[0, 1], [1, 0], [2, 0.5], [3, 0], [4, 1], [5, 0.25], [6, -0.5],
                                     [7, 0], [8, -0.25], [9, 0], [10, 2]] }
[[event]]
name = "up"
when = "v(x)"
direction = "up"
record = ["t"])toml"});
    CHECK(number(run["final"], "states", "n") == 5);  // 1, 3, 5 1/3, 7, 9
    const auto& events = run["events"];
    CHECK(std::count_if(events.begin(), events.end(), [](const auto& e) { return e["name"] == "up"; }) ==
          2);  // 7, 9
}

TEST_CASE("touches: what stays at zero happens once, when it comes there") {
    // y stays where f is 0; x comes to the level part at 0.5, leaves it at 0, and passes zero at -1.5 and -2.5
    CHECK(times_of({.when = "f(x) - f(y)",
                    .x = 1,
                    .rate = -1,
                    .duration = 3.9,
                    .tables = R"(f = { arguments = ["a"], outside = "hold",
                                     points = [[-3, 1], [-2, -1], [-1, 1], [0, 0], [0.5, 0], [0.8, 1]] })",
                    .y = 0.2})
              .size() == 3);
    // both are level at the start, and equal but for rounding; they are equal again at t = 1.482 (where
    // steps end elsewhere, rounding may tell of the end of the level part, and the estimate says so)
    CHECK(times_of({.when = "f(x) - f(y)",
                    .x = 0.5,
                    .rate = -1,
                    .duration = 3,
                    .tables = R"(f = { arguments = ["a"], interpolation = "pchip", outside = "line",
                                     points = [[-3, -1.59], [-2, 0.01], [-1.25, 1.83], [-0.5, 0.25], [0, 0.08]] })",
                    .y = 0.7,
                    .y_rate = -1.5,
                    .tolerance = "1e-11"})
              .size() == 1);
}

TEST_CASE("touches: beside knots, levels and flat places ordinary zeros happen once") {
    const std::string tables =
        R"(c = { arguments = ["a"], interpolation = "cubic", outside = "line",
      points = [[-1, 1], [0, 1], [1, 0], [2, -1], [3, -0.5], [4, 1]] }
l = { arguments = ["a"], outside = "line", points = [[-1, 1.19], [0, 0.43], [0.74, 0], [1.493, -1.48], [2.413, -1.47]] }
p = { arguments = ["a"], interpolation = "pchip", outside = "line",
      points = [[-3, 1.79], [-1.99, 1.9], [-0.717, -1.8], [0.298, 0], [1.354, -1.36], [2.496, 0.9], [3.621, -0.97]] })";
    const auto are = [](const std::vector<double>& found, const std::vector<double>& right) {
        return std::equal(found.begin(), found.end(), right.begin(), right.end(),
                          [](double a, double b) { return std::abs(a - b) < 1e-7; });
    };
    for (const char* const more : {"record = [\"t\"]", "set = { n = \"n + 1\" }"}) {
        CAPTURE(more);
        const auto times = [&](const char* when, double x, double rate, double duration) {
            return times_of(
                {.when = when, .more = more, .x = x, .rate = rate, .duration = duration, .tables = tables});
        };
        CHECK(are(times("c(t)", 0, 1, 1.9), {1}));
        CHECK(are(times("l(t)", 0.05, 1, 1.393), {0.74}));
        CHECK(are(times("(x-1)*abs(x-1)", 0.013, 1.22, 4), {0.987 / 1.22}));
        CHECK(are(times("-p(t)*(2+cos(3*t))", 0, 1, 2.4), {0.298, 2.00296534556225}));
        CHECK(are(times("max(0, x-1)", 3, -1, 4), {2}));
        CHECK(are(times("max(0, x-1)", 0, 1, 4), {}));
    }
}

TEST_CASE("touches: of many in one step none is lost") {
    // the tangents at two points around a touch meet below zero, however far each is from it
    const double frequency = 200, duration = 3;
    const std::vector<double> times =
        times_of({.when = "sin(200*x)^2", .more = "record = [\"t\"]", .duration = duration});
    REQUIRE(times.size() == static_cast<std::size_t>(frequency * duration / std::numbers::pi));
    for (std::size_t k = 0; k < times.size(); ++k)
        CHECK(std::abs(times[k] - static_cast<double>(k + 1) * std::numbers::pi / frequency) < 1e-9);
}

TEST_CASE("touches: a saw tooth comes to zero at each of its tips") {
    // rounding keeps some tips a little away from zero, and others a little before their knots
    const auto tips = [](const char* when, const char* more) {
        return times_of({.when = when,
                         .more = more,
                         .x = -1.2,
                         .duration = 4.95,
                         .tables = "F = { arguments = [\"t\"], period = 0.2, points = [[0, 0], [0.1, 1]] }\n"
                                   "[forces]\nx = \"F(t)\""})
            .size();
    };
    CHECK(tips("F(t)*(1 - F(t))", "set = { n = \"n + 1\" }") == 49);
    CHECK(tips("F(t)*(1 - F(t))", "") == 49);
    CHECK(tips("F(t)", "") == 24);
    CHECK(tips("1 - F(t)", "set = { n = \"n + 1\" }") == 25);
    CHECK(tips("F(t) - 1", "direction = \"up\"") == 25);
    CHECK(tips("F(t) - 1", "direction = \"down\"") == 0);
    CHECK(tips("1.0000001 - F(t)", "") == 0);
    CHECK(tips("0.9999999 - F(t)", "") == 50);
}

TEST_CASE("touches: an event at the very end of a run happens, on whatever side of its zero rounding leaves it") {
    for (const char* const method : {"auto", "dop853", "radau", "taylor"})
        for (const int duration : {1, 2, 3, 4, 7, 10}) {
            CAPTURE(method);
            CAPTURE(duration);
            const auto count = [&](const std::string& when) {
                return times_of({.when = when, .x = -1, .duration = static_cast<double>(duration)}, method).size();
            };
            CHECK(count("sin(pi*t)") == static_cast<std::size_t>(duration));
            CHECK(count(fmt::format("x + 1 - {}", duration)) == 1);
            CHECK(count(fmt::format("x + 0.999999 - {}", duration)) == 0);
        }
}

}  // namespace commands_event_touches
