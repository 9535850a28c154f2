// SPDX-License-Identifier: MIT
// Scenes of welded bodies alone, which have no coordinates: what their joints bear, against statics.
#include <doctest/doctest.h>
#include <fmt/format.h>

#include <Eigen/Dense>
#include <random>
#include <string>
#include <vector>

#include "json.hpp"
#include "program.hpp"

namespace commands_welded {

using namespace alembert::test;

namespace {

const std::string two = R"toml(
gravity = [0, 0, "-g"]
[parameters]
g = 9.81
[[body]]
name = "A"
mass = 2
inertia = [0.1, 0.1, 0.1]
[[body]]
name = "B"
mass = 2
inertia = [0.1, 0.1, 0.1]
[[joint]]
name = "w1"
type = "fixed"
parent = "N"
child = "A"
parent_point = [1, 0, 0]
[[joint]]
name = "w2"
type = "fixed"
parent = "A"
child = "B"
parent_point = [1, 0, 0]
)toml";

Eigen::Vector3d vector(const Json& v) {
    return {v[0].get<double>(), v[1].get<double>(), v[2].get<double>()};
}

}  // namespace

TEST_CASE("welded: two bodies on a wall hang on their welds") {
    const std::string scene = temporary("welded.toml", two);
    const Json json = json_of({"eval", scene, "--reactions"});
    CHECK(json["coordinates"].empty());
    CHECK(json["kinetic"].get<double>() == 0);
    const Json& joints = json["joint_reactions"];
    CHECK((vector(joints["w1"]["force"]) - Eigen::Vector3d(0, 0, 4 * 9.81)).norm() < 1e-13);
    CHECK((vector(joints["w1"]["moment"]) - Eigen::Vector3d(0, -2 * 9.81, 0)).norm() < 1e-13);
    CHECK((vector(joints["w2"]["force"]) - Eigen::Vector3d(0, 0, 2 * 9.81)).norm() < 1e-13);
    CHECK((vector(joints["w2"]["moment"]) - Eigen::Vector3d(0, 0, 0)).norm() < 1e-13);
    const Run derived = run({"derive", scene, "--reactions"});
    CHECK(derived.exit == 0);
    CHECK(derived.out.find("4*g") != std::string::npos);
    CHECK(json_of({"derive", scene, "--reactions"})["equations"].empty());
    CHECK(json_of({"derive", scene})["degrees_of_freedom"].get<int>() == 0);
    CHECK(json_of({"eval", scene, "--reactions", "--at", "g=1"})["joint_reactions"]["w1"]["force"][2]
              .get<double>() == doctest::Approx(4).epsilon(1e-14));
    CHECK((vector(json_of({"kinematics", scene})["points"]["B"]["values"]["position"]) - Eigen::Vector3d(2, 0, 0))
              .norm() < 1e-14);
    CHECK(json_of({"inertia", scene, "--of", "A,B"})["mass"].get<double>() == 4);
}

TEST_CASE("welded: what moves nothing refuses to be moved") {
    const std::string scene = temporary("welded.toml", two);
    for (const std::vector<std::string>& words : {std::vector<std::string>{"simulate", scene},
                                                  {"sweep", scene, "--vary", "g=1:2:2"},
                                                  {"linearize", scene},
                                                  {"equilibrium", scene},
                                                  {"stability", scene},
                                                  {"audit", scene},
                                                  {"agree", scene},
                                                  {"identify", scene},
                                                  {"inverse", scene},
                                                  {"impact", scene},
                                                  {"bench", scene},
                                                  {"check", scene},
                                                  {"emit", scene, "-o", temporary("folder", "")},
                                                  {"fmu", scene, "-o", temporary("unit.fmu", "")}}) {
        CAPTURE(words[0]);
        const Run told = run(words);
        CAPTURE(told.err);
        CHECK(told.exit == 3);
        CHECK(told.err.find("no coordinates") != std::string::npos);
    }
    CHECK(run({"eval", temporary("none.toml", "[parameters]\nm = 1\n")}).exit == 3);
}

// The weld of a body bears the forces on it and on all that hangs on it, and their moments about its point.
TEST_CASE("welded: chains of bodies turned at random, with forces at points") {
    const unsigned seed = 20261126;
    CAPTURE(seed);
    std::mt19937_64 random(seed);
    std::uniform_real_distribution<double> any(-1, 1);
    const auto some = [&] { return Eigen::Vector3d(any(random), any(random), any(random)); };
    const auto text_of = [](const Eigen::Vector3d& v) {
        return fmt::format("[{:.17g}, {:.17g}, {:.17g}]", v[0], v[1], v[2]);
    };
    for (int again = 0; again < 8; ++again) {
        constexpr int bodies = 4;
        const Eigen::Vector3d gravity = 10 * some();
        std::string text = "gravity = " + text_of(gravity) + "\n";
        Eigen::Matrix3d turn = Eigen::Matrix3d::Identity();
        Eigen::Vector3d place = Eigen::Vector3d::Zero();
        std::vector<Eigen::Matrix3d> axes;
        std::vector<Eigen::Vector3d> centre, point, force;
        std::vector<double> mass;
        for (int k = 0; k < bodies; ++k) {
            const Eigen::Vector3d angles = 3 * some(), from = some(), to = some(), load = 5 * some();
            const double m = 2 + any(random);
            const std::string before = k == 0 ? "N" : fmt::format("B{}", k - 1);
            text += fmt::format(
                "[[body]]\nname = \"B{0}\"\nmass = {1:.17g}\ninertia = [0.1, 0.2, 0.15]\n"
                "[[joint]]\nname = \"w{0}\"\ntype = \"fixed\"\nparent = \"{2}\"\nchild = \"B{0}\"\n"
                "parent_point = {3}\nchild_point = {4}\n"
                "parent_rotate = [[\"x\", {5:.17g}], [\"y\", {6:.17g}], [\"z\", {7:.17g}]]\n"
                "[[force]]\nat = \"B{0}\"\nvector = {8}\n",
                k, m, before, text_of(from), text_of(to), angles[0], angles[1], angles[2], text_of(load));
            const Eigen::Matrix3d joint = turn * (Eigen::AngleAxisd(angles[0], Eigen::Vector3d::UnitX()) *
                                                  Eigen::AngleAxisd(angles[1], Eigen::Vector3d::UnitY()) *
                                                  Eigen::AngleAxisd(angles[2], Eigen::Vector3d::UnitZ()));
            point.push_back(place + turn * from);
            turn = joint;
            axes.push_back(joint);
            place = point.back() - turn * to;
            centre.push_back(place);
            force.push_back(load + m * gravity);
            mass.push_back(m);
        }
        const Json joints = json_of({"eval", temporary("chain.toml", text), "--reactions"})["joint_reactions"];
        for (int k = 0; k < bodies; ++k) {
            CAPTURE(k);
            Eigen::Vector3d F = Eigen::Vector3d::Zero(), M = F;
            for (int j = k; j < bodies; ++j) {
                F -= force[static_cast<std::size_t>(j)];
                M -= (centre[static_cast<std::size_t>(j)] - point[static_cast<std::size_t>(k)])
                         .cross(force[static_cast<std::size_t>(j)]);
            }
            const Json& found = joints[fmt::format("w{}", k)];
            const Eigen::Matrix3d& along = axes[static_cast<std::size_t>(k)];
            CHECK((vector(found["force"]) - along.transpose() * F).norm() < 1e-11);
            CHECK((vector(found["moment"]) - along.transpose() * M).norm() < 1e-11);
        }
    }
}

}  // namespace commands_welded
