// SPDX-License-Identifier: MIT
// Events that look at forces of constraints, where these jump along the motion.
#include <doctest/doctest.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "contacts.hpp"

namespace commands_force_jumps {

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

}  // namespace

// A bead on a wire, x = sin(w t)/w: it passes a at asin(w a)/w + k times the period, and on the way back, and the
// force of the wire jumps from 2.5 to −3.5 and back. So it does where another event of the same instant acts.
TEST_CASE("rounds: a force that a sign takes through zero is looked at on the side on which the motion goes on") {
    for (const double w : {2.7, 3.1, 2.2})
        for (const double a : {0.3, -0.2, 0.11})
            for (const bool with_another : {false, true}) {
                CAPTURE(w);
                CAPTURE(a);
                CAPTURE(with_another);
                std::string scene = fmt::format(R"toml(
[coordinates]
x = {{ initial = 0, rate = 1 }}
y = {{ initial = 0 }}
[states]
n = {{}}
k = {{}}
[[particle]]
name = "p"
mass = 1
position = ["x", "y"]
[[constraint]]
name = "wire"
holonomic = "y"
[forces]
x = "-{}^2*x"
y = "3*sign(x - {}) + 0.5"
[simulation]
duration = 6
tolerance = 1e-11
[[event]]
name = "flip"
when = "lambda_wire"
set = {{ n = "n + 1" }}
)toml",
                                                w, a);
                if (with_another)
                    scene += fmt::format(
                        "[[event]]\nname = \"there\"\nwhen = \"x - {}\"\nset = {{ k = \"k + 1\" }}\n", a);
                const Json motion = simulated(temporary("wire.toml", scene));
                const double pi = 3.14159265358979323846, first = std::asin(w * a), period = 2 * pi;
                std::vector<double> expected;
                for (const double phase : {first < 0 ? first + period : first, pi - first})
                    for (double at = phase; at < 6 * w; at += period) expected.push_back(at / w);
                std::sort(expected.begin(), expected.end());
                const std::vector<double> found = times(motion, "flip");
                REQUIRE(found.size() == expected.size());
                for (std::size_t i = 0; i < found.size(); ++i) CHECK(std::abs(found[i] - expected[i]) < 1e-9);
                CHECK(state(motion, "n") == expected.size());
                if (with_another) CHECK(state(motion, "k") == expected.size());
            }
}

// By DOP853 and brentq of scipy 1.14 with 1e-13: the force jumps to −1.27 at the knot 0.3, comes back through
// zero, jumps from 5.26 to −43 at 0.6, and comes back again.
TEST_CASE("rounds: a force passes zero by jumps at the knots of a track, and by itself between them") {
    const Json motion = simulated(temporary("track.toml", R"toml(
gravity = [0, -9.81]
[tables]
h = { arguments = ["x"], interpolation = "pchip", outside = "hold", points = [
    [-5,0], [0,0], [0.3,-0.1], [0.6,-0.35], [1,-1], [5,-1]] }
[coordinates]
x = { initial = -1, rate = 1.5 }
y = { guess = 0, rate_guess = 0 }
[states]
n = {}
[[particle]]
name = "p"
mass = 2
position = ["x", "y"]
[[constraint]]
name = "track"
holonomic = "y = h(x)"
[[event]]
name = "off"
when = "lambda_track"
set = { n = "n + 1" }
[simulation]
duration = 2.5
tolerance = 1e-12
)toml"));
    const std::vector<double> found = times(motion, "off"), expected = {0.853012, 0.869808, 1.010199, 1.079234};
    REQUIRE(found.size() == expected.size());
    for (std::size_t i = 0; i < found.size(); ++i) CHECK(std::abs(found[i] - expected[i]) < 1e-6);
    CHECK(state(motion, "n") == 4);
}

// At the bottom the rod bears mg + m v²/l, and from there what the state adds: past 30 N with k = 1. The force
// turns on another side than that on which it was before.
TEST_CASE("rounds: a state that is set moves the argument of a sign, a bend or a knot, and forces jump by it") {
    const auto scene = [](const std::string& load) {
        return temporary("set.toml", fmt::format(R"toml(
gravity = [0, -9.81]
[tables]
ramp = {{ arguments = ["k"], outside = "hold", points = [[0, 0], [0.5, 0], [1, 1]] }}
[coordinates]
x = {{ initial = 0.5 }}
y = {{ guess = -1 }}
[states]
k = {{}}
hits = {{}}
back = {{}}
[[particle]]
name = "bob"
mass = 2
position = ["x", "y"]
[[constraint]]
name = "rod"
holonomic = "sqrt(x^2 + y^2) = 1.1"
[[force]]
at = "bob"
vector = [0, "{}"]
[[event]]
name = "set"
when = "x"
direction = "down"
set = {{ k = 1 }}
[[event]]
name = "hard"
when = "-lambda_rod - 30"
direction = "up"
set = {{ hits = "hits + 1" }}
record = ["lambda_rod", "k"]
[[event]]
name = "unset"
when = "hits - 0.5"
set = {{ k = 0, back = "back + 1" }}
[[event]]
name = "soft"
when = "-lambda_rod - 29"
direction = "down"
set = {{ hits = "hits + 0.125" }}
[simulation]
duration = 0.8
tolerance = 1e-11
)toml",
                                                 load));
    };
    for (const char* const load :
         {"-12*k", "-12*k*sign(k - 0.5)", "-12*k*max(0, k)", "-12*min(k, 0.75) - 3*k", "-12*ramp(k)", "-12*abs(k)",
          "-6*abs(k - 0.5) - 12*k + 3", "-6 - 6*sign(k - 0.5)"})
        for (const char* const method : {"auto", "dop853", "radau"}) {
            CAPTURE(load);
            CAPTURE(method);
            const std::string file = scene(load);
            const Json motion = simulated(file, {"--method", method});
            CHECK(state(motion, "hits") == 1.125);
            CHECK(state(motion, "back") == 1);
            CHECK(state(motion, "k") == 0);
            REQUIRE(times(motion, "hard").size() == 1);
            CHECK(times(motion, "hard") == times(motion, "set"));
            CHECK(times(motion, "soft") == times(motion, "set"));
        }
}

// x goes from 0.5 towards 0, where k becomes 1; x + 0.3 sign(k − 1/2) is zero before, there and after it.
TEST_CASE("rounds: events whose signs, bends or knots a set state moves past zero happen at that instant") {
    struct Moved {
        const char* when;
        double times;
    };
    for (const Moved& one :
         {Moved{"max(0, k - 0.2) - 0.5", 1}, Moved{"abs(k - 2) - 1.5", 1}, Moved{"ramp(k) - 0.5", 1},
          Moved{"min(k, 0.4) - 0.3", 1}, Moved{"sign(k - 0.3) + 0.5", 1}, Moved{"x + 0.3*sign(k - 0.5)", 3},
          Moved{"max(0, k - 0.2) - 0.9", 0}, Moved{"abs(k - 0.4) - 0.7", 0}}) {
        CAPTURE(one.when);
        const std::string scene = temporary("moved.toml", fmt::format(R"toml(
[parameters]
m = 2
[tables]
ramp = {{ arguments = ["k"], outside = "hold", points = [[0, 0], [0.5, 0], [1, 1]] }}
[coordinates]
x = {{ initial = 0.5, rate = -1 }}
[states]
k = {{}}
n = {{}}
[[particle]]
name = "bob"
mass = "m"
position = ["x", 0]
[[event]]
name = "set"
when = "x"
set = {{ k = 1 }}
[[event]]
name = "moved"
when = "{}"
set = {{ n = "n + 1" }}
[simulation]
duration = 1
)toml",
                                                                      one.when));
        const Json motion = simulated(scene);
        CHECK(state(motion, "n") == one.times);
        const std::vector<double> found = times(motion, "moved");
        if (one.times > 0) CHECK(std::count(found.begin(), found.end(), times(motion, "set")[0]) == 1);
        const Json rows = swept({scene, "--vary", "m=2:2:1"});
        CHECK(rows["failed"] == 0);
        CHECK_MESSAGE(number(rows["rows"][0]["final"], "states", "n") == one.times, rows.dump());
    }
}

}  // namespace commands_force_jumps
