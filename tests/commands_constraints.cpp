// SPDX-License-Identifier: MIT
// Constrained scenes: closed forms, conservation, and what is wrong with constraints.
#include <doctest/doctest.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "program.hpp"
#include "scenes.hpp"

using alembert::test::run;
using alembert::test::source_path;
using alembert::test::temporary;
using Json = nlohmann::json;

// v' = a w², w' = −m a v w/(J + m a²): v = c tanh(l t + b), w = c √(m/(J + m a²)) sech(l t + b); angle and place by
// quadrature in 32 digits. Local errors of 1e-11 on some sixty steps of an attracting motion.
TEST_CASE("commands: the Chaplygin sleigh follows its closed form") {
    const auto result = run({"simulate", source_path("scenes/textbook/chaplygin_sleigh.toml"), "--json", "--tolerance", "1e-13"});
    REQUIRE(result.exit == 0);
    const Json json = Json::parse(result.out);
    const Json& end = json["final"];
    CHECK(std::abs(end["coordinates"]["x"].get<double>() + 18.23918484310695690258495) < 1e-10);
    CHECK(std::abs(end["coordinates"]["y"].get<double>() - 6.323136253265931452629073) < 1e-10);
    CHECK(std::abs(end["coordinates"]["phi"].get<double>() - 3.0201244756063002614002546515393) < 1e-10);
    CHECK(std::abs(end["rates"]["phi"].get<double>() - 0.00034352657603529491905111653790) < 1e-10);
    CHECK(json["energy_drift"].get<double>() < 1e-11);
    CHECK(json["constraint_drift"].get<double>() < 1e-12);
}

// A Cartesian pendulum from the horizontal is the angle's pendulum: the same end state by other equations.
TEST_CASE("commands: the Cartesian pendulum moves like the pendulum in its angle, with the tension m(g cos + l w²)") {
    const auto cartesian = run({"simulate", source_path("scenes/textbook/cartesian_pendulum.toml"), "--json", "--tolerance", "1e-12"});
    const std::string angle = temporary("angle.toml", R"toml(
[coordinates]
th = { initial = "pi/2" }
[energy]
kinetic = "th'^2/2"
potential = "-9.81*cos(th)"
[simulation]
duration = 10
tolerance = 1e-13
)toml");
    const auto reference = run({"simulate", angle, "--json"});
    REQUIRE(cartesian.exit == 0);
    REQUIRE(reference.exit == 0);
    const Json end = Json::parse(cartesian.out)["final"], other = Json::parse(reference.out)["final"];
    const double th = other["coordinates"]["th"], w = other["rates"]["th"];
    CHECK(std::abs(end["coordinates"]["x"].get<double>() - std::sin(th)) < 1e-9);
    CHECK(std::abs(end["coordinates"]["y"].get<double>() + std::cos(th)) < 1e-9);
    CHECK(std::abs(end["rates"]["x"].get<double>() - w * std::cos(th)) < 1e-9);
    const auto low = run({"eval", source_path("scenes/textbook/cartesian_pendulum.toml"), "--json", "--at", "x=0", "y=-1", "x'=3"});
    REQUIRE(low.exit == 0);
    CHECK(Json::parse(low.out)["outputs"]["tension"].get<double>() == doctest::Approx(2 * (9.81 + 9)).epsilon(1e-14));
}

TEST_CASE("commands: a four-bar keeps its loop and its energy over a hundred turns of the crank") {
    const auto result = run({"simulate", source_path("scenes/textbook/four_bar.toml"), "--json", "--tolerance", "1e-12", "--duration", "450"});
    REQUIRE(result.exit == 0);
    const Json json = Json::parse(result.out);
    CHECK(json["final"]["coordinates"]["alpha"].get<double>() > 200 * M_PI);
    CHECK(json["constraint_drift"].get<double>() < 1e-12);
    CHECK(json["energy_drift"].get<double>() < 1e-9);
}

TEST_CASE("commands: a constraint that moves does work, and the balance says how much") {
    const std::string scene = temporary("driven.toml", R"toml(
[coordinates]
x = { guess = 1, rate_guess = 0 }
y = 0.2
[[particle]]
name = "P"
mass = 2
position = ["x", "y"]
[[spring]]
between = ["O", "P"]
stiffness = 3
[[constraint]]
name = "slide"
holonomic = "x = 1 + sin(t)/2"
[simulation]
duration = 10
tolerance = 1e-11
)toml");
    const auto result = run({"simulate", scene, "--json"});
    REQUIRE(result.exit == 0);
    const Json json = Json::parse(result.out);
    CHECK(json["energy_drift"].is_null());
    CHECK(json["work_balance"].get<double>() < 1e-9);
    CHECK(json["final"]["coordinates"]["x"].get<double>() == doctest::Approx(1 + std::sin(10.0) / 2).epsilon(1e-12));
}

TEST_CASE("commands: what is wrong with constraints has its message and exit code") {
    const auto scene = [](const std::string& constraint, const std::string& x = "x = 0.6", const std::string& more = "") {
        return temporary("c.toml", "[coordinates]\n" + x + "\ny = 0.8\n[[particle]]\nname = \"P\"\nmass = 1\nposition = [\"x\", \"y\"]\n" +
                                       "[[constraint]]\nname = \"c\"\n" + constraint + "\n" + more);
    };
    const auto fails = [](const std::string& file, int exit, const std::string& message) {
        const auto result = run({"eval", file});
        CAPTURE(result.err);
        CHECK(result.exit == exit);
        CHECK(result.err.find(message) != std::string::npos);
    };
    fails(scene("holonomic = \"x^2 + y^2 - 2\""), 3, "constraint 'c' is off by 1 at the start");
    fails(scene("holonomic = \"x^2 + y^2 + 1\"", "x = { guess = 0.6 }"), 4, "the guesses do not converge");
    fails(scene("nonholonomic = \"x'^2 - y'\""), 3, "not linear in the rates");
    fails(scene("holonomic = \"x'\""), 3, "'nonholonomic'");
    fails(scene("holonomic = \"t - t\""), 3, "contains no coordinate");
    fails(scene("nonholonomic = \"x*y\""), 3, "contains no rate");
    fails(scene("multiplier = \"mu\""), 3, "needs one of 'holonomic' and 'nonholonomic'");
    fails(scene("holonomic = \"x^2 + y^2 = 1\"", "x = 0.6", "[outputs]\nx = \"lambda_d\"\n"), 3, "unknown name 'lambda_d'");
    CHECK(run({"eval", scene("holonomic = \"x^2 + y^2 = 1\""), "--by", "lagrange"}).exit == 3);
    CHECK(run({"eval", scene("holonomic = \"x^2 + y^2 = 1\"")}).exit == 0);
}

TEST_CASE("commands: redundant constraints are named and left out, and the run goes on") {
    const std::string scene = temporary("redundant.toml", R"toml(
gravity = [0, -9.81]
[coordinates]
x = 0.6
y = 0.8
[[particle]]
name = "P"
mass = 1
position = ["x", "y"]
[[constraint]]
name = "circle"
holonomic = "x^2 + y^2 = 1"
[[constraint]]
name = "twice"
holonomic = "2*x^2 + 2*y^2 = 2"
[[constraint]]
name = "rate"
nonholonomic = "x*x' + y*y'"
[simulation]
duration = 2
)toml");
    const auto result = run({"simulate", scene, "--json"});
    CHECK(result.exit == 0);
    CHECK(result.err.find("constraint 'twice' follows from the others") != std::string::npos);
    CHECK(result.err.find("constraint 'rate' follows from the others") != std::string::npos);
    CHECK(result.err.find("circle") == std::string::npos);
    CHECK(Json::parse(result.out)["energy_drift"].get<double>() < 1e-8);
    CHECK(run({"derive", source_path("scenes/textbook/four_bar.toml")}).err.empty());
}

// Two particles on nonlinear springs, H = p²/2 + V(x, y): the composition of order 8 against dop853; then the same with
// what it cannot have, each named.
TEST_CASE("commands: kahanli8 integrates a separable system and refuses the others with the reason") {
    const auto scene = [](const std::string& kinetic, const std::string& more) {
        return temporary("separable.toml", "[coordinates]\nx = { initial = 1 }\ny = { initial = 0.2, rate = 0.3 }\n[energy]\nkinetic = \"" +
                                               kinetic + "\"\npotential = \"x^2/2 + y^2 + x^2*y^2 + y^4/4\"\n" + more);
    };
    const std::string free = scene("x'^2/2 + y'^2", "");
    const auto end = [&](const std::vector<std::string>& more) {
        std::vector<std::string> words{"simulate", free, "--json", "--duration", "20"};
        words.insert(words.end(), more.begin(), more.end());
        const auto result = run(words);
        REQUIRE(result.exit == 0);
        return Json::parse(result.out)["final"]["coordinates"];
    };
    const Json exact = end({"--tolerance", "1e-13"});
    for (const std::vector<std::string>& words :
         {std::vector<std::string>{"--method", "kahanli8", "--step", "0.05"}, {"--method", "gauss", "--step", "0.02"}}) {
        const Json other = end(words);
        for (const char* name : {"x", "y"}) CHECK(std::abs(other[name].get<double>() - exact[name].get<double>()) < 1e-9);
    }
    const auto refused = [&](const std::string& path, const char* reason) {
        const auto result = run({"simulate", path, "--duration", "1", "--method", "verlet", "--step", "0.01"});
        CHECK(result.exit != 0);
        CHECK(result.err.find(reason) != std::string::npos);
    };
    refused(scene("x'^2/2 + (1 + x^2)*y'^2", ""), "the inertia of y changes with the motion");
    refused(scene("x'^2/2 + x*y' + y'^2", ""), "a rate occurs in the equation of");
    refused(source_path("scenes/textbook/cartesian_pendulum.toml"), "there are constraints");
}
