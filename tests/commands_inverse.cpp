// SPDX-License-Identifier: MIT
// Inverse dynamics and reactions of joints, as a user requests them, against closed forms, Newton's and Euler's
// laws for single bodies and for the whole, and the forward equations with the loads applied.
#include <doctest/doctest.h>
#include <fmt/format.h>

#include <array>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <random>
#include <sstream>

#include "program.hpp"
#include "scenes.hpp"

namespace commands_inverse {

using alembert::test::contents;
using alembert::test::run;
using alembert::test::source_path;
using alembert::test::temporary;
using Json = nlohmann::json;
using V3 = std::array<double, 3>;

namespace {

Json json_of(std::vector<std::string> args) {
    args.emplace_back("--json");
    const auto result = run(args);
    CAPTURE(result.err);
    REQUIRE(result.exit == 0);
    return Json::parse(result.out);
}

/// With these values of coordinates (prime "") or rates ("'") …
void set(std::vector<std::string>& args, const Json& values, const std::string& prime) {
    for (const auto& [name, value] : values.items()) {
        args.emplace_back("--at");
        args.push_back(fmt::format("{}{}={:.17g}", name, prime, value.get<double>()));
    }
}

std::string with_forces(const std::string& text, const Json& loads) {
    std::string result = text + "\n[forces]\n";
    for (const auto& [name, value] : loads.items())
        result += fmt::format("{} = {:.17g}\n", name, value.get<double>());
    return result;
}

V3 three(const Json& v) {
    return {v[0].get<double>(), v[1].get<double>(), v[2].get<double>()};
}

void check_near(const V3& found, const V3& expected, double tolerance) {
    for (std::size_t k = 0; k < 3; ++k) {
        CAPTURE(k);
        CHECK(std::abs(found[k] - expected[k]) < tolerance);
    }
}

/// A body on a hinge about z; its mass centre at (0, -a, h) of the hinge where theta is 0.
const std::string pendulum = R"(gravity = [0, "-g", 0]
[parameters]
g = 9.81
a = 0.7
h = 0.2
[[body]]
name = "rod"
mass = 1.3
inertia = [0.4, 0.1, 0.35]
[[joint]]
name = "pin"
type = "revolute"
parent = "N"
child = "rod"
child_point = [0, "a", "-h"]
coordinates = { theta = { initial = 0.4, rate = 1.7 } }
)";

}  // namespace

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

// F = m (a_C − g), M = H_C' + r × F, with r from the pin to the mass centre and ω along z, I diagonal.
TEST_CASE("reactions: those of a pin obey Newton's and Euler's laws for its rod, whichever body is the child") {
    const double m = 1.3, g = 9.81, a = 0.7, h = 0.2, s = std::sin(0.4), c = std::cos(0.4), w = 1.7;
    const double tau = 0.8, e = (tau - m * g * a * s) / (0.35 + m * a * a);
    const V3 force{m * a * (e * c - w * w * s), m * a * (e * s + w * w * c) + m * g, 0};
    const V3 r{a * s, -a * c, h};
    const V3 moment{r[1] * force[2] - r[2] * force[1], r[2] * force[0] - r[0] * force[2],
                    0.35 * e + r[0] * force[1] - r[1] * force[0]};
    CHECK(std::abs(moment[2] - tau) < 1e-13);
    for (const char* by : {"lagrange", "recursive", "kane", "schiehlen"}) {
        CAPTURE(by);
        const Json pin = json_of({"eval", temporary("pin.toml", with_forces(pendulum, {{"theta", tau}})),
                                  "--reactions", "--by", by})["joint_reactions"]["pin"];
        check_near(three(pin["force"]), force, 1e-12);
        check_near(three(pin["moment"]), moment, 1e-12);
    }
    std::string turned = pendulum;
    const auto replace = [&](const std::string& from, const std::string& to) {
        turned.replace(turned.find(from), from.size(), to);
    };
    replace("parent = \"N\"\nchild = \"rod\"\nchild_point", "parent = \"rod\"\nchild = \"N\"\nparent_point");
    replace("initial = 0.4, rate = 1.7", "initial = -0.4, rate = -1.7");
    const Json pin = json_of({"eval", temporary("turned.toml", with_forces(turned, {{"theta", -tau}})),
                              "--reactions"})["joint_reactions"]["pin"];
    check_near(three(pin["force"]), {-force[0], -force[1], -force[2]}, 1e-12);
    check_near(three(pin["moment"]), {-moment[0], -moment[1], -moment[2]}, 1e-12);
}

TEST_CASE("reactions: derive shows those of a pin as in a textbook") {
    const Json pin = json_of({"derive", temporary("pin.toml", with_forces(pendulum, {{"theta", 0.8}})),
                              "--reactions"})["joint_reactions"]["pin"];
    CHECK(pin["F_x"] == "1.3*a*theta''*cos(theta) - 1.3*a*theta'^2*sin(theta)");
    CHECK(pin["F_y"] == "1.3*a*theta''*sin(theta) + 1.3*a*theta'^2*cos(theta) + 1.3*g");
    CHECK(pin["F_z"] == "0");
    // With numbers it agrees with eval, also about the free axis.
    const std::string scene = with_forces(pendulum, {{"theta", 0.8}});
    std::string outputs = scene + "[outputs]\n";
    for (const auto& [name, formula] : pin.items())
        outputs += fmt::format("{} = \"{}\"\n", name, formula.get<std::string>());
    const Json eval = json_of({"eval", temporary("both.toml", outputs), "--reactions"});
    for (std::size_t k = 0; k < 3; ++k) {
        CHECK(std::abs(eval["outputs"][fmt::format("F_{}", "xyz"[k])].get<double>() -
                       eval["joint_reactions"]["pin"]["force"][k].get<double>()) < 1e-12);
        CHECK(std::abs(eval["outputs"][fmt::format("M_{}", "xyz"[k])].get<double>() -
                       eval["joint_reactions"]["pin"]["moment"][k].get<double>()) < 1e-12);
    }
}

// The carriage does not turn: about its joint's point M = c × m (a − g), at any position on the rail.
TEST_CASE(
    "reactions: a rail bears the moment of a carriage about the carriage's own point, with springs and forces "
    "counted") {
    const std::string text = R"(gravity = [0, 0, -9.81]
[[body]]
name = "carriage"
mass = 2
inertia = [1, 1, 1]
[[joint]]
name = "rail"
type = "prismatic"
axis = [3, 4, 0]
parent = "N"
child = "carriage"
parent_point = [1, 0, 0]
child_point = [-0.1, -0.2, 0.3]
coordinates = { x = { initial = 3, rate = 1 } }
[[point]]
name = "hook"
from = "carriage"
offset = [0.5, 0, 0]
axes = "carriage"
[[force]]
at = "hook"
vector = [0, 7, 0]
[[spring]]
between = ["O", "carriage"]
stiffness = 5
[[damper]]
along = "x"
damping = 4
)";
    const Json json = json_of({"eval", temporary("rail.toml", text), "--reactions"});
    const double x = json["accelerations"]["x"].get<double>();
    // Mass centre at (1, 0, 0) + 3 (0.6, 0.8, 0) + (0.1, 0.2, −0.3); pulled by −5 times that.
    const V3 at{1 + 1.8 + 0.1, 2.4 + 0.2, -0.3};
    const V3 force{2 * 0.6 * x + 5 * at[0], 2 * 0.8 * x + 5 * at[1] - 7,
                   2 * 9.81 + 5 * at[2]};  // m a − gravity − spring − force
    check_near(three(json["joint_reactions"]["rail"]["force"]), force, 1e-12);
    // About the mass centre 0 = M − c × F + (0.5, 0, 0) × (0, 7, 0) where c leads from the joint's point to it.
    const V3 c{0.1, 0.2, -0.3};
    const V3 moment{c[1] * force[2] - c[2] * force[1], c[2] * force[0] - c[0] * force[2],
                    c[0] * force[1] - c[1] * force[0] - 3.5};
    check_near(three(json["joint_reactions"]["rail"]["moment"]), moment, 1e-12);
    CHECK(std::abs(0.6 * force[0] + 0.8 * force[1] + 4 * 1) < 1e-12);  // along the rail only the damper acts
}

TEST_CASE(
    "reactions: the ground's joints together bear what Newton's law says of a closed linkage and of an arm") {
    struct Case {
        std::string name;
        std::vector<std::string> feet;
        std::vector<std::pair<std::string, double>> bodies;
        V3 gravity;
    };
    for (const auto& [name, feet, bodies, gravity] :
         {Case{"gallery/four_bar_joints",
               {"J1", "J3"},
               {{"crank", 1.0}, {"coupler", 2.0}, {"rocker", 1.5}},
               {0, 0, 0}},
          Case{"textbook/double_pendulum_joints", {"hook"}, {{"upper", 1}, {"lower", 1}}, {0, 9.81, 0}},
          Case{"gallery/six_joint_arm",
               {"waist"},
               {{"shoulder", 12}, {"upper", 9}, {"fore", 5}, {"roll", 2}, {"pitch", 1.2}, {"flange", 0.6}},
               {0, 0, -9.81}}}) {
        const std::string where = name;  // clang 14: no structured binding in a macro's lambda
        CAPTURE(where);
        std::string text = contents(source_path(std::string("scenes/") + name + ".toml")) + "\n[outputs]\n";
        for (const auto& [body, mass] : bodies)
            for (const char* axis : {"x", "y", "z"})
                text += fmt::format("{}_{} = \"{}*(dot(pos({}), e{}(N)))''\"\n", body, axis, mass, body, axis);
        const Json json = json_of({"eval", temporary("whole.toml", text), "--reactions"});
        V3 needed{0, 0, 0}, borne{0, 0, 0};
        for (const auto& [body, mass] : bodies) {
            for (std::size_t k = 0; k < 3; ++k)
                needed[k] +=
                    json["outputs"][fmt::format("{}_{}", body, "xyz"[k])].get<double>() - mass * gravity[k];
        }
        for (const std::string& foot : feet)
            for (std::size_t k = 0; k < 3; ++k)
                borne[k] += json["joint_reactions"][foot]["force"][k].get<double>();
        CHECK(std::abs(needed[0]) > 0.01);
        check_near(borne, needed, 1e-10);
    }
}

// F = Σ m (a − g) − P and M = Σ (r_i − r_Q) × m (a − g) + H_i' − (r_tip − r_Q) × P over the base and an arm on it,
// about the base's point Q of the joint; all from the positions and angular velocities of the bodies,
// differentiated as outputs.
TEST_CASE("reactions: those of each type of joint obey Newton's and Euler's laws for all bodies beyond it") {
    struct Type {
        std::string name, rest;
    };
    for (const auto& [type, rest] :
         {Type{"fixed", ""},
          {"revolute", "axis = [1, 2, 2]\ncoordinates = { a = { initial = 0.3, rate = 0.8 } }"},
          {"revolute", "axis = \"y\"\nmotion = { a = \"0.4*sin(3*t)\" }"},
          {"prismatic", "axis = [0, 3, 4]\ncoordinates = { a = { initial = 0.3, rate = 0.8 } }"},
          {"cylindrical",
           "axis = \"x\"\ncoordinates = { a = { initial = 0.3, rate = 0.8 }, b = { initial = 1.2, rate = -0.5 } "
           "}"},
          {"screw", "axis = [2, 0, 1]\npitch = 0.3\ncoordinates = { a = { initial = 1.3, rate = 0.8 } }"},
          {"universal", "coordinates = { a = { initial = 0.3, rate = 0.8 }, b = { initial = 1.2, rate = -0.5 } }"},
          {"planar",
           "coordinates = { a = { initial = 0.3, rate = 0.8 }, b = { initial = 1.2, rate = -0.5 }, c = { initial "
           "= 0.7, rate = 2 } }"},
          {"spherical",
           "angles = \"xyz\"\ncoordinates = { a = { initial = 0.3, rate = 0.8 }, b = { initial = 0.2, rate = -0.5 "
           "}, c = { initial = 0.7, rate = 2 } }"},
          {"spherical",
           "coordinates = { a = { initial = 0.5, rate = 0.2 }, b = { initial = 0.5, rate = -0.2 }, c = { initial "
           "= -0.5, rate = 0.3 }, d = { initial = 0.5, rate = 0.3 } }"}}) {
        const std::string what = std::string(type) + " " + rest;
        CAPTURE(what);
        std::string text = fmt::format(R"(gravity = [1, 2, -9.81]
[[body]]
name = "base"
mass = 2
inertia = {{ xx = 0.3, yy = 0.2, zz = 0.25, xy = 0.01, yz = -0.02, zx = 0.03 }}
[[joint]]
name = "foot"
type = "{}"
parent = "N"
child = "base"
parent_point = [0.5, 0.4, 0.3]
child_point = [-0.1, 0.2, -0.3]
{}
[[body]]
name = "arm"
mass = 0.7
inertia = [0.02, 0.05, 0.06]
[[joint]]
name = "elbow"
type = "revolute"
parent = "base"
child = "arm"
parent_point = [0.2, 0.3, 0.1]
child_point = [-0.4, 0, 0.1]
axis = "y"
coordinates = {{ q = {{ initial = 0.6, rate = -1.1 }} }}
[[point]]
name = "Q"
from = "base"
offset = [-0.1, 0.2, -0.3]
axes = "base"
[[point]]
name = "tip"
from = "arm"
offset = [0.5, 0.1, 0]
axes = "arm"
[[force]]
at = "tip"
vector = [3, -2, 1]
[outputs]
)",
                                       type, rest);
        for (const char* k : {"x", "y", "z"}) {
            text += fmt::format("t{0} = \"dot(pos(Q, tip), e{0}(N))\"\n", k);
            for (const auto& [body, tensor] :
                 {std::pair("base", std::array{"0.3*{x} + 0.01*{y} + 0.03*{z}", "0.01*{x} + 0.2*{y} - 0.02*{z}",
                                               "0.03*{x} - 0.02*{y} + 0.25*{z}"}),
                  std::pair("arm", std::array{"0.02*{x}", "0.05*{y}", "0.06*{z}"})}) {
                text += fmt::format(
                    "a{0}{1} = \"(dot(vel({1}), e{0}(N)))'\"\nr{0}{1} = \"dot(pos(Q, {1}), e{0}(N))\"\n", k, body);
                std::string H;
                for (std::size_t i = 0; i < 3; ++i) {
                    std::string part = tensor[i];
                    for (const char* w : {"x", "y", "z"})
                        for (std::size_t at; (at = part.find(fmt::format("{{{}}}", w))) != std::string::npos;)
                            part.replace(at, 3, fmt::format("dot(omega({0}), e{1}({0}))", body, w));
                    H += fmt::format("{}({})*dot(e{}({}), e{}(N))", i == 0 ? "" : " + ", part, "xyz"[i], body, k);
                }
                text += fmt::format("h{0}{1} = \"({2})'\"\n", k, body, H);
            }
        }
        const Json json = json_of({"eval", temporary("type.toml", text), "--reactions"});
        const auto vector = [&](const std::string& letter, const std::string& of) {
            V3 v;
            for (std::size_t k = 0; k < 3; ++k)
                v[k] = json["outputs"][fmt::format("{}{}{}", letter, "xyz"[k], of)].get<double>();
            return v;
        };
        const V3 g{1, 2, -9.81}, P{3, -2, 1};
        V3 force{-P[0], -P[1], -P[2]}, moment{0, 0, 0};
        const auto add_moment = [&](const V3& r, const V3& f) {
            for (std::size_t k = 0; k < 3; ++k)
                moment[k] += r[(k + 1) % 3] * f[(k + 2) % 3] - r[(k + 2) % 3] * f[(k + 1) % 3];
        };
        add_moment(vector("t", ""), force);
        for (const auto& [body, mass] : {std::pair("base", 2.0), std::pair("arm", 0.7)}) {
            V3 f = vector("a", body);
            for (std::size_t k = 0; k < 3; ++k)
                f[k] = mass * (f[k] - g[k]), force[k] += f[k], moment[k] += vector("h", body)[k];
            add_moment(vector("r", body), f);
        }
        check_near(three(json["joint_reactions"]["foot"]["force"]), force, 1e-11);
        check_near(three(json["joint_reactions"]["foot"]["moment"]), moment, 1e-11);
        CHECK(std::abs(force[2]) + std::abs(moment[0]) + std::abs(moment[2]) > 0.1);
    }
}

TEST_CASE(
    "reactions: those of a body on a quaternion's joint, and those that a run records, are those of its state") {
    const std::string scene = source_path("scenes/textbook/heavy_top_joint.toml"), file = temporary("top.csv", "");
    const Json run_of_it = json_of({"simulate", scene, "--reactions", "--duration", "0.3", "-o", file})["final"];
    std::ifstream stream(file);
    std::string names, line, last;
    std::getline(stream, names);
    while (std::getline(stream, line)) last = line;
    std::vector<std::string> name_of;
    std::vector<double> value;
    for (std::istringstream cells(names); std::getline(cells, line, ',');) name_of.push_back(line);
    for (std::istringstream cells(last); std::getline(cells, line, ',');) value.push_back(std::stod(line));
    REQUIRE(name_of.size() == value.size());
    std::vector<std::string> args{"eval", scene, "--reactions"};
    set(args, run_of_it["coordinates"], "");
    set(args, run_of_it["speeds"], "");
    const Json joints = json_of(args)["joint_reactions"];
    REQUIRE(joints.size() == 1);
    const std::string joint = joints.begin().key();
    const Json load = joints.begin().value();
    for (std::size_t k = 0; k < 3; ++k)
        for (const auto& [part, what] : {std::pair('f', "force"), std::pair('m', "moment")}) {
            const auto column =
                std::find(name_of.begin(), name_of.end(), fmt::format("{}.{}{}", joint, part, "xyz"[k]));
            REQUIRE(column != name_of.end());
            CHECK(std::abs(value[static_cast<std::size_t>(column - name_of.begin())] -
                           load[what][k].get<double>()) < 1e-8);
        }
    CHECK(std::abs(load["force"][2].get<double>()) > 1);
    for (std::size_t k = 0; k < 3; ++k)
        CHECK(std::abs(load["moment"][k].get<double>()) < 1e-9);  // a spherical joint transmits no moment
}

namespace {

void check_same_reactions(const Json& one, const Json& other, double tolerance) {
    REQUIRE(one.size() == other.size());
    for (const auto& entry : one.items()) {
        const std::string joint = entry.key();
        const Json& load = entry.value();
        CAPTURE(joint);
        REQUIRE(other.contains(joint));
        check_near(three(load["force"]), three(other[joint]["force"]), tolerance);
        check_near(three(load["moment"]), three(other[joint]["moment"]), tolerance);
    }
}

/// The same text with what is between `from` and `to` replaced.
std::string replaced(std::string text, const std::string& from, const std::string& to) {
    const std::size_t at = text.find(from);
    REQUIRE(at != std::string::npos);
    return text.replace(at, from.size(), to);
}

std::string closed_elsewhere(const std::string& text, const std::string& opened, const std::string& coordinates) {
    // The joint `opened` closed the loop and now gets coordinates. It becomes a joint of the tree because it
    // stands before the joint that closes the loop now.
    const std::size_t at = text.find("name = \"" + opened + "\"");
    REQUIRE(at != std::string::npos);
    const std::size_t end = std::min(text.find("\n\n", at), text.size());
    return text.substr(0, end) + "\ncoordinates = { " + coordinates + " }" + text.substr(end);
}

std::string moved_to_the_end(const std::string& text, const std::string& joint, const std::string& coordinates) {
    const std::size_t at = text.rfind("[[joint]]", text.find("name = \"" + joint + "\""));
    const std::size_t end = text.find("\n\n", at);
    const std::string block = text.substr(at, end - at);
    return text.substr(0, at) + text.substr(end) + "\n" + replaced(block, "\n" + coordinates, "") + "\n";
}

using Q4 = std::array<double, 4>;

Q4 times(const Q4& p, const Q4& q) {
    return {p[0] * q[0] - p[1] * q[1] - p[2] * q[2] - p[3] * q[3],
            p[0] * q[1] + p[1] * q[0] + p[2] * q[3] - p[3] * q[2],
            p[0] * q[2] - p[1] * q[3] + p[2] * q[0] + p[3] * q[1],
            p[0] * q[3] + p[1] * q[2] - p[2] * q[1] + p[3] * q[0]};
}

}  // namespace

TEST_CASE("reactions: those of a four-bar's joints are the same wherever its loop is closed") {
    const std::string text = contents(source_path("scenes/gallery/four_bar_joints.toml"));
    const Json one = json_of({"eval", temporary("one.toml", text), "--reactions"});
    const auto q = [&](const char* name) { return one["coordinates"][name].get<double>(); };
    const std::string guess =
        fmt::format("delta = {{ guess = {:.17g}, rate_guess = 0 }}", q("gamma") - q("alpha") - q("beta"));
    const std::string other =
        moved_to_the_end(closed_elsewhere(text, "J4", guess), "J3",
                         "coordinates = { gamma = { guess = 1.4, rate_guess = 0, unit = \"rad\" } }");
    const Json two = json_of({"eval", temporary("two.toml", other), "--reactions"});
    CHECK(std::abs(two["accelerations"]["beta"].get<double>() - one["accelerations"]["beta"].get<double>()) <
          1e-10);
    check_same_reactions(one["joint_reactions"], two["joint_reactions"], 1e-9);
    CHECK(std::abs(one["joint_reactions"]["J4"]["force"][0].get<double>()) > 1);
    // The rocker by itself: m a at its middle, and no moment at either pin: ½ c e × (F4 − F3) = I γ''.
    const double gamma = q("gamma"), rate = one["rates"]["gamma"].get<double>(),
                 second = one["accelerations"]["gamma"].get<double>(), turn = q("alpha") + q("beta");
    const auto force = [&](const char* joint, double by) {
        const V3 f = three(one["joint_reactions"][joint]["force"]);
        return std::array{f[0] * std::cos(by) - f[1] * std::sin(by), f[0] * std::sin(by) + f[1] * std::cos(by)};
    };
    const auto F3 = force("J3", 0), F4 = force("J4", turn);  // J4's axes are the coupler's
    const double ax = -1.75 * (second * std::sin(gamma) + rate * rate * std::cos(gamma)),
                 ay = 1.75 * (second * std::cos(gamma) - rate * rate * std::sin(gamma));
    CHECK(std::abs(F3[0] + F4[0] - 1.5 * ax) < 1e-10);
    CHECK(std::abs(F3[1] + F4[1] - 1.5 * ay) < 1e-10);
    const double about_centre = 1.75 * (std::cos(gamma) * (F4[1] - F3[1]) - std::sin(gamma) * (F4[0] - F3[0]));
    CHECK(std::abs(about_centre - 1.5 * 3.5 * 3.5 / 12 * second) < 1e-10);
}

TEST_CASE("reactions: at a hinge that closes a spatial linkage they are those of the same hinge in a tree") {
    const std::string text = contents(source_path("scenes/gallery/rssr.toml"));
    const Json one = json_of({"eval", temporary("one.toml", text), "--reactions"});
    const auto q = [&](const char* name) { return one["coordinates"][name].get<double>(); };
    const double alpha = q("alpha") / 2, beta = q("beta") / 2, half = std::sqrt(0.5);
    Q4 back = times({std::cos(alpha), 0, 0, std::sin(alpha)}, {q("e0"), q("e1"), q("e2"), q("e3")});
    for (std::size_t k = 1; k < 4; ++k) back[k] = -back[k];
    const Q4 f = times(back, times({half, half, 0, 0}, {std::cos(beta), 0, 0, std::sin(beta)}));
    std::string coordinates, ball = "coordinates = {";
    for (std::size_t k = 0; k < 4; ++k) {
        const std::string e = fmt::format("e{}", k);
        coordinates += fmt::format("{}f{} = {{ guess = {:.17g}, rate_guess = 0 }}", k == 0 ? "" : ", ", k, f[k]);
        ball += fmt::format("{} {} = {{ initial = {:.17g}, rate = {:.17g} }}", k == 0 ? "" : ",", e, q(e.c_str()),
                            one["rates"][e].get<double>());
    }
    std::string other = closed_elsewhere(text, "socket", coordinates);
    const std::size_t old = other.find("coordinates = { e0"), end = other.find('\n', old);
    other = other.substr(0, old) + ball + " }" + other.substr(end);
    other = replaced(moved_to_the_end(other, "foot",
                                      "coordinates = { beta = { guess = 1.3, rate_guess = 0, unit = \"rad\" } }"),
                     "spread", "# spread");
    const Json two = json_of({"eval", temporary("two.toml", other), "--reactions"});
    CHECK(std::abs(two["accelerations"]["alpha"].get<double>() - one["accelerations"]["alpha"].get<double>()) <
          1e-9);
    check_same_reactions(one["joint_reactions"], two["joint_reactions"], 1e-9);
    CHECK(std::abs(one["joint_reactions"]["foot"]["moment"][0].get<double>()) > 0.1);
}

TEST_CASE(
    "reactions: a slider's rail bears force and moment about the slider's point, as the joint that closes the "
    "loop too") {
    const std::string bodies = R"toml(gravity = [0, -9.81, 0]
[[body]]
name = "crank"
mass = 1
inertia = [0.01, 0.02, 0.02]
[[body]]
name = "rod"
mass = 0.8
inertia = [0.01, 0.05, 0.05]
[[body]]
name = "slider"
mass = 2
inertia = [0.03, 0.04, 0.05]
[outputs]
ax = "(dot(vel(slider), ex(N)))'"
ay = "(dot(vel(slider), ey(N)))'"
s = "dot(pos(slider), ex(N))"
[[joint]]
name = "hub"
type = "revolute"
parent = "N"
child = "crank"
child_point = [-0.2, 0, 0]
coordinates = { phi = { initial = 0.7, rate = 3 } }
[[joint]]
name = "knee"
type = "revolute"
parent = "crank"
child = "rod"
parent_point = [0.2, 0, 0]
child_point = [-0.5, 0, 0]
coordinates = { psi = { guess = -1, rate_guess = 0 } }
)toml";
    const std::string rail =
        "[[joint]]\nname = \"rail\"\ntype = \"prismatic\"\nparent = \"N\"\nchild = \"slider\"\nparent_point = "
        "[0.3, 0.05, 0]\n"
        "parent_rotate = [[\"z\", 0.2]]\nchild_point = [0.1, -0.15, 0]\naxis = \"x\"\n";
    const std::string pin =
        "[[joint]]\nname = \"pin\"\ntype = \"revolute\"\nparent = \"rod\"\nchild = \"slider\"\nparent_point = "
        "[0.5, 0, 0]\n"
        "child_point = [-0.05, 0.02, 0]\n";
    const Json one = json_of(
        {"eval",
         temporary("one.toml", bodies + rail + "coordinates = { x = { guess = 1, rate_guess = 0 } }\n" + pin),
         "--reactions"});
    const double psi = one["coordinates"]["psi"].get<double>();
    const std::string chi =
        fmt::format("coordinates = {{ chi = {{ guess = {:.17g}, rate_guess = 0 }} }}\n", 0.2 - 0.7 - psi);
    const Json two =
        json_of({"eval",
                 temporary("two.toml",
                           replaced(bodies, "guess = -1", fmt::format("guess = {:.17g}", psi)) + pin + chi + rail),
                 "--reactions"});
    check_same_reactions(one["joint_reactions"], two["joint_reactions"], 1e-9);
    // Newton and Euler for the slider, which does not turn: its two joints along N, moments about its mass centre.
    const auto along_ground = [](const V3& v, double by) {
        return V3{v[0] * std::cos(by) - v[1] * std::sin(by), v[0] * std::sin(by) + v[1] * std::cos(by), v[2]};
    };
    const Json& load = two["joint_reactions"];
    const V3 F = along_ground(three(load["rail"]["force"]), 0.2),
             P = along_ground(three(load["pin"]["force"]), 0.7 + psi);
    const V3 at = along_ground({0.1, -0.15, 0}, 0.2), to = along_ground({-0.05, 0.02, 0}, 0.2);
    CHECK(std::abs(F[0] + P[0] - 2 * two["outputs"]["ax"].get<double>()) < 1e-10);
    CHECK(std::abs(F[1] + P[1] - 2 * (two["outputs"]["ay"].get<double>() + 9.81)) < 1e-10);
    const double M = load["rail"]["moment"][2].get<double>();
    CHECK(std::abs(M + at[0] * F[1] - at[1] * F[0] + to[0] * P[1] - to[1] * P[0]) < 1e-10);
    CHECK(std::abs(M) > 0.1);
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

}  // namespace commands_inverse
