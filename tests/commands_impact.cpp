// SPDX-License-Identifier: MIT
// Impacts of scenes: the book's example to the letter, closed forms, momenta, and the limit of short forces.
#include <doctest/doctest.h>
#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "program.hpp"
#include "scenes.hpp"

using alembert::test::run;
using alembert::test::source_path;
using alembert::test::temporary;
using Json = nlohmann::json;

namespace {

Json impact_of(const std::string& text) {
    const auto result = run({"impact", temporary("struck.toml", text), "--json"});
    INFO(result.err);
    REQUIRE(result.exit == 0);
    return Json::parse(result.out);
}

double number(const Json& json) { return json.get<double>(); }

/// "{v}" in a scene.
std::string filled(std::string text, const std::vector<std::pair<std::string, double>>& values) {
    for (const auto& [name, value] : values) {
        const std::string mark = "{" + name + "}";
        for (std::size_t at = text.find(mark); at != std::string::npos; at = text.find(mark))
            text.replace(at, mark.size(), fmt::format("{:.17g}", value));
    }
    return text;
}

const std::string slanting_rod = R"toml(
[parameters]
m = {m}
l = {l}
v = {v}
e = {e}
alpha = {alpha}
[coordinates]
y = { initial = "l/2*sin(alpha)", rate = "-v" }
theta = { initial = "alpha" }
[[frame]]
name = "R"
rotate = [["z", "-theta"]]
[[body]]
name = "rod"
mass = "m"
inertia = "m*l^2/12"
frame = "R"
position = [0, "y"]
[[unilateral]]
name = "table"
gap = "y - l/2*sin(theta)"
restitution = "e"
)toml";

/// A rod on a pin as a free body with the pin as constraints, struck at h below the pin.
const std::string pinned_rod = R"toml(
gravity = [0, 9.81]
[parameters]
m = 3
l = 1.2
S = 2
h = "{h}"
tau = {tau}
[inputs]
F = "S/tau*(1-cos(2*pi*t/tau))"
[coordinates]
x = { initial = "l/2*sin(0.4)" }
y = { initial = "l/2*cos(0.4)" }
theta = 0.4
[[frame]]
name = "R"
rotate = [["z", "-theta"]]
[[body]]
name = "rod"
mass = "m"
frame = "R"
inertia = "m*l^2/12"
position = ["x", "y"]
[[point]]
name = "P"
from = "rod"
offset = [0, "h - l/2"]
axes = "R"
[[constraint]]
name = "pin_x"
holonomic = "x - l/2*sin(theta)"
[[constraint]]
name = "pin_y"
holonomic = "y - l/2*cos(theta)"
)toml";

const std::string double_pendulum = R"toml(
gravity = [0, "-g"]
[parameters]
g = 9.81
m1 = 1.3
m2 = 2
l1 = 1.1
l2 = 0.5
w1 = 1
w2 = -2
[coordinates]
theta1 = { initial = 0.3, rate = "w1" }
theta2 = { initial = 1.1, rate = "w2" }
[[particle]]
name = "A"
mass = "m1"
position = ["l1*sin(theta1)", "-l1*cos(theta1)"]
[[particle]]
name = "B"
mass = "m2"
position = ["l1*sin(theta1)+l2*sin(theta2)", "-l1*cos(theta1)-l2*cos(theta2)"]
)toml";

const std::string lock = R"toml(
[[constraint]]
name = "lock"
nonholonomic = "theta1' - theta2'"
)toml";

}  // namespace

// Zhang & Qin, example 1-4. By hand: m l² [4/3 1/2; 1/2 1/3] ω = S l (1, 1/2).
TEST_CASE("impact: the book's struck rods turn at 3S/7ml and 6S/7ml, exactly as such") {
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
          "8*m*l*theta1' + 3*m*l*theta2'*cos(theta1-theta2) - 8*m*l*theta1'(-) - 3*m*l*theta2'(-)*cos(theta1-theta2) = "
          "6*S*cos(theta1)");
    const auto person = run({"impact", source_path("scenes/textbook/struck_rods.toml")});
    CHECK(person.out.find("  theta1' = 3*S/(7*m*l)\n  theta2' = 6*S/(7*m*l)\n") != std::string::npos);
}

// The tip's speed is v, its mass m/(1 + 3 cos²α).
TEST_CASE("impact: a slanting rod on a table, in closed form and in symbols") {
    for (const double e : {0.0, 0.4, 1.0}) {
        const double m = 2, l = 0.8, v = 1.5, alpha = 0.6, c = std::cos(alpha);
        const Json json = impact_of(filled(slanting_rod, {{"m", m}, {"l", l}, {"v", v}, {"e", e}, {"alpha", alpha}}));
        const double P = (1 + e) * m * v / (1 + 3 * c * c);
        CHECK(number(json["reactions"]["table"]) == doctest::Approx(P).epsilon(1e-13));
        CHECK(number(json["after"]["y"]) == doctest::Approx(P / m - v).epsilon(1e-13));
        CHECK(number(json["after"]["theta"]) == doctest::Approx(-6 * P * c / (m * l)).epsilon(1e-13));
        CHECK(std::abs(number(json["energy_loss"]) - (1 - e * e) * m * v * v / 2 / (1 + 3 * c * c)) < 1e-13);
        CHECK(std::abs(number(json["loss_in_constraints"]) - number(json["energy_loss"])) < 1e-13);
        if (e > 0) CHECK(json["reactions_solution"]["table"] == "(1+e)*m*v/(1+3*cos(alpha)^2)");
    }
}

// What is printed can be typed: outputs of a scene with other values of the parameters, against the numbers there.
TEST_CASE("impact: the symbolic rates are right at other values than those at which they were found") {
    const Json first = impact_of(filled(slanting_rod, {{"m", 2}, {"l", 0.8}, {"v", 1.5}, {"e", 0.4}, {"alpha", 0.6}}));
    std::string other = filled(slanting_rod, {{"m", 0.7}, {"l", 3.1}, {"v", 0.2}, {"e", 0.9}, {"alpha", 1.3}}) + "[outputs]\n";
    for (const auto& [name, text] : first["solution"].items()) other += fmt::format("after_{} = \"{}\"\n", name, text.get<std::string>());
    const auto evaluated = run({"eval", temporary("other.toml", other), "--json"});
    REQUIRE(evaluated.exit == 0);
    const Json outputs = Json::parse(evaluated.out)["outputs"], there = impact_of(other)["after"];
    for (const char* name : {"y", "theta"})
        CHECK(number(outputs[std::string("after_") + name]) == doctest::Approx(number(there[name])).epsilon(1e-13));
}

// No impulse has a moment about O but the hinge's, and that acts within the system; locked, it is one body.
TEST_CASE("impact: a double pendulum whose lower hinge locks keeps its angular momentum and loses Carnot's energy") {
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
    // The same scene is no start for anything else.
    CHECK(run({"eval", temporary("locked.toml", double_pendulum + lock)}).exit == 3);
    // A holonomic one: the angle between the rods stays what it is.
    const Json welded = impact_of(double_pendulum + "[[constraint]]\nname = \"weld\"\nholonomic = \"theta1 - theta2 + 0.8\"\n");
    CHECK(number(welded["after"]["theta1"]) == doctest::Approx(w1).epsilon(1e-13));
    CHECK(number(welded["reactions"]["weld"]) == doctest::Approx(number(json["reactions"]["lock"])).epsilon(1e-12));
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

// A smooth pulse of the same ∫F dt, integrated by the equations of motion; gravity acts meanwhile, so the rates differ
// by a term of first order in its length: halving it halves the difference.
TEST_CASE("impact: it is the limit of a large short force") {
    std::string text = pinned_rod;
    text.replace(text.find("{h}"), 3, "0.9*l");
    const Json limit = impact_of(filled(text, {{"tau", 1}}) + "[[impulse]]\nat = \"P\"\nvector = [\"S\", 0]\n");
    const auto after = [&](double tau) {
        const std::string scene = filled(text, {{"tau", tau}}) + "[[force]]\nat = \"P\"\nvector = [\"F\", 0]\n";
        const auto result = run({"simulate", temporary("pulse.toml", scene), "--json", "--tolerance", "1e-12", "--duration", fmt::format("{}", tau)});
        REQUIRE(result.exit == 0);
        return Json::parse(result.out)["final"]["rates"];
    };
    const Json coarse = after(4e-3), fine = after(2e-3);
    for (const char* name : {"x", "y", "theta"}) {
        CAPTURE(name);
        const double aim = limit["after"][name], one = number(coarse[name]) - aim, half = number(fine[name]) - aim;
        CHECK(std::abs(one) < 0.05);
        CHECK(std::abs(one) > 1e-5);
        CHECK(one / half == doctest::Approx(2).epsilon(0.02));
    }
}

TEST_CASE("impact: a generalized impulse is that of the forces that do its work") {
    const Json by_point = impact_of(double_pendulum + "[[impulse]]\nat = \"B\"\nvector = [0.3, -0.2]\n");
    const double Q1 = 1.1 * (0.3 * std::cos(0.3) - 0.2 * std::sin(0.3)), Q2 = 0.5 * (0.3 * std::cos(1.1) - 0.2 * std::sin(1.1));
    const Json by_angle = impact_of(double_pendulum + fmt::format("[impulses]\ntheta1 = {:.17g}\ntheta2 = {:.17g}\n", Q1, Q2));
    for (const char* name : {"theta1", "theta2"})
        CHECK(number(by_point["after"][name]) == doctest::Approx(number(by_angle["after"][name])).epsilon(1e-13));
    CHECK(number(by_point["work_of_impulses"]) == doctest::Approx(-number(by_point["energy_loss"])).epsilon(1e-13));
}

// A string of length l, slack no longer: gap = l − r, approached at the outward speed u, which e turns back.
TEST_CASE("impact: a string that becomes taut takes the outward speed and leaves the one across") {
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

// x' = 2 y' stands before and after; the guess obeys it, so the constraint is not imposed but carries on.
TEST_CASE("impact: guessed rates obey the constraints before the impact") {
    const Json json = impact_of(R"toml(
[parameters]
S = 5
[coordinates]
x = { rate_guess = 0 }
y = { rate = 1.5 }
[energy]
kinetic = "x'^2/2 + y'^2/2"
[[constraint]]
name = "gear"
nonholonomic = "x' - 2*y'"
[impulses]
x = "S"
)toml");
    CHECK(number(json["before"]["x"]) == doctest::Approx(3));
    CHECK(json["imposed"].empty());
    CHECK(number(json["after"]["y"]) == doctest::Approx(1.5 + 2 * 5. / 5));  // (1 + 4) Δy' = 2 S
    CHECK(number(json["loss_in_constraints"]) < 1e-14);
}

// Rates before as numbers, rates after by `eval --at`, multipliers by the impulses of the reactions.
TEST_CASE("impact: its equations read as claims, and hold, as do those that textbook scenes carry") {
    int held = 0;
    const auto check = [&](const std::string& text, std::vector<std::string> claims) {
        const Json json = impact_of(text);
        for (const auto& equation : json["equations"]) claims.push_back(equation["text"]);
        for (const auto& condition : json["conditions"]) claims.push_back(condition);
        std::string read = text;
        for (const std::string& claim : claims) read += fmt::format("[[claim]]\nequation = \"{}\"\nat = \"impact\"\n", claim);
        CHECK(run({"impact", temporary("claims.toml", read)}).exit == 0);
        std::string outputs = "\n[outputs]\n";
        const auto replace = [](std::string& in, const std::string& mark, const Json& by) {
            for (std::size_t at = in.find(mark); at != std::string::npos; at = in.find(mark))
                in.replace(at, mark.size(), fmt::format("({:.17g})", by.get<double>()));
        };
        for (std::size_t k = 0; k < claims.size(); ++k) {
            std::string claim = claims[k];
            for (const auto& item : json["before"].items()) replace(claim, item.key() + "'(-)", item.value());
            for (const auto& item : json["reactions"].items()) replace(claim, "lambda_" + item.key(), item.value());
            const std::size_t equals = claim.find('=');
            outputs += fmt::format("c{} = \"{} - ({})\"\n", k, claim.substr(0, equals), claim.substr(equals + 1));
        }
        std::vector<std::string> args{"eval", temporary("held.toml", text + outputs), "--json", "--at"};
        for (const auto& item : json["after"].items()) args.push_back(fmt::format("{}'={:.17g}", item.key(), item.value().get<double>()));
        const auto result = run(args);
        INFO(result.err);
        REQUIRE(result.exit == 0);
        const Json evaluated = Json::parse(result.out)["outputs"];
        for (const auto& item : evaluated.items()) {
            const std::string claim = claims[static_cast<std::size_t>(std::stoi(item.key().substr(1)))];
            CAPTURE(claim);
            CHECK(std::abs(item.value().get<double>()) < 1e-12);
            ++held;
        }
    };
    check(filled(slanting_rod, {{"m", 2}, {"l", 0.8}, {"v", 1.5}, {"e", 0.4}, {"alpha", 0.6}}), {});
    check(double_pendulum + lock + "[[impulse]]\nat = \"B\"\nvector = [0.3, -0.2]\n", {});
    for (const std::string& file : alembert::test::scenes_in("scenes/textbook")) {
        const alembert::Scene scene = alembert::read_scene(file);
        std::vector<std::string> claims;
        for (const alembert::Claim& claim : scene.claims)
            if (claim.at == "impact") claims.push_back(claim.equation.lhs.text + " = " + claim.equation.rhs.text);
        if (!claims.empty()) check(scene.text, claims);
    }
    CHECK(held >= 12);
}

TEST_CASE("impact: where nothing is struck the rates stay, and that is said") {
    for (const std::string more : {"", "[[unilateral]]\nname = \"far\"\ngap = \"1 - theta1\"\n",
                                   "[[unilateral]]\nname = \"opening\"\ngap = \"theta1 - 0.3\"\nrestitution = 1\n"}) {
        const Json json = impact_of(double_pendulum + more);
        CHECK(json["after"] == json["before"]);
        CHECK(number(json["energy_loss"]) == 0);
        CHECK(run({"impact", temporary("calm.toml", double_pendulum + more)}).out.find("Nothing is struck") != std::string::npos);
    }
}

// h' = 0.8 at t = 0 and the ball comes at −3: it leaves at 0.8 + e·3.8, and the floor works 0.8 times its impulse.
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
    CHECK(number(json["loss_in_constraints"]) ==
          doctest::Approx(number(json["energy_loss"]) + number(json["work_of_moving_constraints"])).epsilon(1e-13));
    CHECK(json["solution"]["y"] == "(4+19*e)/5");
}

TEST_CASE("impact: a long chain is computed in numbers, and that is said") {
    std::string text = "[coordinates]\n";
    for (int i = 0; i < 12; ++i) text += fmt::format("a{} = {}\n", i, 0.1 * i);
    text += "[parameters]\nm = 1\nS = 1\n";
    for (int i = 0; i < 12; ++i)
        text += fmt::format("[[particle]]\nname = \"P{}\"\nmass = \"m\"\nfrom = \"{}\"\nposition = [\"sin(a{})\", \"cos(a{})\"]\n", i,
                            i == 0 ? "O" : fmt::format("P{}", i - 1), i, i);
    const Json json = impact_of(text + "[[impulse]]\nat = \"P5\"\nvector = [\"S\", 0]\n");
    CHECK(json["solution"].empty());
    CHECK(json["note"].get<std::string>().find("beyond the readable size") != std::string::npos);
    CHECK(number(json["loss_in_constraints"]) == 0);
    CHECK(number(json["energy_loss"]) == doctest::Approx(-number(json["work_of_impulses"])).epsilon(1e-12));
}

TEST_CASE("impact: what cannot be struck is refused with its reason") {
    const auto refused = [](const std::string& more, int code, const char* reason) {
        const auto result = run({"impact", temporary("refused.toml", double_pendulum + more)});
        INFO(result.err);
        CHECK(result.exit == code);
        CHECK(result.err.find(reason) != std::string::npos);
    };
    refused("[[unilateral]]\nname = \"wall\"\ngap = \"0.2 - theta1\"\n", 3, "the gap 'wall' is -0.1");
    refused("[[constraint]]\nname = \"far\"\nholonomic = \"theta1 - 0.4\"\n", 3, "constraint 'far' is off by 0.1");
    refused("[[constraint]]\nname = \"a\"\nnonholonomic = \"theta1' - 1\"\n[[constraint]]\nname = \"b\"\nnonholonomic = \"theta1' - 2\"\n",
            4, "the constraints contradict each other");
    const auto singular = run({"impact", temporary("massless.toml", "[coordinates]\nx = 0\ny = 0\n[energy]\nkinetic = \"x'^2\"\n[impulses]\ny = 1\n")});
    CHECK(singular.exit == 4);
    CHECK(singular.err.find("mass matrix is singular") != std::string::npos);
}
