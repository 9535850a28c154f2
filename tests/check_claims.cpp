// SPDX-License-Identifier: MIT
// Verdicts on hand derivations: right ones in any dress are proved, wrong ones refuted with the slip named.
#include <doctest/doctest.h>

#include <fmt/format.h>

#include "analysis/check.hpp"
#include "scene/claims_file.hpp"
#include "scenes.hpp"

using namespace alembert;

namespace {

Checked checked(Scene scene) {
    const Mechanism m = build(scene);
    return check(scene, m);
}

/// A textbook scene with these claims in place of its own.
Checked checked(const std::string& name, const std::string& claims) {
    return checked(with_claims(read_scene(test::source_path("scenes/textbook/" + name + ".toml")), claims, "claims.txt"));
}

}  // namespace

TEST_CASE("check: every hand derivation that a textbook scene carries is proved") {
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

TEST_CASE("check: the equation of rest of example 1-1 is proved, and one of its branches alone refuted by the other") {
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

// m x'' = a tan φ, m y'' = −a with any scale of a; x'' = … alone is taken up by a.
TEST_CASE("check: unknown multipliers are in the author's sign and scale, and a claim that one takes up alone is vacuous") {
    const Checked right = checked("sled", "unknowns a\nm*xC'' = -7*a*sin(phi)\nm*yC'' = 7*a*cos(phi)\nphi'' = 0\n");
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
TEST_CASE("check: of claims that share an unknown the one that the others contradict is refuted, with its slip") {
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
    CHECK(slip("(m1+m2)*l1*theta1'' + m2*l2*theta2''*cos(theta1-theta2) + m2*l2*theta2'^2*sin(theta1-theta2) - (m1+m2)*g*sin(theta1) = F*cos(theta1)") == "sign");
    CHECK(slip("(m1+m2)*l1*theta1'' + m2*l2*theta2''*cos(theta1-theta2) + 2*m2*l2*theta2'^2*sin(theta1-theta2) + (m1+m2)*g*sin(theta1) = F*cos(theta1)") == "factor");
    CHECK(slip("(m1+m2)*l1*theta1'' + m2*l2*theta2'*cos(theta1-theta2) + m2*l2*theta2'^2*sin(theta1-theta2) + (m1+m2)*g*sin(theta1) = F*cos(theta1)") == "lost_dot");
    CHECK(slip("(m1+m2)*l1*theta1'' + m2*l2*theta2''*cos(theta1-theta2) + (m1+m2)*g*sin(theta1) = F*cos(theta1)") == "missing_term");
    CHECK(slip("(m1+m2)*l1*theta1'' + m2*l2*theta2''*cos(theta1-theta2) + m2*l2*theta2'^2*sin(theta1-theta2) + m1*l1*theta1'^2 + (m1+m2)*g*sin(theta1) = F*cos(theta1)") == "extra_term");
    CHECK(slip("(m1+m2)*l1*theta1'' + m2*l2*theta2''*sin(theta1-theta2) + m2*l2*theta2'^2*sin(theta1-theta2) + (m1+m2)*g*sin(theta1) = F*cos(theta1)") == "swapped_trig");
    CHECK(slip("(m1+m2)*l1*theta1'' + m2*l2*theta2''*cos(theta1-theta2) + m2*l2*theta2'^2*sin(theta1+theta2) + (m1+m2)*g*sin(theta1) = F*cos(theta1)") == "wrong_argument");
    CHECK(slip("(m1+m2)*l1*theta1'' + m2*l1*theta2''*cos(theta1-theta2) + m2*l2*theta2'^2*sin(theta1-theta2) + (m1+m2)*g*sin(theta1) = F*cos(theta1)") == "wrong_arm");
    CHECK(slip("m2*l2*theta2'' + m2*l1*theta1''*cos(theta1-theta2) - m2*l1*theta1'^2*sin(theta1-theta2) + m2*g*sin(theta2) + (m1+m2)*g*sin(theta1) = F*cos(theta2)") == "wrong_row");
}

TEST_CASE("check: the difference from the nearest right equation is shown after matching the row's scale") {
    const Checked result = checked("double_pendulum",
                                   "theta1'' + m2*l2/((m1+m2)*l1)*theta2''*cos(theta1-theta2) + m2*l2*theta2'^2*sin(theta1-theta2)/((m1+m2)*l1) + "
                                   "g*sin(theta1)/l1 = -F*cos(theta1)/((m1+m2)*l1)\n");
    REQUIRE(result.claims[0].verdict == Verdict::refuted);
    CHECK(result.claims[0].likely->kind == "sign");
}

TEST_CASE("check: a claim that holds at the scene's values only is refuted, with that said") {
    // two_body has m1 = 3 and m2 = 1.
    Scene scene = parse_scene("[parameters]\nm = 2\nk = 8\n[coordinates]\nx = 1\n[energy]\nkinetic = \"m*x'^2/2\"\npotential = \"k*x^2/2\"\n"
                              "[[claim]]\nequation = \"x'' = -4*x\"\n", "values.toml");
    const Checked result = checked(scene);
    REQUIRE(result.claims[0].verdict == Verdict::refuted);
    CHECK(result.claims[0].reason.find("scene's values") != std::string::npos);
}

TEST_CASE("check: momenta are legal in claims; names that are not declared and lines that are no equations are errors with their place") {
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

TEST_CASE("check: claims at an impact speak of the rates before and after, at the pose where the scene starts") {
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
