// SPDX-License-Identifier: MIT
// Initial states that obey their constraints up to the rounding of π/2, and numbers on the command line that are
// expressions.
#include <doctest/doctest.h>
#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "program.hpp"
#include "scenes.hpp"

namespace commands_start {

using alembert::test::run;
using alembert::test::source_path;
using alembert::test::temporary;
using Json = nlohmann::json;

namespace {

/// A particle on a circle whose radius's angle is a coordinate too. Each row holds at the start, where each of its
/// terms is 0 up to rounding.
std::string circle(const std::string& constraint, const std::string& x, const std::string& theta,
                   const std::string& rate = "0") {
    return temporary("circle.toml", fmt::format(R"toml(
[parameters]
l = 2.0
[coordinates]
x = "{}"
theta = {{ initial = "{}", rate = "{}" }}
[[particle]]
name = "P"
mass = 1.5
position = ["x", "l*sin(theta)"]
[[constraint]]
name = "c"
{}
)toml",
                                                x, theta, rate, constraint));
}

}  // namespace

TEST_CASE("commands: a start that obeys its constraints up to rounding is accepted, in positions and in rates") {
    for (const auto& [constraint, x, theta] : {
             std::array<const char*, 3>{R"x(holonomic = "x - l*cos(theta)")x", "0", "pi/2"},
             {R"x(holonomic = "x - l*sin(theta)")x", "0", "pi"},
             {R"x(holonomic = "x - l*sin(theta)")x", "0", "100*pi"},
             {R"x(holonomic = "x*l = l^2*(1 + sin(theta))")x", "0", "3*pi/2"},
             {R"x(holonomic = "x - tan(theta)")x", "0", "pi"},
             {R"x(holonomic = "x - atan(l*exp(2)*cos(theta))")x", "0", "pi/2"},
             {R"x(nonholonomic = "x' - cos(theta)*theta'")x", "0", "pi/2"},
             {R"x(nonholonomic = "x' - l*(theta - pi/2 - cos(theta))*theta'")x", "0", "pi/2"},
         }) {
        const auto result = run({"eval", circle(constraint, x, theta, "3*(1-1)"), "--json"});
        INFO(constraint << " " << result.err);
        CHECK(result.exit == 0);
        CHECK(run({"eval", circle(constraint, x, fmt::format("{} + 1e-7", theta), "3"), "--json"}).exit == 3);
    }
    const auto rate =
        run({"eval", circle(R"x(nonholonomic = "x' - cos(theta)*theta'")x", "0", "pi/2", "3"), "--json"});
    CHECK(rate.exit == 0);
    // If the terms are more than rounding, the bound is still 1e-9 of them.
    CHECK(run({"eval", circle(R"x(holonomic = "x - l*sin(theta)")x", "2.000001", "pi/2")}).exit == 3);
}

TEST_CASE("commands: numbers of --at and --vary may be expressions of numbers and pi") {
    const std::string scene = source_path("scenes/textbook/cartesian_pendulum.toml");
    const auto evaluated = run({"eval", scene, "--json", "--at", "x=sin(pi/6)", "y=-sqrt(3)/2", "x'=0"});
    REQUIRE(evaluated.exit == 0);
    const Json at = Json::parse(evaluated.out)["coordinates"];
    CHECK(at["x"].get<double>() == 0.5);
    CHECK(at["y"].get<double>() == doctest::Approx(-std::cos(M_PI / 6)).epsilon(1e-15));

    for (const char* wrong : {"x=2*foo", "x=1/0", "x=sqrt(-1)", "x=", "x=x'", "x=vel(P)", "x=(1", "=1", "x"}) {
        const auto result = run({"eval", scene, "--at", wrong});
        CHECK(result.exit == 3);
        CHECK(result.err.find(fmt::format("--at {}", wrong)) != std::string::npos);
    }
}

// A former version took −0.5 as +0.5 in symbols; d²/dx²(−x³) = −6x there.
TEST_CASE("commands: linearize takes the sign of a number of --at in its symbols too") {
    const std::string scene = temporary("cubic.toml", R"toml(
[parameters]
a = 3.0
[coordinates]
x = 0
[energy]
kinetic = "x'^2/2"
potential = "a*(x/4 - x^3/3)"
)toml");
    const auto result = run({"linearize", scene, "--at", "x=-0.5"});
    REQUIRE(result.exit == 0);
    CHECK(result.out.find("K     a") != std::string::npos);
    CHECK(run({"linearize", scene, "--at", "x=1/2"}).out.find("K     -a") != std::string::npos);
}

}  // namespace commands_start
