// SPDX-License-Identifier: MIT
// Inverse dynamics, as a user requests them, against closed forms and the forward equations with the loads
// applied.
#include <cmath>
#include <filesystem>
#include <random>
#include <sstream>

#include "inverse_and_reactions.hpp"

namespace commands_inverse {

using namespace alembert::test;

TEST_CASE("inverse: a rod's torque is its closed form") {
    const Json json = json_of({"inverse", temporary("rod.toml", pendulum), "--at", "theta''=2.5"});
    const double expected = (0.35 + 1.3 * 0.49) * 2.5 + 1.3 * 9.81 * 0.7 * std::sin(0.4);
    CHECK(std::abs(json["loads"]["theta"].get<double>() - expected) < 1e-14 * 20);
    CHECK(json["accelerations"]["theta"].get<double>() == 2.5);
    CHECK(std::abs(json_of({"inverse", temporary("rod.toml", pendulum)})["loads"]["theta"].get<double>() -
                   1.3 * 9.81 * 0.7 * std::sin(0.4)) < 1e-14 * 20);
}

TEST_CASE(
    "inverse: loads applied as forces give the accelerations back, and are what the joints bear about their "
    "axes") {
    std::string text = contents(source_path("scenes/benchmark/trees/arm7.toml"));
    const std::size_t own = text.find("[forces]");
    if (own != std::string::npos) text.erase(own, text.find("\n[", own) - own);
    const std::string scene = temporary("arm.toml", text);
    std::mt19937_64 random(7);
    std::uniform_real_distribution<double> any(-1.5, 1.5);
    Json q, u, a;
    for (int k = 1; k <= 7; ++k) {
        const std::string name = "q" + std::to_string(k);
        q[name] = any(random), u[name] = any(random), a[name] = any(random);
    }
    std::vector<std::string> args{"inverse", scene};
    set(args, q, "");
    set(args, u, "'");
    std::vector<std::string> forward = args;
    set(args, a, "''");
    const Json loads = json_of(args)["loads"];
    forward[0] = "eval";
    forward[1] = temporary("driven.toml", with_forces(contents(scene), loads));
    forward.emplace_back("--reactions");
    const Json eval = json_of(forward);
    for (const auto& [name, value] : a.items())
        CHECK(std::abs(eval["accelerations"][name].get<double>() - value.get<double>()) < 1e-10);
    for (int k = 1; k <= 7; ++k)
        CHECK(std::abs(eval["joint_reactions"]["J" + std::to_string(k)]["moment"][2].get<double>() -
                       loads["q" + std::to_string(k)].get<double>()) < 1e-10);
}

TEST_CASE("inverse: the drive of a four-bar follows from its own acceleration, the rest from the loop") {
    const std::string scene = source_path("scenes/gallery/four_bar_joints.toml");
    const Json json = json_of({"inverse", scene, "--at", "alpha''=1.5"});
    CHECK(std::abs(json["loads"]["alpha"].get<double>()) > 0.1);
    CHECK(json["loads"]["beta"].get<double>() == 0);
    const Json eval = json_of(
        {"eval", temporary("driven.toml", with_forces(contents(scene), {{"alpha", json["loads"]["alpha"]}}))});
    CHECK(std::abs(eval["accelerations"]["alpha"].get<double>() - 1.5) < 1e-11);
    for (const char* name : {"beta", "gamma"})
        CHECK(std::abs(eval["accelerations"][name].get<double>() - json["accelerations"][name].get<double>()) <
              1e-11);
    for (const auto& [name, lambda] : json["multipliers"].items())
        CHECK(std::abs(eval["multipliers"][name].get<double>() - lambda.get<double>()) < 1e-10);
    // The accelerations of the free motion need no loads.
    std::vector<std::string> args{"inverse", scene};
    set(args, json_of({"eval", scene})["accelerations"], "''");
    const Json idle = json_of(args);
    for (const auto& [name, load] : idle["loads"].items()) CHECK(std::abs(load.get<double>()) < 1e-11);
}

TEST_CASE("inverse: wrong requests are refused with a message") {
    const std::string scene = source_path("scenes/gallery/four_bar_joints.toml");
    const auto refused = [&](const std::vector<std::string>& at, const std::string& told) {
        std::vector<std::string> args{"inverse", scene};
        for (const std::string& item : at) args.insert(args.end(), {"--at", item});
        const auto result = run(args);
        CAPTURE(result.err);
        CHECK(result.exit == 3);
        CHECK(result.err.find(told) != std::string::npos);
    };
    refused({"alpah''=1"}, "no coordinate has the acceleration alpah''; did you mean 'alpha'''?");
    refused({"alpha''=x"}, "expected NAME=VALUE");
    refused({"alpha''=1", "beta''=1"},
            "of 2 coordinates are given; expected those of 1 or fewer, the degrees of freedom, or of all 3");
    refused({"alpha''=1", "beta''=1", "gamma''=1"}, "break constraint 'J4_1'");
}

// A body that turns about a vertical axis shows its moment about the axis and nothing else.
TEST_CASE("functions: lists of names are read strictly, and one combination is told as one") {
    const std::string wheel =
        temporary("wheel.toml",
                  "gravity = [0, 0, -9.81]\nbody = [{ name = \"wheel\", mass = 2, inertia = [1, 1, 3] "
                  "}]\n[[joint]]\nname = \"axle\"\ntype = \"revolute\"\nparent = \"N\"\nchild = "
                  "\"wheel\"\ncoordinates = { q = { initial = 0 } }\narmature = { q = 0.5 }\n");
    const std::string folder = temporary("solver", "");
    std::filesystem::remove(folder);
    for (const char* names : {"mass,", ",mass", "mass,,bias"}) {
        const auto refused = run({"emit", wheel, "-o", folder, "--functions", names});
        CHECK(refused.exit == 3);
        CHECK(refused.err.find("has a comma beside which there is no name") != std::string::npos);
    }
    CHECK(run({"emit", wheel, "-o", folder, "--functions", "mobility"}).err.find("say of which with --frame") !=
          std::string::npos);
    const auto told = run({"identify", wheel});
    CHECK(told.out.find(
              "Of 11 inertial parameters, motion and loads show one combination:\n  zz(wheel) + rotor(q) = "
              "3.5\n") != std::string::npos);
    // ∂/∂m of the torque about the axis is 1.
    const auto emitted =
        run({"emit", wheel, "-o", folder, "--functions", "inverse", "--wrench", "wheel", "--json"});
    CHECK(emitted.exit == 0);
    CHECK(contents(folder + "/wheel.cpp").find("wheel_mz") != std::string::npos);
}

namespace {

/// A free body of three angles with velocities along its own axes as speeds; c is where its mass centre is.
std::string free_body(const std::string& more) {
    return R"toml(
gravity = [0, 0, -9.81]
[coordinates]
x = 0.3
y = -0.2
z = 0.5
a = 0.4
b = 0.3
c = -0.6
[speeds]
vx = { form = "dot(vel(P), ex(B))", initial = 0.2 }
vy = { form = "dot(vel(P), ey(B))", initial = -0.5 }
vz = { form = "dot(vel(P), ez(B))", initial = 1 }
wx = { form = "dot(omega(B), ex(B))", initial = 1.1 }
wy = { form = "dot(omega(B), ey(B))", initial = 0.7 }
wz = { form = "dot(omega(B), ez(B))", initial = -0.3 }
[[frame]]
name = "B"
rotate = [["z", "a"], ["y", "b"], ["x", "c"]]
[[body]]
name = "P"
mass = 2
frame = "B"
position = ["x", "y", "z"]
inertia = [1, 2, 2.5]
)toml" + more;
}

}  // namespace

// Newton and Euler along the axes of the body: F = m (v' + ω × v) − m g, M = J ω' + ω × J ω.
TEST_CASE("inverse: loads along speeds of a free body are those of Newton and Euler along its axes") {
    const std::string scene = temporary("free.toml", free_body(""));
    const V3 v{0.2, -0.5, 1}, w{1.1, 0.7, -0.3}, dv{0, 3, 0}, dw{0, 0, -1.5}, J{1, 2, 2.5};
    const Json json = json_of({"inverse", scene, "--at", "vy'=3", "--at", "wz'=-1.5"});
    const auto cross = [](const V3& p, const V3& q) {
        return V3{p[1] * q[2] - p[2] * q[1], p[2] * q[0] - p[0] * q[2], p[0] * q[1] - p[1] * q[0]};
    };
    const double b = 0.3, c = -0.6;
    // The third row of Rz(a) Ry(b) Rx(c) is the vertical along the axes of the body.
    const V3 up{-std::sin(b), std::cos(b) * std::sin(c), std::cos(b) * std::cos(c)};
    const V3 wv = cross(w, v), Jw{J[0] * w[0], J[1] * w[1], J[2] * w[2]}, wJw = cross(w, Jw);
    const char *const forces[] = {"vx", "vy", "vz"}, *const moments[] = {"wx", "wy", "wz"};
    for (std::size_t k = 0; k < 3; ++k) {
        CHECK(json["loads"][forces[k]].get<double>() ==
              doctest::Approx(2 * (dv[k] + wv[k] + 9.81 * up[k])).epsilon(1e-13));
        CHECK(json["loads"][moments[k]].get<double>() == doctest::Approx(J[k] * dw[k] + wJw[k]).epsilon(1e-13));
        CHECK(json["speed_rates"][forces[k]].get<double>() == doctest::Approx(dv[k]).epsilon(1e-13));
        CHECK(json["speeds"][moments[k]].get<double>() == doctest::Approx(w[k]).epsilon(1e-13));
    }
    CHECK(json["speed_loads"] == json["loads"]);
    // The same accelerations, given along the coordinates, and the loads, applied as forces.
    std::vector<std::string> args{"inverse", scene};
    set(args, json["accelerations"], "''");
    const Json along = json_of(args);
    CHECK(along["loads"].size() == 6);
    for (const auto& [name, value] : along["loads"].items())
        CHECK(value.get<double>() == doctest::Approx(json["coordinate_loads"][name].get<double>()).epsilon(1e-11));
    const Json forward =
        json_of({"eval", temporary("driven.toml", with_forces(free_body(""), json["coordinate_loads"]))});
    CHECK(forward["speed_rates"]["vy"].get<double>() == doctest::Approx(3).epsilon(1e-11));
    CHECK(forward["speed_rates"]["wz"].get<double>() == doctest::Approx(-1.5).epsilon(1e-11));
    for (const char* const name : {"vx", "vz", "wx", "wy"})
        CHECK(std::abs(forward["speed_rates"][name].get<double>()) < 1e-11);
}

TEST_CASE("inverse: speeds may eliminate constraints, and others stay") {
    // A sledge: m (v' - ...) along its blade, J w' about it, with its mass centre on the blade.
    const std::string sledge = temporary("sledge.toml", R"toml(
[coordinates]
x = 1
y = 2
phi = 0.7
[speeds]
v = { form = "x'*cos(phi) + y'*sin(phi)", initial = 2 }
w = { form = "phi'", initial = 0.5 }
[[frame]]
name = "B"
rotate = [["z", "phi"]]
[[body]]
name = "sledge"
mass = 3
frame = "B"
position = ["x", "y"]
inertia = 0.4
[[constraint]]
name = "blade"
nonholonomic = "-x'*sin(phi) + y'*cos(phi)"
)toml");
    const Json json = json_of({"inverse", sledge, "--at", "v'=1.5", "--at", "w'=-2"});
    CHECK(json["loads"]["v"].get<double>() == doctest::Approx(4.5).epsilon(1e-13));
    CHECK(json["loads"]["w"].get<double>() == doctest::Approx(-0.8).epsilon(1e-13));
    CHECK(json["multipliers"]["lambda_blade"].get<double>() == doctest::Approx(3 * 2 * 0.5).epsilon(1e-13));
    const double c = std::cos(0.7), s = std::sin(0.7);
    CHECK(json["accelerations"]["x"].get<double>() == doctest::Approx(1.5 * c - 2 * 0.5 * s).epsilon(1e-13));
    CHECK(json["coordinate_loads"]["y"].get<double>() == doctest::Approx(4.5 * s).epsilon(1e-13));
    const Run mixed = run({"inverse", sledge, "--at", "v'=1", "--at", "phi''=2"});
    CHECK(mixed.exit == 3);
    CHECK(mixed.err.find("expected those of one kind") != std::string::npos);
    CHECK(run({"inverse", sledge, "--at", "v'=nan"}).exit == 3);
    const Run text = run({"inverse", sledge, "--at", "v'=1.5"});
    CHECK(text.out.find("\nv               ") != std::string::npos);
}

}  // namespace commands_inverse
