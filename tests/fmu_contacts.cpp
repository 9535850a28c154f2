// SPDX-License-Identifier: MIT
// Units of scenes with contacts: impacts, releases and contacts that lie, in both kinds and versions of FMI, held
// against closed forms and against the motions of `simulate`.
#include <doctest/doctest.h>

#include "fmu_exports.hpp"
#include "redundant_plate.hpp"

namespace fmu_contacts {

using namespace alembert::test;

namespace {

/// A ball of restitution e falls from the height h on a floor at 0: parabolas between the bounces, which end at
/// √(2h/g) (1 + e)/(1 − e).
std::pair<double, double> ball_at(double e, double h, double end) {
    constexpr double g = 9.81;
    double t = std::sqrt(2 * h / g), v = g * t;
    if (end < t) return {h - g / 2 * end * end, -g * end};
    if (e < 1 && end > t * (1 + e) / (1 - e)) return {0, 0};
    for (v *= e; t + 2 * v / g < end; v *= e) t += 2 * v / g;
    return {v * (end - t) - g / 2 * (end - t) * (end - t), v - g * (end - t)};
}

bool stepped(Instance& one, double end, int steps) {
    for (int k = 0; k < steps; ++k)
        if (!one.step(end * k / steps, end / steps)) return false;
    return true;
}

/// The largest difference from `simulate`, of both kinds in this version: co-simulation in 1 and in 40 steps of
/// the importer, and model exchange.
double worst_difference(const std::string& scene, int version, double end, int steps_of_exchange = 4000) {
    const Json final = simulated(scene, end);
    const Unit unit = exported(scene, version);
    double worst = 0;
    for (const int steps : {1, 40}) {
        Instance one(unit, true, 1e-12);
        one.begin();
        CHECK(stepped(one, end, steps));
        worst = std::max(worst, difference(one, final));
    }
    Instance exchanged(unit, false, 1e-12);
    exchanged.begin();
    exchange(exchanged, end, steps_of_exchange);
    return std::max(worst, difference(exchanged, final));
}

std::string contact_scene(const char* name, const std::string& text) {
    return temporary(name, text);
}

}  // namespace

TEST_CASE("fmu: a ball bounces on a contact as in closed form, comes to rest, and lies") {
    const std::string scene = source_path("scenes/textbook/bouncing_ball.toml");
    for (const int version : {2, 3}) {
        const Unit unit = exported(scene, version);
        CHECK(unit.description.at("lambda_floor", "causality") == "local");
        for (const double e : {0.7, 0.3, 0.0, 1.0})
            for (const double end : {0.4, 1.3, 2.5, 4.0})
                for (const int steps : {1, 7, 100}) {
                    CAPTURE(e);
                    CAPTURE(end);
                    CAPTURE(steps);
                    Instance one(unit, true, 1e-11);
                    one.set("e", e);
                    one.begin();
                    REQUIRE(stepped(one, end, steps));
                    const auto [y, v] = ball_at(e, 1, end);
                    CHECK(std::abs(one.get("y") - y) < 1e-8);
                    CHECK(std::abs(one.get("der(y)") - v) < 1e-8);
                    const bool lies = e < 1 && end > std::sqrt(2 / 9.81) * (1 + e) / (1 - e);
                    CHECK(std::abs(one.get("lambda_floor") - (lies ? 0.5 * 9.81 : 0)) < 1e-9);
                    CHECK(one.get("reaction") == one.get("lambda_floor"));
                }
        for (const double end : {1.3, 4.0}) {
            Instance one(unit, false, 1e-11);
            one.begin();
            exchange(one, end, 400);
            const auto [y, v] = ball_at(0.7, 1, end);
            CHECK(std::abs(one.get("y") - y) < 1e-9);
            CHECK(std::abs(one.get("der(y)") - v) < 1e-9);
        }
    }
}

TEST_CASE("fmu: a particle leaves a sphere, and a pressed block its stop, as in simulate") {
    const std::string sphere = contact_scene("sphere.toml", R"toml(gravity = [0, -9.81]
[coordinates]
r = { initial = 2 }
th = { initial = 0.5 }
[[particle]]
name = "p"
mass = 1
position = ["r*sin(th)", "r*cos(th)"]
[[unilateral]]
name = "sphere"
gap = "r - 2"
)toml");
    const std::string stop = contact_scene("stop.toml", R"toml([coordinates]
x = 0
[[particle]]
name = "block"
mass = 1
position = ["x", 0]
[forces]
x = "-cos(t) - 0.2"
[[unilateral]]
name = "stop"
gap = "x"
)toml");
    for (const int version : {2, 3}) {
        CHECK(worst_difference(sphere, version, 0.7) < 1e-8);
        CHECK(worst_difference(sphere, version, 2) < 1e-8);
        CHECK(worst_difference(stop, version, 3) < 1e-9);
        CHECK(worst_difference(stop, version, 8) < 1e-8);  // it returns, and is struck
    }
}

namespace {

constexpr const char* table = R"toml(gravity = [0, -9.81]
[parameters]
A = 0.2
w = 10
[inputs]
s = "A*sin(w*t)"
[coordinates]
y = { initial = 0, rate = "A*w" }
[[particle]]
name = "ball"
mass = 0.7
position = [0, "y"]
[[unilateral]]
name = "table"
gap = "y - s"
restitution = 0.3
)toml";

constexpr const char* corner = R"toml(gravity = [0, -9.81]
[coordinates]
x = { initial = 1, rate = -3 }
y = 0.5
[[particle]]
name = "P"
mass = 1
position = ["x", "y"]
[forces]
x = -1
[[unilateral]]
name = "wall"
gap = "x"
[[unilateral]]
name = "floor"
gap = "y"
restitution = 0.4
)toml";

/// A rod that falls on its ends; three supports below it depend on each other.
std::string rod(const std::string& phi, const std::string& more = "") {
    return R"toml(gravity = [0, -9.81]
[coordinates]
y = 1
phi = )toml" +
           phi + R"toml(
[[frame]]
name = "B"
rotate = [["z", "phi"]]
[[body]]
name = "rod"
mass = 1
inertia = "1/12"
frame = "B"
position = [0, "y"]
[[unilateral]]
name = "left"
gap = "y - sin(phi)/2"
restitution = 0.5
[[unilateral]]
name = "right"
gap = "y + sin(phi)/2"
restitution = 0.5
)toml" + more;
}

constexpr const char* cradle = R"toml([coordinates]
a = { initial = -1, rate = 2 }
b = 0
c = 0.5
d = 1.5
[[particle]]
name = "A"
mass = 1
position = ["a", 0]
[[particle]]
name = "B"
mass = 2
position = ["b", 0]
[[particle]]
name = "C"
mass = 1
position = ["c", 0]
[[particle]]
name = "D"
mass = 3
position = ["d", 0]
[[unilateral]]
name = "ab"
gap = "b - a - 0.1"
restitution = 1
[[unilateral]]
name = "bc"
gap = "c - b - 0.1"
restitution = 0.8
[[unilateral]]
name = "cd"
gap = "d - c - 0.1"
restitution = 0.9
)toml";

/// A pendulum of a rod, held by constraints, between two walls; an event kicks it, and a drag has a kink.
constexpr const char* held = R"toml(gravity = [0, -9.81]
[coordinates]
x = { initial = 0.6, rate = 0 }
y = { initial = -0.8, rate = 0 }
[[particle]]
name = "bob"
mass = 2
position = ["x", "y"]
[[constraint]]
name = "rod"
holonomic = "x^2 + y^2 = 1"
[forces]
x = "-0.3*abs(x')*x'"
y = "-0.3*abs(y')*y'"
[[unilateral]]
name = "left"
gap = "x + 0.4"
restitution = 0.6
[[unilateral]]
name = "right"
gap = "0.7 - x"
restitution = 0.5
[[event]]
name = "push"
when = "x - 0.2"
direction = "down"
impulses = { x = "-0.5" }
[outputs]
pull = "lambda_rod"
press = "lambda_left + lambda_right"
)toml";

}  // namespace

TEST_CASE("fmu: contacts that move, that meet in a corner, that depend on each other, or under constraints") {
    const auto worst = [](const char* name, const std::string& text, double end) {
        const std::string scene = temporary(name, text);
        return std::max(worst_difference(scene, 2, end), worst_difference(scene, 3, end));
    };
    CHECK(worst("table.toml", table, 0.6) < 1e-8);
    CHECK(worst("corner.toml", corner, 2) < 1e-8);
    CHECK(worst("rod.toml", rod("0.3"), 0.9) < 1e-7);
    CHECK(worst("rod.toml", rod("0.3"), 3) < 1e-7);
    CHECK(worst("flat.toml", rod("0"), 2.5) < 1e-8);
    CHECK(worst("middle.toml", rod("0", "[[unilateral]]\nname = \"middle\"\ngap = \"y\"\nrestitution = 0.5\n"),
                2.5) < 1e-8);
    CHECK(worst("cradle.toml", cradle, 2) < 1e-9);
    CHECK(worst("held.toml", held, 3) < 1e-7);
    CHECK(worst_difference(source_path("scenes/textbook/slack_pendulum.toml"), 2, 5) < 1e-6);
}

TEST_CASE(
    "fmu: a unit with contacts obeys the rules of FMI, goes on from a saved state, and begins with no negative "
    "gap") {
    const std::string scene = source_path("scenes/textbook/bouncing_ball.toml");
    for (const int version : {2, 3}) {
        const Unit unit = exported(scene, version);
        check_rules(unit.files.at("modelDescription.xml"), version);
        for (const char* const source : {"sources/bouncing_ball.c", "sources/bouncing_ball_fmu.c"}) {
            const std::string head = unit.files.at(source).substr(0, 500);
            CHECK(head.find("SPDX-License-Identifier: MIT\n") <= 6);
            CHECK(head.find(std::string("alembert emit bouncing_ball.toml --fmu bouncing_ball.fmu") +
                            (version == 3 ? " --fmi 3\n" : "\n")) != std::string::npos);
        }
        CHECK(unit.files.at("modelDescription.xml").find("rovidesDirectionalDerivative=\"true\"") ==
              std::string::npos);
        Instance one(unit, true, 1e-9);
        one.begin();
        stepped(one, 2.6, 1);  // it lies
        void* saved = nullptr;
        one.ok(one.prefix() + (version == 2 ? "GetFMUstate" : "GetFMUState"), &saved);
        Instance other(unit, true, 1e-9);
        other.begin();
        other.ok(one.prefix() + (version == 2 ? "SetFMUstate" : "SetFMUState"), saved);
        CHECK(other.step(2.6, 1));
        CHECK(other.get("y") == 0);
        CHECK(std::abs(other.get("lambda_floor") - 0.5 * 9.81) < 1e-12);
        one.ok(one.prefix() + (version == 2 ? "FreeFMUstate" : "FreeFMUState"), &saved);

        Instance below(unit, true);
        below.set("y", -0.1);
        if (version == 2)
            below.ok("fmi2EnterInitializationMode");
        else
            below.ok("fmi3EnterInitializationMode", false, 0.0, 0.0, false, 0.0);
        CHECK(below.status(below.prefix() + "ExitInitializationMode") == failed);
    }
}

TEST_CASE("fmu: contacts are refused where constraints depend on each other at some poses only") {
    const std::string wheels = temporary(
        "wheels.toml", std::string(redundant_wheels) + "[[unilateral]]\nname = \"wall\"\ngap = \"9 - x\"\n");
    const auto refused = run({"fmu", wheels, "-o", file_name("none.fmu")});
    CHECK(refused.exit == 3);
    CHECK_MESSAGE(refused.err.find("depend on each other at some poses") != std::string::npos, refused.err);
}

}  // namespace fmu_contacts
