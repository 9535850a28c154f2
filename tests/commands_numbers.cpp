// SPDX-License-Identifier: MIT
// Impossible numbers in a scene, a claim or an option are reported by name and place, and never used.
#include <doctest/doctest.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "program.hpp"
#include "scenes.hpp"

namespace commands_numbers {

using alembert::test::run;
using alembert::test::source_path;
using alembert::test::temporary;
using Json = nlohmann::json;

namespace {

/// A mass on a spring, with this force.
std::string oscillator(const std::string& force, const std::string& start = "0.1") {
    return "[parameters]\nm1 = 1\n[coordinates]\nx = " + start +
           "\n[[particle]]\nname = \"A\"\nmass = \"m1\"\nposition = [\"x\", 0]\n[forces]\nx = \"" + force +
           "\"\n[simulation]\nduration = 1\n";
}

bool says(const std::string& text, const std::string& part) {
    return text.find(part) != std::string::npos;
}

}  // namespace

TEST_CASE("numbers: the root of a negative number inside max, min or sign stops a motion") {
    for (const char* force : {"max(0, sqrt(-x))", "min(0, sqrt(-x))", "sign(sqrt(-x))"}) {
        CAPTURE(force);
        const auto at_once = run({"simulate", temporary("root.toml", oscillator(force))});
        CHECK(at_once.exit == 4);
        CHECK(says(at_once.err, "sqrt(-0.1)"));
        CHECK(run({"eval", temporary("root.toml", oscillator(force))}).exit == 4);
        // x passes zero during the motion.
        CHECK(run({"simulate", temporary("later.toml", oscillator(force, "{ initial = -0.1, rate = 1 }"))}).exit ==
              4);
    }
}

TEST_CASE(
    "numbers: a negative mass is refused in --at and --vary as in the scene, by the particle's name and place") {
    const std::string scene = temporary("mass.toml", oscillator("-x"));
    for (const char* verb : {"eval", "linearize", "inverse"}) {
        CAPTURE(verb);
        const auto result = run({verb, scene, "--at", "m1=-1"});
        CHECK(result.exit == 3);
        CHECK(says(result.err, ":6:"));
        CHECK(says(result.err, "the mass of particle A is -1; expected zero or more"));
    }
    const auto sweep = run({"sweep", scene, "--vary", "m1=2:-2:3"});
    CHECK(sweep.exit == 3);
    CHECK(says(sweep.err, "the mass of particle A is -2; expected zero or more, at m1 = -2"));
    CHECK(run({"sweep", scene, "--vary", "m1=1:2:2"}).exit == 0);
}

TEST_CASE("numbers: a sweep warns of a broken triangle inequality, once for each body") {
    const std::string scene = temporary("triangle.toml", R"toml(
[parameters]
C = 1.5
[coordinates]
a = { initial = 0.1, rate = 1 }
b = 0.2
[[frame]]
name = "F"
rotate = [["z", "a"], ["x", "b"]]
[[body]]
name = "B"
frame = "F"
mass = 1
position = [0, 0, 0]
inertia = [1, 1, "C"]
[simulation]
duration = 0.1
)toml");
    const auto result = run({"sweep", scene, "--vary", "C=1.5:4.5:4"});
    CHECK(result.exit == 0);
    const std::size_t first = result.err.find("triangle inequality");
    REQUIRE(first != std::string::npos);
    CHECK(says(result.err, "at C = 2.5"));
    CHECK(result.err.find("triangle inequality", first + 1) == std::string::npos);
}

TEST_CASE(
    "numbers: what has no value or none in double precision is told with its place, in scenes, claims and "
    "options") {
    for (const char* force :
         {"x*0^0", "x^(0^0)", "1/0", "log(0)", "x/(1-1)", "1e400*x", "x*log(m1-m1)", "x/(m1-m1)"}) {
        CAPTURE(force);
        const std::string scene = temporary("none.toml", oscillator(force));
        for (const char* verb : {"derive", "eval", "audit", "check", "linearize", "impact", "agree"}) {
            CAPTURE(verb);
            const auto result = run({verb, scene});
            CHECK(result.exit == 3);
            CHECK(says(result.err, "none.toml:10:"));
        }
        const auto claim = run({"check", temporary("fine.toml", oscillator("-x")),
                                temporary("claim.txt", std::string("x'' = ") + force + "\n")});
        CHECK(claim.exit == 3);
        CHECK(says(claim.err, "claim.txt:1:"));
    }
    const std::string scene = temporary("fine.toml", oscillator("-x"));
    CHECK(run({"eval", scene, "--at", "m1=1e400"}).exit == 3);
    CHECK(run({"sweep", scene, "--vary", "m1=1:1e400:3"}).exit == 3);
}

TEST_CASE("numbers: impact without a blow leaves the motion of a scene that gives speeds as it is") {
    const auto result = run({"impact", source_path("scenes/textbook/rattleback.toml"), "--json"});
    REQUIRE(result.exit == 0);
    const Json json = Json::parse(result.out),
               before = Json::parse(
                   run({"eval", source_path("scenes/textbook/rattleback.toml"), "--json"}).out)["rates"];
    for (const auto& [name, value] : before.items()) {
        CAPTURE(name);
        CHECK(json["before"][name].get<double>() == doctest::Approx(value.get<double>()).epsilon(1e-12));
        CHECK(json["after"][name].get<double>() == doctest::Approx(value.get<double>()).epsilon(1e-9));
    }
}

TEST_CASE("numbers: fractional powers do not prevent the derivation from ending") {
    // In a^(1/1250), a common denominator of the exponents, this inertia is of degree 3927.
    const std::string body =
        "[parameters]\nm1 = 2\na = 0.66\n[coordinates]\ntheta = 0.3\n[[frame]]\nname = \"F\"\nrotate = [[\"z\", "
        "\"theta\"]]\n"
        "[[body]]\nname = \"B\"\nframe = \"F\"\nmass = \"m1\"\ninertia = \"m1*(a^3.1416/12 + a^2/4 + 1)\"\n"
        "position = [\"a^1.5*sin(theta)\", \"a*cos(theta)\"]\n";
    const auto derived = run({"derive", temporary("power.toml", body)});
    CHECK(derived.exit == 0);
    const auto eval = run({"eval", temporary("power.toml", body), "--json", "--at", "theta'=1", "theta=0"});
    REQUIRE(eval.exit == 0);
    const double a = 0.66;
    CHECK(Json::parse(eval.out)["kinetic"].get<double>() ==
          doctest::Approx(std::pow(a, 3.1416) / 12 + a * a / 4 + 1 + a * a * a).epsilon(1e-14));
}

}  // namespace commands_numbers
