// SPDX-License-Identifier: MIT
// Contacts together with constraints, other contacts, moving frames and events, at the start, and in cases where
// nothing is consistent.
#include "contacts.hpp"

namespace commands_contacts {

using namespace alembert::test;

// A pendulum strikes a wall, described by its angle and by Cartesian coordinates with a rod as constraint.
TEST_CASE("contact: impacts keep bilateral constraints: two kinds of coordinates give one motion") {
    const std::string angle = temporary("angle.toml", R"toml(
[coordinates]
th = 1
[energy]
kinetic = "th'^2/2"
potential = "-9.81*cos(th)"
[[unilateral]]
name = "wall"
gap = "sin(th) + 0.3"
restitution = 0.8
[simulation]
duration = 10
tolerance = 1e-13
)toml");
    const std::string cartesian = temporary("cartesian.toml", R"toml(
gravity = [0, -9.81]
[coordinates]
x = "sin(1)"
y = "-cos(1)"
[[particle]]
name = "P"
mass = 1
position = ["x", "y"]
[[constraint]]
name = "rod"
holonomic = "x^2 + y^2 = 1"
[[unilateral]]
name = "wall"
gap = "x + 0.3"
restitution = 0.8
[simulation]
duration = 10
tolerance = 1e-13
)toml");
    const Json one = simulated(angle), other = simulated(cartesian);
    REQUIRE(one["contacts"].size() == other["contacts"].size());
    CHECK(one["contacts"].size() > 5);
    for (std::size_t k = 0; k < one["contacts"].size(); ++k) {
        CHECK(std::abs(value(one["contacts"][k], "time") - value(other["contacts"][k], "time")) < 1e-9);
        CHECK(std::abs(value(one["contacts"][k], "energy_loss") - value(other["contacts"][k], "energy_loss")) <
              1e-9);
    }
    CHECK(std::abs(std::sin(coordinate(one, "th")) - coordinate(other, "x")) < 1e-9);
    CHECK(other["constraint_drift"].get<double>() < 1e-12);
}

TEST_CASE(
    "contact: three bodies stacked above each other bounce, collapse and lie; four legs share a load that moves") {
    const Json stack = simulated(temporary("stack.toml", R"toml(
[coordinates]
a = 0
b = 0.5
c = 1.3
[energy]
kinetic = "(3*a'^2 + 2*b'^2 + c'^2)/2"
potential = "9.81*(3*a + 2*b + c)"
[[unilateral]]
name = "floor"
gap = "a"
restitution = 0.6
[[unilateral]]
name = "ab"
gap = "b - a"
restitution = 0.7
[[unilateral]]
name = "bc"
gap = "c - b"
restitution = 0.8
[outputs]
weight = "lambda_floor"
[simulation]
duration = 20
)toml"));
    CHECK(std::abs(stack["impact_loss"].get<double>() - 2.3 * g) < 1e-7);
    for (const char* q : {"a", "b", "c"}) CHECK(std::abs(coordinate(stack, q)) < 1e-12);
    CHECK(stack["work_balance"].get<double>() < 1e-10);

    const Json legs = simulated(temporary("legs.toml", R"toml(
[coordinates]
z = 0
a = 0
b = 0
[energy]
kinetic = "(z'^2 + a'^2 + b'^2)/2"
[forces]
z = -10
a = -0.1
b = "3*sin(t)"
[[unilateral]]
name = "l1"
gap = "z + a + b"
[[unilateral]]
name = "l2"
gap = "z + a - b"
[[unilateral]]
name = "l3"
gap = "z - a + b"
[[unilateral]]
name = "l4"
gap = "z - a - b"
[simulation]
duration = 10
)toml"));
    CHECK(legs["contacts"].empty());
    for (const char* q : {"z", "a", "b"}) CHECK(std::abs(coordinate(legs, q)) < 1e-12);
}

// The motion relative to a swinging platform, x = y − s(t), on which the floor is at rest.
TEST_CASE(
    "contact: a moving frame sees the same bounces, and the work of its motion in the impacts is accounted for") {
    const std::string moving = temporary("moving.toml", R"toml(
gravity = [0, -9.81]
[inputs]
s = "0.3*sin(5*t)"
[coordinates]
x = { initial = 1, rate = -1.5 }
[[particle]]
name = "P"
mass = 2
position = [0, "x + s"]
[[unilateral]]
name = "platform"
gap = "x"
restitution = 0.7
[simulation]
duration = 5
tolerance = 1e-12
)toml");
    const std::string still = temporary("still.toml", R"toml(
gravity = [0, -9.81]
[inputs]
s = "0.3*sin(5*t)"
[coordinates]
y = 1
[[particle]]
name = "P"
mass = 2
position = [0, "y"]
[[unilateral]]
name = "platform"
gap = "y - s"
restitution = 0.7
[simulation]
duration = 5
tolerance = 1e-12
)toml");
    const Json one = simulated(moving), other = simulated(still);
    REQUIRE(one["contacts"].size() == other["contacts"].size());
    CHECK(one["contacts"].size() > 5);
    for (std::size_t k = 0; k < one["contacts"].size(); ++k) {
        CHECK(std::abs(value(one["contacts"][k], "time") - value(other["contacts"][k], "time")) < 1e-8);
        CHECK(one["contacts"][k]["event"] == other["contacts"][k]["event"]);
    }
    CHECK(std::abs(coordinate(one, "x") + 0.3 * std::sin(25.0) - coordinate(other, "y")) < 1e-8);
    CHECK(other["work_balance"].get<double>() < 1e-10);
    CHECK(one["work_balance"].get<double>() < 1e-10);
}

TEST_CASE(
    "contact: where no mode is consistent the run ends with exit 4, the contacts by name, and what there was "
    "until then") {
    const std::string scene = temporary("squeeze.toml", R"toml(
[coordinates]
y = { initial = 0.3, rate = 0.1 }
[[particle]]
name = "P"
mass = 1
position = [0, "y"]
[[unilateral]]
name = "below"
gap = "y"
[[unilateral]]
name = "above"
gap = "1 - t - y"
[simulation]
duration = 3
)toml");
    const std::string file = temporary("squeeze.csv", "");
    const auto result = run({"simulate", scene, "--json", "-o", file});
    CHECK(result.exit == 4);
    CHECK(result.err.find("no contact mode is consistent at t = 1") != std::string::npos);
    CHECK(result.err.find("'below', 'above'") != std::string::npos);
    CHECK(std::abs(table_of(file).back()[0] - 1) < 1e-12);
    CHECK(Json::parse(result.out)["completed"] == false);
}

TEST_CASE("contact: a gap that is negative at the start is a mistake of the scene, with its name and size") {
    for (const char* verb : {"simulate", "eval"}) {
        const auto result =
            run({verb, temporary("deep.toml",
                                 "[coordinates]\ny = -0.25\n[[particle]]\nname = \"P\"\nmass = 1\n"
                                 "position = [0, \"y\"]\n[[unilateral]]\nname = \"floor\"\ngap = \"y\"\n")});
        CHECK(result.exit == 3);
        CHECK(result.err.find(":8:9: the gap of 'floor' is -0.25 at the start") != std::string::npos);
    }
}

TEST_CASE("contact: a scene's event stops a run between impacts and is reported once") {
    const Json motion = simulated(ball(0.5, 3,
                                       "[[event]]\nname = \"high\"\nwhen = \"y - 0.5\"\n[[event]]\nname = "
                                       "\"end\"\nwhen = \"t - 1\"\nstop = true\n"));
    CHECK(motion["final"]["time"].get<double>() == doctest::Approx(1).epsilon(1e-14));
    REQUIRE(motion["events"].size() == 2);  // on the way down; later it never reaches that height
    CHECK(std::abs(value(motion["events"][0], "time") - std::sqrt(1 / g)) < 1e-11);
    CHECK(motion["events"][1]["name"] == "end");
    CHECK(of_kind(motion, "impact").size() == 2);
}

TEST_CASE("contact: eval chooses the contacts that stay closed, and derive shows gaps and reactions") {
    const std::string scene = source_path("scenes/textbook/bouncing_ball.toml");
    const Json open = Json::parse(run({"eval", scene, "--json"}).out),
               closed = Json::parse(run({"eval", scene, "--json", "--at", "y=0"}).out);
    CHECK(open["multipliers"]["lambda_floor"] == 0.0);
    CHECK(open["closed"].empty());
    CHECK(closed["closed"] == Json::array({"floor"}));
    CHECK(closed["multipliers"]["lambda_floor"].get<double>() ==
          doctest::Approx(open["potential"].get<double>()).epsilon(1e-14));  // m g from h = 1
    CHECK(closed["accelerations"]["y"] == 0.0);
    const Json leaving = Json::parse(run({"eval", scene, "--json", "--at", "y=0", "y'=1"}).out);
    CHECK(leaving["closed"].empty());

    const Json derived = Json::parse(run({"derive", scene, "--json"}).out);
    CHECK(derived["equations"][0]["text"] == "m*y'' + m*g = lambda_floor");
    CHECK(derived["degrees_of_freedom"] == 1);
    CHECK(derived["gaps"]["floor"] == "y");
}

}  // namespace commands_contacts
