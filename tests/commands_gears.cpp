// SPDX-License-Identifier: MIT
// Rolling rows that vanish at regular poses where they are taken along N: they are therefore taken along the axes
// of the contact. The results are compared with the same mechanism with the rolling condition integrated by hand.
#include <doctest/doctest.h>
#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <string>

#include "program.hpp"

namespace commands_gears {

using alembert::test::run;
using alembert::test::temporary;
using Json = nlohmann::json;

namespace {

std::string planet(const std::string& phi) {
    return fmt::format(R"toml(
[parameters]
M = 2.0
m = 1.0
R = 1.0
r = 0.3
J = 0.5
tau = 1.5
[coordinates]
phi = "{}"
psi = 0
[[frame]]
name = "A"
rotate = [["z", "phi"]]
[[frame]]
name = "B"
rotate = [["z", "psi"]]
[[body]]
name = "arm"
frame = "A"
mass = "M"
inertia = "J"
at = "O"
[[body]]
name = "planet"
frame = "B"
mass = "m"
inertia = "m*r^2/2"
position = ["R + r", 0]
axes = "A"
[[rolling]]
name = "mesh"
body = "planet"
contact = ["-r", 0]
axes = "A"
[[torque]]
on = "arm"
vector = "tau"
[outputs]
tooth = "lambda_mesh_y"
[simulation]
duration = 6
tolerance = 1e-12
[[claim]]
equation = "(J + 3/2*m*(R+r)^2)*phi'' = tau"
source = "energy: the planet turns by psi = (R + r) phi/r"
[[claim]]
equation = "m*r*psi'' = -2*lambda_mesh_y"
)toml",
                       phi);
}

/// φ″ of the planetary gear, with ψ = (R + r) φ/r in T.
const double phi_2 = 1.5 / (0.5 + 1.5 * 1.3 * 1.3);

}  // namespace

TEST_CASE("commands: a planet gear has one degree of freedom at every pose, in every verb") {
    for (const char* phi : {"0", "pi/2", "0.3", "pi"}) {
        const std::string scene = temporary("planet.toml", planet(phi));
        INFO(phi);
        const auto evaluated = run({"eval", scene, "--json"});
        REQUIRE(evaluated.exit == 0);
        const Json at = Json::parse(evaluated.out);
        CHECK(at["accelerations"]["phi"].get<double>() == doctest::Approx(phi_2).epsilon(1e-12));
        CHECK(at["outputs"]["tooth"].get<double>() == doctest::Approx(-0.15 * 1.3 / 0.3 * phi_2).epsilon(1e-12));
        CHECK(Json::parse(run({"derive", scene, "--json"}).out)["degrees_of_freedom"] == 1);
        const Json audited = Json::parse(run({"audit", scene, "--json"}).out);
        CHECK(audited["degrees_of_freedom"] == 1);
        CHECK(audited["notes"].dump().find("along the axes of A") != std::string::npos);
        CHECK(run({"check", scene}).exit == 0);
    }
    CHECK(run({"agree", temporary("planet.toml", planet("0"))}).exit == 0);
}

TEST_CASE("commands: a planet gear's run keeps its digits through all poses") {
    const auto result = run({"simulate", temporary("planet.toml", planet("0")), "--json"});
    REQUIRE(result.exit == 0);
    const Json end = Json::parse(result.out)["final"];
    CHECK(end["coordinates"]["phi"].get<double>() == doctest::Approx(phi_2 * 18).epsilon(1e-10));
    CHECK(end["coordinates"]["psi"].get<double>() == doctest::Approx(phi_2 * 18 * 1.3 / 0.3).epsilon(1e-10));
}

// A ball rolls inside a vertical cylinder. x and y obey the wall, so that its row along the radius follows. It
// neither falls for ever nor rises: z'' = −(5/7) g + (2/7) r' …, and at the start without spin about the radius
// z'' = −5/7 g.
TEST_CASE("commands: a ball in a vertical cylinder can start where a row along N vanishes") {
    for (const char* angle : {"0", "pi/2", "1"}) {
        const std::string scene = temporary("well.toml", fmt::format(R"toml(
gravity = [0, 0, "-g"]
[parameters]
m = 1.0
R = 1.0
r = 0.3
g = 9.81
[coordinates]
x = "0.7*cos({0})"
y = "0.7*sin({0})"
z = 0
a = 0
b = 0
c = 0
[[frame]]
name = "P"
rotate = [["z", "atan2(y, x)"]]
[[frame]]
name = "B"
rotate = [["z", "a"], ["x", "1+b"], ["z", "c"]]
[[body]]
name = "ball"
frame = "B"
mass = "m"
inertia = ["0.4*m*r^2", "0.4*m*r^2", "0.4*m*r^2"]
position = ["x", "y", "z"]
[[constraint]]
name = "wall"
holonomic = "x^2 + y^2 - (R-r)^2"
[[rolling]]
name = "roll"
body = "ball"
contact = ["r", 0, 0]
axes = "P"
)toml",
                                                                     angle));
        const auto result = run({"eval", scene, "--json"});
        INFO(angle << result.err);
        REQUIRE(result.exit == 0);
        const Json at = Json::parse(result.out);
        CHECK(at["accelerations"]["z"].get<double>() == doctest::Approx(-5.0 / 7 * 9.81).epsilon(1e-12));
    }
}

}  // namespace commands_gears
