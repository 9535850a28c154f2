// SPDX-License-Identifier: MIT
// Joints that close loops: their constraints against motions that obey them, and against the same loop written
// with points.
#include <doctest/doctest.h>
#include <fmt/format.h>

#include <Eigen/Dense>
#include <random>

#include "analysis/state/assemble.hpp"
#include "joint_scenes.hpp"
#include "mechanisms.hpp"
#include "model/formalism/routh.hpp"

namespace model_loop_joints {

using namespace alembert;
using namespace alembert::test;

namespace {

/// Two bodies, the second of which moves relative to the first according to `motion`, and a joint of this type
/// that closes a loop between them.
std::string loop(const std::string& type, const std::string& keys, const std::string& free) {
    return fmt::format(R"({}
[[body]]
name = "A" {}
[[body]]
name = "B" {}
[[joint]]
name = "first"
type = "revolute"
parent = "N"
child = "A"
axis = "x"
coordinates = {{ q0 = 0.3 }}
[[joint]]
name = "moved"
type = "free"
parent = "A"
child = "B"
parent_point = [0.3, 0.2, -0.1]
child_point = [0, 0.4, -0.5]
angles = "xyz"
{}
[[joint]]
name = "loop"
type = "{}"
parent = "A"
child = "B"
parent_point = [0.3, 0.2, -0.1]
child_point = [0, 0.4, -0.5]
{}
)",
                       base, masses, masses, free, type, keys);
}

struct Locked {
    const char *type, *keys;
    const char* allowed[6];  // x, y, z, and angles about x, y, z as functions of time
    std::vector<int> rows;   // the directions that are locked
};

const Locked locked[] = {
    {"fixed", "", {"0", "0", "0", "0", "0", "0"}, {0, 1, 2, 3, 4, 5}},
    {"revolute", "", {"0", "0", "0", "0", "0", "t"}, {0, 1, 2, 3, 4}},
    {"revolute", "axis = 'y'", {"0", "0", "0", "0", "t", "0"}, {0, 1, 2, 3, 5}},
    {"revolute", "axis = [-1, 0, 0]", {"0", "0", "0", "t", "0", "0"}, {0, 1, 2, 4, 5}},
    {"prismatic", "axis = 'x'", {"t", "0", "0", "0", "0", "0"}, {1, 2, 3, 4, 5}},
    {"cylindrical", "axis = 'y'", {"0", "t", "0", "0", "2*t", "0"}, {0, 2, 3, 5}},
    {"universal", "", {"0", "0", "0", "t", "3*t", "0"}, {0, 1, 2, 5}},
    {"spherical", "", {"0", "0", "0", "t", "3*t", "2*t"}, {0, 1, 2}},
    {"planar", "", {"t", "t^2", "0", "0", "0", "2*t"}, {2, 3, 4}},
    {"screw", "pitch = 0.2", {"0", "0", "0.2*t", "0", "0", "t"}, {0, 1, 2, 3, 4}},
};

}  // namespace

TEST_CASE("joints: a loop's rows hold for every motion that its joint allows") {
    for (const Locked& c : locked) {
        CAPTURE(c.type);
        std::string motion = "motion = { ";
        for (int k = 0; k < 6; ++k)
            motion += fmt::format("{}q{} = \"{}\"", k > 0 ? ", " : "", k + 1, c.allowed[k]);
        const Mechanism m = from_text(loop(c.type, c.keys, motion + " }"));
        CHECK(m.constraints.empty());
        CHECK(m.identities.size() == c.rows.size());
    }
}

TEST_CASE("joints: a loop's rows lock exactly the other directions, and pull the child along the joint's axes") {
    for (const Locked& c : locked) {
        CAPTURE(c.type);
        const Mechanism m =
            from_text(loop(c.type, c.keys, "coordinates = { q1 = 0, q2 = 0, q3 = 0, q4 = 0, q5 = 0, q6 = 0 }"));
        CHECK(m.constraints.size() == c.rows.size());
        const Program program = lower_constraints(m);
        const State<double> state = start_of(m).state();
        const std::vector<double> A = group(program, state, Group::row);
        for (std::size_t k = 0; k < c.rows.size(); ++k)
            for (std::size_t i = 0; i < 7; ++i) {
                // All joints' axes agree at the start: the k-th row is the rate of one coordinate of the free
                // joint.
                const double screw = std::string(c.type) == "screw" && c.rows[k] == 2 && i == 6 ? -0.2 : 0;
                CHECK(A[k * 7 + i] ==
                      doctest::Approx(static_cast<int>(i) == c.rows[k] + 1 ? 1 : screw).epsilon(1e-14));
            }
    }
}

TEST_CASE("joints: a four-bar linkage closed by a joint accelerates as the one written with points") {
    const auto accelerations = [](const std::string& file, std::vector<double>& lambda) {
        const Mechanism m = prepared(read_scene(source_path(file))).mechanism;
        REQUIRE(m.constraints.size() == 2);
        Start start = start_of(m);
        assemble(start, m, lower_constraints(m), {});
        const Program p = lowered(m, routh(m));
        lambda = group(p, start.state(), Group::multiplier);
        return group(p, start.state(), Group::acceleration);
    };
    std::vector<double> force, other;
    const std::vector<double> joints = accelerations("scenes/gallery/four_bar_joints.toml", force),
                              points = accelerations("scenes/textbook/four_bar.toml", other);
    // The angles of the first are counted from the link before. The start is assembled to 1e-12.
    const double size = std::abs(points[0]) + std::abs(points[1]) + std::abs(points[2]);
    CHECK(std::abs(joints[0] - points[0]) < 1e-11 * size);
    CHECK(std::abs(joints[0] + joints[1] - points[1]) < 1e-11 * size);
    CHECK(std::abs(joints[2] - points[2]) < 1e-11 * size);
    // Both pull the rocker's end from the coupler's: along N there, along the coupler here.
    CHECK(std::hypot(force[0], force[1]) == doctest::Approx(std::hypot(other[0], other[1])).epsilon(1e-10));
}

}  // namespace model_loop_joints
