// SPDX-License-Identifier: MIT
// Roots on the sheet of the initial state, and formulas that are right on one branch. Proved formulas are compared
// with `eval`, which computes the roots themselves in floating point.
#include <doctest/doctest.h>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "program.hpp"
#include "scenes.hpp"

namespace check_sheets {

using alembert::test::run;
using alembert::test::temporary;
using Json = nlohmann::json;

namespace {

/// A mass on a spring from the origin, in polar coordinates.
std::string spring_pendulum(const std::string& r, const std::string& spring = R"(between = ["O", "P"])") {
    return temporary("spring.toml", fmt::format(R"toml(
gravity = [0, "g"]
[parameters]
m = 1.2
k = 30.0
l0 = 0.8
g = 9.81
[coordinates]
r = {}
th = {{ initial = 0.4, rate = 0.5 }}
[[particle]]
name = "P"
mass = "m"
position = ["r*sin(th)", "r*cos(th)"]
[[spring]]
{}
stiffness = "k"
length = "l0"
)toml",
                                                r, spring));
}

Json check_of(const std::string& scene, const std::string& claim) {
    const auto result = run({"check", scene, temporary("sheet.claims", claim + "\n"), "--json"});
    INFO(result.err);
    REQUIRE(!result.out.empty());
    return Json::parse(result.out)["claims"][0];
}

const std::string right = "r'' - r*th'^2 - g*cos(th) + k/m*(r - l0) = 0";
const std::string mirrored = "r'' - r*th'^2 - g*cos(th) + k/m*(r + l0) = 0";

}  // namespace

TEST_CASE("derive: a sign that is used is told as a person writes it") {
    const std::string scene = temporary("signs.toml", R"toml(
[parameters]
F = -2
a = 3
b = 1
[coordinates]
x = 1
[[particle]]
name = "P"
mass = 1
position = ["x", 0]
[forces]
x = "abs(F)*sqrt((a - b)^2)*x"
)toml");
    const auto derived = run({"derive", scene, "--json"});
    REQUIRE(derived.exit == 0);
    CHECK(Json::parse(derived.out)["where"] == Json::array({"F < 0", "a - b > 0"}));
    CHECK(run({"derive", scene}).out.find("valid while F < 0") != std::string::npos);
}

TEST_CASE("check: a spring's length along its coordinate is that coordinate, on the sheet of the initial state") {
    for (const char* spring : {R"(between = ["O", "P"])", R"x(along = "sqrt(r^2)")x",
                               R"x(along = "sqrt(r^2*sin(th)^2 + r^2*cos(th)^2)")x", R"x(along = "norm(pos(P))")x",
                               R"x(along = "(r^2)^(1/2)")x"}) {
        const std::string scene = spring_pendulum("1.1", spring);
        INFO(spring);
        const auto derived = run({"derive", scene, "--json"});
        REQUIRE(derived.exit == 0);
        CHECK(derived.out.find("sqrt") == std::string::npos);
        CHECK(Json::parse(derived.out)["where"] == Json::array({"r > 0"}));
        CHECK(run({"derive", scene}).out.find("valid while r > 0") != std::string::npos);
        const Json claim = check_of(scene, right);
        CHECK(claim["verdict"] == "proved");
        CHECK(claim["where"] == Json::array({"r > 0"}));
        const Json wrong = check_of(scene, mirrored);
        CHECK(wrong["verdict"] == "refuted");
        CHECK(wrong["counterexample"]["r"].get<std::string>()[0] != '-');
        CHECK(check_of(scene, "r'' = r*th'^2 + g*cos(th) - k/m*(norm(pos(P)) - l0)")["verdict"] == "proved");
    }
}

TEST_CASE("check: a coordinate that starts negative is on the other sheet, and eval agrees") {
    const std::string scene = spring_pendulum("-1.1");
    CHECK(check_of(scene, mirrored)["verdict"] == "proved");
    CHECK(check_of(scene, mirrored)["where"] == Json::array({"r < 0"}));
    CHECK(check_of(scene, right)["verdict"] == "refuted");
    const auto result = run({"eval", scene, "--json"});
    REQUIRE(result.exit == 0);
    const double a = Json::parse(result.out)["accelerations"]["r"];
    CHECK(a == doctest::Approx(-1.1 * 0.25 + 9.81 * std::cos(0.4) - 30 / 1.2 * (-1.1 + 0.8)).epsilon(1e-13));
}

TEST_CASE("check: no sign is assumed if a root's argument may pass zero, nor for a bouncing force") {
    const std::string bouncing = temporary("bouncing.toml", R"toml(
[parameters]
m = 1.0
k = 2.0
[coordinates]
x = 0.5
[energy]
kinetic = "m*x'^2/2"
[forces]
x = "-k*abs(x)"
)toml");
    CHECK(check_of(bouncing, "m*x'' = -k*abs(x)")["verdict"] == "proved");
    CHECK(check_of(bouncing, "m*x'' = -k*x")["verdict"] == "refuted");
    CHECK(!check_of(bouncing, "m*x'' = -k*abs(x)").contains("where"));
    const std::string between = temporary("between.toml", R"toml(
[parameters]
m = 1.0
k = 2.0
l = 1.0
[coordinates]
x = 0
[energy]
kinetic = "m*x'^2/2"
[[spring]]
along = "sqrt(x^2)"
stiffness = "k"
length = "l"
)toml");
    const auto result = run({"derive", between, "--json"});
    CHECK(!Json::parse(result.out).contains("where"));
}

TEST_CASE("check: a formula of a slider-crank with a root is proved on the branch of the start, which is named") {
    const auto crank = [](const char* x) {
        return temporary("crank.toml", fmt::format(R"toml(
[parameters]
r = 0.5
l = 1.3
m = 2.0
J = 0.4
[coordinates]
th = {{ initial = 0.7, rate = 1 }}
x = {{ guess = {}, rate_guess = 0 }}
[energy]
kinetic = "J*th'^2/2 + m*x'^2/2"
[[constraint]]
name = "rod"
holonomic = "(x - r*cos(th))^2 + r^2*sin(th)^2 - l^2"
)toml",
                                                   x));
    };
    const std::string outer = "x = r*cos(th) + sqrt(l^2 - r^2*sin(th)^2)",
                      inner = "x = r*cos(th) - sqrt(l^2 - r^2*sin(th)^2)",
                      rate = "x' = -r*th'*sin(th) - r^2*th'*sin(th)*cos(th)/sqrt(l^2 - r^2*sin(th)^2)";
    for (const auto& [start, good, bad] :
         {std::array{"1.6", outer.c_str(), inner.c_str()}, std::array{"-0.8", inner.c_str(), outer.c_str()}}) {
        const std::string scene = crank(start);
        const Json proved = check_of(scene, good);
        CHECK(proved["verdict"] == "proved");
        REQUIRE(proved.contains("where"));
        CHECK(proved["where"].size() == 1);
        CHECK(proved["where"][0].get<std::string>().find("> 0") != std::string::npos);
        CHECK(check_of(scene, bad)["verdict"] == "refuted");
    }
    CHECK(check_of(crank("1.6"), rate)["verdict"] == "proved");
    CHECK(check_of(crank("-0.8"), rate)["verdict"] == "refuted");
    CHECK(check_of(crank("1.6"), "x = r*cos(th) + sqrt(l^2 - r^2*cos(th)^2)")["verdict"] == "refuted");
}

TEST_CASE("check: what a claim assumes stands above the initial state, is told as typed, and must be possible") {
    const std::string scene = temporary("assumed.toml", R"toml(
[parameters]
m = 0.5
k = 2.9
s = 0.7
[coordinates]
x = { initial = -0.6, rate = 0.6 }
[[particle]]
name = "P"
mass = "m"
position = ["x", 0]
[forces]
x = "-k*x - s*sign(x)"
)toml");
    const auto verdicts = [&](const char* assumed) {
        return Json::parse(run({"check", scene,
                                temporary("assumed.claims", fmt::format("where {}\n"
                                                                        "m*x'' + k*sqrt(x^2) + s = 0\n"
                                                                        "m*x'' - k*sqrt(x^2) - s = 0\n",
                                                                        assumed)),
                                "--json"})
                               .out)["claims"];
    };
    for (const auto& [assumed, first, second] :
         {std::array{"x > 0", "proved", "refuted"}, std::array{"x - 1000 > 0", "proved", "refuted"},
          std::array{"x < -1/2", "refuted", "proved"}, std::array{"x^2 + x'^2 < -1", "undecided", "undecided"}}) {
        INFO(assumed);
        const Json claims = verdicts(assumed);
        CHECK(claims[0]["verdict"] == first);
        CHECK(claims[1]["verdict"] == second);
        const Json& where = claims[0]["where"];
        CHECK(std::find(where.begin(), where.end(), assumed) != where.end());
        for (const Json& words : where) CHECK(words.get<std::string>().find('z') == std::string::npos);
    }
}

TEST_CASE("check: what a verdict rests on is told by its kind") {
    using Texts = std::vector<std::pair<std::string, std::string>>;
    const auto assumed = [](const std::string& scene, const std::string& claim) {
        const auto result = run({"check", scene, temporary("rests.claims", claim + "\n"), "--json"});
        INFO(result.err);
        REQUIRE(!result.out.empty());
        Texts texts;
        const Json claims = Json::parse(result.out)["claims"];
        for (const Json& one : claims.back()["assumed"]) texts.emplace_back(one["kind"], one["text"]);
        return texts;
    };
    CHECK(assumed(spring_pendulum("1.1"), right) == Texts{{"side", "r > 0"}});
    CHECK(assumed(spring_pendulum("1.1"), "where th > 0\n" + right) ==
          Texts{{"side", "r > 0"}, {"stated", "th > 0"}});
    CHECK(assumed(spring_pendulum("1.1"), "where th > 0\n" + right + "\nwhere\n" + right) ==
          Texts{{"side", "r > 0"}});
    const auto particle = [](const std::string& more) {
        return temporary("rests.toml",
                         "[parameters]\nm = 1\nF = -2\n[coordinates]\nx = 1\ny = 1\n[[particle]]\nname = \"P\"\n"
                         "mass = \"m\"\nposition = [\"x\", \"y\"]\n[forces]\nx = \"F\"\n" +
                             more);
    };
    CHECK(assumed(particle(""), "m*x'' = F").empty());
    CHECK(assumed(particle(""), "m*x'' = -abs(F)") == Texts{{"parameter", "F < 0"}});
    const std::string bound = particle("[[constraint]]\nname = \"z\"\nholonomic = \"x^2 - y^2\"\n");
    CHECK(assumed(bound, "x = y") == Texts{{"branch", "the branch of the constraints on which the scene starts"}});
    CHECK(assumed(bound, "x^2 = y^2").empty());
    const std::string wall = particle("[[unilateral]]\nname = \"wall\"\ngap = \"x - 1\"\n");
    CHECK(assumed(wall, "m*x'' = F").empty());
    CHECK(assumed(wall, "closed wall\nx'' = 0") == Texts{{"closed", "contact wall is closed"}});
}

TEST_CASE(
    "check: an initial state that a claim's assumption excludes decides nothing, nor does another claim's root") {
    const auto verdicts = [](const std::string& scene, const std::string& claims) {
        std::vector<std::string> result;
        const auto told = run({"check", scene, temporary("apart.claims", claims), "--json"});
        INFO(told.err);
        const Json json = Json::parse(told.out);
        for (const Json& claim : json["claims"]) result.push_back(claim["verdict"]);
        return result;
    };
    using Words = std::vector<std::string>;
    const std::string circle = temporary("circle.toml", R"toml(
[parameters]
l = 1
[coordinates]
x = { initial = 0, rate = 1 }
y = -1
[energy]
kinetic = "(x'^2 + y'^2)/2"
[[constraint]]
name = "c"
holonomic = "x^2 + y^2 - l^2"
)toml");
    CHECK(verdicts(circle,
                   "y = -sqrt(l^2 - x^2)\nwhere y > 0\ny = -sqrt(l^2 - x^2)\ny = sqrt(l^2 - x^2)\n"
                   "x*(y + sqrt(l^2 - x^2)) = 0\nwhere\nwhere x + y > 5\ny = -sqrt(l^2 - x^2)\nwhere\n"
                   "where y < 0\ny = -sqrt(l^2 - x^2)\ny = sqrt(l^2 - x^2)\n") ==
          Words{"proved", "refuted", "proved", "refuted", "refuted", "proved", "refuted"});
    const std::string spring = temporary("left.toml", R"toml(
[parameters]
k = 1
[coordinates]
x = -2
[energy]
kinetic = "x'^2/2"
potential = "k*x^2/2"
)toml");
    for (const char* const root : {"", "sqrt(x^2) = -x\n"}) {
        Words found = verdicts(spring, std::string(root) +
                                           "where k > 0\nabs(x) = -x\nx'' = k*abs(x)\nwhere\nwhere x > 0\n"
                                           "x'' = -k*x\nx'' = -k*sqrt(x^2)\nx'' = k*sqrt(x^2)\n");
        if (*root != 0) found.erase(found.begin());
        CHECK(found == Words{"refuted", "refuted", "proved", "proved", "refuted"});
    }
}

}  // namespace check_sheets
