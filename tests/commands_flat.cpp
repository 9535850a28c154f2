// SPDX-License-Identifier: MIT
// A linkage passes a pose in which its constraints lose rank (inline_slider.hpp), beside a block C of mass 1 that
// is independent of it and has a closed form.
#include <doctest/doctest.h>

#include <cmath>
#include <string>

#include "contacts.hpp"
#include "files.hpp"
#include "inline_slider.hpp"

namespace commands_flat {

using namespace alembert::test;

namespace {

/// The position and speed of C after one second, with its initial rate, and with what acts on it.
Json motion_beside_linkage(const std::string& rate, const std::string& acts, const char* method) {
    const std::string scene =
        temporary("flat_beside.toml", "gravity = [0, -9.81]\n" +
                                          inline_slider("xc = { initial = 0, rate = " + rate + " }\nyc = 0\n") +
                                          R"toml(
[[particle]]
name = "C"
mass = 1
position = ["xc", "yc"]
[[constraint]]
name = "floor"
holonomic = "yc = 0"
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
