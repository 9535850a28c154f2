// SPDX-License-Identifier: MIT
// Linkages that pass a pose in which their constraints lose rank, beside a block C of mass 1 that is independent
// of them and has a closed form. The crank A and the rod AB have length 1, and B slides along y = 0: with B at the
// pivot the rows of the crank, the rod and the guide depend on each other.
#include <doctest/doctest.h>

#include <cmath>
#include <string>

#include "contacts.hpp"
#include "files.hpp"

namespace commands_flat {

using namespace alembert::test;

namespace {

/// The position and speed of C after one second, with its initial rate, and with what acts on it.
Json motion_beside_linkage(const std::string& rate, const std::string& acts, const char* method) {
    const std::string scene = temporary("flat_beside.toml", R"toml(
gravity = [0, -9.81]
[coordinates]
xa = { guess = 0.5, rate_guess = -0.87 }
ya = { guess = 0.87, rate_guess = 0.5 }
xb = { initial = 1, rate = -1.7 }
yb = { guess = 0, rate_guess = 0 }
xc = { initial = 0, rate = )toml" + rate + R"toml( }
yc = 0
[[particle]]
name = "A"
mass = 1
position = ["xa", "ya"]
[[particle]]
name = "B"
mass = 1
position = ["xb", "yb"]
[[particle]]
name = "C"
mass = 1
position = ["xc", "yc"]
[[constraint]]
name = "crank"
holonomic = "xa^2 + ya^2 = 1"
[[constraint]]
name = "guide"
holonomic = "yb = 0"
[[constraint]]
name = "rod"
holonomic = "(xa - xb)^2 + (ya - yb)^2 = 1"
[[constraint]]
name = "floor"
holonomic = "yc = 0"
[simulation]
duration = 1
)toml" + acts);
    return json_of({"simulate", scene, "--method", method, "--tolerance", "1e-11"});
}

void check_block(const Json& motion, double position, double speed) {
    CHECK(coordinate(motion, "xb") < -0.1);  // beyond the pivot
    // A hundred tolerances. A force that were wrong near the pose, for some 7 ms, would change the end by 1e-3.
    CHECK(std::abs(coordinate(motion, "xc") - position) < 1e-9);
    CHECK(std::abs(motion["final"]["rates"]["xc"].get<double>() - speed) < 1e-9);
}

const std::string friction = R"toml(
[[friction]]
name = "drag"
coefficient = 0.2
slip = "xc'"
on = "floor"
)toml";

}  // namespace

TEST_CASE("flat: a force with a sign keeps its sign where a linkage passes a singular pose") {
    for (const char* const method : {"verner98", "dop853"}) {
        CAPTURE(method);
        check_block(motion_beside_linkage("-3", "[forces]\nxc = \"-2*sign(xc')\"\n", method), -2, -1);
        check_block(motion_beside_linkage("3", "[forces]\nxc = \"-2*sign(xc')\"\n", method), 2, 1);
    }
}

TEST_CASE("flat: friction on a reaction acts on where a linkage passes a singular pose") {
    for (const char* const method : {"verner98", "dop853"}) {
        CAPTURE(method);
        for (const double sign : {1.0, -1.0})
            check_block(motion_beside_linkage(sign > 0 ? "3" : "-3", friction, method), sign * (3 - 0.1 * g),
                        sign * (3 - 0.2 * g));
    }
}

TEST_CASE("flat: what sticks beside a linkage that passes a singular pose stays where it is") {
    for (const char* const method : {"verner98", "dop853"}) {
        CAPTURE(method);
        check_block(motion_beside_linkage("0", friction + "[forces]\nxc = 1\n", method), 0, 0);
    }
}

}  // namespace commands_flat
