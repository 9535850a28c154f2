// SPDX-License-Identifier: MIT
// Units of scenes whose events set states and rates, set each other off, and are counted: the same motions as by
// `simulate`, in co-simulation with large steps and in model exchange, by both versions of the interface.
#include <doctest/doctest.h>

#include "edits.hpp"
#include "fmu_exports.hpp"
#include "scenes.hpp"

namespace fmu_modes {

using namespace alembert::test;

namespace {

std::string line(const std::string& events, const std::string& more = "") {
    return temporary("line.toml", fmt::format(R"toml(
[coordinates]
x = {{ initial = -1, rate = 2 }}
[states]
n = {{}}
m = {{}}
s = {{ rate = "x" }}
[energy]
kinetic = "x'^2/2"
potential = "x^2/2"
{}
{}
)toml",
                                              more, events));
}

}  // namespace

// The recursion from instant to instant is that of "modes: a sampled controller with a hold …".
TEST_CASE("fmu: a sampled controller holds what it has measured, and its last instant ends the simulation") {
    const std::string scene = temporary("sampled.toml", R"toml(
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
count = 30
)toml");
    check_unit(scene, 2.95);
    check_unit(scene, 4);
    for (const int version : {2, 3}) {
        const Unit unit = exported(scene, version);
        Instance one(unit, true, 1e-11);
        one.begin();
        CHECK_FALSE(one.step(0, 4));
        CHECK(std::abs(one.get("x") + 0.058408001316365113976) < 1e-8);
        CHECK(one.get("n") == 30);
    }
}

TEST_CASE("fmu: rates and states that events set, in rounds, are those of a run") {
    for (const char* const events :
         {"[[event]]\nname = \"a\"\nwhen = \"x\"\nset = { n = \"n + 1\" }\nrates = { x = \"x'/2\" }\n",
          "[[event]]\nname = \"a\"\nwhen = \"x\"\nset = { n = \"1 - n\" }\n"
          "[[event]]\nname = \"b\"\nwhen = \"n - 0.5\"\nset = { m = \"m + 2\" }\nrates = { x = \"x' + n\" }\n"
          "[[event]]\nname = \"c\"\nwhen = \"m - 4\"\nimpulses = { x = \"-x'/2\" }\n",
          "[[event]]\nname = \"a\"\nwhen = \"x\"\nset = { n = \"n + 1 \" }\n"
          "[[event]]\nname = \"e\"\nwhen = \"x\"\nset = { n = \"n + x'\" }\nimpulses = { x = \"0.1*n\" }\n",
          // The second round turns the motion, at the place of the first one's event.
          "[[event]]\nname = \"hit\"\nwhen = \"x\"\nrates = { x = \"-x'/2\" }\nset = { n = \"n + 1\" }\n"
          "[[event]]\nname = \"again\"\nwhen = \"n - 0.5\"\nrates = { x = \"3\" }\n",
          "[[event]]\nname = \"hit\"\nwhen = \"x\"\nimpulses = { x = \"-1.5*x'\" }\nset = { n = \"n + 1\" }\n"
          "[[event]]\nname = \"again\"\nwhen = \"n - 0.5\"\nimpulses = { x = \"4\" }\n",
          "[[event]]\nname = \"a\"\nwhen = \"x\"\ndirection = \"up\"\nset = { n = \"n + 1\" }\n"
          "[[event]]\nname = \"last\"\nwhen = \"n - 3\"\nstop = true\n"}) {
        INFO(events);
        check_unit(line(events), 12.3);
    }
}

// Where the fourth tooth clicks, a second event of the instant takes the lock off, and the next click comes at the
// fifth.
TEST_CASE("fmu: a counter whose own event goes on to the next zero sees it after a second event of the instant") {
    check_unit(temporary("teeth.toml", R"toml(
[coordinates]
phi = { initial = 0, rate = 1 }
[states]
tooth = {}
lock = {}
[energy]
kinetic = "0.1*phi'^2/2"
[forces]
phi = "sin(3*t) - 0.05*phi' - 40*lock*min(0, phi - 0.3*tooth)"
[[event]]
name = "click"
when = "phi - 0.3*(tooth + 1)"
direction = "up"
set = { tooth = "tooth + 1", lock = 1 }
[[event]]
name = "free"
when = "tooth - 4"
set = { lock = 0 }
)toml"),
               4, 1e-6);
}

TEST_CASE("fmu: impulses and rates stand beside states, coupled coordinates and constraints") {
    const auto coupled = [](const char* const action) {
        return temporary("coupled.toml", fmt::format(R"toml(
[coordinates]
x = {{ initial = -1, rate = 2 }}
y = {{ initial = 0.3, rate = 0 }}
[states]
F = {{ rate = "(1 - F)/0.3" }}
n = {{}}
[energy]
kinetic = "x'^2/2 + y'^2 + x'*y'/2"
potential = "x^2/2 + 2*y^2"
[forces]
y = "F"
[[event]]
name = "a"
when = "x"
set = {{ n = "n + 1" }}
{}
)toml",
                                                     action));
    };
    check_unit(coupled("impulses = { x = \"0.5*n + 1\" }"), 8);
    check_unit(coupled("rates = { x = \"x'/2 + F\" }"), 8);
    const std::string rod = temporary("rod.toml", R"toml(
gravity = [0, -9.81]
[coordinates]
x = 1
y = 0
[states]
n = {}
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
set = { n = "n + 1" }
rates = { x = "1.1*x'", y = "1.1*y'" }
)toml");
    check_unit(rod, 3);
    const Unit unit =
        exported(temporary("wrong.toml", edited(contents(rod), {{"y = \"1.1*y'\"", "y = \"y'\""}})), 2);
    Instance one(unit, true, 1e-10);
    one.begin();
    CHECK(one.step_status(0, 1) == failed);
}

/// The status of a step of co-simulation in which this unit ends, and of the event mode in model exchange.
void check_failing(const std::string& scene, double end) {
    CHECK(run({"simulate", scene, "--duration", fmt::format("{}", end)}).exit == 4);
    for (const int version : {2, 3}) {
        CAPTURE(version);
        const Unit unit = exported(scene, version);
        Instance one(unit, true, 1e-10);
        one.begin();
        CHECK(one.step_status(0, end) == failed);
    }
}

TEST_CASE("fmu: what set states turn into the direction that counts happens at the same instant") {
    const std::string turn =
        "[[event]]\nname = \"a\"\nwhen = \"x\"\nset = { m = 1, n = 2 }\n"
        "[[event]]\nname = \"b\"\nwhen = \"(m - 0.5)*x\"\ndirection = \"up\"\n";
    for (const char* const act : {"set = { n = \"n + 1\" }\n", "rates = { x = \"x'/2\" }\n", "stop = true\n"})
        check_unit(line(turn + act), 3);
    // Each of them turns the value back to the zero of the other one.
    check_failing(temporary("endless.toml", R"toml(
[coordinates]
x = 0.1
[states]
s = { initial = 1 }
[energy]
kinetic = "x'^2/2"
[forces]
x = "-s - 0.1*x'"
[[event]]
name = "down"
when = "x + 0.1*x'"
direction = "down"
set = { s = -1 }
[[event]]
name = "up"
when = "x + 0.1*x'"
direction = "up"
set = { s = 1 }
)toml"),
                  3);
}

TEST_CASE("fmu: events of one instant agree in all orders, or the simulation ends") {
    const auto setting = [](const std::vector<std::string>& values) {
        std::string events;
        for (std::size_t k = 0; k < values.size(); ++k)
            events += fmt::format("[[event]]\nname = \"e{0}\"\nwhen = \"{0}*x + x\"\nset = {{ n = \"{1}\" }}\n", k,
                                  values[k]);
        return line(events);
    };
    check_unit(setting({"n + 1", "n + 2", "n + 3", "n + 4", "n + 5", "n + 6"}), 2);
    check_failing(setting({"n + 1", "2*n", "n + 1"}), 2);  // 2 n + 3, and the same in the opposite order
    check_failing(setting({"n + 1", "n + 1", "2*n + 1", "n + 1", "n + 1", "n + 1", "n + 1"}), 2);
}

TEST_CASE("fmu: masses, moments and energies that events or rates make impossible end the simulation") {
    const auto body = [](const std::string& mass, const std::string& state, const std::string& event) {
        return temporary("body.toml", fmt::format(R"toml(
[coordinates]
x = {{ initial = -1, rate = 2 }}
[states]
z = {{ initial = 2{} }}
[[particle]]
name = "p"
mass = "{}"
leaves = [0, 0]
position = ["x", 0]
[[event]]
name = "a"
when = "x"
{}
)toml",
                                                  state, mass, event));
    };
    check_unit(body("z", "", "set = { z = \"z - 1.5\" }"), 2);
    check_failing(body("z", "", "set = { z = \"z - 3\" }"), 2);
    check_failing(body("z", ", rate = -1.5", "record = [\"z\"]"), 2);
    check_failing(line("[[event]]\nname = \"a\"\nwhen = \"x\"\nset = { n = -1 }\n", "[forces]\nx = \"sqrt(n)\"\n"),
                  2);
}

TEST_CASE("fmu: events set states beside speeds that are fewer than the coordinates") {
    check_unit(temporary("skate.toml", R"toml(
[coordinates]
x = 0
y = 0
phi = 0.5
[speeds]
v = { form = "x'*cos(phi) + y'*sin(phi)", initial = 1 }
w = { form = "phi'", initial = 0.7 }
[states]
n = {}
s = { rate = "v" }
[[frame]]
name = "B"
rotate = [["z", "phi"]]
[[body]]
name = "b"
frame = "B"
mass = 2
position = ["x", "y"]
inertia = 0.3
[[constraint]]
name = "skate"
nonholonomic = "y'*cos(phi) - x'*sin(phi)"
[forces]
phi = "-phi + 0.3*n"
[[event]]
name = "a"
when = "phi - 0.2"
set = { n = "n + 1 + x'/10 + s/20" }
)toml"),
               5);
}

TEST_CASE("fmu: events that look at forces happen where these jump, by signs, knots, set states and impulses") {
    const auto wire = [](const std::string& curve, const std::string& force, const std::string& events) {
        return temporary("wire.toml", fmt::format(R"toml(
[tables]
h = {{ arguments = ["x"], interpolation = "pchip", outside = "hold", points = [
    [-5,0], [0,0], [0.3,-0.1], [0.6,-0.35], [1,-1], [5,-1]] }}
[coordinates]
x = {{ initial = 0, rate = 1 }}
y = {{ initial = 0 }}
[states]
n = {{}}
k = {{ initial = 1 }}
[[particle]]
name = "p"
mass = 1
position = ["x", "y"]
[[constraint]]
name = "wire"
holonomic = "{}"
[forces]
x = "-7.29*x"
y = "{}"
[[event]]
name = "flip"
when = "lambda_wire"
set = {{ n = "n + 1" }}
{}
)toml",
                                                  curve, force, events));
    };
    const std::string there = "[[event]]\nname = \"there\"\nwhen = \"x - 0.3\"\nset = { k = \"k + 1\" }\n";
    for (const std::string& more : {std::string(), there})
        check_unit(wire("y", "3*sign(x - 0.3) + 0.5", more), 6, 1e-6);
    check_unit(wire("y = h(x)", "5*k - x'^2",
                    "direction = \"up\"\n[[event]]\nname = \"pass\"\nwhen = \"x - 0.2\"\nset = { k = \"-k\" }\n"
                    "impulses = { x = \"-0.1*x'\" }\n"),
               3, 1e-6);
    check_unit(wire("y = h(x)", "x'^2 - 2*k",
                    "[[event]]\nname = \"pass\"\nwhen = \"x - 0.2\"\nimpulses = { x = \"-1.6*x'\" }\n"),
               3, 1e-6);
}

// It comes back to the floor with 0.8 of the speed, while a counter and a controller go on.
TEST_CASE("fmu: contacts stand beside states that events set") {
    check_unit(temporary("contact.toml", R"toml(
gravity = [0, -9.81]
[coordinates]
x = 0
y = 1
[states]
n = {}
s = { rate = "y" }
[[particle]]
name = "b"
mass = 2
position = ["x", "y"]
[[unilateral]]
name = "floor"
gap = "y"
restitution = 0.8
[forces]
x = "n - x"
[[event]]
name = "half"
when = "y - 0.5"
set = { n = "n + 1" }
rates = { x = "x' + 0.1*n" }
)toml"),
               2.3);
}

TEST_CASE(
    "fmu: the scenes of modes run as units where these follow them, and are refused with the reason elsewhere") {
    for (const char* const name : {"sampled_hold", "freewheel", "ratchet", "slack_rope", "pick_and_drop"}) {
        INFO(name);
        check_unit(source_path(fmt::format("scenes/modes/{}.toml", name)), 1.17, 1e-6);
    }
    const auto refused = run({"fmu", source_path("scenes/modes/clutch.toml"), "-o", file_name("clutch.fmu")});
    CHECK(refused.exit == 3);
    CHECK(refused.err.find("dry friction") != std::string::npos);
    const std::string moved =
        "gravity = [0, -9.81]\n[coordinates]\ny = 0\n[states]\nz = {}\n[[particle]]\nname = \"b\"\n"
        "mass = 2\nposition = [0, \"y\"]\n[[unilateral]]\nname = \"floor\"\ngap = \"y - z\"\n"
        "[[event]]\nname = \"drop\"\nwhen = \"t - 1\"\nset = { z = -0.5 }\n";
    const auto moves = run({"fmu", temporary("moved.toml", moved), "-o", file_name("moved.fmu")});
    CHECK(moves.exit == 3);
    CHECK(moves.err.find("event 'drop' sets a state that moves constraint 'floor'") != std::string::npos);
}

}  // namespace fmu_modes
