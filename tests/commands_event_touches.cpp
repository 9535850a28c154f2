// SPDX-License-Identifier: MIT
// Events whose values come to zero and go back, stay at zero, or turn at the knots of tables: each zero happens
// once, and its direction is that in which the value comes to it.
#include <doctest/doctest.h>

#include <fmt/format.h>

#include <cmath>
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

std::string scene_of(const std::string& when, const std::string& more, double x, double rate, double duration) {
    return fmt::format(R"toml([coordinates]
x = {{ initial = {}, rate = {} }}
[states]
n = {{}}
[tables]
l = {{ arguments = ["x"], points = [[-1,1],[0,0.5],[1,0],[2,0.5],[3,1],[4,0.4]], outside = "line" }}
p = {{ arguments = ["x"], interpolation = "pchip", points = [[-1,1],[0,0.5],[1,0],[2,0.5],[3,1],[4,0.4]], outside = "line" }}
[energy]
kinetic = "x'^2/2"
[[event]]
name = "zero"
when = "{}"
{}
[simulation]
duration = {}
tolerance = 1e-10
)toml",
                       x, rate, when, more, duration);
}

}  // namespace

TEST_CASE("touches: each happens once, in the direction from which the value comes, whatever rounding says") {
    std::mt19937 draw(20);
    const auto between = [&](double low, double high) {
        return low + (high - low) * static_cast<double>(draw() % 1000) / 1000;
    };
    const std::vector<std::string> methods = {"auto", "dop853", "verner98", "radau"};
    for (const Touch& touch : touches)
        for (const char* const direction : {"both", "up", "down"}) {
            const bool kicks = draw() % 2 == 0;
            const double x = between(-0.9, 0.9), rate = between(0.3, 2);
            const std::string method = methods[draw() % methods.size()],
                              scene = scene_of(touch.when,
                                               fmt::format("direction = \"{}\"\n{}", direction,
                                                           kicks ? "set = { n = \"n + 1\" }" : "record = [\"t\"]"),
                                               x, rate, 2.7 / rate);
            CAPTURE(scene);
            CAPTURE(method);
            const auto run = simulated(temporary("touch.toml", scene), {"--method", method});
            const bool counts =
                std::string(direction) == "both" || (std::string(direction) == "down") == touch.from_above;
            REQUIRE(run["events"].size() == (counts ? 1u : 0u));
            if (kicks) CHECK(number(run["final"], "states", "n") == (counts ? 1 : 0));
            const double when = (1 - x) / rate;
            if (counts)
                CHECK(std::abs(run["events"][0]["time"].get<double>() - when) <=
                      touch.known * std::max(1.0, when));
        }
}

TEST_CASE("touches: a value that is clearly kept from zero, or passes it twice, is no touch") {
    const auto events = [](const char* when) {
        return simulated(temporary("near.toml", scene_of(when, "set = { n = \"n + 1\" }", 0.2, 0.7, 3)),
                         {})["events"]
            .size();
    };
    CHECK(events("(x-1)^2 + 1e-11") == 0);
    CHECK(events("(x-1)^2 - 1e-11") == 2);
    CHECK(events("abs(x-1) + 1e-8") == 0);
    CHECK(events("abs(x-1) - 1e-7") == 2);
    CHECK(events("l(x) + 1e-9") == 0);
    CHECK(events("p(x) - 1e-9") == 2);
}

TEST_CASE("touches: two events at one zero have each its direction") {
    const auto run = simulated(temporary("two.toml", R"toml([coordinates]
x = { initial = 0, rate = 1 }
[states]
n = {}
q = {}
[tables]
v = { arguments = ["x"], points = [[0,1],[1,0],[2,0.5],[3,0],[4,1],[5,0.25],[6,-0.5],[7,0],[8,-0.25],[9,0],[10,2]] }
[energy]
kinetic = "x'^2/2"
[[event]]
name = "any"
when = "v(x)"
set = { n = "n + 1" }
[[event]]
name = "up"
when = "v(x)"
direction = "up"
set = { q = "q + 1" }
[simulation]
duration = 9.5
)toml"),
                               {});
    CHECK(number(run["final"], "states", "n") == 5);  // 1, 3, 5 1/3, 7, 9
    CHECK(number(run["final"], "states", "q") == 2);  // 7, 9
}

TEST_CASE("touches: what stays at zero happens once, when it comes there") {
    const auto count = [](const std::string& table, double x, double y, double speed, double duration) {
        const auto run = simulated(temporary("level.toml", fmt::format(R"toml([coordinates]
x = {{ initial = {}, rate = -1 }}
y = {{ initial = {}, rate = {} }}
[states]
n = {{}}
[tables]
{}
[energy]
kinetic = "x'^2/2 + y'^2/2"
[[event]]
name = "zero"
when = "f(x) - f(y)"
set = {{ n = "n + 1" }}
[simulation]
duration = {}
tolerance = 1e-11
)toml",
                                                                       x, y, speed, table, duration)),
                                   {});
        return number(run["final"], "states", "n");
    };
    // at rest y keeps f(y) = 0; x comes to the level part at 0.5, leaves it at 0, and passes zero at -1.5 and -2.5
    CHECK(
        count(
            R"(f = { arguments = ["a"], outside = "hold", points = [[-3, 1], [-2, -1], [-1, 1], [0, 0], [0.5, 0], [0.8, 1]] })",
            1, 0.2, 0, 3.9) == 3);
    // both are level at the start, and equal but for rounding; they are equal again at t = 1.482
    CHECK(
        count(
            R"(f = { arguments = ["a"], interpolation = "pchip", outside = "line", points = [[-3, -1.59], [-2, 0.01], [-1.25, 1.83], [-0.5, 0.25], [0.0, 0.08]] })",
            0.5, 0.7, -1.5, 3) == 1);
}

TEST_CASE("touches: beside knots, levels and flat places ordinary zeros happen once") {
    const auto times = [](const std::string& when, const std::string& more, double x, double rate,
                          double duration) {
        const auto run = simulated(temporary("once.toml", fmt::format(R"toml([coordinates]
x = {{ initial = {}, rate = {} }}
[states]
n = {{}}
[tables]
c = {{ arguments = ["a"], interpolation = "cubic", outside = "line", points = [[-1, 1], [0, 1], [1, 0], [2, -1], [3, -0.5], [4, 1]] }}
l = {{ arguments = ["a"], outside = "line", points = [[-1, 1.19], [0, 0.43], [0.74, 0], [1.493, -1.48], [2.413, -1.47]] }}
p = {{ arguments = ["a"], interpolation = "pchip", outside = "line", points = [[-3, 1.79], [-1.99, 1.9], [-0.717, -1.8], [0.298, 0], [1.354, -1.36], [2.496, 0.9], [3.621, -0.97]] }}
[energy]
kinetic = "x'^2/2"
[[event]]
name = "zero"
when = "{}"
{}
[simulation]
duration = {}
tolerance = 1e-10
)toml",
                                                                      x, rate, when, more, duration)),
                                   {});
        std::vector<double> result;
        for (const auto& event : run["events"]) result.push_back(event["time"].get<double>());
        return result;
    };
    const auto are = [](const std::vector<double>& found, const std::vector<double>& right) {
        return std::equal(found.begin(), found.end(), right.begin(), right.end(),
                          [](double a, double b) { return std::abs(a - b) < 1e-7; });
    };
    for (const char* const more : {"record = [\"t\"]", "set = { n = \"n + 1\" }"}) {
        CAPTURE(more);
        CHECK(are(times("c(t)", more, 0, 1, 1.9), {1}));
        CHECK(are(times("l(t)", more, 0.05, 1, 1.393), {0.74}));
        CHECK(are(times("(x-1)*abs(x-1)", more, 0.013, 1.22, 4), {0.987 / 1.22}));
        CHECK(are(times("-p(t)*(2+cos(3*t))", more, 0, 1, 2.4), {0.298, 2.00296534556225}));
        CHECK(are(times("max(0, x-1)", more, 3, -1, 4), {2}));
        CHECK(are(times("max(0, x-1)", more, 0, 1, 4), {}));
    }
}

}  // namespace commands_event_touches
