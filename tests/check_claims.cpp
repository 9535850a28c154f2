// SPDX-License-Identifier: MIT
// Verdicts on hand derivations: right ones in any form are proved, wrong ones are refuted and the slip is named.
#include <doctest/doctest.h>

#include "algebra/notation/text.hpp"
#include "analysis/derive/derivation.hpp"
#include "checked.hpp"
#include "model/formalism/routh.hpp"

namespace check_claims {

using namespace alembert;
using test::check_verdicts;
using test::checked;

TEST_CASE("check: every hand derivation in a textbook scene is proved") {
    int claims = 0;
    for (const std::string& file : test::scenes_in("scenes/textbook")) {
        CAPTURE(file);
        const Scene scene = read_scene(file);
        const Checked result = checked(scene);
        for (std::size_t k = 0; k < result.claims.size(); ++k) {
            const std::string equation = text_of(scene.claims[k].equation);
            CAPTURE(equation);
            CHECK(result.claims[k].verdict == Verdict::proved);
            ++claims;
        }
    }
    CHECK(claims >= 150);
}

// m x'' = a tan φ, m y'' = −a with any scale of a; a claim x'' = … alone can be satisfied by the choice of a.
TEST_CASE(
    "check: unknown multipliers are in the author's sign and scale, and a claim that one takes up alone is "
    "vacuous") {
    const Checked right =
        checked("sled", "unknowns a\nm*xC'' = -7*a*sin(phi)\nm*yC'' = 7*a*cos(phi)\nphi'' = 0\n");
    for (const CheckedClaim& c : right.claims) CHECK(c.verdict == Verdict::proved);
    CHECK(right.complete);
    const Checked alone = checked("sled", "unknowns a\nm*xC'' = a*tan(phi)\nphi'' = 0\n");
    CHECK(alone.claims[0].verdict == Verdict::vacuous);
    CHECK(alone.claims[1].verdict == Verdict::proved);
    CHECK_FALSE(alone.complete);
    const Checked wrong = checked("sled", "unknowns a\nm*xC'' = a*tan(phi)\nm*yC'' = a\nphi'' = 0\n");
    CHECK(wrong.claims[0].verdict == Verdict::refuted);
    CHECK(wrong.claims[1].verdict == Verdict::refuted);
    CHECK(wrong.claims[2].verdict == Verdict::proved);
}

// Three equations with one unknown: the two that agree show which is wrong.
TEST_CASE(
    "check: among claims with a common unknown, the one that the others contradict is refuted with its slip") {
    const Checked result = checked("sled", "unknowns a\nm*xC'' = a*tan(phi)\nm*yC'' = -a\na = m*xC'*phi'\n");
    CHECK(result.claims[0].verdict == Verdict::proved);
    CHECK(result.claims[1].verdict == Verdict::proved);
    REQUIRE(result.claims[2].verdict == Verdict::refuted);
    REQUIRE(result.claims[2].likely);
    CHECK(result.claims[2].likely->kind != "unknown");
    CHECK_FALSE(result.claims[2].counterexample.empty());
}

TEST_CASE("check: integrals of the motion as derivatives and with constants") {
    const Checked result = checked("two_body", R"(
constants h E c1 c2
r^2*phi' = h
m1*m2/(m1+m2)*(r'^2 + r^2*phi'^2)/2 - G*m1*m2/r = E
r*phi'^2 = c1
(r^2*phi')' = 0
X = c1 + c2*t
)");
    CHECK(result.claims[0].verdict == Verdict::proved);
    CHECK(result.claims[1].verdict == Verdict::proved);
    CHECK(result.claims[2].verdict == Verdict::refuted);
    CHECK(result.claims[3].verdict == Verdict::proved);
    const Checked line = checked("two_body", "constants c1 c2\nX = c1 + c2*t\nX' = c2\n");
    for (const CheckedClaim& c : line.claims) CHECK(c.verdict == Verdict::proved);
}

TEST_CASE("check: the slips of students are named") {
    const auto slip = [](const std::string& claim) {
        const Checked result = checked("double_pendulum", claim + "\n");
        CAPTURE(claim);
        REQUIRE(result.claims[0].verdict == Verdict::refuted);
        CHECK_FALSE(result.claims[0].counterexample.empty());
        return result.claims[0].likely ? result.claims[0].likely->kind : std::string("unknown");
    };
    CHECK(slip("(m1+m2)*l1*theta1'' + m2*l2*theta2''*cos(theta1-theta2) + m2*l2*theta2'^2*sin(theta1-theta2) - "
               "(m1+m2)*g*sin(theta1) = F*cos(theta1)") == "sign");
    CHECK(slip("(m1+m2)*l1*theta1'' + m2*l2*theta2''*cos(theta1-theta2) + 2*m2*l2*theta2'^2*sin(theta1-theta2) + "
               "(m1+m2)*g*sin(theta1) = F*cos(theta1)") == "factor");
    CHECK(slip("(m1+m2)*l1*theta1'' + m2*l2*theta2'*cos(theta1-theta2) + m2*l2*theta2'^2*sin(theta1-theta2) + "
               "(m1+m2)*g*sin(theta1) = F*cos(theta1)") == "lost_dot");
    CHECK(
        slip("(m1+m2)*l1*theta1'' + m2*l2*theta2''*cos(theta1-theta2) + (m1+m2)*g*sin(theta1) = F*cos(theta1)") ==
        "missing_term");
    CHECK(slip("(m1+m2)*l1*theta1'' + m2*l2*theta2''*cos(theta1-theta2) + m2*l2*theta2'^2*sin(theta1-theta2) + "
               "m1*l1*theta1'^2 + (m1+m2)*g*sin(theta1) = F*cos(theta1)") == "extra_term");
    CHECK(slip("(m1+m2)*l1*theta1'' + m2*l2*theta2''*sin(theta1-theta2) + m2*l2*theta2'^2*sin(theta1-theta2) + "
               "(m1+m2)*g*sin(theta1) = F*cos(theta1)") == "swapped_trig");
    CHECK(slip("(m1+m2)*l1*theta1'' + m2*l2*theta2''*cos(theta1-theta2) + m2*l2*theta2'^2*sin(theta1+theta2) + "
               "(m1+m2)*g*sin(theta1) = F*cos(theta1)") == "wrong_argument");
    CHECK(slip("(m1+m2)*l1*theta1'' + m2*l1*theta2''*cos(theta1-theta2) + m2*l2*theta2'^2*sin(theta1-theta2) + "
               "(m1+m2)*g*sin(theta1) = F*cos(theta1)") == "wrong_arm");
    CHECK(slip("m2*l2*theta2'' + m2*l1*theta1''*cos(theta1-theta2) - m2*l1*theta1'^2*sin(theta1-theta2) + "
               "m2*g*sin(theta2) + (m1+m2)*g*sin(theta1) = F*cos(theta2)") == "wrong_row");
}

TEST_CASE("check: slips in equations of speeds and in relations of kinematics are named, with the right claim") {
    const auto slip = [](const std::string& scene, const std::string& claim) {
        const Checked result = checked(scene, claim + "\n");
        REQUIRE(result.claims[0].verdict == Verdict::refuted);
        REQUIRE(result.claims[0].likely);
        return *result.claims[0].likely;
    };
    CHECK(slip("heavy_top_quaternion", "A*w1' = 2*m*g*l*(e2*e3 + e0*e1)").term == "(A-C)*w2*w3");
    CHECK(slip("free_body_quaternion", "2*e0' = -e1*w1 - e2*w2").term == "-w3*e3");
    const Slip turned = slip("euler_angles", "dot(ez(N), ey(F)) = -sin(theta)*cos(phi)");
    CHECK(turned.kind == "sign");
    CHECK(turned.repair == "dot(ez(N), ey(F)) = sin(theta)*cos(phi)");
    CHECK(slip("universal_joint", "2*dot(alpha(S2), ez(S2)) = theta2''").kind == "factor");
}

TEST_CASE("check: the slips in claims about rest and about impacts are named too") {
    const auto slip = [](const std::string& scene, const std::string& claim) {
        CAPTURE(claim);
        const Checked result = checked(scene, claim + "\n");
        REQUIRE(result.claims[0].verdict == Verdict::refuted);
        REQUIRE(result.claims[0].likely);
        return result.claims[0].likely->kind + ": " + result.claims[0].likely->term;
    };
    const std::string condition = "sin(alpha)*(m*l*Omega^2*cos(alpha) ";
    CHECK(slip("watt_governor", "rest\n" + condition + "+ (m+M)*g) = 0").rfind("sign: ", 0) == 0);
    CHECK(slip("watt_governor", "rest\n" + condition + "- (m+m)*g) = 0").rfind("factor: ", 0) == 0);
    CHECK(slip("watt_governor", "rest\n" + condition + "- 2*(m+M)*g) = 0").rfind("factor: ", 0) == 0);
    CHECK(slip("watt_governor", "rest\n" + condition + ") = 0").rfind("missing_term: ", 0) == 0);
    CHECK(slip("watt_governor", "rest\nsin(alpha)*(m*l*Omega^2*sin(alpha) - (m+M)*g) = 0") ==
          "swapped_trig: m*l*Omega^2*sin(alpha)");
    const std::string momentum =
        "m*l^2*(4/3*(theta1'-theta1'(-)) + 1/2*(theta2'-theta2'(-))*cos(theta1-theta2)) = ";
    CHECK(slip("struck_rods", "impact\n" + momentum + "0").rfind("missing_term: ", 0) == 0);
    CHECK(slip("struck_rods", "impact\n" + momentum + "2*S*l*cos(theta1)") == "factor: 2*S*l*cos(theta1)");
    CHECK(slip("struck_rods", "impact\ntheta2' = 7/2*theta1'") == "factor: 7/2*theta1'");
}

// 2·ω' J and the like divided by (e·e)², as the rotation is for every e, would be the quotients.
TEST_CASE("check: the printed equations of a body turned by a quaternion use e.e = 1 and are proved") {
    const Scene scene = parse_scene(R"(title = "Free body"
[parameters]
A = 1.0
B = 2.0
C = 2.5
[coordinates]
e0 = 1
e1 = { initial = 0, rate = 0.3 }
e2 = { initial = 0, rate = -0.2 }
e3 = 0
[[frame]]
name = "F"
quaternion = ["e0", "e1", "e2", "e3"]
[[body]]
name = "body"
frame = "F"
mass = 1
inertia = ["A", "B", "C"]
position = [0, 0, 0]
)",
                                    "quaternion.toml");
    const Mechanism m = prepared(scene).mechanism;
    const Derivation shown = derivation_of(m, routh(m));
    REQUIRE(shown.definitions.empty());
    CHECK(shown.has_unit_quaternions);
    std::string claims;
    for (const ReadableEquation& e : shown.equations) claims += text(e.lhs) + " = " + text(e.rhs) + "\n";
    CHECK(claims.find('/') == std::string::npos);
    const Checked result = checked(with_claims(scene, claims, "claims.txt"));
    check_verdicts(result, std::vector<Verdict>(4, Verdict::proved));
}

TEST_CASE("check: the printed equations of springs and of a blade with powers and quotients are proved") {
    const Scene springs = parse_scene(R"toml(title = "Springs"
[parameters]
m = 1.0
k = 2.0
b = 0.5
l0 = 0.3
[coordinates]
x1 = 0.1
y1 = 0.2
x2 = 0.7
y2 = 0
[[particle]]
name = "P1"
mass = "m"
position = ["x1", "y1"]
[[particle]]
name = "P2"
mass = "m"
position = ["x2", "y2"]
[[spring]]
between = ["P1", "P2"]
stiffness = "k"
length = "l0"
[energy]
potential = "b/4*((x2-x1)^4 + x1^4)"
)toml",
                                      "springs.toml");
    const Scene sled = read_scene(test::source_path("scenes/textbook/sled.toml"));
    for (const Scene& scene : {springs, sled}) {
        const Mechanism m = prepared(scene).mechanism;
        const Derivation shown = derivation_of(m, formalism("kane").derive(m));
        std::string claims;
        for (const ReadableEquation& e : shown.equations) claims += text(e.lhs) + " = " + text(e.rhs) + "\n";
        CAPTURE(claims);
        CHECK(claims.find(m.constraints.empty() ? "(x1-x2)^3" : "xC'' + xC'*phi'*tan(phi) = 0") !=
              std::string::npos);
        const Checked result = checked(with_claims(scene, claims, "claims.txt"));
        check_verdicts(result, std::vector<Verdict>(shown.equations.size(), Verdict::proved));
    }
}

// theta2' l2 cos has the dimension of a velocity among accelerations, and no single change sets the claim right.
TEST_CASE("check: a term with the wrong dimension is named if no single change helps") {
    const Checked result = checked("double_pendulum", R"(
(m1+m2)*l1*theta1'' - 3*m2*l2*theta2'*sin(theta1-theta2) + 2*(m1+m2)*g*cos(theta1) = 5*F*sin(theta1)
(m1+m2)*l1*theta1'' - 3*m2*l2*theta2'^2*theta1*sin(theta2) + 2*(m1+m2)*g*cos(theta1) = 5*F*sin(theta1)
)");
    check_verdicts(result, {Verdict::refuted, Verdict::refuted});
    REQUIRE(result.claims[0].likely);
    CHECK(result.claims[0].likely->kind == "wrong_unit");
    CHECK(result.claims[0].likely->term == "3*m2*l2*theta2'*sin(theta1-theta2)");
    CHECK_FALSE(result.claims[1].likely);
}

TEST_CASE("check: the difference from the nearest right equation is shown after matching the row's scale") {
    const Checked result = checked("double_pendulum",
                                   "theta1'' + m2*l2/((m1+m2)*l1)*theta2''*cos(theta1-theta2) + "
                                   "m2*l2*theta2'^2*sin(theta1-theta2)/((m1+m2)*l1) + "
                                   "g*sin(theta1)/l1 = -F*cos(theta1)/((m1+m2)*l1)\n");
    REQUIRE(result.claims[0].verdict == Verdict::refuted);
    CHECK(result.claims[0].likely->kind == "sign");
}

TEST_CASE("check: a claim that holds only at the scene's values is refuted, and the reason is given") {
    // two_body has m1 = 3 and m2 = 1.
    Scene scene = parse_scene(
        "[parameters]\nm = 2\nk = 8\n[coordinates]\nx = 1\n[energy]\nkinetic = \"m*x'^2/2\"\npotential = "
        "\"k*x^2/2\"\n"
        "[[claim]]\nequation = \"x'' = -4*x\"\n",
        "values.toml");
    const Checked result = checked(scene);
    REQUIRE(result.claims[0].verdict == Verdict::refuted);
    CHECK(result.claims[0].reason.find("scene's values") != std::string::npos);
}

TEST_CASE(
    "check: momenta are legal in claims; names that are not declared and lines that are no equations are errors "
    "with their place") {
    const Checked result = checked("two_body", "(p_phi)' = 0\np_phi = m1*m2/(m1+m2)*r^2*phi'\n");
    for (const CheckedClaim& c : result.claims) CHECK(c.verdict == Verdict::proved);
    const auto complaint = [](const std::string& claims) -> std::string {
        try {
            checked("two_body", claims);
        } catch (const SceneError& e) {
            return e.what();
        }
        return {};
    };
    CHECK(complaint("r'' = 0\nrho'' = 0\n").find(":2:1: unknown name 'rho'") != std::string::npos);
    CHECK(complaint("r''\n").find(":1:1: an equation needs an = sign") != std::string::npos);
    CHECK(complaint("p_rho = 0\n").find("unknown name 'p_rho'") != std::string::npos);
    CHECK(complaint("unknowns r\nr'' = 0\n").find("cannot be left open") != std::string::npos);
    CHECK(complaint("# nothing\n").find("has no claims") != std::string::npos);
}

TEST_CASE("check: the derivative of a multiplier, an acceleration or an unknown function is refused") {
    for (const char* claims :
         {"(lambda1)' = 0\n", "(m*xC'*phi' + lambda1)' = 0\n", "unknowns a\n(a*phi')' = 0\n"}) {
        CAPTURE(claims);
        CHECK_THROWS_AS(checked("sled", claims), SceneError);
    }
}

// l'' = 0, so that a repair that is tried divides by zero: l'/l'' in place of l'/l.
TEST_CASE(
    "check: a pendulum whose string is drawn in evenly has the equation of the book, and its slip is refuted") {
    const std::string scene =
        "gravity = [0, \"-g\"]\nparameters = { m = 1, l0 = 1, v = 0.05, g = 9.81 }\ninputs = { l = \"l0 - v*t\" "
        "}\n"
        "coordinates = { theta = 0.2 }\n"
        "[[particle]]\nname = \"bob\"\nmass = \"m\"\nposition = [\"l*sin(theta)\", \"-l*cos(theta)\"]\n";
    const Checked result = checked(with_claims(parse_scene(scene, "s.toml"), R"(
theta'' + 2*l'/l*theta' + g/l*sin(theta) = 0
theta'' + l'/l*theta' + g/l*sin(theta) = 0
constants E
m*l^2*theta'^2/2 + m*l'^2/2 - m*g*l*cos(theta) = E
)",
                                               "claims.txt"));
    check_verdicts(result, {Verdict::proved, Verdict::refuted, Verdict::refuted});
    REQUIRE(result.claims[1].likely);
    CHECK(result.claims[1].likely->kind == "factor");
}

TEST_CASE("check: a claim that divides by what is always zero is undecided, and the others are judged") {
    const std::string scene =
        "parameters = { m = 1, k = 2 }\ninputs = { s = \"3\", r = \"2*t\" }\ncoordinates = { x = 0.3, y = 0.2 }\n"
        "[[particle]]\nname = \"P\"\nmass = \"m\"\nposition = [\"x\", \"y\"]\n"
        "[[spring]]\nalong = \"x\"\nstiffness = \"k\"\n";
    const Checked result = checked(with_claims(parse_scene(scene, "s.toml"), R"(
x'' + k*x/m = 0
x'' + k*x/s' = 0
x'' + k*x/(r''*m) = 0
y'' = x/s''
x'' + k*x/(sin(x)^2 + cos(x)^2 - 1) = 0
constants E
m*x'^2/2 + k*x^2/2 = E + s/r''
m*x'^2/2 + k*x^2/2 = E
rest
y = x/s'
x = 0
motion
y'' = x
y'' = 0
)",
                                               "claims.txt"));
    check_verdicts(result, {Verdict::proved, Verdict::undecided, Verdict::undecided, Verdict::undecided,
                            Verdict::undecided, Verdict::undecided, Verdict::proved, Verdict::undecided,
                            Verdict::proved, Verdict::refuted, Verdict::proved});
    for (const CheckedClaim& c : result.claims)
        if (c.verdict == Verdict::undecided) CHECK(c.reason.find("divides by something") != std::string::npos);
    CHECK(result.complete);
}

}  // namespace check_claims
