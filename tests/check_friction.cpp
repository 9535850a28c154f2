// SPDX-License-Identifier: MIT
// Claims about dry friction: on constraints, whose reactions press from either side, and while it sticks.
#include <doctest/doctest.h>

#include <ginac/ginac.h>
#include <cmath>
#include <map>

#include "alembert/base/error.hpp"
#include "algebra/notation/text.hpp"
#include "analysis/derive/derive.hpp"
#include "checked.hpp"

namespace check_friction {

using namespace alembert;
using test::check_verdicts;
using test::checked;

namespace {

/// A bead on a rough rod that turns at a constant rate in a horizontal plane; the rod presses with N = 2 m w v.
Scene bead(const std::string& mass = "m") {
    return parse_scene(R"toml(
[parameters]
m = 1
w = 2
mu = 0.3
[coordinates]
x = { initial = 1, rate_guess = 1 }
y = { guess = 0, rate_guess = 2 }
[definitions]
v = "x'*cos(w*t) + y'*sin(w*t)"
[[particle]]
name = "P"
mass = ")toml" + mass + R"toml("
position = ["x", "y"]
[[constraint]]
name = "rod"
holonomic = "y*cos(w*t) - x*sin(w*t)"
[[friction]]
name = "skin"
coefficient = "mu"
slip = "x'*cos(w*t) + y'*sin(w*t)"
on = "rod"
)toml",
                       "bead.toml");
}

Checked of_bead(const std::string& claims, const std::string& mass = "m") {
    return checked(with_claims(bead(mass), claims, "claims.txt"));
}

Scene friction_scene(const std::string& name) {
    return read_scene(test::source_path("scenes/friction/" + name + ".toml"));
}

}  // namespace

TEST_CASE("check: claims with the friction of a constraint are decided for both sides that it may press") {
    const Checked result = of_bead(R"(
m*x'' = -lambda_rod*sin(w*t) - mu*abs(lambda_rod)*sign(v)*cos(w*t)
m*y'' = lambda_rod*cos(w*t) - mu*abs(lambda_rod)*sign(v)*sin(w*t)
m*(x''*cos(w*t) + y''*sin(w*t)) = -mu*abs(lambda_rod)*sign(v)
lambda_rod = 2*m*w*v
x''*cos(w*t) + y''*sin(w*t) = -2*mu*w*v
)");
    check_verdicts(result, std::vector(5, Verdict::proved));
    CHECK(result.complete);
}

TEST_CASE("check: wrong friction on a constraint is refuted at a state, and the wrong term is named") {
    const Checked result = of_bead(R"(
m*x'' = -lambda_rod*sin(w*t) + mu*abs(lambda_rod)*sign(v)*cos(w*t)
m*(x''*cos(w*t) + y''*sin(w*t)) = -mu*lambda_rod*sign(v)
m*(x''*cos(w*t) + y''*sin(w*t)) = -mu*abs(lambda_rod)
lambda_rod = m*w*v
)");
    check_verdicts(result, std::vector(4, Verdict::refuted));
    REQUIRE(result.claims[0].likely);
    CHECK(result.claims[0].likely->kind == "sign");
    CHECK(result.claims[0].likely->term.find("mu*abs(lambda_rod)*sign(v)") != std::string::npos);
    for (const CheckedClaim& claim : result.claims) CHECK(!claim.counterexample.empty());
    // What is wrong on one side only fails at a state of that side.
    const auto at = [&](std::size_t k, const std::string& name) {
        for (const auto& [known, value] : result.claims[k].counterexample)
            if (known == name) return value;
        return std::string();
    };
    CHECK(at(1, "lambda_rod").starts_with("-"));
    REQUIRE(result.claims[3].likely);
    CHECK(result.claims[3].likely->kind == "factor");
}

// Legendre's symbol of 3 modulo the prime is -1: 6 m w v would have the sign opposite to v.
TEST_CASE("check: numbers in the reaction do not confuse its side") {
    check_verdicts(of_bead("x''*cos(w*t) + y''*sin(w*t) = -2*mu*w*v\nlambda_rod = 6*m*w*v\n", "3*m"),
                   {Verdict::proved, Verdict::proved});
    check_verdicts(of_bead("x''*cos(w*t) + y''*sin(w*t) = 2*mu*w*v\n", "3*m"), {Verdict::refuted});
}

// On the constraint x + 2 y = 3 x.
TEST_CASE("check: a sign that constraints multiply by 3 stays what it is") {
    const Scene line = parse_scene(
        "[coordinates]\nx = 1\ny = { guess = 1 }\n[[particle]]\nname = \"P\"\nmass = 1\n"
        "position = [\"x\", \"y\"]\n[[constraint]]\nname = \"line\"\n"
        "holonomic = \"y - x\"\n",
        "line.toml");
    const Checked result =
        checked(with_claims(line, "sign(x + 2*y) = -sign(x)\nabs(x + 2*y) = -3*abs(x)\n", "claims.txt"));
    check_verdicts(result, {Verdict::refuted, Verdict::refuted});
}

TEST_CASE(
    "check: the equations of a rod in two rough slots are proved, and one without a slot's friction refuted") {
    const std::string first = "m*x'' = lambda_B - mu*abs(lambda_A)*sign(x' + l*theta'*sin(theta))\n",
                      second = "m*y'' = lambda_A - m*g - nu*abs(lambda_B)*sign(y' + l*theta'*cos(theta))\n",
                      third =
                          "m*l^2/3*theta'' = -l*cos(theta)*lambda_A - l*sin(theta)*lambda_B"
                          " - mu*abs(lambda_A)*sign(x' + l*theta'*sin(theta))*l*sin(theta)"
                          " - nu*abs(lambda_B)*sign(y' + l*theta'*cos(theta))*l*cos(theta)\n";
    const Scene trammel = friction_scene("trammel");
    const Checked right = checked(with_claims(trammel, first + second + third, "claims.txt"));
    check_verdicts(right, std::vector(3, Verdict::proved));
    CHECK(right.complete);
    const Checked wrong = checked(with_claims(
        trammel, "m*y'' = lambda_A - m*g\n" + third.substr(0, third.find(" - nu")) + "\n", "claims.txt"));
    check_verdicts(wrong, {Verdict::refuted, Verdict::refuted});
}

TEST_CASE("check: a claim at \"sticking\" is about the motion while friction holds, with its force") {
    const Checked result = of_bead(R"(
sticking
v = 0
friction_skin = m*(x''*cos(w*t) + y''*sin(w*t))
friction_skin = -m*w^2*(x*cos(w*t) + y*sin(w*t))
friction_skin = m*w^2*(x*cos(w*t) + y*sin(w*t))
lambda_rod = 0
sticking skin
x'' = -w^2*x
motion
x'' = -w^2*x
)");
    check_verdicts(result, {Verdict::proved, Verdict::proved, Verdict::proved, Verdict::refuted, Verdict::proved,
                            Verdict::proved, Verdict::refuted});
    REQUIRE(result.claims[3].likely);
    CHECK(result.claims[3].likely->kind == "sign");
    CHECK(!result.complete);

    check_verdicts(checked(with_claims(friction_scene("block_on_slope"),
                                       "sticking slope\nfriction_slope = -m*g*sin(alpha) - F\ns'' = 0\n"
                                       "friction_slope = -m*g*sin(alpha)\n",
                                       "claims.txt")),
                   {Verdict::proved, Verdict::proved, Verdict::refuted});
    // One of three blocks sticks to the belt while the others slide.
    const Scene blocks = friction_scene("belt_blocks");
    check_verdicts(checked(with_claims(blocks, "sticking second\nx2'' = 0\nmotion\nx2'' = 0\n", "claims.txt")),
                   {Verdict::proved, Verdict::refuted});
}

// Words are separated by blanks of any kind, and by commas in a file, as names after "unknowns" are.
TEST_CASE("check: the friction that sticks may stand behind a tab or a comma, and have a Greek name") {
    std::string text = test::contents(test::source_path("scenes/friction/block_on_slope.toml"));
    const std::string slope = "name = \"slope\"";
    text.replace(text.find(slope), slope.size(), "name = \"σ\"");
    text = text.substr(0, text.find("[[claim]]"));
    const std::string claim = "friction_σ = -m*g*sin(alpha) - F\n";
    for (const char* const at : {"sticking\tσ\n", "sticking \t σ\r\n", "sticking, σ\n", "  sticking\t\n"}) {
        CAPTURE(at);
        check_verdicts(checked(with_claims(parse_scene(text, "block.toml"), at + claim, "claims.txt")),
                       {Verdict::proved});
    }
    for (const char* const at : {"sticking\\tσ", "sticking  σ", "sticking\\t"}) {
        CAPTURE(at);
        check_verdicts(checked(parse_scene(text + "[[claim]]\nequation = \"" + claim.substr(0, claim.size() - 1) +
                                               "\"\nat = \"" + at + "\"\n",
                                           "block.toml")),
                       {Verdict::proved});
    }
}

TEST_CASE("check: in a plane the force of what sticks has two components") {
    const Scene puck = friction_scene("puck_on_slope");
    check_verdicts(
        checked(with_claims(puck, "sticking\nfriction_slope_1 = 0\nfriction_slope_2 = -m*g*sin(alpha)\n",
                            "claims.txt")),
        {Verdict::proved, Verdict::proved});
}

// With as many speeds as the blade leaves free there are too many of them while the runner sticks.
TEST_CASE("derive: a sled in generalized speeds shows the equations while its runner sticks") {
    const auto sled = [](const std::string& speeds, const std::string& slip) {
        return parse_scene(R"toml(
[parameters]
m = 4
J = 0.8
g = 9.81
mu = 0.1
[coordinates]
x = {}
y = {}
phi = 0.2
)toml" + speeds + R"toml(
[[frame]]
name = "S"
rotate = [["z", "phi"]]
[[body]]
name = "sled"
mass = "m"
inertia = "J"
frame = "S"
position = ["x", "y"]
[[constraint]]
name = "blade"
nonholonomic = "y'*cos(phi) - x'*sin(phi)"
[[friction]]
name = "runner"
coefficient = "mu"
slip = ")toml" + slip + R"toml("
normal = "m*g"
)toml",
                           "sled.toml");
    };
    const std::string along = "x'*cos(phi) + y'*sin(phi)",
                      speeds = "[speeds]\nv = { form = \"" + along +
                               "\", initial = 1.2 }\nw = { form = \"phi'\", initial = 0.3 }\n";
    const auto held = [](const DerivedScene& d) {
        std::vector<std::string> result;
        REQUIRE(d.shown.frictions.size() == 1);
        for (const ReadableEquation& e : d.shown.frictions[0].held)
            result.push_back(text(e.lhs) + " = " + text(e.rhs));
        return result;
    };
    const Scene in_speeds = sled(speeds, "v");
    const std::vector<std::string> equations = held(derive(in_speeds));
    CHECK(equations.size() == 3);
    CHECK(equations == held(derive(sled("", along))));
    std::string claims = "sticking\nv = 0\nx'' = 0\nw' = 0\nfriction_runner = 0\n";
    for (const std::string& equation : equations) claims += equation + "\n";
    check_verdicts(checked(with_claims(in_speeds, claims, "claims.txt")), std::vector(7, Verdict::proved));
}

TEST_CASE("derive: a parameter with the name of the force of what sticks stays a parameter") {
    std::string block = test::contents(test::source_path("scenes/friction/block_on_slope.toml"));
    for (const auto& [from, to] : {std::pair{"[inputs]", "friction_slope = 1.5\n[inputs]"},
                                   {"s = \"F\"", "s = \"F + friction_slope\""},
                                   {"sign(s')\"", "sign(s') + friction_slope\""}}) {
        const std::size_t at = block.find(from);
        REQUIRE(at != std::string::npos);
        block.replace(at, std::string(from).size(), to);
    }
    const Scene scene = parse_scene(block, "block.toml");
    check_verdicts(checked(scene), {Verdict::proved});
    const DerivedScene d = derive(scene);
    REQUIRE(d.shown.frictions.size() == 1);
    CHECK(d.shown.frictions[0].held.empty());
    try {
        checked(with_claims(scene, "sticking\ns'' = 0\n", "claims.txt"));
        FAIL("the force of what sticks has no name");
    } catch (const SceneError& mistake) {
        CHECK(std::string(mistake.what()).find("'friction_slope' is its force, and the scene has a parameter") !=
              std::string::npos);
    }
}

TEST_CASE("check: claims about sticking where nothing of this name can stick are mistakes") {
    const auto told = [](const Scene& scene, const std::string& claims) -> std::string {
        try {
            checked(with_claims(scene, claims, "claims.txt"));
        } catch (const std::runtime_error& mistake) {
            return mistake.what();
        }
        return "";
    };
    CHECK(told(bead(), "sticking skni\nx = 0\n").find("did you mean 'skin'") != std::string::npos);
    CHECK(told(bead(), "motion\nfriction_skin = 0\n").find("friction_skin") != std::string::npos);
    const Scene free = read_scene(test::source_path("scenes/textbook/double_pendulum.toml"));
    CHECK(told(free, "sticking\ntheta1 = 0\n").find("the scene has no [[friction]]") != std::string::npos);
}

}  // namespace check_friction
