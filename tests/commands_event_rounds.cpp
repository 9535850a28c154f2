// SPDX-License-Identifier: MIT
// Events that make others happen at the same instant: by the states that they set, and by forces that jump.
#include <doctest/doctest.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "contacts.hpp"
#include "edits.hpp"

namespace commands_event_rounds {

using namespace alembert::test;

namespace {

double state(const Json& motion, const std::string& name) {
    return motion["final"]["states"][name].get<double>();
}

/// The times of an event.
std::vector<double> times(const Json& motion, const std::string& name) {
    std::vector<double> result;
    for (const Json& event : motion["events"])
        if (event["name"] == name) result.push_back(event["time"].get<double>());
    return result;
}

/// A mass of 2 on a floor whose height z and lifting force F are states.
std::string on_floor(const std::string& events, double restitution = 0.5, double y = 0,
                     const std::string& rate_of_F = "0") {
    return temporary("on_floor.toml", fmt::format(R"toml(
gravity = [0, -9.81]
[coordinates]
y = {}
[states]
z = {{}}
F = {{ rate = "{}" }}
k = {{}}
[[particle]]
name = "b"
mass = 2
position = [0, "y"]
[forces]
y = "F"
[[unilateral]]
name = "floor"
gap = "y - z"
restitution = {}
{}
[simulation]
duration = 1.4
tolerance = 1e-12
)toml",
                                                  y, rate_of_F, restitution, events));
}

/// A particle on a line from −1 with the speed 2, so that it is at 0 at t = 0.5.
std::string on_line(const std::string& events, const std::string& more = "") {
    return temporary("on_line.toml", fmt::format(R"toml(
[coordinates]
x = {{ initial = -1, rate = 2 }}
[states]
n = {{}}
[energy]
kinetic = "x'^2/2"
{}
{}
[simulation]
duration = 2
tolerance = 1e-12
)toml",
                                                 more, events));
}

}  // namespace

// The force of the floor is m g = 19.62 until the floor drops at t = 1, and none from then on.
TEST_CASE("rounds: a force that a set state takes past a value sets off the events that look at it") {
    const std::string drop = "[[event]]\nname = \"drop\"\nwhen = \"t - 1\"\nset = { z = -0.5 }\n";
    const std::string look =
        "[[event]]\nname = \"unloaded\"\nwhen = \"lambda_floor - 5\"\nset = { k = \"k + 1\" }\n"
        "record = [\"lambda_floor\", \"z\"]\n";
    for (const char* const direction : {"", "direction = \"down\"\n"}) {
        const Json motion = simulated(on_floor(drop + look + direction));
        REQUIRE(times(motion, "unloaded").size() == 1);
        CHECK(std::abs(times(motion, "unloaded")[0] - 1) < 1e-12);
        CHECK(state(motion, "k") == 1);
        const Json& told = motion["events"].back()["record"];
        CHECK(told["z"] == -0.5);  // what the first round has left
        CHECK(told["lambda_floor"] == 0);
        CHECK(std::abs(of_kind(motion, "impact")[0]["time"].get<double>() - 1 - std::sqrt(1 / 9.81)) < 1e-11);
    }
    CHECK(times(simulated(on_floor(drop + look + "direction = \"up\"\n")), "unloaded").empty());
    const std::string none = edited(look, {{"lambda_floor - 5", "lambda_floor"}});
    const Json motion = simulated(on_floor(drop + none));
    REQUIRE(times(motion, "unloaded").size() == 1);
    CHECK(std::abs(times(motion, "unloaded")[0] - 1) < 1e-12);
}

// Lifted with 30 the floor would have to pull with 10.38; but the contact opens, and its force is 0, above −5.
TEST_CASE("rounds: a force counts that acts after the contact has opened, not the one that would hold it") {
    const std::string lift = "[[event]]\nname = \"lift\"\nwhen = \"t - 1\"\nset = { F = 30 }\n";
    const auto look = [](const char* const value) {
        return fmt::format("[[event]]\nname = \"look\"\nwhen = \"lambda_floor {}\"\nset = {{ k = \"k + 1\" }}\n",
                           value);
    };
    CHECK(times(simulated(on_floor(lift + look("+ 5"))), "look").empty());
    CHECK(times(simulated(on_floor(lift + look("- 5"))), "look").size() == 1);
}

// From the height 0.5 it falls for √(1/g) and stays, and the force jumps from 0 to 19.62. A force that grows by 20
// a second takes it off after 0.981 s.
TEST_CASE("rounds: the force of a contact that closes passes a value at once, and of one that opens slowly once") {
    const std::string look =
        "[[event]]\nname = \"loaded\"\nwhen = \"lambda_floor - 5\"\nset = { k = \"k + 1\" }\n"
        "[[event]]\nname = \"none\"\nwhen = \"lambda_floor\"\nset = { k = \"k + 10\" }\n";
    const Json landed = simulated(on_floor(look, 0, 0.5));
    REQUIRE(times(landed, "loaded").size() == 1);
    CHECK(std::abs(times(landed, "loaded")[0] - std::sqrt(1 / 9.81)) < 1e-11);
    CHECK(state(landed, "k") == 1);
    const Json lifted = simulated(on_floor(look, 0, 0, "20"));
    REQUIRE(times(lifted, "loaded").size() == 1);
    CHECK(std::abs(times(lifted, "loaded")[0] - (19.62 - 5) / 20) < 1e-10);
    REQUIRE(times(lifted, "none").size() == 1);
    CHECK(std::abs(times(lifted, "none")[0] - 19.62 / 20) < 1e-9);
    CHECK(state(lifted, "k") == 11);
}

TEST_CASE("rounds: a rope that breaks at a force breaks where it pulls tight with more") {
    // From the height 0.5 to the end of the rope, where it would carry 19.62: it breaks at 10 and not at 30.
    for (const double strength : {10.0, 30.0}) {
        const std::string scene = temporary("rope.toml", fmt::format(R"toml(
gravity = [0, -9.81]
[coordinates]
y = 0
[states]
whole = {{ initial = 1 }}
[[particle]]
name = "b"
mass = 2
position = [0, "y"]
[[unilateral]]
name = "rope"
gap = "y + 0.5 + 10*(1 - whole)"
restitution = 0
[[event]]
name = "breaks"
when = "lambda_rope - {}"
direction = "up"
set = {{ whole = 0 }}
[simulation]
duration = 1
tolerance = 1e-12
)toml",
                                                                     strength));
        const Json motion = simulated(scene);
        const double t = std::sqrt(1 / 9.81);
        CHECK(times(motion, "breaks").size() == (strength < 19.62 ? 1 : 0));
        const double end = strength < 19.62 ? -0.5 - 9.81 * (1 - t) * (1 - t) / 2 : -0.5;
        CHECK(std::abs(coordinate(motion, "y") - end) < 1e-10);  // all speed is lost where it pulls tight
    }
}

// While it slides, the rod brakes the mass of 2 with 2 N; where it sticks, at t = 1 and x = 0.5, with nothing.
TEST_CASE(
    "rounds: the force of a constraint passes a value at once where friction begins to stick or slides the other "
    "way") {
    const auto scene = [](const std::string& event) {
        return temporary("braked.toml", R"toml(
[coordinates]
x = { initial = 0, rate = 1 }
y = { initial = 0, rate = 1 }
[states]
k = {}
[energy]
kinetic = "x'^2/2 + y'^2"
[[constraint]]
name = "rod"
holonomic = "y - x"
[[friction]]
name = "ground"
coefficient = 0.3
slip = "x'"
normal = 10
[[event]]
name = "relaxed"
when = "lambda_rod + 1"
)toml" + event + "\n[simulation]\nduration = 2.5\ntolerance = 1e-12\n");
    };
    for (const char* const event : {"set = { k = \"k + 1\" }", "record = [\"x\"]", "stop = true",
                                    "direction = \"up\"", "count = 1", "rates = { x = 1, y = 1 }"}) {
        INFO(event);
        const Json motion = simulated(scene(event));
        const std::vector<double> found = times(motion, "relaxed");
        REQUIRE(found.size() >= 1);
        CHECK(std::abs(found[0] - 1) < 1e-9);
        const std::string what = event;
        CHECK(found.size() == (what[0] == 'r' && what[1] == 'a' ? 2 : 1));  // pushed on, it stops at t = 2 again
        CHECK(state(motion, "k") == (what[0] == 's' && what[1] == 'e' ? 1 : 0));
        CHECK((motion["final"]["time"].get<double>() < 1.5) == (what == "stop = true" || what == "count = 1"));
    }
    CHECK(times(simulated(scene("direction = \"down\"")), "relaxed").empty());
}

// Two events with one `when` hold each other back at its zero: the motion would slide along it.
TEST_CASE("rounds: events that turn each other back without end are told, and a mode that may pass is not") {
    const auto scene = [](const char* const force) {
        return temporary("relay.toml", fmt::format(R"toml(
[coordinates]
x = 0.1
[states]
s = {{ initial = 1 }}
[energy]
kinetic = "x'^2/2"
[forces]
x = "{}"
[[event]]
name = "down"
when = "x + 0.1*x'"
direction = "down"
set = {{ s = -1 }}
[[event]]
name = "up"
when = "x + 0.1*x'"
direction = "up"
set = {{ s = 1 }}
[simulation]
duration = 3
)toml",
                                                   force));
    };
    const Run endless = run({"simulate", scene("-s - 0.1*x'")});
    CHECK(endless.exit == 4);
    CHECK(endless.err.find("turn its value back and forth at its zero without end") != std::string::npos);
    CHECK(run({"simulate", scene("-4*x + 0.01*s")}).exit == 0);
}

TEST_CASE("rounds: rates that an event of a second round sets act on those of the first") {
    const auto scene = [](const std::string& first, const std::string& second) {
        return on_line(
            fmt::format("[[event]]\nname = \"a\"\nwhen = \"x\"\nset = {{ n = 1 }}\n{}\n"
                        "[[event]]\nname = \"b\"\nwhen = \"n - 0.5\"\n{}\n",
                        first, second));
    };
    struct Case {
        const char *first, *second;
        double end;  // x' after both
        double gain_a, gain_b;
    };
    for (const Case& of :
         {Case{"rates = { x = 0.5 }", "rates = { x = 0.5 }", 0.5, (0.25 - 4) / 2, 0},
          Case{"rates = { x = 0.5 }", "rates = { x = 3 }", 3, (0.25 - 4) / 2, (9 - 0.25) / 2},
          Case{"rates = { x = 0.5 }", "rates = { x = \"2*x' + n\" }", 2, (0.25 - 4) / 2, (4 - 0.25) / 2},
          Case{"impulses = { x = 1 }", "rates = { x = \"x'/2\" }", 1.5, (9. - 4) / 2, (2.25 - 9) / 2},
          Case{"rates = { x = \"-x'\" }", "impulses = { x = \"x'\" }", -4, 0, (16. - 4) / 2},
          Case{"", "impulses = { x = \"n - x'\" }", 1, 0, (1. - 4) / 2}}) {
        INFO(of.first, " then ", of.second);
        const Json motion = simulated(scene(of.first, of.second));
        CHECK(std::abs(rate(motion, "x") - of.end) < 1e-13);
        CHECK(std::abs(coordinate(motion, "x") - 1.5 * of.end) < 1e-12);
        REQUIRE(motion["events"].size() == 2);
        if (*of.first != '\0') CHECK(std::abs(motion["events"][0].value("energy_gain", 0.0) - of.gain_a) < 1e-12);
        CHECK(std::abs(motion["events"][1]["energy_gain"].get<double>() - of.gain_b) < 1e-12);
        CHECK(motion["work_balance"].get<double>() < 1e-12);
    }
}

// T = x'²/2 + y'² + x'y'/2, so that an impulse along one coordinate changes both rates; those that are set are
// reached.
TEST_CASE(
    "rounds: rates of coupled coordinates are those that each round sets, and a third round follows the second") {
    const std::string scene = temporary("coupled.toml", R"toml(
[coordinates]
x = { initial = -1, rate = 2 }
y = { initial = 0, rate = 0.3 }
[states]
n = {}
m = {}
[energy]
kinetic = "x'^2/2 + y'^2 + x'*y'/2"
[[event]]
name = "a"
when = "x"
set = { n = 1 }
rates = { x = 0.5 }
[[event]]
name = "b"
when = "n - 0.5"
set = { m = 2 }
rates = { y = "x' + n" }
[[event]]
name = "c"
when = "m - 0.5"
rates = { x = "y'", y = "m*x'" }
[simulation]
duration = 2
tolerance = 1e-12
)toml");
    const Json motion = simulated(scene);
    CHECK(std::abs(rate(motion, "x") - 1.5) < 1e-12);
    CHECK(std::abs(rate(motion, "y") - 1.0) < 1e-12);
    CHECK(motion["events"].size() == 3);
    CHECK(motion["work_balance"].get<double>() < 1e-12);
}

TEST_CASE("rounds: an event that a later round takes the other way happens in its direction") {
    const std::string scene = on_line(R"toml(
[[event]]
name = "tick"
when = "x"
set = { n = 3 }
[[event]]
name = "reset"
when = "n - 2.5"
set = { n = 0 }
[[event]]
name = "fallen"
when = "n - 1.5"
direction = "down"
[[event]]
name = "grown"
when = "n - 1.5"
direction = "up"
)toml");
    const Json motion = simulated(scene);
    CHECK(times(motion, "fallen").size() == 1);
    CHECK(times(motion, "grown").size() == 1);
    CHECK(motion["events"].size() == 4);
}

TEST_CASE("rounds: what events set must have an energy, equations and constraints with a value") {
    const auto refusal = [](const std::string& scene) {
        const Run result = run({"simulate", scene});
        CHECK(result.exit == 4);
        return result.err;
    };
    const std::string flip = "[[event]]\nname = \"flip\"\nwhen = \"x\"\nset = { n = \"-n - 1\" }\n";
    const std::string energy = refusal(on_line(flip, "potential = \"sqrt(n + 0.5)*x^2/2\""));
    CHECK(energy.find("event 'flip' sets n to -n - 1 = -1, and the energy is no finite real number") !=
          std::string::npos);
    const std::string force = refusal(on_line(flip, "[forces]\nx = \"log(n + 0.5)\""));
    CHECK(force.find(
              "event 'flip' sets n to -n - 1 = -1, and the equation of motion of x has no finite real value") !=
          std::string::npos);
    const std::string row = refusal(temporary("row.toml", R"toml(
[coordinates]
x = { initial = -1, rate = 2 }
y = { guess = 0, rate_guess = 0 }
[states]
n = {}
[tables]
shape = { arguments = ["s"], points = [[0, 0], [1, 0]] }
[energy]
kinetic = "x'^2/2 + y'^2/2"
[[constraint]]
name = "slot"
holonomic = "y = x*shape(n)"
[[event]]
name = "flip"
when = "x + 0.5"
set = { n = 2 }
)toml"));
    CHECK(row.find("event 'flip' sets n to 2, and constraint 'slot' has no finite real value") !=
          std::string::npos);
}

// (n + 1)·2 + 1 is the same in the opposite order, and 2 n + 1 + 1 is not.
TEST_CASE("rounds: three events that set one state are refused where any order gives another value") {
    const auto scene = [](const char* const third) {
        return on_line(
            fmt::format("[[event]]\nname = \"a\"\nwhen = \"x\"\nset = {{ n = \"n + 1\" }}\n"
                        "[[event]]\nname = \"b\"\nwhen = \"x\"\nset = {{ n = \"{}\" }}\n"
                        "[[event]]\nname = \"c\"\nwhen = \"x\"\nset = {{ n = \"n + 1\" }}\n",
                        third));
    };
    const Run refused = run({"simulate", scene("2*n")});
    CHECK(refused.exit == 4);
    CHECK(refused.err.find("the events 'a', 'b', 'c' set n at t = 0.5, which makes it 3 in this order and") !=
          std::string::npos);
    CHECK(state(simulated(scene("n + 5")), "n") == 7);
}

TEST_CASE("rounds: the energy of a run and of a sweep is kept through counters, and not through what changes it") {
    const std::string counter = "[[event]]\nname = \"tick\"\nwhen = \"x\"\nset = { n = \"n + 1\" }\n";
    const auto columns = [](const std::string& scene) {
        const std::string out = run({"sweep", scene, "--vary", "x=-1:-0.5:2"}).out;
        return out.substr(0, out.find('\n'));
    };
    const std::string kept = on_line(counter, "potential = \"x^2/2\"");
    CHECK(simulated(kept).contains("energy_drift"));
    CHECK(columns(kept).find("energy_drift") != std::string::npos);
    const std::string changed = on_line(counter, "potential = \"(1 + n)*x^2/2 + n\"");
    CHECK(simulated(changed).contains("work_balance"));
    CHECK(columns(changed).find("work_balance") != std::string::npos);
    const std::string kicked = on_line("[[event]]\nname = \"tick\"\nwhen = \"x\"\nrates = { x = \"x'/2\" }\n");
    CHECK(columns(kicked).find("work_balance") != std::string::npos);
}

TEST_CASE("rounds: at a state where an event is zero nothing is judged by one side of it") {
    const auto scene = [](const std::string& what) {
        return temporary("mode.toml", fmt::format(R"toml(
[coordinates]
x = 0
[states]
k = {{ initial = 1 }}
n = {{}}
[energy]
kinetic = "x'^2/2"
potential = "k*x^2/2"
[[event]]
name = "switch"
when = "x"
{}
)toml",
                                                  what));
    };
    for (const char* const what : {"set = { k = -1 }", "rates = { x = \"2*x'\" }", "impulses = { x = 1 }"}) {
        INFO(what);
        const Run judged = run({"stability", scene(what)});
        CHECK(judged.exit != 0);
        CHECK(judged.err.find("event 'switch' is at its zero here") != std::string::npos);
        const Run found = run({"equilibrium", scene(what)});
        CHECK(found.out.find("stable: undecided (event 'switch' is at its zero here") != std::string::npos);
    }
    // An event of time needs no disturbance; one that a disturbance sets off at the same state is told first.
    const std::string of_time =
        edited(contents(scene("set = { k = -1 }")), {{"when = \"x\"", "when = \"sin(pi*t)\""}});
    CHECK(run({"stability", temporary("of_time.toml", of_time)})
              .err.find("event 'switch' happens at this time, t = 0") != std::string::npos);
    const std::string both = of_time + "[[event]]\nname = \"push\"\nwhen = \"x\"\nimpulses = { x = 1 }\n";
    CHECK(run({"stability", temporary("both.toml", both)}).err.find("event 'push' is at its zero here") !=
          std::string::npos);
    // A counter changes nothing, and an event elsewhere is not set off; the mode is told.
    const Run counted = run({"stability", scene("set = { n = \"n + 1\" }")});
    CHECK(counted.exit == 0);
    CHECK(counted.err.find("of the equations between them, with n = 0") != std::string::npos);
    const std::string away = edited(contents(scene("set = { k = -1 }")), {{"when = \"x\"", "when = \"x - 1\""}});
    const Run beside = run({"stability", temporary("away.toml", away)});
    CHECK(beside.out.find("stable:") == 0);
    CHECK(beside.err.find("with k = 1") != std::string::npos);
}

}  // namespace commands_event_rounds
