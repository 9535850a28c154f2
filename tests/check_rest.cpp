// SPDX-License-Identifier: MIT
// Verdicts on claims about rest and about impacts.
#include <doctest/doctest.h>

#include <ginac/ginac.h>
#include <cmath>
#include <map>

#include "checked.hpp"

namespace check_rest {

using namespace alembert;
using test::check_verdicts;
using test::checked;

TEST_CASE(
    "check: the equation of rest of example 1-1 is proved, and one of its branches alone refuted by the other") {
    const Checked result = checked("watt_governor", R"(
rest
sin(alpha)*(cos(alpha) - (m+M)*g/(m*l*Omega^2)) = 0
cos(alpha) = (m+M)*g/(m*l*Omega^2)
sin(alpha) = 0
)");
    CHECK(result.claims[0].verdict == Verdict::proved);
    REQUIRE(result.claims[1].verdict == Verdict::refuted);
    CHECK(result.claims[1].reason.find("sin(alpha) = 0") != std::string::npos);
    REQUIRE(result.claims[2].verdict == Verdict::refuted);
    CHECK(result.claims[2].reason.find("m*l*Omega^2*cos(alpha) - (m+M)*g = 0") != std::string::npos);
    CHECK_FALSE(result.complete);
}

TEST_CASE("check: claims at an impact are about the rates before and after it, at the initial pose") {
    const Checked result = checked("struck_rods", R"(
impact
theta1' = 3*S/(7*m*l)
theta2' - theta2'(-) = 6*S/(7*m*l)
theta2' = 2*theta1'
theta1' = -3*S/(7*m*l)
unknowns R
2*R = S
7*R = 3*S
)");
    for (int k = 0; k < 3; ++k) CHECK(result.claims[k].verdict == Verdict::proved);
    REQUIRE(result.claims[3].verdict == Verdict::refuted);
    CHECK(result.claims[3].likely->kind == "sign");
    CHECK_FALSE(result.claims[3].counterexample.empty());
    CHECK(result.claims[4].verdict == Verdict::refuted);
}

// Where the crank stands at pi/2 the other two angles are known in numbers only, and the loop ties them. Without
// that they were taken to be free, and both claims refuted.
TEST_CASE("check: at an impact angles that are known in numbers only obey the constraints") {
    std::string loop = read_scene(test::source_path("scenes/textbook/four_bar.toml")).text;
    loop.replace(loop.find("initial = 0.5, rate = 2.0"), 25, "initial = \"pi/2\"");
    for (std::size_t at = 0; (at = loop.find(", rate_guess = 0")) != std::string::npos;) loop.erase(at, 16);
    loop.erase(loop.find("[[claim]]"));
    const Scene scene = parse_scene(loop + "[[impulse]]\nat = \"Q\"\nvector = [3, 0]\n", "struck_loop.toml");
    check_verdicts(checked(with_claims(scene, R"(impact
a*cos(alpha) + b*cos(beta) = d + c*cos(gamma)
b*(gamma' - beta')*sin(beta) = a*(alpha' - gamma')*sin(alpha)
b*(gamma' - beta')*sin(beta) = a*(alpha' + gamma')*sin(alpha)
)",
                                       "claims.txt")),
                   {Verdict::proved, Verdict::proved, Verdict::refuted});
}

// Both cranks of a parallelogram start at the same decimal, and are parallel.
TEST_CASE("check: at an impact angles that start at the same decimal are the same") {
    std::string loop = read_scene(test::source_path("scenes/textbook/four_bar.toml")).text;
    loop.erase(loop.find("[[claim]]"));
    const auto replace = [&](const std::string& from, const std::string& to) {
        std::size_t at = loop.find(from);
        REQUIRE(at != std::string::npos);
        for (; at != std::string::npos; at = loop.find(from, at + to.size())) loop.replace(at, from.size(), to);
    };
    replace("initial = 0.5, rate = 2.0", "initial = 1.1");
    replace("guess = 0.6, rate_guess = 0", "initial = 0");
    replace("guess = 1.4, rate_guess = 0", "initial = 1.1");
    replace("value = 3.5", "value = 1.0");
    replace("value = 3.0", "value = 4.0");
    const Scene scene = parse_scene(loop + "[[impulse]]\nat = \"Q\"\nvector = [3, 0]\n", "parallelogram.toml");
    check_verdicts(checked(with_claims(scene, "impact\ngamma = alpha\ngamma = beta\n", "claims.txt")),
                   {Verdict::proved, Verdict::refuted});
}

// Rest of two weights on a rope needs m1 = m2; with a division by (m1 − m2)·g everything would follow.
TEST_CASE("check: a claim that would follow from unequal weights at rest is refuted") {
    const Scene scene = parse_scene(R"(title = "Atwood's machine with springs"
gravity = [0, "-g"]
[parameters]
m1 = 1.0
m2 = 1.0
k = 50.0
g = 9.81
L = 3
[coordinates]
x1 = 1.0
x2 = 2.0
s = 0.2
[[particle]]
name = "A"
mass = "m1"
position = ["0", "-x1-s"]
[[particle]]
name = "B"
mass = "m2"
position = ["1", "-x2"]
[energy]
potential = "k*s^2/2"
[[constraint]]
name = "rope"
holonomic = "x1 + x2 - L = 0"
multiplier = "T"
)",
                                    "atwood.toml");
    check_verdicts(checked(with_claims(scene, "rest\nm1*g + T = 0\nk*s = m1*g\nk*s = 2*m1*g\n", "claims.txt")),
                   {Verdict::proved, Verdict::proved, Verdict::refuted});
}

// g*(m2*sin(beta) - m1*sin(alpha)) = 0: rest needs that of the parameters, and none of them is zero.
TEST_CASE("check: an equation of rest in parameters alone is solved for one of them, unless it has two factors") {
    const auto blocks = [](const std::string& force) {
        return parse_scene(R"toml(gravity = ["g*sin(alpha)", 0]
[parameters]
g = 9.81
m = 1.0
P = 2.0
h = 0.5
alpha = 0.3
[coordinates]
x = 0
[[particle]]
name = "A"
mass = "m"
position = ["x", 0]
[[force]]
at = "A"
vector = [")toml" + force + R"toml(", 0]
)toml",
                           "block.toml");
    };
    const auto at_rest = [&](const std::string& force, const std::string& claims) {
        return checked(with_claims(blocks(force), "rest\n" + claims, "claims.txt"));
    };
    check_verdicts(
        at_rest("-P*cos(h)", "P*cos(h) = m*g*sin(alpha)\nm*g*sin(alpha)/P = cos(h)\nP = m*g*sin(alpha)\n"),
        {Verdict::proved, Verdict::proved, Verdict::refuted});
    // sin(alpha)*(m*g - P) = 0 does not need m*g = P, and m*g*sin(alpha) = 0 allows rest on the level.
    CHECK(at_rest("-P*sin(alpha)", "m*g = P\n").claims[0].verdict != Verdict::proved);
    const Checked level = at_rest("0", "sin(alpha) = 0\ng = 0\n");
    CHECK(level.claims[0].verdict == Verdict::proved);
    CHECK(level.claims[1].verdict != Verdict::proved);
}

// The equations of rest by hand, from V = k x²/2 + k (theta - phi)²/2 - 2 m g l cos(theta) - m g l cos(phi) - F x.
TEST_CASE("check: equations of rest that springs tie together are combined before they are solved") {
    const Scene scene = parse_scene(R"toml(gravity = [0, "-g"]
[parameters]
m = 1
l = 0.5
g = 9.81
k = 3
F = 2
[coordinates]
x = 0
theta = 0.2
phi = 0.1
[[particle]]
name = "C"
mass = "m"
position = ["x", 0]
[[particle]]
name = "P"
mass = "m"
from = "C"
position = ["l*sin(theta)", "-l*cos(theta)"]
[[particle]]
name = "Q"
mass = "m"
from = "P"
position = ["l*sin(phi)", "-l*cos(phi)"]
[[spring]]
along = "x"
stiffness = "k"
[[spring]]
along = "theta - phi"
stiffness = "k"
[forces]
x = "F"
)toml",
                                    "tied.toml");
    const Checked result = checked(with_claims(scene,
                                               "rest\nk*x = F\n2*m*g*l*sin(theta) + k*(theta - phi) = 0\n"
                                               "2*sin(theta) = -sin(phi)\nm*g*l*sin(phi) = -k*(theta - phi)\n"
                                               "2*sin(theta) = sin(phi)\nk*x = F*l\n",
                                               "claims.txt"));
    check_verdicts(result, {Verdict::proved, Verdict::proved, Verdict::proved, Verdict::refuted, Verdict::refuted,
                            Verdict::refuted});
    for (const std::size_t wrong : {3, 4}) {
        std::map<std::string, double> at;
        for (const auto& [name, value] : result.claims[wrong].counterexample)
            at[name] = GiNaC::ex_to<GiNaC::numeric>(GiNaC::parser()(value)).to_double();
        const double turned = at["k"] * (at["theta"] - at["phi"]), weight = at["m"] * at["g"] * at["l"];
        CHECK(at["k"] * at["x"] == doctest::Approx(at["F"]));
        CHECK(turned == doctest::Approx(-2 * weight * std::sin(at["theta"])));
        CHECK(turned == doctest::Approx(weight * std::sin(at["phi"])));
    }
    REQUIRE(result.claims[5].likely);
    CHECK(result.claims[5].likely->repair == "k*x = F");
    for (const CheckedClaim& c : result.claims) CHECK(c.reason.empty());  // rest has one branch
}

TEST_CASE(
    "check: at rest, what constraints drive at a constant rate goes on, and its forces of inertia are there") {
    const std::string scene =
        "gravity = [0, 0, \"-g\"]\nparameters = { m = 1, a = 0.5, l = 0.3, Omega = 4, g = 9.81 }\n[coordinates]\n"
        "phi = { initial = 0, rate = \"Omega\" }\ntheta = 0.4\n[[frame]]\nname = \"A\"\nrotate = [[\"z\", "
        "\"phi\"]]\n"
        "[[particle]]\nname = \"bob\"\nmass = \"m\"\nposition = [\"a + l*sin(theta)\", 0, \"-l*cos(theta)\"]\n"
        "axes = \"A\"\n[[constraint]]\nname = \"motor\"\n";
    for (const char* motor : {"holonomic = \"phi = Omega*t\"\n", "nonholonomic = \"phi' = Omega\"\n"}) {
        CAPTURE(motor);
        const Checked result = checked(with_claims(parse_scene(scene + motor, "arm.toml"), R"(
lambda_motor = 2*m*phi'*l*theta'*cos(theta)*(a + l*sin(theta))
rest
(a + l*sin(theta))*Omega^2 = g*tan(theta)
(a + l*sin(theta))*phi'^2*cos(theta) = g*sin(theta)
phi' = Omega
lambda_motor = 0
sin(theta) = 0
a*Omega^2 = g*tan(theta)
)",
                                                   "claims.txt"));
        check_verdicts(result, {Verdict::proved, Verdict::proved, Verdict::proved, Verdict::proved,
                                Verdict::proved, Verdict::refuted, Verdict::refuted});
        const auto value = [&](const std::string& name) {
            for (const auto& [key, text] : result.claims[5].counterexample)
                if (key == name) return text;
            return std::string();
        };
        CHECK(value("phi'") == value("Omega"));
    }
}

// The equations of rest cannot be solved one after the other: k q1 stands beside sin q1. The states shown obey
// them all, written here by hand.
TEST_CASE("check: what is wrong about states of rest that only numbers give is refuted by one of them") {
    const std::vector<std::string> right{"2*k*q1 - k*q2 = 3*m*g*l*sin(q1)", "k*(2*q2 - q1 - q3) = 2*m*g*l*sin(q2)",
                                         "k*(q3 - q2) = m*g*l*sin(q3)"},
        wrong{"2*k*q1 + k*q2 = 3*m*g*l*sin(q1)", "k*(2*q2 - q1 - q3) = m*g*l*sin(q2)",
              "3*k*(q3 - q2) = 2*m*g*l*sin(q3)", "q1 = q2", "k*q3 = m*g*l*sin(q3) + k*q1"};
    std::string claims = "rest\n";
    for (const auto* list : {&right, &wrong})
        for (const std::string& claim : *list) claims += claim + "\n";
    const Scene scene = read_scene(test::source_path("scenes/stability/standing_triple_pendulum.toml"));
    const Checked result = checked(with_claims(scene, claims, "claims.txt"));
    for (std::size_t k = 0; k < right.size(); ++k) CHECK(result.claims[k].verdict == Verdict::proved);
    for (std::size_t k = right.size(); k < result.claims.size(); ++k) {
        CAPTURE(k);
        REQUIRE(result.claims[k].verdict == Verdict::refuted);
        std::map<std::string, double> at;
        for (const auto& [name, value] : result.claims[k].counterexample) {
            const std::size_t bar = value.find('/');
            at[name] = std::stod(value) / (bar == std::string::npos ? 1 : std::stod(value.substr(bar + 1)));
        }
        const double weight = at["m"] * at["g"] * at["l"], spring = at["k"];
        CHECK(std::abs(spring * (2 * at["q1"] - at["q2"]) - 3 * weight * std::sin(at["q1"])) < 1e-9 * weight);
        CHECK(std::abs(spring * (2 * at["q2"] - at["q1"] - at["q3"]) - 2 * weight * std::sin(at["q2"])) <
              1e-9 * weight);
        CHECK(std::abs(spring * (at["q3"] - at["q2"]) - weight * std::sin(at["q3"])) < 1e-9 * weight);
    }
}

}  // namespace check_rest
