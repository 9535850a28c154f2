// SPDX-License-Identifier: MIT
// A linkage passes a pose in which its constraints lose rank (inline_slider.hpp), beside a block C of mass 1 that
// is independent of it and has a closed form.
#include <doctest/doctest.h>

#include <fmt/format.h>
#include <algorithm>
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

constexpr double mass_of_crank = 0.6, mass_of_coupler = 2;

/// A coupler on `cranks` cranks of length 1 by joints, with their feet on one line, where it lies at the start.
std::string by_joints(int cranks, double rate) {
    std::string bodies = "gravity = [0, -9.81]\n[[body]]\nname = \"c\"\nmass = 2\ninertia = 0.7\n", joints;
    for (int k = 0; k < cranks; ++k) {
        const double foot = cranks == 1 ? 0 : 2.0 * k / (cranks - 1);  // the middle of three is in the middle
        bodies += fmt::format("[[body]]\nname = \"k{}\"\nmass = 0.6\ninertia = 0.05\n", k);
        joints += fmt::format(
            "[[joint]]\nname = \"j{0}\"\ntype = \"revolute\"\nparent = \"N\"\nchild = \"k{0}\"\n"
            "parent_point = [{1}, 0]\nchild_point = [-0.5, 0]\ncoordinates = {{ q{0} = {{ initial = 0, rate = {2} "
            "}} "
            "}}\n[[joint]]\nname = \"t{0}\"\ntype = \"revolute\"\nparent = \"k{0}\"\nchild = \"c\"\n"
            "parent_point = [0.5, 0]\nchild_point = [{3}, 0]\n{4}",
            k, foot, rate, foot - 1,
            k == 0 ? fmt::format("coordinates = {{ p = {{ initial = 0, rate = {} }} }}\n", -rate) : "");
    }
    return bodies + joints + "[simulation]\nduration = 3\ntolerance = 1e-10\n";
}

/// The angle of the cranks after `duration`: (n J + m) q'' = −(n m_k/2 + m) g cos q, by the method of Runge and
/// Kutta.
double angle_of_pendulum(int cranks, double rate, double duration) {
    const double J = cranks * (0.05 + mass_of_crank / 4) + mass_of_coupler,
                 moment = (cranks * mass_of_crank / 2 + mass_of_coupler) * 9.81;
    const auto f = [&](double q) { return -moment / J * std::cos(q); };
    double q = 0, u = rate;
    constexpr int steps = 30000;
    const double h = duration / steps;
    for (int k = 0; k < steps; ++k) {
        const double u2 = u + h / 2 * f(q), u3 = u + h / 2 * f(q + h / 2 * u), u4 = u + h * f(q + h / 2 * u2);
        const double sum = f(q) + 2 * f(q + h / 2 * u) + 2 * f(q + h / 2 * u2) + f(q + h * u3);
        q += h / 6 * (u + 2 * u2 + 2 * u3 + u4);
        u += h / 6 * sum;
    }
    return q;
}

}  // namespace

TEST_CASE("flat: simulate and sweep begin linkages by joints in a flat pose, at rest and in motion") {
    for (const int cranks : {2, 3})
        for (const double rate : {9.0, 0.0}) {
            if (cranks == 3 && rate == 0) continue;
            CAPTURE(cranks);
            CAPTURE(rate);
            const std::string scene = temporary("flat_joints.toml", by_joints(cranks, rate));
            const double exact = angle_of_pendulum(cranks, rate, 3);
            for (const char* const method : {"auto", "dop853", "verner98"}) {
                CAPTURE(method);
                CHECK(std::abs(coordinate(json_of({"simulate", scene, "--method", method}), "q0") - exact) < 1e-6);
                const Json row = swept({scene, "--vary", "t=0:1:2", "--method", method})["rows"][1];
                CHECK(row["status"] == "done");
                CHECK(std::abs(row["final"]["coordinates"]["q0"].get<double>() - exact) < 1e-6);
            }
        }
}

TEST_CASE("flat: bench measures methods from a flat pose") {
    const Json table = json_of({"bench", temporary("flat_bench.toml", by_joints(2, 9)), "--method", "dop853"});
    REQUIRE(table["runs"].size() > 0);
    for (const Json& one : table["runs"]) {
        const double tolerance = one["tolerance"].get<double>();
        // of the size of the tolerance, or of rounding, which a flat pose magnifies
        CHECK(one["error"].get<double>() < 10 * tolerance + 1e-10);
    }
}

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

// The cranks of a parallelogram turn evenly, through two poses in which it lies flat.
TEST_CASE("flat: the error that is told of a parallelogram is no less than the true one") {
    const auto scene = [](double crank, double rod, double angle, double rate) {
        return temporary("parallelogram.toml", fmt::format(R"toml([coordinates]
q0 = {{ initial = {2}, rate = {3} }}
q1 = {{ guess = 0.0, rate_guess = 0.0 }}
q2 = {{ guess = {2}, rate_guess = 3.0 }}
[[particle]]
name = "P1"
mass = 1
position = ["{0}*cos(q0)", "{0}*sin(q0)"]
[[particle]]
name = "P2"
mass = 2
from = "P1"
position = ["{1}*cos(q1)", "{1}*sin(q1)"]
[[constraint]]
name = "across"
holonomic = "{0}*cos(q0) + {1}*cos(q1) = {1} + {0}*cos(q2)"
[[constraint]]
name = "up"
holonomic = "{0}*sin(q0) + {1}*sin(q1) = {0}*sin(q2)"
)toml",
                                                           crank, rod, angle, rate));
    };
    const double angle = 0.9, rate = 2.07;
    for (const char* duration : {"1.5", "2", "2.806953951147077"})
        for (const char* method : {"auto", "dop853", "radau"}) {
            CAPTURE(duration);
            CAPTURE(method);
            const Json motion = json_of({"simulate", scene(0.58, 1.72, angle, rate), "--method", method,
                                         "--tolerance", "1e-12", "--duration", duration});
            const double end = angle + rate * std::stod(duration);
            const double error = std::max(std::abs(coordinate(motion, "q0") - end) / end,
                                          std::abs(motion["final"]["rates"]["q0"].get<double>() - rate) / rate);
            CHECK(error <= motion["error_estimate"]["value"].get<double>());
        }
}

// Without forces the energy is T. Rates that are wrong by the part ρ make it wrong by 2ρ T, and the error is told
// with 2.5 times that part: of the motion's size, and of max(1, |y|) for coordinates of metres, of which y1 goes
// from one end of its circle to the other.
TEST_CASE("flat: what the drift of the energy tells is an error of rates and coordinates, in their units") {
    const double crank = 0.58, rod = 1.72, angle = 0.9, rate = 2.07, x = crank * std::cos(angle),
                 y = crank * std::sin(angle);
    const Json motion =
        json_of({"simulate",
                 temporary("cartesian.toml", fmt::format(R"toml([coordinates]
x1 = {{ initial = {0}, rate = {3} }}
y1 = {{ initial = {1}, rate = {4} }}
x2 = {{ initial = {2}, rate = {3} }}
y2 = {{ initial = {1}, rate = {4} }}
[[particle]]
name = "A"
mass = 1
position = ["x1", "y1"]
[[particle]]
name = "B"
mass = 1
position = ["x2", "y2"]
[[constraint]]
name = "first"
holonomic = "x1^2 + y1^2 - {5}^2"
[[constraint]]
name = "second"
holonomic = "(x2 - {6})^2 + y2^2 - {5}^2"
[[constraint]]
name = "rod"
holonomic = "(x2 - x1)^2 + (y2 - y1)^2 - {6}^2"
[simulation]
duration = 2.806953951147077
tolerance = 1e-12
method = "radau"
)toml",
                                                         x, y, x + rod, -y * rate, x * rate, crank, rod)),
                 "--json"});
    const double drift = motion["energy_drift"];
    REQUIRE(drift > 1e-13);
    CHECK(motion["error_estimate"]["scaled"].get<double>() >= 1.25 * drift * (1 - 1e-12));
    CHECK(motion["error_estimate"]["value"].get<double>() >= 1.25 * drift * 2 * crank);
}

}  // namespace commands_flat
