// SPDX-License-Identifier: MIT
// `[[event]]` with set, rates, record and count, and events on multipliers, compared with closed forms.
#include <doctest/doctest.h>

#include <fmt/format.h>

#include <cmath>

#include "contacts.hpp"
#include "edits.hpp"

namespace commands_modes {

using namespace alembert::test;

namespace {

/// A controller that holds what it has measured last.
const char* const sampled = R"toml(
[parameters]
T = 0.1
k = 2
[coordinates]
x = { initial = 1 }
[states]
held = { initial = 1 }
n = {}
[[particle]]
name = "p"
mass = 1
position = ["x", 0]
[forces]
x = "-k*held - 2*x'"
[[event]]
name = "sample"
when = "sin(pi*t/T)"
set = { held = "x", n = "n + 1" }
record = ["t", "x", "x'", "held"]
count = 30
[simulation]
tolerance = 1e-13
)toml";

double state(const Json& motion, const std::string& name) {
    return motion["final"]["states"][name].get<double>();
}

}  // namespace

// v' = −k h − c v with h held from instant to instant: the recursion with exp(−c T), in 30 digits (mpmath).
TEST_CASE("modes: a sampled controller with a hold follows the recursion from instant to instant") {
    const std::string scene = temporary("sampled.toml", sampled);
    for (const std::string method : {"auto", "dop853", "radau", "taylor"}) {
        const Json motion = simulated(scene, {"--method", method, "--duration", "10"});
        INFO(method);
        CHECK(std::abs(motion["final"]["time"].get<double>() - 3) < 1e-12);
        REQUIRE(motion["events"].size() == 30);
        const Json& last = motion["events"].back();
        CHECK(std::abs(last["record"]["x"].get<double>() + 0.058408001316365113976) < 1e-11);
        CHECK(std::abs(last["record"]["x'"].get<double>() - 3.6635930620998590032e-6) < 1e-11);
        CHECK(std::abs(last["record"]["held"].get<double>() + 0.057789974457471647871) < 1e-11);
        CHECK(last["record"]["t"] == last["time"]);
        CHECK(state(motion, "n") == 30);
        CHECK(motion["work_balance"].get<double>() < 1e-10);
    }
}

// ½ v² = g (y0 − y) and λ = 0 where g y/R = v²/R: y = ⅔ y0, for whatever mass.
TEST_CASE("modes: a body slides off a sphere where the normal force is zero, at two thirds of its height") {
    for (const double mass : {0.5, 2.0}) {
        const std::string scene = temporary("sphere.toml", fmt::format(R"toml(
gravity = [0, -9.81]
[coordinates]
x = 0.3
y = {{ guess = 0.95 }}
[[particle]]
name = "p"
mass = {}
position = ["x", "y"]
[[constraint]]
name = "sphere"
holonomic = "x^2 + y^2 = 1"
[[event]]
name = "off"
when = "lambda_sphere"
stop = true
record = ["y", "lambda_sphere", "energy"]
[simulation]
tolerance = 1e-13
)toml",
                                                                       mass));
        const Json motion = simulated(scene);
        REQUIRE(motion["events"].size() == 1);
        const Json& told = motion["events"][0]["record"];
        const double top = std::sqrt(1 - 0.09);
        CHECK(std::abs(told["y"].get<double>() - 2 * top / 3) < 1e-11);
        CHECK(std::abs(told["lambda_sphere"].get<double>()) < 1e-10);
        CHECK(std::abs(told["energy"].get<double>() - mass * 9.81 * top) < 1e-10);
    }
}

// From 1 to 0.5 in √(2·0.5/g); thrown back with the speed that it has, so that it returns after twice that time.
TEST_CASE("modes: rates that an event sets are those, with the work that this takes") {
    const std::string scene = temporary("thrown.toml", R"toml(
gravity = [0, -9.81]
[coordinates]
y = 1
x = { initial = 0, rate = 1 }
[[particle]]
name = "p"
mass = 2
position = ["x", "y"]
[[event]]
name = "back"
when = "y - 0.5"
direction = "down"
rates = { y = "-y'", x = "x'/2" }
[simulation]
duration = 2
tolerance = 1e-13
)toml");
    const Json motion = simulated(scene);
    const double fall = std::sqrt(1 / 9.81);
    REQUIRE(motion["events"].size() == 3);
    double speed = 1;
    for (std::size_t k = 0; k < 3; ++k) {
        CHECK(std::abs(motion["events"][k]["time"].get<double>() - (1 + 2 * static_cast<double>(k)) * fall) <
              1e-12);
        CHECK(std::abs(motion["events"][k]["energy_gain"].get<double>() - (speed * speed / 4 - speed * speed)) <
              1e-12);
        speed /= 2;
    }
    CHECK(std::abs(rate(motion, "x") - 0.125) < 1e-12);
    CHECK(motion["work_balance"].get<double>() < 1e-11);
}

TEST_CASE("modes: a rate that a constraint forbids ends the run, and one that it allows does not") {
    const auto scene = [](const char* rates) {
        return temporary("rod.toml", fmt::format(R"toml(
gravity = [0, -9.81]
[coordinates]
x = 1
y = 0
[[particle]]
name = "p"
mass = 2
position = ["x", "y"]
[[constraint]]
name = "rod"
holonomic = "x^2 + y^2 = 1"
[[event]]
name = "push"
when = "y + 0.6"
direction = "down"
rates = {{ {} }}
[simulation]
duration = 1
tolerance = 1e-12
)toml",
                                                 rates));
    };
    const Run forbidden = run({"simulate", scene("x = \"1\", y = \"1\"")});
    CHECK(forbidden.exit == 4);
    CHECK(forbidden.err.find("event 'push' sets x' = 1") != std::string::npos);
    CHECK(run({"simulate", scene("x = \"-3\", y = \"-4\"")}).exit == 0);  // along the circle at (0.8, −0.6)
}

// A spring catches a mass where it passes and lets it go: half a period π √(m/k) on the spring, then free again.
TEST_CASE("modes: a mass is picked up and dropped, and the energy that a mode brings is told as work") {
    const std::string scene = temporary("caught.toml", R"toml(
[parameters]
k = 8
m = 2
[coordinates]
x = { initial = -1, rate = 1 }
[states]
on = {}
[[particle]]
name = "p"
mass = "m"
position = ["x", 0]
[energy]
potential = "on*k*x^2/2 + on*3"
[[event]]
name = "catch"
when = "x"
direction = "up"
set = { on = "1" }
[[event]]
name = "drop"
when = "x"
direction = "down"
set = { on = "0" }
[simulation]
duration = 4
tolerance = 1e-13
)toml");
    const Json motion = simulated(scene);
    REQUIRE(motion["events"].size() == 2);
    CHECK(std::abs(motion["events"][0]["time"].get<double>() - 1) < 1e-12);
    CHECK(std::abs(motion["events"][1]["time"].get<double>() - 1 - M_PI / 2) < 1e-11);
    CHECK(std::abs(coordinate(motion, "x") + 3 - M_PI / 2) < 1e-11);
    CHECK(motion["work_balance"].get<double>() < 1e-11);
}

TEST_CASE("modes: states go on through impacts, and a contact may carry one") {
    // A ball on a floor that a state raises: y = z, z' = 0.5, after it has come to rest on it.
    const std::string scene = temporary("raised.toml", R"toml(
gravity = [0, -9.81]
[coordinates]
y = 0
[states]
z = { rate = "0.5" }
s = { rate = "y" }
[[particle]]
name = "p"
mass = 2
position = [0, "y"]
[[unilateral]]
name = "floor"
gap = "y - z"
restitution = 0
[simulation]
duration = 1
tolerance = 1e-12
)toml");
    const Json motion = simulated(scene);
    CHECK(std::abs(coordinate(motion, "y") - 0.5) < 1e-10);
    CHECK(std::abs(state(motion, "z") - 0.5) < 1e-12);
    CHECK(std::abs(state(motion, "s") - 0.25) < 1e-10);
}

TEST_CASE("modes: sweeps have them, and units say that they do not record") {
    const std::string scene = temporary("sampled.toml", sampled);
    const Json rows = swept({scene, "--vary", "k=1:3:3", "--duration", "1"})["rows"];
    for (std::size_t i = 0; i < 3; ++i) {
        const Json alone =
            simulated(temporary("one.toml", edited(sampled, {{"k = 2", fmt::format("k = {}", i + 1)}})),
                      {"--duration", "1"});
        CHECK(std::abs(rows[i]["final"]["states"]["held"].get<double>() - state(alone, "held")) < 1e-11);
    }
    const std::string told =
        edited(sampled, {{"set = { held = \"x\", n = \"n + 1\" }\n", ""}, {"count = 30\n", ""}});
    const Run recorded = run({"emit", temporary("told.toml", told), "--fmu", temporary("out.fmu", "")});
    CHECK(recorded.exit == 0);
    CHECK(recorded.err.find("what events record is told by runs") != std::string::npos);
}

TEST_CASE("modes: what an event cannot set, record or count is refused where it stands") {
    const auto refusal = [](const std::string& from, const std::string& to) {
        const Run result = run({"simulate", temporary("wrong.toml", edited(sampled, {{from, to}}))});
        CHECK(result.exit == 3);
        return result.err;
    };
    CHECK(refusal("held = \"x\"", "x = \"1\"").find("an event sets a state") != std::string::npos);
    CHECK(refusal("held = \"x\"", "helt = \"x\"").find("did you mean 'held'") != std::string::npos);
    CHECK(refusal("count = 30", "count = 0").find("how many zeros") != std::string::npos);
    CHECK(refusal("\"held\"]", "\"2*x\"]").find("there is no '2*x'") != std::string::npos);
    const std::string both = refusal("\"x'\", \"held\"]", "\"helt\", \"2*x\"]");
    CHECK(both.find("wrong.toml:20:22: there is no 'helt' to show (did you mean 'held'?)") != std::string::npos);
    CHECK(both.find("wrong.toml:20:30: there is no '2*x' to show") != std::string::npos);
    CHECK(refusal("record = [\"t\", \"x\", \"x'\", \"held\"]", "record = []").find("expected the names") !=
          std::string::npos);
}

}  // namespace commands_modes
