// SPDX-License-Identifier: MIT
// Constraints that depend on each other: every verb gives the multipliers of least norm. `eval` computes them in
// floating point; the relations that `derive` prints and `check` proves are compared with these numbers and with
// the Moore-Penrose inverse in this file.
#include <doctest/doctest.h>
#include <fmt/format.h>

#include <Eigen/Dense>
#include <cmath>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "alembert/base/dense.hpp"
#include "json.hpp"
#include "program.hpp"
#include "redundant_plate.hpp"
#include "scenes.hpp"

namespace commands_shares {

using alembert::test::Json;
using alembert::test::json_of;
using alembert::test::redundant_plate;
using alembert::test::run;
using alembert::test::temporary;

namespace {

/// A cylinder that rolls inside a ring, which rolls on the ground: the rows of the inner rolling condition along x
/// and y are cos θ and sin θ times the same row.
std::string ring(const std::string& theta) {
    return fmt::format(R"toml(
gravity = [0, "-g"]
[parameters]
M = 2.0
m = 1.0
R = 1.0
r = 0.3
g = 9.81
[coordinates]
x = 0
phi = 0
theta = "{}"
psi = 0
[[frame]]
name = "A"
rotate = [["z", "phi"]]
[[frame]]
name = "B"
rotate = [["z", "psi"]]
[[body]]
name = "big"
frame = "A"
mass = "M"
inertia = "M*R^2"
position = ["x", "R"]
[[body]]
name = "small"
frame = "B"
mass = "m"
inertia = "m*r^2/2"
position = ["x + (R-r)*sin(theta)", "R - (R-r)*cos(theta)"]
[[rolling]]
name = "ground"
body = "big"
contact = [0, "-R"]
[[rolling]]
name = "in"
body = "small"
on = "big"
contact = ["r*sin(theta)", "-r*cos(theta)"]
)toml",
                       theta);
}

}  // namespace

TEST_CASE("commands: eval's least multipliers are those of Moore and Penrose") {
    const Json json = json_of({"eval", temporary("plate.toml", redundant_plate), "--json"});
    // M q'' = F + Aᵀ λ of all rows: λ = (Aᵀ)⁺ (M q'' − F).
    Eigen::MatrixXd A(3, 3);
    A << 1, 0, 0.5, 2, 1, 1, 0, 3, 0;
    const Json& a = json["accelerations"];
    const Eigen::Vector3d force(2 * a["x"].get<double>() - 3, 2 * a["y"].get<double>() - 1,
                                0.25 * a["phi"].get<double>());
    const Eigen::Vector3d least = alembert::least_norm(A.transpose(), force).x;
    int k = 0;
    for (const char* name : {"lambda_rail", "lambda_again", "lambda_height"})
        CHECK(json["multipliers"][name].get<double>() == doctest::Approx(least[k++]).epsilon(1e-12));
}

TEST_CASE("commands: derive prints all multipliers and what makes them least, and check proves both") {
    for (const std::string& scene :
         {temporary("plate.toml", redundant_plate), temporary("ring.toml", ring("0.5"))}) {
        const Json shown = json_of({"derive", scene, "--json"}), at = json_of({"eval", scene, "--json"});
        CHECK(shown["multipliers"].size() == at["multipliers"].size());
        REQUIRE(shown["shares"].size() == 1);
        std::string claims = shown["shares"][0]["text"].get<std::string>() + "\n";
        for (const Json& equation : shown["equations"]) claims += equation["text"].get<std::string>() + "\n";
        const auto proved = run({"check", scene, temporary("shares.claims", claims)});
        INFO(claims << proved.out);
        CHECK(proved.exit == 0);
    }
}

TEST_CASE(
    "commands: check holds claims on multipliers for the least ones, and says where another share would not do") {
    const std::string scene = temporary("ring.toml", ring("0.5"));
    const auto verdict = [&](const std::string& claim) {
        const auto result = run({"check", scene, temporary("one.claims", claim + "\n"), "--json"});
        return Json::parse(result.out)["claims"][0];
    };
    const Json right = verdict("lambda_in_y*cos(theta) = lambda_in_x*sin(theta)");
    CHECK(right["verdict"] == "proved");
    CHECK(right["reason"].get<std::string>().find("least reactions") != std::string::npos);
    CHECK(verdict("lambda_in_y = 0")["verdict"] == "refuted");
    CHECK(verdict("lambda_in_x = 0")["verdict"] == "refuted");
    const Json whole = verdict("m*r*psi'' = 2*lambda_in_x*cos(theta) + 2*lambda_in_y*sin(theta)");
    CHECK(whole["verdict"] == "proved");
    CHECK(!whole.contains("reason"));
    CHECK(verdict("m*r*psi'' = 2*lambda_in_x*cos(theta)")["verdict"] == "refuted");
}

TEST_CASE("commands: reactions have the share of every row, and sum up to M q'' - F") {
    const std::string scene = temporary("plate.toml", redundant_plate);
    const Json json = json_of({"eval", scene, "--json", "--reactions"});
    double along_y = 0;
    for (const auto& [constraint, by] : json["reactions"].items())
        if (by.contains("y")) along_y += by["y"].get<double>();
    CHECK(json["reactions"].contains("height"));
    CHECK(along_y == doctest::Approx(-1).epsilon(1e-12));
}

TEST_CASE("commands: of rows that depend on each other one is kept that has not vanished at the start") {
    const Json level = json_of({"eval", temporary("ring.toml", ring("pi/2")), "--json"});
    const Json beside = json_of({"eval", temporary("ring.toml", ring("pi/2 - 1e-7")), "--json"});
    for (const char* q : {"x", "phi", "theta", "psi"})
        CHECK(level["accelerations"][q].get<double>() ==
              doctest::Approx(beside["accelerations"][q].get<double>()).epsilon(1e-5));
}

}  // namespace commands_shares
