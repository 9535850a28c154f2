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

}  // namespace commands_inverse
