// SPDX-License-Identifier: MIT
// Impacts of scenes against closed forms: the book's example in every detail, and momenta.
#include <doctest/doctest.h>
#include <fmt/format.h>

#include <cmath>

#include "impact_scenes.hpp"
#include "scenes.hpp"

namespace commands_impact {

using namespace alembert::test;

// Zhang & Qin, example 1-4. By hand: m l² [4/3 1/2; 1/2 1/3] ω = S l (1, 1/2).
TEST_CASE("impact: the book's struck rods turn at 3S/7ml and 6S/7ml, in exactly this form") {
    const auto result = run({"impact", source_path("scenes/textbook/struck_rods.toml"), "--json"});
    REQUIRE(result.exit == 0);
    const Json json = Json::parse(result.out);
    CHECK(json["solution"]["theta1"] == "3*S/(7*m*l)");
    CHECK(json["solution"]["theta2"] == "6*S/(7*m*l)");
    CHECK(json["energy_loss_solution"] == "-3*S^2/(7*m)");
    CHECK(number(json["after"]["theta1"]) == doctest::Approx(3 * 1.4 / (7 * 2 * 0.6)).epsilon(1e-14));
    CHECK(number(json["after"]["theta2"]) == doctest::Approx(6 * 1.4 / (7 * 2 * 0.6)).epsilon(1e-14));
    CHECK(number(json["before"]["theta1"]) == 0);
    CHECK(number(json["energy_loss"]) == doctest::Approx(-number(json["work_of_impulses"])).epsilon(1e-14));
    CHECK(json["equations"][0]["text"] ==
          "8*m*l*theta1' + 3*m*l*theta2'*cos(theta1-theta2) - 8*m*l*theta1'(-) - "
          "3*m*l*theta2'(-)*cos(theta1-theta2) = "
          "6*S*cos(theta1)");
    CHECK(json["equations"][0]["latex"] ==
          "8 m l \\dot{\\theta}_{1} + 3 m l \\dot{\\theta}_{2} \\cos(\\theta_{1} - \\theta_{2}) - 8 m l "
          "\\dot{\\theta}_{1-} "
          "- 3 m l \\dot{\\theta}_{2-} \\cos(\\theta_{1} - \\theta_{2}) = 6 S \\cos\\theta_{1}");
    const auto person = run({"impact", source_path("scenes/textbook/struck_rods.toml")});
    CHECK(person.out.find("  theta1' = 3*S/(7*m*l)\n  theta2' = 6*S/(7*m*l)\n") != std::string::npos);
}

// The tip's speed is v, its mass m/(1 + 3 cos²α).
TEST_CASE("impact: a slanting rod on a table, in closed form and in symbols") {
    for (const double e : {0.0, 0.4, 1.0}) {
        const double m = 2, l = 0.8, v = 1.5, alpha = 0.6, c = std::cos(alpha);
        const Json json =
            impact_of(filled(slanting_rod, {{"m", m}, {"l", l}, {"v", v}, {"e", e}, {"alpha", alpha}}));
        const double P = (1 + e) * m * v / (1 + 3 * c * c);
        CHECK(number(json["reactions"]["table"]) == doctest::Approx(P).epsilon(1e-13));
        CHECK(number(json["after"]["y"]) == doctest::Approx(P / m - v).epsilon(1e-13));
        CHECK(number(json["after"]["theta"]) == doctest::Approx(-6 * P * c / (m * l)).epsilon(1e-13));
        CHECK(std::abs(number(json["energy_loss"]) - (1 - e * e) * m * v * v / 2 / (1 + 3 * c * c)) < 1e-13);
        CHECK(std::abs(number(json["loss_in_constraints"]) - number(json["energy_loss"])) < 1e-13);
        if (e > 0) CHECK(json["reactions_solution"]["table"] == "(1+e)*m*v/(1+3*cos(alpha)^2)");
    }
}

// Only the hinge's impulse has a moment about O, and it is internal to the system; locked, the system is one body.
TEST_CASE(
    "impact: a double pendulum whose lower hinge locks keeps its angular momentum and loses Carnot's energy") {
    const Json json = impact_of(double_pendulum + lock);
    const double m1 = 1.3, m2 = 2, l1 = 1.1, l2 = 0.5, c = std::cos(0.3 - 1.1);
    const auto momentum = [&](double w1, double w2) {
        return (m1 + m2) * l1 * l1 * w1 + m2 * l1 * l2 * c * (w1 + w2) + m2 * l2 * l2 * w2;
    };
    const auto kinetic = [&](double w1, double w2) {
        return (m1 + m2) * l1 * l1 * w1 * w1 / 2 + m2 * l1 * l2 * c * w1 * w2 + m2 * l2 * l2 * w2 * w2 / 2;
    };
    const double w1 = json["after"]["theta1"], w2 = json["after"]["theta2"];
    CHECK(w1 == doctest::Approx(w2).epsilon(1e-13));
    CHECK(momentum(w1, w2) == doctest::Approx(momentum(1, -2)).epsilon(1e-13));
    CHECK(number(json["energy_loss"]) == doctest::Approx(kinetic(1 - w1, -2 - w2)).epsilon(1e-13));
    CHECK(json["imposed"] == Json({"lock"}));
    CHECK(json["solution"]["theta1"] == json["solution"]["theta2"]);
    // Other verbs refuse the initial state of this scene.
    CHECK(run({"eval", temporary("locked.toml", double_pendulum + lock)}).exit == 3);
    // A holonomic constraint keeps the angle between the rods constant.
    const Json welded =
        impact_of(double_pendulum + "[[constraint]]\nname = \"weld\"\nholonomic = \"theta1 - theta2 + 0.8\"\n");
    CHECK(number(welded["after"]["theta1"]) == doctest::Approx(w1).epsilon(1e-13));
    CHECK(number(welded["reactions"]["weld"]) ==
          doctest::Approx(number(json["reactions"]["lock"])).epsilon(1e-12));
}

// About the edge of the step: (J + m r²) ω = J v/r + m v (r − h); the classic ω = (v/r)(1 − 2h/3r).
TEST_CASE("impact: a rolling disc caught by the edge of a step goes on at the classic rate and leaves the floor") {
    const Json json = impact_of(R"toml(
[parameters]
m = 2
r = 0.5
h = 0.1
v = 1
[coordinates]
x = { rate = "v" }
y = { initial = "r" }
phi = { rate = "-v/r" }
[[body]]
name = "disc"
mass = "m"
position = ["x", "y"]
[energy]
kinetic = "m*r^2/4*phi'^2"
[[constraint]]
name = "across"
nonholonomic = "-x'*sqrt(1-(1-h/r)^2) + y'*(1-h/r)"
[[constraint]]
name = "along"
nonholonomic = "x'*(1-h/r) + y'*sqrt(1-(1-h/r)^2) + r*phi'"
[[unilateral]]
name = "floor"
gap = "y - r"
)toml");
    CHECK(json["solution"]["phi"] == "(2*h-3*r)*v/(3*r^2)");
    CHECK(number(json["after"]["phi"]) == doctest::Approx(-2 * (1 - 2 * 0.1 / 1.5)).epsilon(1e-14));
    CHECK(number(json["reactions"]["floor"]) == 0);
    CHECK(json["contacts"][0]["stays_closed"] == false);
    CHECK(number(json["energy_loss"]) == doctest::Approx(number(json["loss_in_constraints"])).epsilon(1e-14));
}

TEST_CASE("impact: a rod struck at two thirds of its length leaves its pin alone") {
    const auto struck = [](const char* h) {
        std::string text = filled(pinned_rod, {{"tau", 1}});
        text.replace(text.find("{h}"), 3, h);
        return impact_of(text + "[[impulse]]\nat = \"P\"\nvector = [\"S*cos(theta)\", \"-S*sin(theta)\"]\n");
    };
    const Json centre = struck("2*l/3"), end = struck("l");
    CHECK(std::abs(number(centre["reactions"]["pin_x"])) < 1e-13);
    CHECK(std::abs(number(centre["reactions"]["pin_y"])) < 1e-13);
    // ω = 3 S h/(m l²); the pin gives m l ω/2 − S along the blow: S/2 at the end.
    CHECK(number(centre["after"]["theta"]) == doctest::Approx(3 * 2 * 0.8 / (3 * 1.2 * 1.2)).epsilon(1e-13));
    CHECK(number(end["reactions"]["pin_x"]) == doctest::Approx(std::cos(0.4)).epsilon(1e-13));
    CHECK(number(end["reactions"]["pin_y"]) == doctest::Approx(-std::sin(0.4)).epsilon(1e-13));
    CHECK(end["solution"]["theta"] == "3*S*h/(m*l^2)");
}

TEST_CASE("impact: a generalized impulse is that of the forces that do its work") {
    const Json by_point = impact_of(double_pendulum + "[[impulse]]\nat = \"B\"\nvector = [0.3, -0.2]\n");
    const double Q1 = 1.1 * (0.3 * std::cos(0.3) - 0.2 * std::sin(0.3)),
                 Q2 = 0.5 * (0.3 * std::cos(1.1) - 0.2 * std::sin(1.1));
    const Json by_angle =
        impact_of(double_pendulum + fmt::format("[impulses]\ntheta1 = {:.17g}\ntheta2 = {:.17g}\n", Q1, Q2));
    for (const char* name : {"theta1", "theta2"})
        CHECK(number(by_point["after"][name]) == doctest::Approx(number(by_angle["after"][name])).epsilon(1e-13));
    CHECK(number(by_point["work_of_impulses"]) ==
          doctest::Approx(-number(by_point["energy_loss"])).epsilon(1e-13));
}

// A string of length l becomes taut: gap = l − r closes at the outward speed u, which is reversed with the factor
// e.
TEST_CASE("impact: a string that becomes taut removes the radial speed and keeps the transverse one") {
    const Json json = impact_of(R"toml(
[parameters]
m = 2
u = 3
w = 4
e = 0.25
[coordinates]
x = { initial = "5*cos(0.3)", rate = "u*cos(0.3) - w*sin(0.3)" }
y = { initial = "5*sin(0.3)", rate = "u*sin(0.3) + w*cos(0.3)" }
[[particle]]
name = "P"
mass = "m"
position = ["x", "y"]
[[unilateral]]
name = "string"
gap = "5 - sqrt(x^2+y^2)"
restitution = "e"
)toml");
    const double c = std::cos(0.3), s = std::sin(0.3), vx = json["after"]["x"], vy = json["after"]["y"];
    CHECK(c * vx + s * vy == doctest::Approx(-0.75).epsilon(1e-14));
    CHECK(c * vy - s * vx == doctest::Approx(4).epsilon(1e-14));
    CHECK(number(json["reactions"]["string"]) == doctest::Approx(2 * 3.75).epsilon(1e-14));
}

// With h' = 0.8 at t = 0 and the ball at −3, it leaves at 0.8 + e·3.8, and the work of the floor is 0.8 times its
// impulse.
TEST_CASE("impact: a racket gives energy, and the balance says how much") {
    const Json json = impact_of(R"toml(
[parameters]
m = 2
e = 0.5
[inputs]
h = "0.4*sin(2*t)"
[coordinates]
y = { rate = -3 }
[[particle]]
name = "ball"
mass = "m"
position = [0, "y"]
[[unilateral]]
name = "racket"
gap = "y - h"
restitution = "e"
)toml");
    CHECK(number(json["after"]["y"]) == doctest::Approx(0.8 + 0.5 * 3.8).epsilon(1e-14));
    CHECK(number(json["work_of_moving_constraints"]) == doctest::Approx(0.8 * 2 * 1.5 * 3.8).epsilon(1e-14));
    CHECK(number(json["loss_in_constraints"]) == doctest::Approx(0.5 * (1 - 0.25) * 2 * 3.8 * 3.8).epsilon(1e-14));
    CHECK(
        number(json["loss_in_constraints"]) ==
        doctest::Approx(number(json["energy_loss"]) + number(json["work_of_moving_constraints"])).epsilon(1e-13));
    CHECK(json["solution"]["y"] == "(4+19*e)/5");
}

// The same motion in the scene's own speeds, whose initial values replace the rates; the reader accepts these in
// no other place.
TEST_CASE("impact: speeds with initial values give the same result as the corresponding rates") {
    const std::string speeds =
        "[speeds]\nu1 = { form = \"theta1'\", initial = \"w1\" }\nu2 = { form = \"theta2' - theta1'\", initial = "
        "\"w2 - w1\" }\n";
    for (const std::string& further :
         {std::string(), lock}) {  // the lock contradicts the initial speeds, and is imposed
        std::string in_rates = double_pendulum + further, in_speeds = in_rates;
        for (const char* rate : {", rate = \"w1\"", ", rate = \"w2\""})
            in_speeds.erase(in_speeds.find(rate), std::string(rate).size());
        in_speeds += speeds;
        const Json expected = impact_of(in_rates), json = impact_of(in_speeds);
        for (const char* name : {"theta1", "theta2"})
            for (const char* when : {"before", "after"})
                CHECK(number(json[when][name]) == doctest::Approx(number(expected[when][name])).epsilon(1e-13));
        CHECK(number(json["energy_loss"]) == doctest::Approx(number(expected["energy_loss"])).epsilon(1e-12));
    }
}

}  // namespace commands_impact
