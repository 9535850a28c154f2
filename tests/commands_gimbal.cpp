// SPDX-License-Identifier: MIT
// Runs through gimbal lock: near it a quaternion takes the place of the angles (simulate/charts.hpp). Held against
// the same motions of scenes that have a quaternion from the start.
#include <doctest/doctest.h>

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <cmath>
#include <nlohmann/json.hpp>
#include <tuple>
#include <utility>

#include "edits.hpp"
#include "files.hpp"
#include "json.hpp"
#include "program.hpp"
#include "scenes.hpp"

namespace commands_gimbal {

using alembert::test::contents;
using alembert::test::edited;
using alembert::test::Json;
using alembert::test::json_of;
using alembert::test::run;
using alembert::test::source_path;
using alembert::test::temporary;

namespace {

std::string changed(const std::string& name, const std::vector<std::pair<std::string, std::string>>& edits) {
    return temporary(name + "_changed.toml",
                     edited(contents(source_path("scenes/textbook/" + name + ".toml")), edits));
}

Json simulated(const std::string& scene) {
    return json_of({"simulate", scene, "--duration", "25", "--tolerance", "1e-13"});
}

Eigen::Matrix3d turned(const Json& motion) {
    const Json& q = motion["final"]["coordinates"];
    if (q.contains("e0"))
        return Eigen::Quaterniond(q["e0"].get<double>(), q["e1"].get<double>(), q["e2"].get<double>(),
                                  q["e3"].get<double>())
            .toRotationMatrix();
    const auto about = [&](const char* name, const Eigen::Vector3d& axis) {
        return Eigen::AngleAxisd(q[name].get<double>(), axis).toRotationMatrix();
    };
    return about("phi", Eigen::Vector3d::UnitZ()) * about("theta", Eigen::Vector3d::UnitX()) *
           about("psi", Eigen::Vector3d::UnitZ());
}

/// The top hangs, spins with 3 rad/s and swings from theta = 2. With `miss` = 0 its momentum about the vertical is
/// minus that about its axis, so that it passes exactly through theta = pi.
struct Swing {
    double miss;
    double precession() const { return -0.5 * 3 / (1 - std::cos(2.0)) + miss; }
    std::string by_angles() const {
        return changed("heavy_top",
                       {{"initial = 0, rate = 0", fmt::format("initial = 0, rate = {:.17g}", precession())},
                        {"initial = 1, rate = 0", "initial = 2, rate = 0"},
                        {"initial = 0, rate = 4",
                         fmt::format("initial = 0, rate = {:.17g}", 3 - precession() * std::cos(2.0))}});
    }
    /// The fixed point is held by three constraints.
    std::string held() const {
        std::string scene = contents(by_angles());
        scene.erase(scene.find("[[claim]]"));
        const auto replace = [&](const std::string& from, const std::string& to) {
            scene.replace(scene.find(from), from.size(), to);
        };
        replace("psi   =",
                "x = { guess = 0.01, rate_guess = 0 }\ny = { guess = 0.1, rate_guess = 0 }\nz = { guess = -0.3, "
                "rate_guess = 0 }\npsi   =");
        replace("position = [0, 0, \"l\"]\naxes = \"F\"", "position = [\"x\", \"y\", \"z\"]");
        for (const char c : {'x', 'y', 'z'})
            scene += fmt::format(
                "\n[[constraint]]\nname = \"at_{0}\"\nholonomic = \"{0} - l*dot(ez(F), e{0}(N))\"\n", c);
        return temporary("held_top.toml", scene);
    }
    /// The fixed point is a joint.
    std::string by_joint() const {
        return temporary("top_by_joint.toml", fmt::format(R"toml(
gravity = [0, 0, "-1"]
[[body]]
name = "top"
mass = 2
inertia = [0.5, 0.5, 0.5]
[[joint]]
name = "socket"
type = "spherical"
parent = "N"
child = "top"
child_point = [0, 0, -0.5]
angles = "zxz"
[joint.coordinates]
phi = {{ initial = 0, rate = {:.17g} }}
theta = {{ initial = 2 }}
psi = {{ initial = 0, rate = {:.17g} }}
)toml",
                                                          precession(), 3 - precession() * std::cos(2.0)));
    }
    std::string by_quaternion() const {
        return changed(
            "heavy_top_quaternion",
            {{"theta0 = { value = 1.0", "theta0 = { value = 2.0"},
             {"ey(F))\", initial = 0", fmt::format("ey(F))\", initial = {:.17g}", precession() * std::sin(2.0))},
             {"initial = 4", "initial = 3"}});
    }
};

}  // namespace

TEST_CASE("gimbal lock: a gyroscope that passes through it ten times ends where its quaternion says") {
    for (const double miss : {0.0, 1e-3}) {
        CAPTURE(miss);
        const Swing swing{miss};
        const Json angles = simulated(swing.by_angles()), quaternion = simulated(swing.by_quaternion());
        REQUIRE(angles.contains("charts"));
        CHECK(angles["charts"].size() >= 10);
        CHECK(angles["charts"][0]["frame"] == "F");
        CHECK((turned(angles) - turned(quaternion)).norm() < 1e-10);
        CHECK(angles["energy_drift"].get<double>() < 1e-12);
        CHECK_FALSE(quaternion.contains("charts"));
    }
}

namespace {

/// A body on which nothing acts, with the initial values of its angles z-x-z and its moments of inertia.
std::string lone_body(const std::string& psi, const std::string& theta, const std::string& phi,
                      const std::string& inertia) {
    return temporary("lone_body.toml", fmt::format(R"toml(
[coordinates]
psi = {{ initial = 0.3, {} }}
theta = {{ {} }}
phi = {{ initial = 0, {} }}
[[frame]]
name = "F"
rotate = [["z", "psi"], ["x", "theta"], ["z", "phi"]]
[[body]]
name = "body"
mass = 1
frame = "F"
position = [0, 0, 0]
inertia = {}
)toml",
                                                   psi, theta, phi, inertia));
}

}  // namespace

TEST_CASE("gimbal lock: beside it the angles are those of a run that stays in them, at every tolerance") {
    // radau stays in the angles. Six times the body passes the lock at 0.02 to 0.03.
    const std::string scene = lone_body("rate = 0.02", "initial = 1, rate = 1", "rate = 0.001", "[1, 2, 2.5]");
    const auto end = [&](const char* method, const char* tolerance) {
        return json_of({"simulate", scene, "--duration", "50", "--method", method, "--tolerance", tolerance});
    };
    const Json in_angles = end("radau", "1e-13");
    CHECK_FALSE(in_angles.contains("charts"));
    for (const auto& [tolerance, method] :
         {std::pair("1e-4", "verner98"), {"1e-7", "taylor"}, {"1e-13", "verner98"}}) {
        CAPTURE(tolerance);
        CAPTURE(method);
        const Json run = end(method, tolerance);
        CHECK(run["charts"].size() == 6);
        for (const char* name : {"psi", "theta", "phi"})
            CHECK(std::abs(run["final"]["coordinates"][name].get<double>() -
                           in_angles["final"]["coordinates"][name].get<double>()) <
                  100 * std::stod(tolerance) + 1e-9);
        CHECK(run["error_estimate"]["value"].get<double>() < 1000 * std::stod(tolerance) + 1e-9);
    }
}

TEST_CASE("gimbal lock: a motion through it goes on in the same way wherever rows and steps are") {
    // The body turns uniformly about an axis with theta alone; at t = 0.5 and 0.5037 it is in the lock.
    for (const auto& [theta, tolerance, sample] : {std::tuple("0.5", "1e-6", "0.1"),
                                                   {"0.5", "1e-9", "0.1"},
                                                   {"0.5", "1e-12", "0.1"},
                                                   {"0.5037", "1e-9", "0.007"}}) {
        CAPTURE(theta);
        CAPTURE(tolerance);
        CAPTURE(sample);
        const std::string scene =
            lone_body("rate = 0", fmt::format("initial = {}, rate = -1", theta), "rate = 5", "[1, 1, 1e-13]");
        const std::string table = temporary("rows.csv", "");
        const Json motion = json_of({"simulate", scene, "--no-estimate", "--duration", "1", "--tolerance",
                                     tolerance, "--sample", sample, "-o", table});
        const Json& q = motion["final"]["coordinates"];
        CHECK(std::abs(q["psi"].get<double>() - 0.3) < 1e-5);
        CHECK(std::abs(q["theta"].get<double>() - (std::stod(theta) - 1)) < 1e-5);
        CHECK(std::abs(q["phi"].get<double>() - 5) < 1e-5);
    }
}

TEST_CASE("gimbal lock: a gyroscope that constraints or a joint hold passes through it too") {
    const Swing swing{1e-3};
    const Json quaternion = simulated(swing.by_quaternion());
    for (const std::string& scene : {swing.held(), swing.by_joint()}) {
        CAPTURE(scene);
        const Json angles = simulated(scene);
        REQUIRE(angles.contains("charts"));
        CHECK(angles["charts"].size() >= 10);
        CHECK((turned(angles) - turned(quaternion)).norm() < 1e-10);
        CHECK(angles["energy_drift"].get<double>() < 1e-12);
    }
}

TEST_CASE("gimbal lock: where another part of the scene names the angles, the run stays in them and says so") {
    for (const char* more :
         {"[forces]\ntheta = \"-theta'\"\n[[frame]]", "[energy]\npotential = \"cos(2*theta)\"\n[[frame]]",
          "[definitions]\nlean = \"theta\"\n[[frame]]",
          "[[constraint]]\nname = \"c\"\nholonomic = \"phi\"\n[[frame]]"}) {
        CAPTURE(more);
        const auto result = run(
            {"simulate",
             changed("heavy_top", {{"initial = 1, rate = 0", "initial = 0.02, rate = 0.1"}, {"[[frame]]", more}}),
             "--duration", "0.1", "--json"});
        CHECK(result.exit == 0);
        CHECK(result.err.find("the angles of frame 'F' come near gimbal lock, and the run stays in them") !=
              std::string::npos);
        CHECK_FALSE(Json::parse(result.out).contains("charts"));
    }
}

}  // namespace commands_gimbal
