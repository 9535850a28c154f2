// SPDX-License-Identifier: MIT
// Motions that begin at knots of tables, or rest there, and events that bend at their zeros. What is right is of
// DOP853 of scipy 1.14 with 1e-13, piece by piece, or closed.
#include <doctest/doctest.h>

#include <fmt/format.h>

#include <cmath>

#include "contacts.hpp"

namespace commands_at_knots {

using namespace alembert::test;

namespace {

const char* const methods[] = {"auto", "dop853", "radau", "bdf"};

double allowed(const std::string& method) {
    return method == "bdf" ? 1e-7 : 1e-9;
}

std::vector<double> times(const Json& motion, const std::string& name) {
    std::vector<double> result;
    for (const Json& event : motion["events"])
        if (event["name"] == name) result.push_back(event["time"].get<double>());
    return result;
}

}  // namespace

TEST_CASE("knots: what begins at rest at knots of tables goes to the side to which forces take it later") {
    // A table of two arguments, at knots of both.
    const std::string pushed = temporary("pushed.toml", R"toml(
[coordinates]
phi = 0
[tables]
load = { arguments = ["phi", "w"], units = ["deg", "rad/s"], period = [360, 0], outside = "hold", points = [
    [0,-20,-0.5],[0,0,0],[0,20,0.3],[120,-20,-0.6],[120,0,0.1],[120,20,0.5],[360,-20,-0.5],[360,0,0],[360,20,0.3]] }
[[particle]]
name = "P"
mass = 1
position = ["phi", 0]
[forces]
phi = "sin(3*t) - load(phi, phi')"
[simulation]
duration = 2
tolerance = 1e-11
)toml");
    // A ratchet: five functions are zero at the start, and one of them, the pawl's moment, stays so.
    const std::string ratchet = temporary("ratchet.toml", R"toml(
[parameters]
p = { value = 30, unit = "deg" }
[tables]
drive = { arguments = ["t"], units = ["ms"], period = 400, points = [
    [0, 0], [40, 1.6], [120, 1.2], [150, -0.6], [300, -0.6], [340, 0]] }
load = { arguments = ["phi", "w"], units = ["deg", "rad/s"], period = [360, 0], outside = "hold", points = [
    [0,-20,-0.5],[0,0,0],[0,20,0.3],[120,-20,-0.6],[120,0,0.1],[120,20,0.5],[250,-20,-0.3],[250,0,0.05],[250,20,0.6],
    [360,-20,-0.5],[360,0,0],[360,20,0.3]] }
pawl = { arguments = ["back"], units = ["deg"], outside = "line", points = [[-4, 4], [-1, 0.5], [0, 0], [30, 0]] }
[coordinates]
phi = 0
[states]
n = {}
W = { rate = "drive(t)*phi'" }
[energy]
kinetic = "0.025*phi'^2"
[forces]
phi = "drive(t) - load(phi, phi') + max(0, pawl(phi - n*p)) - 0.05*phi'"
[[event]]
name = "tooth"
when = "phi - (n + 1)*p"
direction = "up"
set = { n = "n + 1" }
[simulation]
duration = 3
tolerance = 1e-12
)toml");
    for (const std::string method : methods) {
        CAPTURE(method);
        const Json there = simulated(pushed, {"--method", method})["final"];
        CHECK(std::abs(number(there, "coordinates", "phi") - 0.670212556131) < allowed(method));
        CHECK(std::abs(number(there, "rates", "phi") - (-0.028457797593)) < allowed(method));
        const Json turned = simulated(ratchet, {"--method", method})["final"];
        CHECK(number(turned, "states", "n") == 5);
        CHECK(std::abs(number(turned, "coordinates", "phi") - 3.0297870549729184) < allowed(method));
        CHECK(std::abs(number(turned, "states", "W") - 0.6388969574447003) < allowed(method));
    }
}

TEST_CASE("knots: a mass at rest stays at a bend of a force that is zero there") {
    const Json motion = simulated(temporary("rest.toml", R"toml(
[tables]
f = { arguments = ["x"], outside = "line", points = [[-1, 3], [0, 0], [1, -5]] }
g = { arguments = ["x", "v"], outside = "hold", points = [[-1,-1,2],[-1,0,0],[-1,1,-1],[0,-1,1],[0,0,0],[0,1,-2],
    [1,-1,1],[1,0,0],[1,1,-1]] }
[coordinates]
x = 0
y = { initial = 0.5 }
[[particle]]
name = "P"
mass = 1
position = ["x", "y"]
[forces]
x = "f(x) + g(x, x') + max(0, x) - 2*abs(x')*x'"
y = "-4*y"
[simulation]
duration = 3
)toml"));
    CHECK(coordinate(motion, "x") == 0);
    CHECK(std::abs(coordinate(motion, "y") - 0.5 * std::cos(6.0)) < 1e-8);
}

TEST_CASE("knots: an event that bends at its zero happens once there") {
    for (const std::string method : methods)
        for (const char* const when : {"abs(x - 0.5) - (x - 0.5)/2", "abs(x - 0.5) + (x - 0.5)/2",
                                       "max(x - 0.5, 3*(0.5 - x))", "2*abs(x - 0.5)", "h(x)", "h(x)*(1 + x)"}) {
            CAPTURE(method);
            CAPTURE(when);
            const Json motion = simulated(temporary("bend.toml", fmt::format(R"toml(
[tables]
h = {{ arguments = ["x"], outside = "line", points = [[0, 1.5], [0.5, 0], [1, 0.25]] }}
[coordinates]
x = {{ initial = 0, rate = 1 }}
[states]
n = {{}}
z = {{}}
[[particle]]
name = "P"
mass = 1
position = ["x", 0]
[forces]
x = "z"
[[event]]
name = "e"
when = "{}"
set = {{ n = "n + 1", z = 1 }}
[simulation]
duration = 2
tolerance = 1e-11
)toml",
                                                                             when)),
                                          {"--method", method});
            REQUIRE(times(motion, "e").size() == 1);
            CHECK(std::abs(times(motion, "e")[0] - 0.5) < 1e-9);
            CHECK(number(motion["final"], "states", "n") == 1);
            CHECK(std::abs(coordinate(motion, "x") - (0.5 + 1.5 + 1.5 * 1.5 / 2)) < allowed(method));
        }
}

}  // namespace commands_at_knots
