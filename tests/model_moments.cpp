// SPDX-License-Identifier: MIT
// A negative moment of inertia that is only rounding counts as zero, decided everywhere by the same relative
// bound.
#include <doctest/doctest.h>
#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <string>

#include "program.hpp"

namespace model_moments {

using alembert::test::run;
using alembert::test::temporary;
using Json = nlohmann::json;

namespace {

std::string rod(const std::string& inertia, const std::string& about = "") {
    return temporary("rod.toml", fmt::format(R"toml(
gravity = ["g", 0, 0]
[parameters]
g = 9.81
m = 3.0
k = 0.1
J = -1e-20
[coordinates]
a = 0.3
[[frame]]
name = "B"
rotate = [["z", "a"]]
[[point]]
name = "P"
offset = ["k", 0, 0]
axes = "B"
[[body]]
name = "rod"
frame = "B"
mass = "m"
position = [0.3, 0, 0]
axes = "B"
inertia = {}
{}
)toml",
                                             inertia, about));
}

}  // namespace

TEST_CASE("model: negative moments within 1e-9 of the largest count as rounding, wherever they come from") {
    const double expected = Json::parse(run({"eval", rod("[0, 1, 1]"), "--json"}).out)["accelerations"]["a"];
    for (const char* inertia :
         {"[-1e-20, 1, 1]", "[\"J\", 1, 1]", "[-1e-10, 1, 1]", "{ xx = 0, yy = 1, zz = 1, xy = 1e-6 }"}) {
        INFO(inertia);
        const auto result = run({"eval", rod(inertia), "--json"});
        REQUIRE(result.exit == 0);
        CHECK(Json::parse(result.out)["accelerations"]["a"].get<double>() == expected);
    }
    for (const char* inertia : {"[-1e-8, 1, 1]", "[\"1e13*J\", 1, 1]", "[-1e-20, 0, 0]", "\"J\"",
                                "{ xx = 0, yy = 1, zz = 1, xy = 1e-3 }"}) {
        INFO(inertia);
        CHECK(run({"eval", rod(inertia), "--json"}).exit == 3);
    }
}

// A point mass at 0.3, given about P at 0.1: I about the mass centre is 0, of which rounding leaves −3e-19.
TEST_CASE("model: moments about another point are judged relative to the terms of which they are the difference") {
    const std::string about = "about = \"P\"";
    for (const char* inertia : {"[0, \"m*0.2^2\", \"m*(0.3-k)^2\"]", "\"m*(0.3-k)^2\""}) {
        const auto result = run({"eval", rod(inertia, about), "--json"});
        INFO(result.err);
        REQUIRE(result.exit == 0);
        CHECK(Json::parse(result.out)["accelerations"]["a"].get<double>() ==
              doctest::Approx(-9.81 / 0.3 * std::sin(0.3)).epsilon(1e-12));
    }
    CHECK(run({"eval", rod("[0, \"m*0.19^2\", \"m*0.19^2\"]", about)}).exit == 3);
}

}  // namespace model_moments
