// SPDX-License-Identifier: MIT
// Joints against the same geometry written with frames and points.
#include <doctest/doctest.h>
#include <fmt/format.h>

#include <Eigen/Geometry>
#include <random>

#include "joint_scenes.hpp"
#include "mechanisms.hpp"
#include "model/formalism/dalembert.hpp"
#include "model/formalism/kane.hpp"
#include "model/formalism/lagrange.hpp"
#include "model/formalism/roberson_wittenburg.hpp"
#include "model/formalism/routh.hpp"
#include "model/formalism/schiehlen.hpp"

namespace model_joints {

using namespace alembert;
using namespace alembert::test;

namespace {

/// The same accelerations, outputs and energy at random states, by Lagrange's equations; and by those that start
/// from bodies.
void same_motion(const std::string& joints, const std::string& frames) {
    const Mechanism a = from_text(joints), b = from_text(frames);
    REQUIRE(a.size() == b.size());
    const Program p = lowered(a, lagrange(a)), r = lowered(b, lagrange(b)), k = lowered(a, kane(a)),
                  d = lowered(a, dalembert(a)), s = lowered(a, schiehlen(a)),
                  w = lowered(a, roberson_wittenburg(a));
    const unsigned seed = 20040110;
    CAPTURE(seed);
    std::mt19937_64 random(seed);
    for (int i = 0; i < 8; ++i) {
        const State<double> state = random_state(start_of(a), random);
        const std::vector<double> expected = group(r, state, Group::acceleration);
        // Rounding times the conditioning of M (below 10³ here).
        for (const Program* program : {&p, &k, &d, &s, &w})
            CHECK(relative_distance(group(*program, state, Group::acceleration), expected) < 1e-12);
        CHECK(relative_distance(group(p, state, Group::energy), group(r, state, Group::energy)) < 1e-13);
    }
}

/// A joint's type with its turns and shifts, written with frames and points.
struct Case {
    const char* type;
    const char* keys;
    const char* coordinates;
    const char* turns;      // after parent_rotate
    const char* backwards;  // the same, undone
    const char* shift;      // along the joint's axes in the parent
};

const Case cases[] = {
    {"fixed", "", "", "", "", "[0, 0, 0]"},
    {"revolute", "axis = 'y'", "q1 = 0.1", "['y', 'q1'],", "['y', '-q1'],", "[0, 0, 0]"},
    {"revolute", "axis = [1, 2, 'h']", "q1 = 0.1", "[[1, 2, 'h'], 'q1'],", "[[1, 2, 'h'], '-q1'],", "[0, 0, 0]"},
    {"prismatic", "axis = [0, 3, 4]", "q1 = 0.1", "", "", "[0, '3*q1/5', '4*q1/5']"},
    {"cylindrical", "axis = 'x'", "q1 = 0.1, q2 = 0.2", "['x', 'q1'],", "['x', '-q1'],", "['q2', 0, 0]"},
    {"screw", "pitch = 'h/10'", "q1 = 0.1", "['z', 'q1'],", "['z', '-q1'],", "[0, 0, 'h/10*q1']"},
    {"universal", "", "q1 = 0.1, q2 = 0.2", "['x', 'q1'], ['y', 'q2'],", "['y', '-q2'], ['x', '-q1'],",
     "[0, 0, 0]"},
    {"planar", "", "q1 = 0.1, q2 = 0.2, q3 = 0.3", "['z', 'q3'],", "['z', '-q3'],", "['q1', 'q2', 0]"},
    {"spherical", "angles = 'zxz'", "q1 = 0.1, q2 = 0.2, q3 = 0.3", "['z', 'q1'], ['x', 'q2'], ['z', 'q3'],",
     "['z', '-q3'], ['x', '-q2'], ['z', '-q1'],", "[0, 0, 0]"},
    {"free", "angles = 'xyz'", "q1 = 0.1, q2 = 0.2, q3 = 0.3, q4 = 0.4, q5 = 0.5, q6 = 0.6",
     "['x', 'q4'], ['y', 'q5'], ['z', 'q6'],", "['z', '-q6'], ['y', '-q5'], ['x', '-q4'],", "['q1', 'q2', 'q3']"},
};

std::string with_joints(const Case& c, bool from_parent) {
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
child_point = [0.1, 0.2, 0.3]
coordinates = {{ q0 = 0.3 }}
[[joint]]
name = "second"
type = "{}"
parent = "{}"
child = "{}"
parent_point = [0.3, "h", -0.1]
child_point = [0, 0.4, "-h"]
parent_rotate = [["x", 0.2], ["z", "h"]]
child_rotate = [["y", 0.5]]
{}
coordinates = {{ {} }}
)",
                       base, masses, masses, c.type, from_parent ? "A" : "B", from_parent ? "B" : "A", c.keys,
                       c.coordinates);
}

std::string with_frames(const Case& c, bool from_parent) {
    const std::string head = fmt::format(R"({}
[coordinates]
q0 = 0.3
{}
[[frame]]
name = "FA"
rotate = [["z", "q0"]]
[[body]]
name = "A" {}
frame = "FA"
position = [-0.1, -0.2, -0.3]
axes = "FA"
)",
                                         base,
                                         [&] {
                                             std::string lines = c.coordinates;
                                             std::replace(lines.begin(), lines.end(), ',', '\n');
                                             return lines;
                                         }(),
                                         masses);
    const std::string there = R"(["x", 0.2], ["z", "h"])", back = R"(["z", "-h"], ["x", -0.2])";
    if (from_parent)
        return head + fmt::format(R"([[frame]]
name = "J"
parent = "FA"
rotate = [{}]
[[frame]]
name = "FB"
parent = "J"
rotate = [{} ["y", -0.5]]
[[point]]
name = "P"
from = "A"
offset = [0.3, "h", -0.1]
axes = "FA"
[[point]]
name = "Q"
from = "P"
offset = {}
axes = "J"
[[body]]
name = "B" {}
frame = "FB"
from = "Q"
position = [0, -0.4, "h"]
axes = "FB"
)",
                                  there, c.turns, c.shift, masses);
    return head + fmt::format(R"([[frame]]
name = "J"
parent = "FA"
rotate = [["y", 0.5], {}]
[[frame]]
name = "FB"
parent = "J"
rotate = [{}]
[[point]]
name = "Q"
from = "A"
offset = [0, 0.4, "-h"]
axes = "FA"
[[point]]
name = "S"
offset = {}
axes = "J"
[[body]]
name = "B" {}
frame = "FB"
from = "Q"
position = ["-dot(pos(S), ex(FB))-0.3", "-dot(pos(S), ey(FB))-h", "-dot(pos(S), ez(FB))+0.1"]
axes = "FB"
)",
                              c.backwards, back, c.shift, masses);
}

}  // namespace

TEST_CASE("joints: a body placed by a joint of any type moves as one placed by frames and points") {
    for (const Case& c : cases)
        for (const bool from_parent : {true, false}) {
            CAPTURE(c.type);
            CAPTURE(from_parent);
            same_motion(with_joints(c, from_parent), with_frames(c, from_parent));
        }
}

TEST_CASE(
    "joints: a spherical joint by a quaternion turns the child against the parent by that quaternion, whichever "
    "it places") {
    for (const bool from_parent : {true, false}) {
        CAPTURE(from_parent);
        std::string text = fmt::format("{}[[body]]\nname = \"A\"{}[[body]]\nname = \"B\"{}", base, masses, masses);
        text +=
            "[[joint]]\nname = \"first\"\ntype = \"revolute\"\nparent = \"N\"\nchild = \"A\"\naxis = [1, 2, "
            "2]\ncoordinates = { q0 = 0.3 }\n";
        text += fmt::format(
            "[[joint]]\nname = \"ball\"\ntype = \"spherical\"\nparent = \"{0}\"\nchild = \"{1}\"\nparent_point = "
            "[0.3, 0, 0.1]\n"
            "child_point = [0, 0.2, 0]\ncoordinates = {{ a = 1, b = 0, c = 0, d = 0 }}\n[outputs]\n",
            from_parent ? "A" : "B", from_parent ? "B" : "A");
        const char* axes[] = {"ex", "ey", "ez"};
        for (int i = 0; i < 3; ++i)
            for (int k = 0; k < 3; ++k)
                text += fmt::format("R{}{} = \"dot({}({}), {}({}))\"\n", i, k, axes[i], from_parent ? "A" : "B",
                                    axes[k], from_parent ? "B" : "A");
        const Mechanism m = from_text(text);
        REQUIRE(m.constraints.size() == 1);
        CHECK(m.constraints[0].multiplier.get_name() == "lambda_B");
        const Program program = lowered(m, routh(m)), k = lowered(m, kane(m)), s = lowered(m, schiehlen(m)),
                      w = lowered(m, roberson_wittenburg(m));
        std::mt19937_64 random(20040110);
        for (int i = 0; i < 5; ++i) {
            State<double> state = random_state(start_of(m), random);  // q0, a, b, c, d
            const Eigen::Quaterniond e(state.q[1], state.q[2], state.q[3], state.q[4]);
            const Eigen::Matrix3d R = e.normalized().toRotationMatrix();
            const std::vector<double> outputs = group(program, state, Group::output);
            for (int r = 0; r < 9; ++r) CHECK(outputs[r] == doctest::Approx(R(r / 3, r % 3)).epsilon(1e-13));
            for (const Program* other : {&k, &s, &w})
                CHECK(relative_distance(group(*other, state, Group::acceleration),
                                        group(program, state, Group::acceleration)) < 1e-12);
        }
    }
}

TEST_CASE("joints: a free joint whose quaternion is prescribed moves as the body turned by angles as prescribed") {
    const std::string head = fmt::format(
        "{}[[body]]\nname = \"B\"{}[[joint]]\nname = \"j\"\ntype = \"free\"\nparent = \"N\"\nchild = \"B\"\n"
        "child_point = [0.1, 0.2, 0.3]\ncoordinates = {{ x = 0, y = 0, z = 0 }}\n",
        base, masses);
    const Mechanism a = from_text(head + "motion = { a = 'cos(t/2)', b = '0', c = '0', d = 'sin(t/2)' }\n"),
                    b = from_text(head + "angles = 'xyz'\nmotion = { p = '0', q = '0', r = 't' }\n");
    CHECK(a.constraints.empty());
    REQUIRE(a.size() == 3);
    std::mt19937_64 random(20040110);
    const State<double> state = random_state(start_of(a), random);
    CHECK(relative_distance(group(lowered(a, lagrange(a)), state, Group::acceleration),
                            group(lowered(b, kane(b)), state, Group::acceleration)) < 1e-12);
}

TEST_CASE("joints: the double pendulum by joints is the one by coordinates") {
    const std::string head = R"(
gravity = [0, "g"]
[parameters]
m1 = 1.2
m2 = 0.9
l1 = 1.1
l2 = 0.8
g = 9.81
)";
    same_motion(head + R"(
[[body]]
name = "A"
mass = "m1"
inertia = 0.02
[[body]]
name = "B"
mass = "m2"
inertia = 0.03
[[joint]]
name = "a"
type = "revolute"
parent = "N"
child = "A"
child_point = [0, "-l1"]
coordinates = { q1 = 0.3 }
[[joint]]
name = "b"
type = "revolute"
parent = "A"
child = "B"
child_point = [0, "-l2"]
coordinates = { q2 = 0.3 }
)",
                head + R"(
[coordinates]
q1 = 0.3
q2 = 0.3
[[particle]]
name = "A"
mass = "m1"
position = ['-l1*sin(q1)', 'l1*cos(q1)']
[[particle]]
name = "B"
mass = "m2"
from = "A"
position = ['-l2*sin(q1+q2)', 'l2*cos(q1+q2)']
[energy]
kinetic = "0.01*q1'^2 + 0.015*(q1'+q2')^2"
)");
}

TEST_CASE("joints: a prescribed motion takes a coordinate's place") {
    const std::string head = "gravity = [0, -9.81]\n[inputs]\nF = \"0.2*sin(3*t)\"\n";
    same_motion(head + R"(
[[body]]
name = "cart"
inertia = [0.5, 0.6, 0.7]
mass = 2
[[body]]
name = "bob"
mass = 1
inertia = [0.1, 0.2, 0.3]
[[joint]]
name = "rail"
type = "cylindrical"
parent = "N"
child = "cart"
axis = "x"
coordinates = { turn = 0.1, s = 0 }
motion = { s = "F + t^2/10" }
[[joint]]
name = "pin"
type = "revolute"
parent = "cart"
child = "bob"
child_point = [0, 0.5]
axis = "x"
coordinates = { phi = 0.4 }
[outputs]
push = "s'"
)",
                head + R"(
[coordinates]
turn = 0.1
phi = 0.4
[definitions]
s = "F + t^2/10"
[[frame]]
name = "K"
rotate = [["x", "turn"]]
[[frame]]
name = "L"
parent = "K"
rotate = [["x", "phi"]]
[[body]]
name = "cart"
inertia = [0.5, 0.6, 0.7]
mass = 2
frame = "K"
position = ["s", 0]
[[body]]
name = "bob"
mass = 1
inertia = [0.1, 0.2, 0.3]
frame = "L"
from = "cart"
position = [0, -0.5]
axes = "L"
)");
}

}  // namespace model_joints
