// SPDX-License-Identifier: MIT
// Motions of trees with quaternions: integrators that share nothing but the right-hand side against each other and
// against Lagrange's equations with a multiplier, and what is conserved.
#include <doctest/doctest.h>
#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "files.hpp"
#include "json.hpp"
#include "program.hpp"

namespace commands_ball_joints {

using alembert::test::Json;
using alembert::test::json_of;
using alembert::test::run;
using alembert::test::source_path;
using alembert::test::temporary;

namespace {

std::string body(const std::string& name, double mass) {
    return fmt::format("[[body]]\nname = \"{}\"\nmass = {}\ninertia = {{ xx = {}, yy = {}, zz = {}, yz = {} }}\n",
                       name, mass, 0.05 * mass, 0.08 * mass, 0.06 * mass, 0.005 * mass);
}

/// A trunk that floats, with four legs of two links; nothing acts from outside.
std::string four_legs() {
    std::string text = body("trunk", 5);
    text +=
        "[[joint]]\nname = \"base\"\ntype = \"free\"\nparent = \"N\"\nchild = \"trunk\"\ncoordinates = { x = 0, y "
        "= 0, "
        "z = { initial = 0.5, rate = 0.2 }, e0 = 0.8, e1 = { initial = 0.6, rate = 0.2 }, e2 = { initial = 0, "
        "rate = "
        "-0.7 }, e3 = { initial = 0, rate = 1.1 } }\n";
    text = text.replace(text.find("e0 = 0.8"), 8, "e0 = { initial = 0.8, rate = -0.15 }");
    int k = 0;
    for (const double ahead : {0.2, -0.2})
        for (const double aside : {0.1, -0.1}) {
            const std::string thigh = fmt::format("thigh{}", ++k), shank = fmt::format("shank{}", k);
            text += body(thigh, 0.8) + body(shank, 0.3);
            text += fmt::format(
                "[[joint]]\nname = \"hip{0}\"\ntype = \"revolute\"\nparent = \"trunk\"\nchild = \"{1}\"\naxis = "
                "\"{2}\"\nparent_point = [{3}, {4}, -0.05]\nchild_point = [0, 0, 0.1]\ncoordinates = {{ h{0} = {{ "
                "initial = 0.{0}, rate = {5} }} }}\n",
                k, thigh, k % 2 == 0 ? "y" : "x", ahead, aside, 0.5 * k);
            text += fmt::format(
                "[[joint]]\nname = \"knee{0}\"\ntype = \"revolute\"\nparent = \"{1}\"\nchild = \"{2}\"\naxis = "
                "\"y\"\nparent_point = [0, 0, -0.1]\nchild_point = [0.01, 0, 0.12]\ncoordinates = {{ k{0} = {{ "
                "initial "
                "= -0.{0}, rate = 1 }} }}\n[[spring]]\nalong = \"k{0}\"\nstiffness = 3\n",
                k, thigh, shank);
        }
    return text;
}

/// An arm whose third link hangs from a spherical joint and carries a fourth.
std::string with_shoulder() {
    std::string text = "gravity = [0, 0, -9.81]\n" + body("A", 2) + body("B", 1.5) + body("C", 1) + body("D", 0.4);
    const auto joint = [&](const char* name, const char* type, const char* parent, const char* child,
                           const char* rest) {
        text += fmt::format(
            "[[joint]]\nname = \"{}\"\ntype = \"{}\"\nparent = \"{}\"\nchild = \"{}\"\nparent_point = [0.05, 0, "
            "-0.2]\nchild_point = [0, 0.03, 0.2]\n{}\n",
            name, type, parent, child, rest);
    };
    joint("j1", "revolute", "N", "A", "axis = \"z\"\ncoordinates = { a = { initial = 0.3, rate = 1 } }");
    joint("j2", "revolute", "A", "B", "axis = \"y\"\ncoordinates = { b = { initial = 0.6, rate = -1 } }");
    joint("ball", "spherical", "B", "C",
          "coordinates = { f0 = 1, f1 = { initial = 0, rate = 0.5 }, f2 = { initial = 0, rate = 1.5 }, f3 = { "
          "initial "
          "= 0, rate = -0.8 } }");
    joint("j3", "revolute", "C", "D", "axis = \"x\"\ncoordinates = { d = { initial = 0.2, rate = 2 } }");
    return text;
}

/// A trunk that floats, with four legs whose hips and ankles are spherical joints: nine turns in space.
std::string spherical_legs(bool by_quaternion) {
    const auto turn = [&](const std::string& e) {
        return by_quaternion ? fmt::format("{0}_0 = 1, {0}_1 = 0, {0}_2 = 0, {0}_3 = 0", e)
                             : fmt::format("{0}_1 = 0.1, {0}_2 = 0.2, {0}_3 = 0.1", e);
    };
    std::string text = "gravity = [0, 0, -9.81]\n" + body("trunk", 5);
    const auto joint = [&](const std::string& name, const char* type, const std::string& parent,
                           const std::string& child, const std::string& points, const std::string& coordinates) {
        text += fmt::format(
            "[[joint]]\nname = \"{}\"\ntype = \"{}\"\nparent = \"{}\"\nchild = \"{}\"\n{}{}coordinates = "
            "{{ {} }}\n",
            name, type, parent, child, points,
            by_quaternion || type == std::string("revolute") ? "" : "angles = \"zyx\"\n", coordinates);
    };
    joint("base", "free", "N", "trunk", "", "x = 0, y = 0, z = 0.5, " + turn("e"));
    int k = 0;
    for (const double ahead : {0.2, -0.2})
        for (const double aside : {0.1, -0.1}) {
            const std::string i = std::to_string(++k),
                              down = "parent_point = [0, 0, -0.1]\nchild_point = [0.01, 0, 0.12]\n";
            text += body("thigh" + i, 0.8) + body("shank" + i, 0.3) + body("foot" + i, 0.3);
            joint("hip" + i, "spherical", "trunk", "thigh" + i,
                  fmt::format("parent_point = [{}, {}, -0.05]\nchild_point = [0, 0, 0.1]\n", ahead, aside),
                  turn("h" + i));
            joint("knee" + i, "revolute", "thigh" + i, "shank" + i, "axis = \"y\"\n" + down, "k" + i + " = 0.3");
            joint("ankle" + i, "spherical", "shank" + i, "foot" + i, down, turn("a" + i));
        }
    return text;
}

/// The end, and E's drift, by a method.
Json end_of(const std::string& scene, const std::vector<std::string>& options) {
    return json_of({"simulate", scene, "--duration", "1.5", "--no-estimate"}, options);
}

double difference(const Json& a, const Json& b) {
    double largest = 0;
    for (const char* group : {"coordinates", "rates"})
        for (const auto& [name, value] : a["final"][group].items())
            largest = std::max(largest, std::abs(value.get<double>() - b["final"][group][name].get<double>()));
    return largest;
}

void check_methods(const std::string& scene) {
    const Json expected = end_of(scene, {"--by", "routh", "--method", "dop853", "--tolerance", "1e-13"});
    CHECK(expected["formulation"].get<std::string>().find("routh") == 0);
    for (const std::vector<std::string>& options :
         {std::vector<std::string>{"--method", "dop853", "--tolerance", "1e-13"},
          {"--method", "verner98", "--tolerance", "1e-13"},
          {"--method", "taylor", "--tolerance", "1e-13"},
          {"--method", "radau", "--tolerance", "1e-12"},
          {"--method", "gauss", "--step", "0.001"}}) {
        CAPTURE(options[1]);
        const Json motion = end_of(scene, options);
        CHECK(motion["formulation"].get<std::string>().find("recursive") != std::string::npos);
        // Hundreds of steps of a tolerance of 1e-13, and 0.001⁶ times the sixth powers of rates near 10 by gauss.
        CHECK(difference(expected, motion) < 1e-10);
        CHECK(std::abs(motion["energy_drift"].get<double>()) < 1e-10);
        CHECK(motion["constraint_drift"].get<double>() < 1e-12);
    }
}

Json momentum_of(const std::string& scene, const Json& at) {
    std::vector<std::string> args{"kinematics", scene, "--json", "--jacobian"};
    for (const auto& [group, prime] : {std::pair("coordinates", ""), std::pair("rates", "'")})
        for (const auto& [name, value] : at[group].items()) {
            args.emplace_back("--at");
            args.push_back(
                fmt::format("{}{}={:.17g}", name.substr(0, name.find('\'')), prime, value.get<double>()));
        }
    return json_of(args)["mass_centre"];
}

}  // namespace

TEST_CASE("ball joints: on a floating trunk with legs, all methods go to the end that Lagrange's equations give") {
    const std::string scene = temporary("four_legs.toml", four_legs());
    check_methods(scene);
    const Json start = json_of({"simulate", scene, "--json", "--duration", "0", "--no-estimate"}),
               motion = end_of(scene, {"--method", "taylor", "--tolerance", "1e-13"});
    const Json before = momentum_of(scene, start["final"]), after = momentum_of(scene, motion["final"]);
    for (const char* name : {"linear_momentum", "angular_momentum"})
        for (std::size_t k = 0; k < 3; ++k)
            CHECK(after[name][k].get<double>() == doctest::Approx(before[name][k].get<double>()).epsilon(1e-11));
}

TEST_CASE("ball joints: with a spherical joint inside a tree, all methods go to the same end") {
    check_methods(temporary("with_shoulder.toml", with_shoulder()));
}

// With so many joints the accelerations come from articulated bodies, and the series from the same code.
TEST_CASE(
    "ball joints: a quadruped that floats by a quaternion goes to one end by steps of a series and of "
    "Runge-Kutta") {
    const std::string scene = temporary("quadruped.toml", "");
    REQUIRE(run({"import", source_path("tests/robots/quadruped.urdf"), "-o", scene, "--quaternion"}).exit == 0);
    std::string text = alembert::test::contents(scene);
    const auto start = [&](const std::string& name, const std::string& value) {
        const std::string before = name + " = { initial = ";
        const std::size_t at = text.find(before);
        REQUIRE(at != std::string::npos);
        text.replace(at + before.size(), text.find('}', at) - at - before.size(), value + " ");
    };
    start("world_to_trunk_e0", "0.8, rate = -0.3");
    start("world_to_trunk_e1", "0.6, rate = 0.4");
    start("world_to_trunk_e3", "0, rate = -0.7");
    int k = 0;
    for (const char* leg : {"LF", "RF", "LH", "RH"})
        for (const char* joint : {"hip", "thigh", "calf"}) {
            ++k;
            start(fmt::format("{}_{}_joint", leg, joint), fmt::format("0.{}, rate = {}", k % 9, 1 - 0.2 * k));
        }
    const std::string moved = temporary("quadruped_moved.toml", text);
    const auto end = [&](const char* method) {
        const Json motion = json_of({"simulate", moved, "--json", "--no-estimate", "--duration", "0.2",
                                     "--tolerance", "1e-12", "--method", method});
        CHECK(motion["formulation"].get<std::string>().find("articulated bodies") != std::string::npos);
        return motion;
    };
    CHECK(difference(end("dop853"), end("taylor")) < 1e-11);
}

TEST_CASE("ball joints: robots that turn by quaternions take at most 1.15 times the operations of angles") {
    const auto operations = [](const std::string& scene) {
        const Json emitted = json_of({"emit", scene, "--json", "-o", temporary("floats", "") + ".d"});
        return emitted["operations"].get<double>();
    };
    const auto quadruped = [&](const std::vector<std::string>& options) {
        const std::string scene = temporary("floats.toml", "");
        std::vector<std::string> args{"import", source_path("tests/robots/quadruped.urdf"), "-o", scene};
        args.insert(args.end(), options.begin(), options.end());
        REQUIRE(run(args).exit == 0);
        return operations(scene);
    };
    CHECK(quadruped({"--quaternion"}) < 1.15 * quadruped({}));
    CHECK(operations(temporary("spherical_legs.toml", spherical_legs(true))) <
          1.15 * operations(temporary("spherical_legs.toml", spherical_legs(false))));
}

}  // namespace commands_ball_joints
