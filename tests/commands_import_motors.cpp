// SPDX-License-Identifier: MIT
// Motors, equalities and keyframes of MJCF against forces known by hand: those of MuJoCo's documentation, where
// all kinds of motors are one element with one default.
#include <doctest/doctest.h>
#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "files.hpp"
#include "json.hpp"
#include "program.hpp"

namespace commands_import_motors {

using alembert::test::contents;
using alembert::test::Json;
using alembert::test::json_of;
using alembert::test::run;
using alembert::test::temporary;

namespace {

std::string imported(const std::string& robot, const std::vector<std::string>& options = {"--drives"}) {
    const std::string scene = temporary("robot.toml", "");
    json_of({"import", temporary("robot.xml", robot), "-o", scene}, options);
    return scene;
}

double value(const std::string& scene, const char* group, const std::string& name,
             const std::vector<std::string>& at = {}) {
    std::vector<std::string> args{"eval", scene};
    for (const std::string& one : at) args.insert(args.end(), {"--at", one});
    return json_of(args)[group][name].get<double>();
}

/// A ball of 0.1 m at 0.3 m on a hinge, with these defaults and this motor.
std::string hinge(const std::string& defaults, const std::string& motor) {
    return "<mujoco><default>" + defaults +
           "</default><worldbody><body name=\"a\"><joint name=\"a\" axis=\"0 0 1\"/><geom size=\".1\" pos=\".3 0 "
           "0\"/></body></worldbody><actuator>" +
           motor + "</actuator></mujoco>";
}

const double ball = 1000 * 4 * M_PI / 3 * 1e-3, hinge_inertia = ball * (0.4 * 0.01 + 0.09);

}  // namespace

TEST_CASE("import: motors of all kinds share one default, into which each kind writes in the order of the file") {
    const double q = 0.2, v = 0.5, u = 3;
    const std::vector<std::string> at{"a=0.2", "a'=0.5", "drive_m=3"};
    const char* const general = "<general gainprm=\"10\" biastype=\"affine\" biasprm=\"0 -10 -2\"/>";
    const struct {
        const char *defaults, *motor;
        double torque;
    } cases[] = {
        {"", "<motor name=\"m\" joint=\"a\"/>", u},
        {"", "<position name=\"m\" joint=\"a\" kp=\"20\"/>", 20 * (u - q)},
        {general, "<position name=\"m\" joint=\"a\"/>", 10 * (u - q) - 2 * v},
        {general, "<position name=\"m\" joint=\"a\" kp=\"7\" kv=\"1\"/>", 7 * (u - q) - v},
        {general, "<motor name=\"m\" joint=\"a\"/>", u},
        {general, "<velocity name=\"m\" joint=\"a\"/>", 10 * (u - v)},
        {"<position kp=\"40\"/>", "<general name=\"m\" joint=\"a\"/>", 40 * (u - q)},
        {"<position kp=\"40\"/>", "<general name=\"m\" joint=\"a\" biasprm=\"1\"/>", 40 * u + 1 - 40 * q},
        {"<motor gear=\"3\"/>", "<velocity name=\"m\" joint=\"a\" kv=\"2\"/>", 3 * 2 * (u - 3 * v)},
        {"<position kp=\"40\"/><velocity kv=\"5\"/>", "<general name=\"m\" joint=\"a\"/>", 5 * (u - v)},
        {"<position kp=\"40\"/><default class=\"c\"><general biasprm=\"0 -8\"/></default>",
         "<general class=\"c\" name=\"m\" joint=\"a\"/>", 40 * u - 8 * q},
    };
    for (const auto& [defaults, motor, torque] : cases) {
        CAPTURE(defaults);
        CAPTURE(motor);
        CHECK(std::abs(value(imported(hinge(defaults, motor)), "accelerations", "a", at) -
                       torque / hinge_inertia) < 1e-11 * std::abs(torque / hinge_inertia));
    }
}

TEST_CASE("import: defaults of equalities hold for each kind, and a weld without torques lets the body turn") {
    const auto pair = [](const std::string& defaults, const std::string& own) {
        return imported(
            "<mujoco><default>" + defaults +
            "</default><worldbody><body name=\"a\"><joint name=\"a\" axis=\"0 1 0\"/><geom size=\".1\" "
            "pos=\".3 0 0\"/></body><body name=\"b\" pos=\"0 1 0\"><joint name=\"b\" axis=\"0 1 0\"/><geom "
            "size=\".1\" pos=\"0 0 -.3\"/></body></worldbody><equality><joint joint1=\"a\" joint2=\"b\" " +
            own + "/></equality></mujoco>");
    };
    const double alone = 9.81 * 0.3 / (0.4 * 0.01 + 0.09);
    CHECK(std::abs(value(pair("<equality active=\"false\"/>", ""), "accelerations", "a") - alone) < 1e-11);
    CHECK(std::abs(value(pair("<equality active=\"false\"/>", "active=\"true\""), "accelerations", "a") -
                   alone / 2) < 1e-11);
    CHECK(std::abs(value(pair("", ""), "accelerations", "a") - alone / 2) < 1e-11);
    // A box that hangs at its edge, at 0.3 m from its middle: I about that point, and gravity's moment.
    const auto box = [](const std::string& weld) {
        return imported(
            "<mujoco><worldbody><body name=\"a\"><freejoint name=\"a\"/><geom type=\"box\" size=\".1 .2 "
            ".3\" pos=\".3 0 0\"/></body></worldbody><equality><weld body1=\"a\" " +
            weld + "/></equality></mujoco>");
    };
    const double about = (0.01 + 0.09) / 3 + 0.09;  // of a kilogram, about y
    CHECK(std::abs(value(box("torquescale=\"0\""), "accelerations", "a_pitch") - 9.81 * 0.3 / about) < 1e-10);
    CHECK(std::abs(value(box("torquescale=\"1\""), "accelerations", "a_pitch")) < 1e-10);
}

TEST_CASE("import: what a default of an unknown kind of motor leaves is not taken for a plain motor") {
    const auto strict = [](const std::string& defaults, const std::string& motor) {
        const auto told = run({"import",
                               temporary("r.xml", "<mujoco><default>" + defaults +
                                                      "</default><worldbody><body name=\"a\"><joint name=\"j\"/>"
                                                      "<geom size=\".1\" pos=\"1 0 0\"/></body></worldbody>"
                                                      "<actuator>" +
                                                      motor + "</actuator></mujoco>"),
                               "-o", temporary("r.toml", ""), "--drives", "--strict"});
        return told.exit;
    };
    for (const char* kind : {"<muscle/>", "<intvelocity kp=\"3\"/>", "<damper kv=\"2\"/>",
                             "<adhesion gain=\"5\"/>", "<cylinder area=\"2\"/>"}) {
        CAPTURE(kind);
        CHECK(strict(kind, "<general joint=\"j\"/>") == 3);
        CHECK(strict(kind, "<position joint=\"j\" kp=\"3\"/>") == 3);
        CHECK(strict(std::string(kind) + "<general gainprm=\"4\"/>", "<general joint=\"j\"/>") == 3);
        CHECK(strict(kind, "<general joint=\"j\" dyntype=\"none\" gaintype=\"fixed\" biastype=\"affine\"/>") == 3);
        // What says all is known again.
        CHECK(strict(kind, "<motor joint=\"j\"/>") == 0);
        CHECK(strict(kind, "<velocity joint=\"j\" kv=\"3\"/>") == 0);
        CHECK(
            strict(kind,
                   "<general joint=\"j\" dyntype=\"none\" gaintype=\"fixed\" gainprm=\"3\" biastype=\"none\"/>") ==
            0);
    }
}

TEST_CASE("import: thrusters at sites, and motors on free and ball joints, push where and along what they say") {
    // A ball of 0.1 m about the origin of a free body that is turned by a quarter about z: x of the body is y.
    const auto free = [](const std::string& motor) {
        return imported(
            "<mujoco><option gravity=\"0 0 0\"/><worldbody><body name=\"a\" euler=\"0 0 90\"><freejoint "
            "name=\"a\"/><geom size=\".1\"/><site name=\"s\" pos=\"0 .2 0\"/></body></worldbody><actuator>" +
                motor + "</actuator></mujoco>",
            {"--drives"});
    };
    const double moment = ball * 0.4 * 0.01;
    const std::vector<std::string> on{"drive_m=2"};
    const std::string jet = free("<motor name=\"m\" site=\"s\" gear=\"3 0 0 0 0 0\"/>");
    CHECK(std::abs(value(jet, "accelerations", "a_y", on) - 6 / ball) < 1e-11);
    CHECK(std::abs(value(jet, "accelerations", "a_x", on)) < 1e-11);
    CHECK(std::abs(value(jet, "accelerations", "a_yaw", on) + 6 * 0.2 / moment) < 1e-9);
    CHECK(value(jet, "accelerations", "a_y") == 0);
    const std::string push = free("<motor name=\"m\" joint=\"a\" gear=\"3 0 0 0.5 0 0\"/>");
    CHECK(std::abs(value(push, "accelerations", "a_x", on) - 6 / ball) < 1e-11);      // forces along the world
    CHECK(std::abs(value(push, "accelerations", "a_roll", on) - 1 / moment) < 1e-9);  // torques along the body
    const std::string in_parent = free("<motor name=\"m\" jointinparent=\"a\" gear=\"0 0 0 0 0.5 0\"/>");
    CHECK(std::abs(value(in_parent, "accelerations", "a_roll", on) - 1 / moment) < 1e-9);
    // A ball joint between two bodies: the torque on one is borne by the other.
    const std::string two = imported(
        "<mujoco><option gravity=\"0 0 0\"/><worldbody><body name=\"a\"><freejoint name=\"a\"/><geom "
        "size=\".1\"/><body "
        "name=\"b\"><joint name=\"j\" type=\"ball\"/><geom "
        "size=\".1\"/></body></body></worldbody><actuator><general "
        "name=\"m\" joint=\"j\" gear=\"0 0 4\"/></actuator></mujoco>");
    CHECK(std::abs(value(two, "accelerations", "a_yaw", on) + 8 / moment) < 1e-8);
    CHECK(std::abs(value(two, "accelerations", "j_yaw", on) - 16 / moment) < 1e-8);
    const auto left_out = json_of({"import",
                                   temporary("r.xml",
                                             "<mujoco><worldbody><body name=\"a\"><freejoint "
                                             "name=\"a\"/><geom size=\".1\"/></body></worldbody>"
                                             "<actuator><position name=\"m\" joint=\"a\"/>"
                                             "</actuator></mujoco>"),
                                   "-o", temporary("r.toml", ""), "--drives"});
    CHECK(left_out["changes_motion"].size() == 1);
}

TEST_CASE("import: a keyframe of MJCF is the state in which the scene starts") {
    const std::string robot =
        "<mujoco><worldbody><body name=\"a\"><freejoint name=\"a\"/><geom size=\".1\"/><body name=\"b\" pos=\"1 0 "
        "0\">"
        "<joint name=\"j\" axis=\"0 1 0\" ref=\"30\"/><geom size=\".1\" pos=\".2 0 0\"/><body name=\"c\" pos=\"1 "
        "0 0\">"
        "<joint name=\"k\" type=\"ball\"/><geom size=\".1\" pos=\".2 0 "
        "0\"/></body></body></body></worldbody><actuator>"
        "<motor name=\"m\" joint=\"j\"/></actuator><keyframe><key name=\"home\"/><key name=\"up\" qpos=\"1 2 3 "
        "0.6 0 0.8 "
        "0 0.7 0.6 0.8 0 0\" qvel=\"0.1 0.2 0.3 1 2 3 0.5 4 5 6\" ctrl=\"9\"/></keyframe></mujoco>";
    for (const bool quaternion : {false, true}) {
        std::vector<std::string> options{"--drives", "--keyframe", "up"};
        if (quaternion) options.emplace_back("--quaternion");
        const std::string scene = imported(robot, options);
        const Json k = json_of({"eval", scene, "--kinematics"});
        CHECK(std::abs(k["coordinates"]["j"].get<double>() - (0.7 - M_PI / 6)) < 1e-12);
        CHECK(k["rates"]["j"] == 0.5);
        for (int i = 0; i < 3; ++i) {
            const char* const axis[] = {"a_x", "a_y", "a_z"};
            CHECK(k["coordinates"][axis[i]] == i + 1);
            CHECK(std::abs(k["rates"][axis[i]].get<double>() - 0.1 * (i + 1)) < 1e-15);
            CHECK(std::abs(k["frames"]["a"]["values"]["own"]["omega"][i].get<double>() - (i + 1)) < 1e-12);
        }
        // e = (0.6, 0, 0.8, 0): x of the body is (1 − 2·0.64, 0, −2·0.48).
        CHECK(std::abs(k["frames"]["a"]["values"]["direction_cosines"][0][0].get<double>() + 0.28) < 1e-12);
        CHECK(std::abs(k["frames"]["a"]["values"]["direction_cosines"][2][0].get<double>() + 0.96) < 1e-12);
        CHECK(contents(scene).find("drive_m = 9") != std::string::npos);
    }
    const std::string file = temporary("robot.xml", robot), scene = temporary("robot.toml", "");
    CHECK(run({"import", file, "-o", scene})
              .err.find("--keyframe NAME starts in a state that the file names: home, up") != std::string::npos);
    const auto wrong = run({"import", file, "-o", scene, "--keyframe", "down"});
    CHECK(wrong.exit == 3);
    CHECK(wrong.err.find("expected one of: home, up") != std::string::npos);
}

TEST_CASE(
    "import: a keyframe with a zero quaternion keeps its place, and one that turns in gimbal lock needs a "
    "quaternion") {
    const auto robot = [](const std::string& q, const std::string& u) {
        return temporary("robot.xml",
                         "<mujoco><worldbody><body name=\"a\"><freejoint name=\"a\"/><geom size=\".1\"/>"
                         "</body></worldbody><keyframe><key name=\"k\" qpos=\"" +
                             q + "\" qvel=\"" + u + "\"/></keyframe></mujoco>");
    };
    const std::string scene = temporary("robot.toml", "");
    const auto start = [&](const std::string& file, const char* more) {
        std::vector<std::string> args{"import", file, "-o", scene, "--keyframe", "k"};
        if (*more != 0) args.emplace_back(more);
        return run(args);
    };
    for (const char* turning : {"", "--quaternion"}) {
        REQUIRE(start(robot("1 2 3 0 0 0 0", "0 0 0 0 0 0"), turning).exit == 0);
        const Json k = json_of({"eval", scene, "--kinematics"});
        CHECK(k["coordinates"]["a_x"] == 1);
        CHECK(k["coordinates"]["a_z"] == 3);
        CHECK(k["frames"]["a"]["values"]["direction_cosines"][0][0] == 1);
    }
    // A quarter about y.
    const std::string up = "0 0 0 0.70710678118654757 0 0.70710678118654757 0";
    const auto refused = start(robot(up, "0 0 0 1 2 3"), "");
    CHECK(refused.exit == 3);
    CHECK(refused.err.find("state 'k' starts joint 'a'") != std::string::npos);
    CHECK(refused.err.find("--quaternion") != std::string::npos);
    CHECK(start(robot(up, "1 2 3 0 0 0"), "").exit == 0);
    CHECK(start(robot(up, "0 0 0 1 2 3"), "--quaternion").exit == 0);
    const Json k = json_of({"eval", scene, "--kinematics"});
    for (int i = 0; i < 3; ++i)
        CHECK(std::abs(k["frames"]["a"]["values"]["own"]["omega"][i].get<double>() - (i + 1)) < 1e-12);
}

TEST_CASE("import: the damping ratio of a servo is told with its MuJoCo, and refused with --strict") {
    const std::string file =
        temporary("ratio.xml", hinge("", "<position name=\"m\" joint=\"a\" kp=\"20\" dampratio=\"1\"/>"));
    const std::string scene = temporary("ratio.toml", "");
    const auto told = run({"import", file, "-o", scene, "--drives"});
    CHECK(told.exit == 0);
    CHECK(told.err.find("with the inertia of MuJoCo 3; MuJoCo 4 takes the reciprocal of the mobility") !=
          std::string::npos);
    CHECK(std::abs(value(scene, "accelerations", "a", {"a'=1"}) +
                   2 * std::sqrt(20 * hinge_inertia) / hinge_inertia) < 1e-10);
    CHECK(run({"import", file, "-o", scene, "--drives", "--strict"}).exit == 3);
}

}  // namespace commands_import_motors
