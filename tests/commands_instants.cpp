// SPDX-License-Identifier: MIT
// What events do at one instant: states are set before impulses act, values jump past zero, several events set the
// same state or rate, values are no numbers.
#include <doctest/doctest.h>

#include <fmt/format.h>

#include <cmath>
#include <tuple>

#include "contacts.hpp"
#include "edits.hpp"

namespace commands_instants {

using namespace alembert::test;

namespace {

/// A mass m that is hit by m2 at rest at x = 0, and goes on with it.
const char* const picked_up = R"toml(
[parameters]
m = 1
m2 = 3
[coordinates]
x = { initial = -1, rate = 2 }
[states]
on = {}
[energy]
kinetic = "(m + on*m2)*x'^2/2"
[[event]]
name = "catch"
when = "x"
direction = "up"
set = { on = "1" }
rates = { x = "m*x'/(m + m2)" }
[simulation]
duration = 4
)toml";

/// An oscillator that counts its passages through zero, at π/2 + k π.
std::string counting(const std::string& more) {
    return temporary("counting.toml", R"toml(
[coordinates]
x = 1
[states]
n = {}
m = {}
[energy]
kinetic = "x'^2/2"
potential = "x^2/2"
[[event]]
name = "tick"
when = "x"
set = { n = "n + 1" }
[simulation]
duration = 20
tolerance = 1e-12
)toml" + more);
}

double state(const Json& motion, const std::string& name) {
    return motion["final"]["states"][name].get<double>();
}

std::vector<double> times(const Json& motion, const std::string& name) {
    std::vector<double> result;
    for (const Json& event : motion["events"])
        if (event["name"] == name) result.push_back(value(event, "time"));
    return result;
}

}  // namespace

// m v = (m + m2) v': 2 → 1/2. At unchanged rates T rises from 2 to 8, and the impulse (m + m2)(v' − v) = −6 takes
// 6·(2 + 1/2)/2 of it.
TEST_CASE("instants: the masses of a kick are those after the event has set its states") {
    const Json motion = simulated(temporary("picked.toml", picked_up));
    CHECK(std::abs(rate(motion, "x") - 0.5) < 1e-15);
    CHECK(std::abs(coordinate(motion, "x") - 1.75) < 1e-13);
    CHECK(std::abs(motion["set_change"].get<double>() - 6) < 1e-14);
    CHECK(std::abs(value(motion["events"][0], "energy_gain") + 7.5) < 1e-14);
    CHECK(motion["work_balance"].get<double>() < 1e-14);
    const Json impulse = simulated(temporary(
        "picked.toml", edited(picked_up, {{"rates = { x = \"m*x'/(m + m2)\" }", "impulses = { x = -6 }"}})));
    CHECK(std::abs(rate(impulse, "x") - 0.5) < 1e-15);
}

TEST_CASE("instants: a rate that an event sets to zero is reached, whatever states there are") {
    const std::string scene = edited(picked_up, {{"on = {}", "on = {}\nbig = 1e9"}, {"m*x'/(m + m2)", "0"}});
    CHECK(rate(simulated(temporary("stopped.toml", edited(scene, {{"big = 1e9", "big = { initial = 1e9 }"}}))),
               "x") == 0);
    // y is on a rod with x: the rate that is set is off by 1e-3, however large a state is.
    const Run run = alembert::test::run({"simulate", temporary("rod.toml", R"toml(
[coordinates]
x = { initial = -1, rate = 1 }
y = { initial = -1, rate = 1 }
[states]
big = { initial = 1e9 }
[energy]
kinetic = "(x'^2 + y'^2)/2"
[[constraint]]
name = "rod"
holonomic = "x = y"
[[event]]
name = "push"
when = "x"
rates = { x = 2, y = 2.002 }
)toml")});
    CHECK(run.exit == 4);
    CHECK(run.err.find("event 'push' sets x' = 2") != std::string::npos);
}

TEST_CASE("instants: an event whose value a set state takes past zero, or to where it stays, happens then") {
    for (const char* when : {"n - 2.5", "n - 3", "(2.5 - n)*exp(-x)", "n^2 - 9"}) {
        const Json motion =
            simulated(counting(fmt::format("[[event]]\nname = \"third\"\nwhen = \"{}\"\nstop = true\n"
                                           "record = [\"n\"]\n",
                                           when)));
        INFO(when);
        const std::vector<double> third = times(motion, "third");
        REQUIRE(third.size() == 1);
        CHECK(std::abs(third[0] - 2.5 * M_PI) < 1e-11);
        CHECK(motion["final"]["time"] == third[0]);
        CHECK(motion["events"].back()["record"]["n"] == 3);  // after `tick`, before what `third` does
    }
}

// The value goes from −1 to zero, where the motion takes over: it is at rest there, and falls.
TEST_CASE("instants: a value that a set state takes to a zero of the motion has not passed it") {
    const Json motion = simulated(counting(R"toml(
[[event]]
name = "turned"
when = "-m*(x + 1) - (1 - m)"
direction = "up"
[[event]]
name = "turn"
when = "x'"
direction = "up"
set = { m = 1 }
)toml"),
                                  {"--duration", "4"});
    CHECK(times(motion, "turn").size() == 1);
    CHECK(times(motion, "turned").empty());
}

TEST_CASE("instants: what jumps past zero sets states in its turn, counts, has a direction, and happens once") {
    const Json motion = simulated(counting(R"toml(
[[event]]
name = "reset"
when = "n - 2.5"
set = { n = 0, m = "m + 1" }
[[event]]
name = "grown"
when = "n - 1.5"
direction = "up"
[[event]]
name = "fallen"
when = "n - 1.5"
direction = "down"
[[event]]
name = "second"
when = "m - 1.5"
count = 1
)toml"));
    const std::vector<double> reset = times(motion, "reset"), grown = times(motion, "grown"),
                              fallen = times(motion, "fallen");
    REQUIRE(reset.size() == 2);  // n: 1 2 0 | 1 2 0, at 2.5 π and 5.5 π
    CHECK(std::abs(reset[0] - 2.5 * M_PI) < 1e-11);
    CHECK(std::abs(motion["final"]["time"].get<double>() - 5.5 * M_PI) < 1e-10);
    CHECK(times(motion, "second").size() == 1);
    CHECK(grown.size() == 2);
    CHECK(fallen.size() == 2);
    CHECK(state(motion, "n") == 0);
    CHECK(state(motion, "m") == 2);
    CHECK(motion["energy_drift"].get<double>() < 1e-12);  // a counter takes no energy
}

TEST_CASE("instants: an impulse of an event that a set state brings about acts with the others") {
    const Json motion = simulated(counting(R"toml(
[[event]]
name = "third"
when = "n - 2.5"
impulses = { x = "-2*x'" }
)toml"));
    REQUIRE(times(motion, "third").size() == 1);
    for (const Json& event : motion["events"])
        if (event["name"] == "third") CHECK(std::abs(event["impulses"]["x"].get<double>() - 2) < 1e-11);
    // cos t until 2.5 π, and from there with the opposite rate
    CHECK(std::abs(coordinate(motion, "x") + std::cos(20.0)) < 1e-10);
}

TEST_CASE("instants: events that set one state or rate must agree, or add to it") {
    const auto at_once = [](const char* one, const char* two) {
        return temporary("both.toml", fmt::format(R"toml(
[coordinates]
x = {{ initial = -1, rate = 2 }}
[states]
n = {{ initial = 5 }}
[energy]
kinetic = "x'^2/2"
[[event]]
name = "one"
when = "x"
{}
[[event]]
name = "two"
when = "x"
{}
[simulation]
duration = 1
)toml",
                                                  one, two));
    };
    CHECK(state(simulated(at_once("set = { n = 0 }", "set = { n = 0 }")), "n") == 0);
    CHECK(state(simulated(at_once("set = { n = \"n + 1\" }", "set = { n = \"n + 2\" }")), "n") == 8);
    CHECK(rate(simulated(at_once("rates = { x = 3 }", "rates = { x = \"x' + 1\" }")), "x") == 3);
    for (const auto& [one, two, told] :
         {std::tuple{"set = { n = 1 }", "set = { n = 2 }",
                     "events 'one' and 'two' both set n at t = 0.5, which makes it 2 in this order and 1"},
          {"set = { n = \"n + 1\" }", "set = { n = 0 }", "which makes it 0 in this order and 1 in the other"},
          {"rates = { x = 3 }", "rates = { x = 4 }", "both set x' at t = 0.5, to 3 and to 4"}}) {
        const Run result = run({"simulate", at_once(one, two)});
        CHECK(result.exit == 4);
        CHECK_MESSAGE(result.err.find(told) != std::string::npos, result.err);
    }
}

TEST_CASE("instants: a value that is no number ends the run with the event and the expression that gave it") {
    const std::string change = "set = { on = \"1\" }\nrates = { x = \"m*x'/(m + m2)\" }";
    for (const auto& [to, told] :
         {std::pair{"set = { on = \"sqrt(-1 - t)\" }",
                    "event 'catch' sets on to sqrt(-1 - t) at t = 0.5, which is no"},
          {"set = { on = \"1/x\" }", "event 'catch' sets on to 1/x"},
          {"rates = { x = \"log(-t)\" }", "event 'catch' sets x' to log(-t)"},
          {"impulses = { x = \"log(-t)\" }", "event 'catch' gives x the impulse log(-t)"}}) {
        const Run result = run({"simulate", temporary("nan.toml", edited(picked_up, {{change, to}})), "--json"});
        CHECK(result.exit == 4);
        CHECK_MESSAGE(result.err.find(told) != std::string::npos, result.err);
        CHECK(Json::parse(result.out)["final"]["time"] == 0.5);  // what was computed until then is kept
    }
}

// λ = 0 at two thirds of the height. The body goes on within the sphere.
TEST_CASE("instants: events on multipliers set states, give impulses and are counted") {
    const auto sphere = [](const char* what) {
        return temporary("sphere.toml", fmt::format(R"toml(
gravity = [0, -9.81]
[coordinates]
x = 0.3
y = {{ guess = 0.95 }}
[states]
n = {{}}
[[particle]]
name = "p"
mass = 1
position = ["x", "y"]
[[constraint]]
name = "sphere"
holonomic = "x^2 + y^2 = 1"
[[event]]
name = "off"
when = "lambda_sphere"
{}
record = ["y"]
[simulation]
duration = 2
tolerance = 1e-13
)toml",
                                                    what));
    };
    const double height = 2 * std::sqrt(1 - 0.09) / 3;
    for (const char* what : {"set = { n = \"n + 1\" }", "count = 2"}) {
        const Json motion = simulated(sphere(what));
        REQUIRE(motion["events"].size() == 2);  // falling off, and again on the other side
        for (const Json& event : motion["events"])
            CHECK(std::abs(event["record"]["y"].get<double>() - height) < 1e-10);
    }
    // Thrown back along the sphere it comes to rest where it began, and falls again: λ passes zero each time.
    const Json back = simulated(sphere("rates = { x = \"-x'\", y = \"-y'\" }\ndirection = \"down\""));
    REQUIRE(back["events"].size() > 1);
    for (const Json& event : back["events"]) CHECK(std::abs(event["record"]["y"].get<double>() - height) < 1e-10);
}

// The floor falls away by 0.5 at t = 1: free fall for √(1/g), with the speed √g; then 1 − 0.5 of it.
TEST_CASE("instants: a state that is set may open a contact, and may not put a body into it") {
    const auto floor = [](const char* z) {
        return temporary("floor.toml", fmt::format(R"toml(
gravity = [0, -9.81]
[coordinates]
y = 0
[states]
z = {{}}
[[particle]]
name = "b"
mass = 2
position = [0, "y"]
[[unilateral]]
name = "floor"
gap = "y - z"
restitution = 0.5
[[event]]
name = "drop"
when = "t - 1"
set = {{ z = {} }}
[simulation]
duration = 1.4
tolerance = 1e-12
)toml",
                                                   z));
    };
    const Json motion = simulated(floor("-0.5"));
    CHECK(of_kind(motion, "release")[0]["time"] == 1.0);
    const Json hit = of_kind(motion, "impact")[0];
    CHECK(std::abs(value(hit, "time") - 1 - std::sqrt(1 / g)) < 1e-12);
    CHECK(std::abs(value(hit, "speed_before") + std::sqrt(g)) < 1e-11);
    CHECK(motion["work_balance"].get<double>() < 1e-11);
    const Run lifted = run({"simulate", floor("0.5")});
    CHECK(lifted.exit == 4);
    CHECK(lifted.err.find("makes the gap of contact 'floor' -0.5") != std::string::npos);
}

// A blade that is set across: u' = 1 along x is left, and of the speed along y nothing. The constraint's impulse
// takes m v²/2 of that.
TEST_CASE("instants: constraints hold after states were set, by an impulse, and coordinates do not jump") {
    const std::string blade = R"toml(
[coordinates]
x = { initial = 0, rate = 1 }
y = { initial = 0, rate = 2 }
[states]
on = {}
[energy]
kinetic = "3*(x'^2 + y'^2)/2"
[[constraint]]
name = "blade"
nonholonomic = "on*y' + (1 - on)*(2*x' - y')"
[[event]]
name = "turn"
when = "t - 1"
set = { on = 1 }
[simulation]
duration = 2
tolerance = 1e-12
)toml";
    const Json motion = simulated(temporary("blade.toml", blade));
    CHECK(std::abs(rate(motion, "x") - 1) < 1e-13);
    CHECK(std::abs(rate(motion, "y")) < 1e-13);
    CHECK(std::abs(coordinate(motion, "x") - 2) < 1e-12);
    CHECK(std::abs(coordinate(motion, "y") - 2) < 1e-12);
    CHECK(motion["work_balance"].get<double>() < 1e-12);
    const Run cut = run({"simulate", temporary("rope.toml", R"toml(
gravity = [0, -9.81]
[coordinates]
x = 0.6
y = -0.8
[states]
l = { initial = 1 }
[[particle]]
name = "b"
mass = 1
position = ["x", "y"]
[[constraint]]
name = "rope"
holonomic = "x^2 + y^2 = l^2"
[[event]]
name = "cut"
when = "x"
set = { l = 0.7 }
)toml")});
    CHECK(cut.exit == 4);
    CHECK(cut.err.find("puts constraint 'rope' off by 0.51") != std::string::npos);
}

// z grows by 1 in each second and is set back.
TEST_CASE("instants: events set states of a scene that has no coordinates") {
    const std::string scene = temporary("saw.toml", R"toml(
[states]
z = { rate = "1 - z/10" }
n = {}
[[event]]
name = "tick"
when = "z - 1"
set = { z = 0, n = "n + 1" }
[simulation]
duration = 5.5
tolerance = 1e-12
)toml");
    const double period = -10 * std::log(0.9);
    for (const char* method : {"auto", "radau", "taylor"}) {
        const Json motion = simulated(scene, {"--method", method});
        const std::vector<double> ticks = times(motion, "tick");
        REQUIRE(ticks.size() == 5);
        for (std::size_t k = 0; k < 5; ++k) CHECK(std::abs(ticks[k] - (k + 1.0) * period) < 1e-11);
        CHECK(std::abs(state(motion, "z") - 10 * (1 - std::exp(-(5.5 - 5 * period) / 10))) < 1e-11);
        CHECK(state(motion, "n") == 5);
    }
    const Json rows = swept({scene, "--vary", "z=0:0.5:2"})["rows"];
    CHECK(rows[0]["final"]["states"]["n"] == 5);
    CHECK(rows[1]["final"]["states"]["n"] == 5);
}

TEST_CASE("instants: a value that passes zero one way and back at one instant happens the way that counts") {
    const Json motion = simulated(temporary("there_and_back.toml", R"toml(
[coordinates]
x = { initial = -1, rate = 1 }
[states]
n = {}
[energy]
kinetic = "x'^2/2"
[[event]]
name = "tick"
when = "x"
set = { n = 3 }
[[event]]
name = "reset"
when = "n - 2.5"
set = { n = 0 }
[[event]]
name = "stopper"
when = "n - 1.5"
direction = "down"
stop = true
[simulation]
duration = 2
)toml"));
    CHECK(std::abs(motion["final"]["time"].get<double>() - 1) < 1e-9);
}

TEST_CASE("instants: a mass that an event makes negative ends the run") {
    const auto result = run({"simulate", temporary("shed.toml", R"toml(
[coordinates]
x = { initial = -1, rate = 1 }
[states]
M = { initial = 1 }
[[particle]]
name = "p"
mass = "M"
position = ["x", 0]
leaves = [-1, 0]
[[event]]
name = "shed"
when = "x"
set = { M = "M - 2" }
[simulation]
duration = 3
)toml")});
    CHECK(result.exit == 4);
    CHECK(result.err.find("expected zero or more") != std::string::npos);
}

TEST_CASE("instants: friction that an event sets sliding is told beside a contact too") {
    const Json motion = simulated(temporary("pushed.toml", R"toml(
[coordinates]
x = 0
y = 0
[states]
F = {}
[energy]
kinetic = "(x'^2 + y'^2)/2"
[forces]
x = "F"
y = "-9.81"
[[friction]]
name = "ground"
coefficient = 0.3
slip = "x'"
normal = 10
[[unilateral]]
name = "floor"
gap = "y"
restitution = 0
[[event]]
name = "push"
when = "t - 1"
set = { F = 5 }
[simulation]
duration = 3
)toml"));
    CHECK(std::abs(number(motion["final"], "coordinates", "x") - 4) < 1e-9);
    bool slips = false;
    for (const Json& event : motion["contacts"])
        slips = slips || (event["event"] == "slip" && std::abs(event["time"].get<double>() - 1) < 1e-9);
    CHECK_MESSAGE(slips, motion["contacts"].dump());
}

// Rounding leaves sin(π t) at 1e-16 where its sign changes; steps, knots and other events end at the same instant.
TEST_CASE("instants: an event whose zero is where the run ends a step for another reason is not lost") {
    const auto clock = [](const char* events) {
        return temporary("clock.toml", fmt::format(R"toml([coordinates]
x = {{ initial = -1, rate = 1 }}
[states]
n = {{}}
[[particle]]
name = "P"
mass = 1
position = ["x", 0]
[tables]
F = {{ arguments = ["t"], outside = "hold", points = [[0, 0], [1, 0], [2, 1], [3, 0], [4, 1], [5, 0.5], [6, 0]] }}
{}[simulation]
duration = 5.5
)toml",
                                                   events));
    };
    const std::string sampled =
                          "[forces]\nx = \"F(t)\"\n[[event]]\nname = \"clock\"\nwhen = \"sin(pi*t)\"\nset = { n = "
                          "\"n + 1\" }\n",
                      place = "[[event]]\nname = \"place\"\nwhen = \"x\"\nset = { n = \"n + 100\" }\n",
                      alarm = "[[event]]\nname = \"alarm\"\nwhen = \"t - 1\"\nset = { n = \"n + 1000\" }\n";
    const auto count = [](const std::string& scene, const std::vector<std::string>& method) {
        return number(simulated(scene, method)["final"], "states", "n");
    };
    for (const char* const method : {"auto", "dop853", "verner98", "dopri5", "radau", "bdf", "taylor"}) {
        CAPTURE(method);
        CHECK(count(clock(sampled.c_str()), {"--method", method}) == 5);
        CHECK(count(clock((sampled + place).c_str()), {"--method", method}) == 105);
        CHECK(count(clock((sampled + place + alarm).c_str()), {"--method", method}) == 1105);
    }
    for (const char* const step : {"0.1", "0.05", "0.01"})
        CHECK(count(clock((place + alarm).c_str()), {"--method", "rk4", "--step", step}) == 1100);
    CHECK(swept({clock((sampled + place).c_str()), "--vary", "x=-1:-1:1"})["rows"][0]["final"]["states"]["n"] ==
          105);
    // one that comes to zero from the side that does not count does not happen
    CHECK(count(clock("[[event]]\nname = \"place\"\nwhen = \"x\"\nset = { n = \"n + 100\" }\ndirection = "
                      "\"down\"\n[[event]]\nname = \"alarm\"\nwhen = \"t - 1\"\nset = { n = \"n + 1000\" }\n"),
                {}) == 1000);
}

}  // namespace commands_instants
