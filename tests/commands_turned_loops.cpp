// SPDX-License-Identifier: MIT
// Joints that close loops hold their axes together: from any guess the bodies end in the pose in which the axes
// coincide, which is known by hand, and a start in which they are turned is refused. Loops whose numbers are
// rounded move as those with exact ones.
#include <doctest/doctest.h>
#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "json.hpp"
#include "program.hpp"

namespace commands_turned_loops {

using alembert::test::Json;
using alembert::test::json_of;
using alembert::test::run;
using alembert::test::temporary;

namespace {

/// A plate on a ball joint at these angles, and a joint that closes a loop between it and the ground.
std::string plate(const std::string& type, const std::string& axis, double yaw, double pitch, double roll,
                  const char* key = "guess") {
    return temporary("plate.toml",
                     fmt::format(R"([[body]]
name = "a"
mass = 1
inertia = {{ xx = 0.1, yy = 0.2, zz = 0.3 }}
[[joint]]
name = "ball"
type = "spherical"
parent = "N"
child = "a"
angles = "zyx"
coordinates = {{ yaw = {{ {4} = {0} }}, pitch = {{ {4} = {1} }}, roll = {{ {4} = {2} }} }}
[[joint]]
name = "weld"
type = "{3}"
parent = "N"
child = "a"
{5})",
                                 yaw, pitch, roll, type, key, axis.empty() ? "" : "axis = " + axis + "\n"));
}

double direction(const Json& kinematics, int row, int column) {
    return kinematics["frames"]["a"]["values"]["direction_cosines"][row][column].get<double>();
}

}  // namespace

TEST_CASE("loops: from any guess a joint that closes a loop ends with its axes together") {
    for (const double yaw : {-2.8, -1.2, 0.3, 1.2, 2.9})
        for (const double pitch : {-1.1, 0.3, 1.2})
            for (const double roll : {-2.5, -0.4, 1.2, 3.0})
                for (const char* type : {"fixed", "prismatic", "revolute", "cylindrical"}) {
                    const std::string scene =
                        plate(type, std::string(type) == "fixed" ? "" : "\"x\"", yaw, pitch, roll);
                    const auto found = run({"eval", scene, "--kinematics", "--of", "a", "--json"});
                    CAPTURE(type);
                    CAPTURE(yaw);
                    CAPTURE(pitch);
                    CAPTURE(roll);
                    INFO(found.err);
                    REQUIRE(found.exit == 0);
                    const Json k = Json::parse(found.out);
                    CHECK(std::abs(direction(k, 0, 0) - 1) < 1e-9);
                    if (type[0] == 'f' || type[0] == 'p') CHECK(std::abs(direction(k, 1, 1) - 1) < 1e-9);
                }
}

TEST_CASE("loops: a start turned by half a turn or a third of one is refused, and the joint named") {
    const double half = M_PI, quarter = M_PI / 2;
    const auto refused = run({"eval", plate("fixed", "", half, 0, 0, "initial")});
    CHECK(refused.exit == 4);
    CHECK(refused.err.find("joint 'weld' is turned at the start: of its axes in the parent and in the child, "
                           "which coincide where it closes, two are 180 deg apart") != std::string::npos);
    CHECK(run({"eval", plate("revolute", "\"x\"", half, 0, 0, "initial")}).exit == 4);
    CHECK(run({"eval", plate("revolute", "\"x\"", half, 0, 0, "guess")}).exit == 0);
    // By half a turn about (0, 1, −1), which is perpendicular to the axis.
    const auto oblique = run({"eval", plate("revolute", "[1, 2, 2]", half, 0, -quarter, "initial")});
    CHECK(oblique.exit == 4);
    CHECK(oblique.err.find("joint 'weld' is turned at the start") != std::string::npos);
    // Turned by a third about (1, 1, 1): z to x, x to y, y to z.
    const auto third = run({"eval", plate("fixed", "", quarter, 0, quarter, "initial")});
    CHECK(third.exit == 4);
    CHECK(third.err.find("two are 90 deg apart") != std::string::npos);
    CHECK(run({"eval", plate("fixed", "", 0, 0, 0, "initial")}).exit == 0);
    CHECK(run({"simulate", plate("fixed", "", half, 0, 0, "initial"), "--duration", "1"}).exit == 4);
}

namespace {

/// A planar five-bar in x and z, closed by a fixed joint; two hinges stand at the angle `off` to the others. All
/// lengths are in `size`, and all names begin with `prefix`.
std::string linkage(const std::string& off, double size = 1, const std::string& prefix = "") {
    std::string scene;
    const auto body = [&](const char* name, double mass, double inertia) {
        const double I = inertia * size * size;
        scene += fmt::format("[[body]]\nname = \"{}{}\"\nmass = {}\ninertia = {{ xx = {}, yy = {}, zz = {} }}\n",
                             prefix, name, mass, I, mass == 1 ? 2 * I : I, mass == 1 ? 3 * I : I);
    };
    for (const char* name : {"a", "b", "c", "d"}) body(name, 1, 0.01);
    body("pin", 0.1, 0.001);
    const auto hinge = [&](const char* name, const std::string& parent, const char* child, double from,
                           double guess, bool turned, double to = -0.5) {
        scene += fmt::format(
            "[[joint]]\nname = \"{7}{0}\"\ntype = \"revolute\"\nparent = \"{1}\"\nchild = \"{7}{2}\"\n"
            "parent_point = [{3}, 0, 0]\nchild_point = [{4}, 0, 0]\naxis = \"z\"\n{5}"
            "coordinates = {{ {7}{0} = {{ guess = {6}, rate_guess = 0 }} }}\n",
            name, parent == "N" ? parent : prefix + parent, child, from * size, to * size,
            turned ? fmt::format("parent_rotate = [[\"x\", {0}], [\"y\", {0}]]\n", off) : "", guess, prefix);
    };
    hinge("q1", "N", "a", 0, 1.2, false);
    hinge("q2", "a", "b", 0.5, -1.0, true);
    hinge("q3", "N", "c", 1, 1.8, false);
    hinge("q4", "c", "d", 0.5, 1.1, true);
    hinge("q5", "d", "pin", 0.5, 0.3, false, 0);
    return scene + fmt::format(
                       "[[joint]]\nname = \"{0}loop\"\ntype = \"revolute\"\nparent = \"{0}b\"\nchild = "
                       "\"{0}pin\"\nparent_point = [{1}, 0, 0]\nchild_point = [0, 0, 0]\naxis = \"z\"\n",
                       prefix, 0.5 * size);
}

std::string heavy(const std::string& linkages) {
    return temporary("linkages.toml", "gravity = [0, -9.81, 0]\n" + linkages);
}

std::string five_bar(const std::string& off) {
    return heavy(linkage(off));
}

}  // namespace

TEST_CASE("loops: a planar linkage whose frames are turned by rounding moves as the exact one, and this is told") {
    const Json exact = json_of({"eval", five_bar("0")});
    double size = 0;
    for (const auto& [name, a] : exact["accelerations"].items()) size = std::max(size, std::abs(a.get<double>()));
    CHECK(size > 1);
    // Places and accelerations in the plane change by the square of the angle, 1e-14 at most.
    for (const char* off : {"1e-16", "1e-12", "1e-9", "1e-7"}) {
        CAPTURE(off);
        const std::string scene = five_bar(off);
        const Json rounded = json_of({"eval", scene});
        for (const auto& [name, value] : exact["accelerations"].items())
            CHECK(std::abs(value.get<double>() - rounded["accelerations"][name].get<double>()) < 1e-12 * size);
        for (const auto& [name, value] : exact["coordinates"].items())
            CHECK(std::abs(value.get<double>() - rounded["coordinates"][name].get<double>()) < 1e-12);
        const Json audit = json_of({"audit", scene});
        CHECK(audit["degrees_of_freedom"] == 3);
        const auto told = run({"eval", scene});
        CHECK(told.err.find("joint 'loop' closes a loop with rows that follow from the others but for ") !=
              std::string::npos);
    }
    // A hundredth of a degree is no rounding: nothing is left out, and the linkage is what it says.
    const auto as_written = run({"eval", five_bar("2e-4")});
    CHECK(as_written.exit == 0);
    CHECK(as_written.err.find("follow from the others but for") == std::string::npos);
}

// The rows of a small linkage are measured by its own levers: a large one beside it is another mechanism.
TEST_CASE("loops: a small linkage moves alike with and without a large one beside it") {
    for (const char* off : {"0", "1e-9"}) {
        CAPTURE(off);
        const Json alone = json_of({"eval", heavy(linkage(off, 1e-3, "s"))});
        const auto both = run({"eval", heavy(linkage(off, 1e-3, "s") + linkage("0", 1e4, "l")), "--json"});
        INFO(both.err);
        REQUIRE(both.exit == 0);
        const Json together = Json::parse(both.out);
        double size = 0;
        for (const auto& [name, a] : alone["accelerations"].items())
            size = std::max(size, std::abs(a.get<double>()));
        CHECK(size > 1e3);
        for (const auto& [name, value] : alone["accelerations"].items())
            CHECK(std::abs(value.get<double>() - together["accelerations"][name].get<double>()) < 1e-9 * size);
        CHECK((both.err.find("joint 'sloop' closes a loop with rows") != std::string::npos) == (*off != '0'));
    }
}

}  // namespace commands_turned_loops
