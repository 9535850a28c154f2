// SPDX-License-Identifier: MIT
// What a claim may be rewritten with: values that constraints and parameters give, constants that other claims
// give.
#include <doctest/doctest.h>

#include <nlohmann/json.hpp>
#include <string>

#include "program.hpp"
#include "scenes.hpp"

namespace check_rewriting {

using alembert::test::run;
using alembert::test::temporary;
using Json = nlohmann::json;

namespace {

Json check_of(const std::string& scene, const std::string& claims) {
    const auto result = run({"check", scene, temporary("rewriting.claims", claims + "\n"), "--json"});
    INFO(result.err);
    REQUIRE(!result.out.empty());
    return Json::parse(result.out)["claims"][0];
}

}  // namespace

TEST_CASE("check: a coordinate that a constraint holds at zero has the cosine 1 and the sine 0") {
    const std::string scene = temporary("held.toml", R"toml(
[parameters]
m = 1
l = 1
[coordinates]
tilt = 0
x = 0
theta = 0.3
[[particle]]
name = "P"
mass = "m"
position = ["x + l*sin(theta + tilt)", "-l*cos(theta)*cos(tilt)"]
[[constraint]]
name = "upright"
holonomic = "tilt"
)toml");
    for (const char* right : {"cos(tilt) = 1", "sin(theta + tilt) = sin(theta)", "cos(tilt/2) = 1",
                              "exp(tilt) = 1", "cos(pi + tilt) = -1", "cos(theta*tilt) = 1"}) {
        INFO(right);
        CHECK(check_of(scene, right)["verdict"] == "proved");
    }
    for (const char* wrong : {"cos(tilt) = -1", "sin(theta + tilt) = -sin(theta)", "cos(theta*tilt) = -1"}) {
        INFO(wrong);
        CHECK(check_of(scene, wrong)["verdict"] == "refuted");
    }
}

TEST_CASE("check: numbers and parameters stand outside of signs and sizes, with their sign in the scene") {
    const std::string scene = alembert::test::source_path("scenes/friction/coulomb_pendulum.toml");
    for (const char* right : {"m*l^2*theta'' + mu*N*r*sign(theta') + m*g*l*sin(theta) = 0",
                              "sign(-3*r*theta') = -sign(theta')", "abs(-3*r*theta'/l) = 3*r/l*abs(theta')"}) {
        INFO(right);
        CHECK(check_of(scene, right)["verdict"] == "proved");
    }
    for (const char* wrong : {"m*l^2*theta'' - mu*N*r*sign(theta') + m*g*l*sin(theta) = 0",
                              "sign(r*theta') = r*sign(theta')", "abs(r*theta') = abs(theta')"}) {
        INFO(wrong);
        CHECK(check_of(scene, wrong)["verdict"] == "refuted");
    }
}

// Two masses on a string through a hole in a table (Goldstein, Classical Mechanics, chapter 1).
TEST_CASE("check: a constant of the motion may stand in a claim in any way where another claim gives it") {
    const std::string scene = temporary("hole.toml", R"toml(
[parameters]
m1 = 1
m2 = 2
g = 9.81
[coordinates]
r = 1
theta = { initial = 0, rate = 3 }
[[particle]]
name = "A"
mass = "m1"
position = ["r*cos(theta)", "r*sin(theta)"]
[[particle]]
name = "B"
mass = "m2"
position = [0, 0, "r"]
[energy]
potential = "m2*g*r"
)toml");
    const auto verdict = [&](const std::string& claims) {
        return check_of(scene, "constants L\n" + claims)["verdict"];
    };
    const std::string given = "m1*r^2*theta' = L\n";
    CHECK(verdict("(m1+m2)*r'' - L^2/(m1*r^3) + m2*g = 0\n" + given) == "proved");
    CHECK(verdict("(m1+m2)*r'' - L^2/(m1*r^2) + m2*g = 0\n" + given) == "refuted");
    CHECK(verdict("(m1+m2)*r'' - L^2/(m1*r^3) + m2*g = 0\n") == "undecided");
    CHECK(verdict("(m1+m2)*r'' - L^2/(m1*r) + m2*g = 0\nm1*r*theta' = L\n") == "undecided");
}

}  // namespace check_rewriting
