// SPDX-License-Identifier: MIT
// Masses that change (`leaves` of a particle): Tsiolkovsky's rocket, a drop that grows, a rocket on a pendulum, by
// all formalisms, against closed forms and against the momentum written out by hand.
#include <doctest/doctest.h>

#include <fmt/format.h>

#include <cmath>
#include <string>
#include <vector>

#include "edits.hpp"
#include "files.hpp"
#include "json.hpp"
#include "program.hpp"

namespace commands_thrust {

using namespace alembert::test;

namespace {

const char* const rocket = R"toml(
gravity = [0, "-g"]
[parameters]
M_0 = 100
mdot = 8
c = 2500
g = 9.81
[coordinates]
h = 0
[[particle]]
name = "rocket"
mass = "M_0 - mdot*t"
position = [0, "h"]
leaves = [0, "-c"]
[simulation]
duration = 8
tolerance = 1e-13
[[claim]]
equation = "(M_0 - mdot*t)*h'' = mdot*c - (M_0 - mdot*t)*g"
)toml";

/// A rocket on an arm that turns: what leaves is along the arm's normal.
const char* const turning = R"toml(
gravity = [0, "-g"]
[parameters]
l = 2
g = 9.81
u = 30
[states]
M = { rate = "-0.3*exp(-t/4)", initial = 2 }
[coordinates]
q = { initial = 0.4, rate = 0.2 }
s = { initial = 0.1, rate = 0 }
[[frame]]
name = "A"
rotate = [["z", "q"]]
[[particle]]
name = "engine"
mass = "M"
position = ["(l + s)*cos(q)", "(l + s)*sin(q)"]
leaves = [0, "-u"]
leaves_along = "A"
[[spring]]
along = "s"
stiffness = 200
[[damper]]
along = "s"
damping = 3
)toml";

}  // namespace

// h' = c ln(M0/M) − g t.
TEST_CASE("thrust: a rocket whose mass is a function of time or a state has Tsiolkovsky's speed") {
    const double wanted = 2500 * std::log(100.0 / (100 - 8 * 8)) - 9.81 * 8;
    const std::string by_state =
        edited(rocket, {{"[coordinates]", "[states]\nM = { rate = \"-mdot\", initial = \"M_0\" }\n[coordinates]"},
                        {"mass = \"M_0 - mdot*t\"", "mass = \"M\""},
                        {"(M_0 - mdot*t)*h'' = mdot*c - (M_0 - mdot*t)*g", "M*h'' = mdot*c - M*g"}});
    for (const std::string& text : {std::string(rocket), by_state}) {
        const std::string scene = temporary("rocket.toml", text);
        const Json motion = simulated(scene);
        CHECK(std::abs(number(motion["final"], "rates", "h") / wanted - 1) < 1e-11);
        CHECK(json_of({"check", scene})["claims"][0]["verdict"] == "proved");
        CHECK(run({"derive", scene}).out.find("mdot*h'") == std::string::npos);  // on neither side
        CHECK(json_of({"check", scene, "--formalisms"})["verdict"] == "proved");
        for (const char* const by : {"kane", "appell", "dalembert", "hamilton", "maggi", "lagrange1", "routh"})
            CHECK(std::abs(number(simulated(scene, {"--by", by})["final"], "rates", "h") / wanted - 1) < 1e-11);
    }
}

TEST_CASE("thrust: what leaves along a frame that turns is the momentum written out by hand, by all formalisms") {
    const std::string scene = temporary("turning.toml", turning);
    const Json agreed = json_of({"check", scene, "--formalisms"});
    CHECK(agreed["verdict"] == "proved");
    CHECK(agreed["formalisms"].size() >= 6);
    // (M v)' = F + M' (v + u): the same by [energy] and [forces].
    const std::string by_hand = temporary(
        "by_hand.toml",
        edited(turning,
               {{"[[particle]]\nname = \"engine\"\nmass = \"M\"\nposition = [\"(l + s)*cos(q)\", \"(l + "
                 "s)*sin(q)\"]\nleaves = [0, \"-u\"]\nleaves_along = \"A\"\n",
                 "[energy]\nkinetic = \"M*((l + s)^2*q'^2 + s'^2)/2\"\npotential = \"M*g*(l + s)*sin(q)\"\n"
                 "[forces]\nq = \"M'*((l + s)^2*q' - (l + s)*u)\"\ns = \"M'*s'\"\n"},
                {"gravity = [0, \"-g\"]\n", ""}}));
    const std::vector<std::string> how{"--duration", "5", "--tolerance", "1e-12"};
    const Json here = simulated(scene, how), there = simulated(by_hand, how);
    for (const char* const name : {"q", "s"}) {
        CHECK(std::abs(number(here["final"], "coordinates", name) - number(there["final"], "coordinates", name)) <
              1e-10);
        CHECK(std::abs(number(here["final"], "rates", name) - number(there["final"], "rates", name)) < 1e-9);
    }
    CHECK(here["work_balance"].get<double>() < 1e-9);
}

TEST_CASE("thrust: the rocket whose momentum is written by hand is the particle that says what leaves it") {
    const std::string by_hand = source_path("scenes/elements/rocket.toml");
    const std::string scene = temporary(
        "rocket_leaves.toml",
        "gravity = [0, \"-g\"]\n" +
            edited(contents(by_hand), {{"[energy]\nkinetic = \"M*h'^2/2\"\n", ""},
                                       {"[forces]\nh = \"M'*(h' - c) - M*g\"\n",
                                        "[[particle]]\nname = \"rocket\"\nmass = \"M\"\nposition = [0, \"h\"]\n"
                                        "leaves = [0, \"-c\"]\n"}}));
    const Json here = simulated(scene), there = simulated(by_hand);
    CHECK(here["events"].size() == 1);
    for (const char* const column : {"h", "h'", "M"}) {
        const double a = here["events"][0]["record"][column].get<double>(),
                     b = there["events"][0]["record"][column].get<double>();
        CHECK(std::abs(a / b - 1) < 1e-12);
    }
    CHECK(std::abs(number(here["final"], "rates", "h") / number(there["final"], "rates", "h") - 1) < 1e-11);
}

// m = m_0 + k t at rest joins the drop: u = −v, so that (m v)' = m g and v = g (m_0 t + k t²/2)/m.
TEST_CASE("thrust: a drop that takes up water at rest falls as its momentum says") {
    const std::string scene = temporary("drop.toml", R"toml(
gravity = [0, "g"]
[parameters]
m0 = 1
k = 0.5
g = 9.81
[coordinates]
y = 0
[[particle]]
name = "drop"
mass = "m0 + k*t"
position = [0, "y"]
leaves = [0, "-y'"]
)toml");
    const double t = 3, v = 9.81 * (t + 0.25 * t * t) / (1 + 0.5 * t);
    const Json motion = simulated(scene, {"--duration", "3", "--tolerance", "1e-13"});
    CHECK(std::abs(number(motion["final"], "rates", "y") - v) < 1e-11);
}

TEST_CASE(
    "thrust: a mass that changes without what leaves, and what leaves a mass that does not change, are refused") {
    const auto refused = [](const std::string& text) {
        const Run result = run({"eval", temporary("refused.toml", text)});
        CHECK(result.exit == 3);
        return result.err;
    };
    const std::string without = refused(edited(rocket, {{"leaves = [0, \"-c\"]\n", ""}}));
    CHECK(without.find("leaves = [x, y] of a [[particle]]") != std::string::npos);
    const std::string constant = refused(edited(rocket, {{"mass = \"M_0 - mdot*t\"", "mass = \"M_0\""}}));
    CHECK(constant.find("its mass does not change") != std::string::npos);
    const std::string moving = refused(edited(rocket, {{"mass = \"M_0 - mdot*t\"", "mass = \"M_0 - mdot*h\""}}));
    CHECK(moving.find("depends on a coordinate") != std::string::npos);
}

}  // namespace commands_thrust
