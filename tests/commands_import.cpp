// SPDX-License-Identifier: MIT
// Robots as scenes: accelerations by the recursion on the imported tree are compared with those of
// robot_model.hpp, which knows the URDF alone.
#include <doctest/doctest.h>
#include <fmt/format.h>

#include <Eigen/Dense>
#include <random>
#include <regex>
#include <sstream>

#include "files.hpp"
#include "json.hpp"
#include "robot_model.hpp"
#include "solved.hpp"

namespace commands_import {

using alembert::test::contents;
using alembert::test::Json;
using alembert::test::json_of;
using alembert::test::RobotHinge;
using alembert::test::RobotModel;
using alembert::test::run;
using alembert::test::source_path;
using alembert::test::temporary;

namespace {

std::string plain(std::string name) {
    for (char& c : name)
        if (c == ' ' || c == '-') c = '_';
    return name;
}

struct Random {
    std::mt19937_64 engine{20261121};
    double operator()(double from, double to) { return std::uniform_real_distribution<double>(from, to)(engine); }
};

/// The largest difference of accelerations, over the largest of them.
void compare(const std::string& robot, const std::vector<std::string>& still, std::size_t freedom,
             const std::vector<std::string>& options = {}) {
    const std::string file = source_path("tests/robots/" + robot + ".urdf"),
                      scene = temporary(robot + ".toml", "");
    std::vector<std::string> args{"import", file, "-o", scene, "--json"};
    args.insert(args.end(), options.begin(), options.end());
    const auto imported = run(args);
    CAPTURE(imported.err);
    REQUIRE(imported.exit == 0);
    const RobotModel model(file);
    Random random;
    for (int trial = 0; trial < 4; ++trial) {
        RobotModel::Values q, u, none;
        for (const RobotHinge& h : model.hinges) {
            if (!h.leader.empty() || h.type == "fixed" ||
                std::find(still.begin(), still.end(), h.name) != still.end())
                continue;
            q[h.name] = random(-1.2, 1.2);
            u[h.name] = random(-1, 1);
        }
        REQUIRE(q.size() == freedom);
        const auto n = static_cast<Eigen::Index>(q.size());
        Eigen::MatrixXd M(n, n);
        Eigen::VectorXd f(n);
        const auto column = [&](const RobotModel::Values& loads) {
            Eigen::VectorXd v(n);
            Eigen::Index k = 0;
            for (const auto& [name, value] : q) v[k++] = loads.at(name);
            return v;
        };
        f = -column(model.loads(q, u, none, 9.81, true));
        Eigen::Index k = 0;
        for (const auto& [name, value] : q) M.col(k++) = column(model.loads(q, none, {{name, 1.0}}, 0, false));
        const Eigen::VectorXd expected = alembert::test::solved(M, f).value();
        std::vector<std::string> eval{"eval", scene, "--json", "--by", "recursive"};
        for (const auto& [values, prime] : {std::pair(&q, ""), std::pair(&u, "'")})
            for (const auto& [name, value] : *values) {
                eval.emplace_back("--at");
                eval.push_back(fmt::format("{}{}={}", plain(name), prime, value));
            }
        const auto result = run(eval);
        CAPTURE(result.err);
        REQUIRE(result.exit == 0);
        const Json accelerations = Json::parse(result.out)["accelerations"];
        CHECK(accelerations.size() == q.size());
        k = 0;
        for (const auto& coordinate : q) {
            const std::string& name = coordinate.first;
            CAPTURE(name);
            const double difference = accelerations[plain(name)].get<double>() - expected[k++];
            CHECK(std::abs(difference) < 1e-12 * expected.cwiseAbs().maxCoeff());
        }
    }
}

std::string link_of(const std::string& name, const std::string& inside = "") {
    return "<link name=\"" + name + "\">" + inside + "</link>";
}
const std::string heavy =
    "<inertial><mass value=\"2\"/><inertia ixx=\"1\" iyy=\"1\" izz=\"1\" ixy=\"0\" ixz=\"0\" "
    "iyz=\"0\"/></inertial>";
std::string hinge_of(const std::string& name, const std::string& type, const std::string& parent,
                     const std::string& child, const std::string& inside = "") {
    return fmt::format("<joint name=\"{}\" type=\"{}\"><parent link=\"{}\"/><child link=\"{}\"/>{}</joint>", name,
                       type, parent, child, inside);
}
std::string robot_of(const std::string& inside) {
    return "<robot name=\"r\">" + inside + "</robot>";
}

}  // namespace

TEST_CASE(
    "import: a six-joint arm with oblique axes, turned inertias and a fixed tool accelerates as link by link") {
    compare("arm6", {}, 6);
}

TEST_CASE(
    "import: a torso of branches, with joints that mimic others and others again, accelerates as link by link") {
    compare("torso", {"antenna"}, 10);
}

TEST_CASE("import: a quadruped on a floating base accelerates as link by link") {
    compare("quadruped", {}, 18);
}

// M (q''(τ) − q''(0)) = τ, with M from the loads that the description itself needs for unit accelerations.
TEST_CASE("import: each joint gets a drive, whose torque accelerates all as the description's own inertia says") {
    const std::string file = source_path("tests/robots/arm6.urdf"), scene = temporary("driven.toml", "");
    const auto imported = run({"import", file, "-o", scene, "--drives", "--json"});
    REQUIRE(imported.exit == 0);
    CHECK(Json::parse(imported.out)["drives"].size() == 6);
    const RobotModel model(file);
    RobotModel::Values q, none;
    for (const RobotHinge& h : model.hinges)
        if (h.type != "fixed") q[h.name] = 0.3 + 0.1 * static_cast<double>(q.size());
    const auto accelerations = [&](const std::string& text) {
        std::vector<std::string> eval{"eval", temporary("one.toml", text), "--json"};
        for (const auto& [name, value] : q) {
            eval.emplace_back("--at");
            eval.push_back(fmt::format("{}={}", name, value));
        }
        return json_of(eval)["accelerations"];
    };
    std::string driven = contents(scene);
    const Json free = accelerations(driven);
    Eigen::VectorXd torque(6);
    Eigen::Index k = 0;
    for (const auto& [name, value] : q) {
        torque[k] = 2.0 - static_cast<double>(k);
        const std::string unset = "drive_" + name + " = { value = 0,";
        const std::size_t place = driven.find(unset);
        REQUIRE(place != std::string::npos);
        driven.replace(place, unset.size(), fmt::format("drive_{} = {{ value = {},", name, torque[k++]));
    }
    const Json pushed = accelerations(driven);
    Eigen::MatrixXd M(6, 6);
    Eigen::VectorXd change(6);
    k = 0;
    for (const auto& [name, value] : q) {
        const RobotModel::Values loads = model.loads(q, none, {{name, 1.0}}, 0, false);
        Eigen::Index row = 0;
        for (const auto& [other, ignored] : q) M(row++, k) = loads.at(other);
        change[k++] = pushed[name].get<double>() - free[name].get<double>();
    }
    CHECK((M * change - torque).norm() < 1e-11 * torque.norm());
}

TEST_CASE("import: right angles written with few digits are counted, and made exact on request") {
    const auto robot = [](const std::string& rpy) {
        return robot_of(link_of("base") + link_of("arm", heavy) +
                        hinge_of("j", "continuous", "base", "arm",
                                 "<origin xyz=\"0 0 1\" rpy=\"" + rpy + "\"/><axis xyz=\"0 0 1\"/>"));
    };
    const std::string scene = temporary("right.toml", "");
    const auto imported = [&](const std::string& rpy, const std::vector<std::string>& more) {
        std::vector<std::string> args{"import", temporary("r.urdf", robot(rpy)), "-o", scene, "--json"};
        args.insert(args.end(), more.begin(), more.end());
        const auto result = run(args);
        REQUIRE(result.exit == 0);
        return std::pair(Json::parse(result.out)["right_angles"]["rounded"].get<int>(), contents(scene));
    };
    for (const char* angle : {"1.5708", "-1.5707", "3.14", "1.570796", "-4.712", "6.283185"}) {
        CAPTURE(angle);
        const auto [found, text] = imported(std::string(angle) + " 0 0", {});
        CHECK(found == 1);
        CHECK(text.find("pi") == std::string::npos);
        const auto [again, mended] = imported(std::string(angle) + " 0 0", {"--right-angles"});
        CHECK(again == 1);
        CHECK(mended.find("pi") != std::string::npos);
    }
    for (const char* angle : {"1.58", "1.5", "0.7854", "1.5709", "1.5707963267948966", "0", "1.6"}) {
        CAPTURE(angle);
        CHECK(imported(std::string(angle) + " 0 0", {"--right-angles"}).first == 0);
    }
    CHECK(imported("1.5708 -1.57 3.1416", {}).first == 3);
}

TEST_CASE("import: omitted and merged parts are reported, and the scene has limits as comments") {
    const std::string scene = temporary("told.toml", "");
    const auto result = run({"import", source_path("tests/robots/arm6.urdf"), "-o", scene});
    REQUIRE(result.exit == 0);
    for (const char* line :
         {"dropped: <visual>: base_link, shoulder-1, forearm\n", "dropped: <collision>: base_link\n",
          "dropped: <transmission>: t1, t2\n", "dropped: <gazebo>: flange\n",
          "dropped: Coulomb friction of joints, without --friction: j1, j4\n",
          "dropped: limits of joints, without --stops: j1, j2, j3, j5, j6\n",
          "dropped: <limit effort=…>: j1, j2, j3, j5, j6\n", "dropped: <limit velocity=…>: j1, j2, j3, j5, j6\n",
          "dropped: <safety_controller>: j5\n", "dropped: mass that is fixed to the ground: base_link\n",
          "note: 'shoulder-1' is called shoulder_1", "note: j3 starts at 0, outside its limits"})
        CHECK(result.err.find(line) != std::string::npos);
    CHECK(result.out.find("welding_torch is fixed to tool0") != std::string::npos);
    CHECK(contents(scene).find("about = \"limits 0.2 to 2.6\"") != std::string::npos);
    // The torch stands at (0, 0, 0.04) turned by roll 0.1, pitch 0.2, yaw 0.3, then at (0.01, 0, 0.02) from the
    // flange.
    const auto motion = [&](const std::vector<std::string>& args) {
        std::vector<std::string> all{"kinematics", scene, "--of", "flange,tool0,welding_torch", "--json"};
        all.insert(all.end(), args.begin(), args.end());
        return Json::parse(run(all).out);
    };
    const Json k = motion({"--at", "j1=0.3", "--at", "j4=0.7"});
    const auto axes = [&](const char* name) { return k["frames"][name]["values"]["direction_cosines"]; };
    const auto at = [&](const char* name) { return k["points"][name]["values"]["position"]; };
    double tool_to_torch = 0;
    for (int i = 0; i < 3; ++i) {
        const double along_tool =
            0.01 * axes("tool0")[i][0].get<double>() + 0.02 * axes("tool0")[i][2].get<double>();
        CHECK(std::abs(at("welding_torch")[i].get<double>() - at("tool0")[i].get<double>() - along_tool) < 1e-12);
        tool_to_torch += axes("tool0")[i][0].get<double>() * axes("welding_torch")[i][0].get<double>();
    }
    CHECK(std::abs(tool_to_torch - std::cos(M_PI / 4)) < 1e-12);
    const auto torso = run({"import", source_path("tests/robots/torso.urdf"), "-o", scene});
    CHECK(torso.err.find("dropped: joints that move no mass: antenna\n") != std::string::npos);
}

// A hinge without gravity's moment, at rest 0.25 from its stop: friction 0.3 against a torque M gives q'' = (M -
// 0.3)/I.
TEST_CASE("import: friction slows a joint as its file says, and a stop ends its range") {
    const std::string file = temporary(
        "stopped.urdf", robot_of(link_of("a") + link_of("b", heavy) +
                                 hinge_of("j", "revolute", "a", "b",
                                          "<axis xyz=\"0 0 1\"/><limit lower=\"0.25\" upper=\"0.75\" effort=\"1\" "
                                          "velocity=\"1\"/><dynamics friction=\"0.3\"/>")));
    const std::string scene = temporary("stopped.toml", "");
    const auto plain = run({"import", file, "-o", scene});
    CHECK(plain.err.find("dropped: Coulomb friction of joints, without --friction: j\n") != std::string::npos);
    const auto whole = run({"import", file, "-o", scene, "--friction", "--stops", "--drives"});
    REQUIRE(whole.exit == 0);
    CHECK(whole.err.find("Coulomb") == std::string::npos);
    CHECK(whole.err.find("note: j starts at 0.5, between its stops") != std::string::npos);
    std::string text = contents(scene);
    const std::string zero = "drive_j = { value = 0,";
    REQUIRE(text.find(zero) != std::string::npos);
    text.replace(text.find(zero), zero.size(), "drive_j = { value = 1.3,");
    const Json moving = Json::parse(
        run({"simulate", temporary("driven.toml", text), "--duration", "0.3", "--json", "--no-estimate"}).out);
    CHECK(std::abs(moving["final"]["coordinates"]["j"].get<double>() - (0.5 + 0.5 * 1 * 0.09)) < 1e-8);
    const Json stopped = Json::parse(
        run({"simulate", temporary("driven.toml", text), "--duration", "2", "--json", "--no-estimate"}).out);
    CHECK(std::abs(stopped["final"]["coordinates"]["j"].get<double>() - 0.75) < 1e-8);
    const std::string reversed = temporary(
        "reversed.urdf", robot_of(link_of("a") + link_of("b", heavy) +
                                  hinge_of("j", "revolute", "a", "b", "<limit lower=\"1\" upper=\"-1\"/>")));
    CHECK(run({"import", reversed, "-o", scene, "--stops"})
              .err.find("note: j has no stops, because its lower limit is above the upper one") !=
          std::string::npos);
}

// Free, a body of two masses 2 and 1 at 0 and 0.3 falls with g and keeps its rotation, however that is described;
// and a body on a planar joint normal to x does not fall along x.
TEST_CASE("import: a root that floats falls, by angles and by a quaternion; a planar joint keeps its plane") {
    const std::string two =
        temporary("two.urdf", robot_of(link_of("a", heavy) +
                                       link_of("b",
                                               "<inertial><mass value=\"1\"/><inertia ixx=\"0.1\" iyy=\"0.1\" "
                                               "izz=\"0.1\" ixy=\"0\" ixz=\"0\" iyz=\"0\"/></inertial>") +
                                       hinge_of("weld", "fixed", "a", "b", "<origin xyz=\"0.3 0 0\"/>")));
    const std::string scene = temporary("two.toml", "");
    REQUIRE(run({"import", two, "-o", scene, "--floating"}).exit == 0);
    const Json by_angles = Json::parse(run({"eval", scene, "--json"}).out);
    CHECK(std::abs(by_angles["accelerations"]["floating_base_z"].get<double>() + 9.81) < 1e-13);
    // About the mass centre at 0.1: izz = 1 + 0.1 + 2·0.1² + 1·0.2²; the origin of a turns about it.
    const Json turning = Json::parse(run({"eval", scene, "--json", "--at", "floating_base_yaw'=2"}).out);
    CHECK(std::abs(turning["kinetic"].get<double>() - (0.5 * 1.16 * 4 + 0.5 * 3 * 0.2 * 0.2)) < 1e-13);
    CHECK(std::abs(turning["accelerations"]["floating_base_x"].get<double>() - 0.4) < 1e-13);
    REQUIRE(run({"import", two, "-o", scene, "--floating", "--quaternion"}).exit == 0);
    const Json by_quaternion = Json::parse(run({"eval", scene, "--json", "--at", "floating_base_e3'=1"}).out);
    CHECK(std::abs(by_quaternion["accelerations"]["floating_base_x"].get<double>() - 0.4) < 1e-13);
    const std::string flat = temporary(
        "flat.urdf",
        robot_of(link_of("a") + link_of("b", heavy) +
                 hinge_of("table", "planar", "a", "b", "<axis xyz=\"0 1 0\"/><origin rpy=\"0 0 0.5\"/>")));
    REQUIRE(run({"import", flat, "-o", scene}).exit == 0);
    const Json planar = Json::parse(
        run({"eval", scene, "--json", "--at", "table_x=0.7", "--at", "table_y=-0.4"}).out)["accelerations"];
    CHECK(std::abs(std::hypot(planar["table_x"].get<double>(), planar["table_y"].get<double>()) - 9.81) < 1e-13);
    CHECK(std::abs(planar["table_turn"].get<double>()) < 1e-13);
}

TEST_CASE("import: a file that is no robot gives one message, and nothing is written") {
    const std::string limit = "<limit lower=\"-1\" upper=\"1\" effort=\"1\" velocity=\"1\"/>";
    std::string nested = "<robot name=\"r\">";
    for (int k = 0; k < 50000; ++k) nested += "<a>";
    const std::string out = temporary("wrong.toml", "untouched");
    const auto refused = [&](const std::string& text, const std::string& told) {
        CAPTURE(told);
        const auto result = run({"import", temporary("wrong.urdf", text), "-o", out});
        CAPTURE(result.err);
        CHECK(result.exit == 3);
        CHECK(result.err.find("wrong.urdf") != std::string::npos);
        CHECK(result.err.find(told) != std::string::npos);
        CHECK(result.err.find("internal") == std::string::npos);
        CHECK(contents(out) == "untouched");
    };
    refused("", "this is no XML");
    refused("title = \"a scene\"\n", "this is no XML");
    refused("<robot name=\"r\"><link name=\"a\"></robot>", "this is no XML");
    refused("<sdf version=\"1.6\"/>", "no <model> is found; expected one, or some in a <world>");
    refused(nested, "elements stand inside each other");
    refused(robot_of("<xacro:leg name=\"a\"/>"), "is a macro of xacro");
    refused(robot_of(""), "urdfdom refuses it");
    refused(robot_of(link_of("a", heavy) + link_of("a", heavy)), "urdfdom refuses it: link 'a' is not unique");
    refused(robot_of(link_of("a", heavy)), "no joint that moves a mass");
    refused(robot_of(link_of("a") + link_of("b") + hinge_of("j", "continuous", "a", "b")),
            "no link of this robot has a mass");
    refused(robot_of(link_of("a") + link_of("b", heavy) + hinge_of("j", "hinge", "a", "b")), "urdfdom refuses it");
    refused(robot_of(link_of("a") + link_of("b", heavy) + hinge_of("j", "revolute", "a", "c", limit)),
            "urdfdom refuses it: Failed to build tree: child link [c] of joint [j] not found");
    refused(robot_of(link_of("a") + link_of("b", heavy) +
                     hinge_of("j", "continuous", "a", "b", "<axis xyz=\"0 0 0\"/>")),
            "the axis of joint 'j' is zero");
    refused(robot_of(link_of("a") + link_of("b", heavy) +
                     hinge_of("j", "continuous", "a", "b", "<origin xyz=\"0 one 0\"/>")),
            "xyz=\"0 one 0\" of <origin>: 'one' is no number; expected 3 numbers");
    refused(robot_of(link_of("a") + link_of("b", "<inertial><origin rpy=\"0 0\"/>" + heavy.substr(10)) +
                     hinge_of("j", "continuous", "a", "b")),
            "rpy=\"0 0\" of <origin>: these are 2 numbers; expected 3 numbers");
    refused(robot_of(link_of("a") + link_of("b", heavy) +
                     hinge_of("j", "continuous", "a", "b", "<mimic joint=\"k\"/>")),
            "joint 'j' mimics 'k', which is no joint");
    refused(robot_of(link_of("a") + link_of("b", heavy) + link_of("c", heavy) +
                     hinge_of("j", "continuous", "a", "b", "<mimic joint=\"k\"/>") +
                     hinge_of("k", "continuous", "b", "c", "<mimic joint=\"j\"/>")),
            "mimics itself in a circle");
    refused(robot_of(link_of("a") + link_of("b", heavy) + link_of("c", heavy) +
                     hinge_of("j", "continuous", "b", "c") + hinge_of("k", "continuous", "c", "b")),
            "in a circle of joints");
    refused(
        robot_of(link_of("a") + link_of("b", heavy) + link_of("c", heavy) + hinge_of("j", "continuous", "a", "b") +
                 hinge_of("k", "continuous", "a", "c") + hinge_of("l", "continuous", "b", "c")),
        "joint 'l' holds link 'c', which joint 'k' holds already");
    refused(robot_of(link_of("a") + link_of("b", std::regex_replace(heavy, std::regex("\"2\""), "\"-2\"")) +
                     hinge_of("j", "continuous", "a", "b")),
            "the mass of link 'b' is -2");
    refused(robot_of(link_of("a") + link_of("b", std::regex_replace(heavy, std::regex("ixy=\"0\""), "ixy=\"3\"")) +
                     hinge_of("j", "continuous", "a", "b")),
            "link 'b' has the principal moments of inertia -2, 1 and 4, which are not all zero or more");
    CHECK(run({"import", source_path("tests/robots/none.urdf"), "-o", out}).exit == 3);
    CHECK(run({"import", source_path("tests/robots/arm6.urdf"), "-o", "/no/such/folder/x.toml"}).exit == 5);
    CHECK(run({"import", source_path("tests/robots/arm6.urdf")}).exit == 3);
}

}  // namespace commands_import
