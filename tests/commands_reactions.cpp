// SPDX-License-Identifier: MIT
// Reactions of joints, as a user requests them, against Newton's and Euler's laws for single bodies and for the
// whole.
#include <random>

#include "inverse_and_reactions.hpp"

namespace commands_reactions {

using namespace alembert::test;

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

}  // namespace commands_reactions
