// SPDX-License-Identifier: MIT
// Constrained scenes: closed forms, conservation, and what is wrong with constraints.
#include <doctest/doctest.h>

#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "json.hpp"
#include "program.hpp"
#include "scenes.hpp"

namespace commands_constraints {

using alembert::test::Json;
using alembert::test::json_of;
using alembert::test::run;
using alembert::test::source_path;
using alembert::test::temporary;

// v' = a w², w' = −m a v w/(J + m a²): v = c tanh(l t + b), w = c √(m/(J + m a²)) sech(l t + b); angle and
// position by quadrature in 32 digits. The local errors are 1e-11 in about sixty steps of an attracting motion.
TEST_CASE("commands: the Chaplygin sleigh follows its closed form") {
    const auto result =
        run({"simulate", source_path("scenes/textbook/chaplygin_sleigh.toml"), "--json", "--tolerance", "1e-13"});
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

// A Cartesian pendulum released from the horizontal reaches the same end state as the pendulum in its angle, by
// other equations.
TEST_CASE(
    "commands: the Cartesian pendulum moves like the pendulum in its angle, with the tension m(g cos + l w²)") {
    const auto cartesian = run(
        {"simulate", source_path("scenes/textbook/cartesian_pendulum.toml"), "--json", "--tolerance", "1e-12"});
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
    const auto low = run(
        {"eval", source_path("scenes/textbook/cartesian_pendulum.toml"), "--json", "--at", "x=0", "y=-1", "x'=3"});
    REQUIRE(low.exit == 0);
    CHECK(Json::parse(low.out)["outputs"]["tension"].get<double>() ==
          doctest::Approx(2 * (9.81 + 9)).epsilon(1e-14));
}

TEST_CASE("commands: a four-bar keeps its loop and its energy over a hundred turns of the crank") {
    const auto result = run({"simulate", source_path("scenes/textbook/four_bar.toml"), "--json", "--tolerance",
                             "1e-12", "--duration", "450"});
    REQUIRE(result.exit == 0);
    const Json json = Json::parse(result.out);
    CHECK(json["final"]["coordinates"]["alpha"].get<double>() > 200 * M_PI);
    CHECK(json["constraint_drift"].get<double>() < 1e-12);
    CHECK(json["energy_drift"].get<double>() < 1e-9);
}

TEST_CASE("commands: a moving constraint does work, which the balance contains") {
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
    CHECK(json["final"]["coordinates"]["x"].get<double>() ==
          doctest::Approx(1 + std::sin(10.0) / 2).epsilon(1e-12));
}

TEST_CASE("commands: mistakes in constraints have their messages and exit codes") {
    const auto scene = [](const std::string& constraint, const std::string& x = "x = 0.6",
                          const std::string& more = "") {
        return temporary("c.toml",
                         "[coordinates]\n" + x +
                             "\ny = 0.8\n[[particle]]\nname = \"P\"\nmass = 1\nposition = [\"x\", \"y\"]\n" +
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
    fails(scene("holonomic = \"x^2 + y^2 = 1\"", "x = { guess = 0.6 }",
                "[[constraint]]\nname = \"d\"\nholonomic = \"2*x^2 + 2*y^2 = 3\"\n"),
          3, "constraints 'c' and 'd' contradict each other");
    fails(scene("nonholonomic = \"x'^2 - y'\""), 3, "not linear in the rates");
    fails(scene("holonomic = \"x'\""), 3, "'nonholonomic'");
    fails(scene("holonomic = \"t - t\""), 3, "contains no coordinate");
    fails(scene("nonholonomic = \"x*y\""), 3, "contains no rate");
    fails(scene("multiplier = \"mu\""), 3, "needs one of 'holonomic' and 'nonholonomic'");
    fails(scene("holonomic = \"x^2 + y^2 = 1\"", "x = 0.6", "[outputs]\nx = \"lambda_d\"\n"), 3,
          "unknown name 'lambda_d'");
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

// The rod of a pendulum pulls with m (g cos + l w²) along itself: at 30° from the lowest point, turning with 2
// rad/s.
TEST_CASE("commands: reactions along the coordinates are those of the free body") {
    const double th = 0.5235987755982988, w = 2, m = 2, g = 9.81;
    const auto at = [&](const char* name, double value) { return fmt::format("{}={:.17g}", name, value); };
    const auto result = run({"eval", source_path("scenes/textbook/cartesian_pendulum.toml"), "--json",
                             "--reactions", "--at", at("x", std::sin(th)), at("y", -std::cos(th)),
                             at("x'", w * std::cos(th)), at("y'", w * std::sin(th))});
    REQUIRE(result.exit == 0);
    const Json rod = Json::parse(result.out)["reactions"]["rod"];
    const double tension = m * (g * std::cos(th) + w * w);
    CHECK(rod["x"].get<double>() == doctest::Approx(-tension * std::sin(th)).epsilon(1e-13));
    CHECK(rod["y"].get<double>() == doctest::Approx(tension * std::cos(th)).epsilon(1e-13));
    const auto shown = run({"derive", source_path("scenes/textbook/cartesian_pendulum.toml"), "--reactions"});
    CHECK(shown.out.find("Q(x) of rod = 2*x*lambda_rod") != std::string::npos);
}

TEST_CASE("commands: constraints that hold together only if the coordinates obey a relation are refused") {
    const std::string scene = temporary("hidden.toml", R"toml(
[coordinates]
x = 0
y = 1
z = 0
[energy]
kinetic = "(x'^2+y'^2+z'^2)/2"
[[constraint]]
name = "a"
nonholonomic = "x' = y*z'"
[[constraint]]
name = "b"
nonholonomic = "x' = y*z' + z"
)toml");
    for (const char* verb : {"derive", "eval", "simulate"}) {
        const auto result = run({verb, scene});
        CHECK(result.exit == 3);
        CHECK(result.err.find("constraint 'b' has a row that follows from the others'") != std::string::npos);
    }
}

// Two equations of one rod, f and 2f: λ₁ + 2 λ₂ is the one rod's multiplier, and the solution of least norm is in
// the ratio 1 : 2.
TEST_CASE("commands: the multipliers of redundant constraints are those of least norm") {
    const std::string rod = R"toml(
gravity = [0, "-9.81"]
[coordinates]
x = 0.6
y = -0.8
[[particle]]
name = "P"
mass = 2
position = ["x", "y"]
[[constraint]]
name = "a"
holonomic = "x^2 + y^2 = 1"
)toml";
    const auto one = run({"eval", temporary("one.toml", rod), "--json"});
    const std::string twice =
        temporary("twice.toml", rod + "[[constraint]]\nname = \"b\"\nholonomic = \"2*x^2 + 2*y^2 = 2\"\n");
    const auto two = run({"eval", twice, "--json"});
    REQUIRE(one.exit == 0);
    REQUIRE(two.exit == 0);
    CHECK(two.err.find("constraint 'b' follows from the others") != std::string::npos);
    const double lambda = Json::parse(one.out)["multipliers"]["lambda_a"];
    const Json shared = Json::parse(two.out)["multipliers"];
    CHECK(shared["lambda_a"].get<double>() == doctest::Approx(lambda / 5).epsilon(1e-14));
    CHECK(shared["lambda_b"].get<double>() == doctest::Approx(2 * lambda / 5).epsilon(1e-14));
    const auto motion = run({"simulate", twice, "--json", "--duration", "1", "-o", temporary("twice.csv", "")});
    CHECK(motion.exit == 0);
}

// Two particles on nonlinear springs, H = p²/2 + V(x, y): the composition of order 8 is compared with dop853; then
// features that it does not support are added, and each is named. x'' + x = cos 2t from rest: x = (cos t − cos
// 2t)/3. The load's work is integrated with the motion.
TEST_CASE("commands: verlet and kahanli8 follow loads that are not in the energy") {
    const std::string driven = temporary("driven.toml",
                                         "[coordinates]\nx = 0\n[energy]\nkinetic = \"x'^2/2\"\npotential = "
                                         "\"x^2/2\"\n[forces]\nx = \"cos(2*t)\"\n");
    for (const auto& [method, tolerance] : {std::pair{"verlet", 1e-4}, {"kahanli8", 1e-12}}) {
        const auto result =
            run({"simulate", driven, "--json", "--duration", "5", "--method", method, "--step", "0.01"});
        INFO(result.err);
        REQUIRE(result.exit == 0);
        const Json motion = Json::parse(result.out);
        CHECK(std::abs(motion["final"]["coordinates"]["x"].get<double>() - (std::cos(5) - std::cos(10)) / 3) <
              tolerance);
        CHECK(motion["work_balance"].get<double>() < tolerance);
    }
    for (const std::string method : {"rkn86", "rkn1210"}) {
        const Json motion =
            json_of({"simulate", driven, "--duration", "5"}, {"--method", method, "--tolerance", "1e-11"});
        CHECK(std::abs(motion["final"]["coordinates"]["x"].get<double>() - (std::cos(5) - std::cos(10)) / 3) <
              1e-10);
        CHECK(motion["work_balance"].get<double>() < 1e-10);
    }
}

TEST_CASE("commands: kahanli8 integrates a separable system and refuses the others with the reason") {
    const auto scene = [](const std::string& kinetic, const std::string& more) {
        return temporary(
            "separable.toml",
            "[coordinates]\nx = { initial = 1 }\ny = { initial = 0.2, rate = 0.3 }\n[energy]\nkinetic = \"" +
                kinetic + "\"\npotential = \"x^2/2 + y^2 + x^2*y^2 + y^4/4\"\n" + more);
    };
    const std::string free = scene("x'^2/2 + y'^2", "");
    const auto end = [&](const std::vector<std::string>& more) {
        return json_of({"simulate", free, "--duration", "20"}, more)["final"]["coordinates"];
    };
    const Json exact = end({"--tolerance", "1e-13"});
    for (const std::vector<std::string>& words :
         {std::vector<std::string>{"--method", "kahanli8", "--step", "0.05"},
          {"--method", "gauss", "--step", "0.02"},
          {"--method", "rkn86", "--tolerance", "1e-11"},
          {"--method", "rkn1210", "--tolerance", "1e-11"}}) {
        const Json other = end(words);
        for (const char* name : {"x", "y"})
            CHECK(std::abs(other[name].get<double>() - exact[name].get<double>()) < 1e-9);
    }
    const auto refused = [&](const std::string& path, const char* reason) {
        const auto result = run({"simulate", path, "--duration", "1", "--method", "verlet", "--step", "0.01"});
        CHECK(result.exit != 0);
        CHECK(result.err.find(reason) != std::string::npos);
    };
    refused(scene("x'^2/2 + (1 + x^2)*y'^2", ""), "the inertia of y changes with the motion");
    refused(scene("x'^2/2 + x*y' + y'^2", ""), "a rate occurs in the equation of");
    refused(source_path("scenes/textbook/cartesian_pendulum.toml"), "there are constraints");
    const auto adaptive =
        run({"simulate", scene("x'^2/2 + x*y' + y'^2", ""), "--duration", "1", "--method", "rkn1210"});
    CHECK(adaptive.exit == 3);
    CHECK(adaptive.err.find("a rate occurs in the equation of") != std::string::npos);
}

}  // namespace commands_constraints
