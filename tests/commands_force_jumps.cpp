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

}  // namespace commands_force_jumps
