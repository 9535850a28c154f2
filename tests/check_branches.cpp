// SPDX-License-Identifier: MIT
// A claim is judged on the branch of the constraints on which the scene starts, and another branch that decides
// otherwise is told.
#include <doctest/doctest.h>

#include "branch_scenes.hpp"
#include "checked.hpp"

namespace check_branches {

using namespace alembert;
using namespace alembert::test;

namespace {

enum class Elsewhere { same, holds, fails };

struct Expected {
    std::string claim;
    Verdict verdict;
    Elsewhere elsewhere = Elsewhere::same;
};

void check_expected(const BranchScene& scene, const std::vector<Expected>& expected) {
    const Checked result = checked(scene.scene());
    REQUIRE(result.claims.size() == expected.size());
    for (std::size_t k = 0; k < expected.size(); ++k) {
        CAPTURE(scene.name);
        CAPTURE(expected[k].claim);
        const CheckedClaim& claim = result.claims[k];
        INFO(claim.reason);
        CHECK(claim.verdict == expected[k].verdict);
        const Elsewhere elsewhere = !claim.other_branch                              ? Elsewhere::same
                                    : claim.other_branch->verdict == Verdict::proved ? Elsewhere::holds
                                                                                     : Elsewhere::fails;
        CHECK(elsewhere == expected[k].elsewhere);
        CHECK((claim.verdict == Verdict::refuted) == !claim.counterexample.empty());
    }
}

std::vector<std::string> texts(const std::vector<Expected>& expected) {
    std::vector<std::string> result;
    for (const Expected& e : expected) result.push_back(e.claim);
    return result;
}

constexpr Verdict proved = Verdict::proved, refuted = Verdict::refuted;

}  // namespace

TEST_CASE("check: a branch on which an angle is pi, whatever the others are, is not lost") {
    const std::vector<Expected> at_pi{{"b' = 0", proved, Elsewhere::fails},
                                      {"b' = -2*a'", refuted, Elsewhere::holds},
                                      {"b'*(b' + 2*a') = 0", proved},
                                      {"sin(a)^2*a'' + sin(a)*cos(a)*a'^2 = 0", proved, Elsewhere::fails},
                                      {"(sin(a)^2 + 4)*a'' + sin(a)*cos(a)*a'^2 = 0", refuted, Elsewhere::holds},
                                      {"a' = 0", refuted}};
    check_expected(straight_angle("pi", texts(at_pi)), at_pi);
    const std::vector<Expected> turned{{"b' = 0", refuted},
                                       {"b' = -2*a'", proved},
                                       {"b = -2*a", proved},
                                       {"(sin(a)^2 + 4)*a'' + sin(a)*cos(a)*a'^2 = 0", proved},
                                       {"sin(a)^2*a'' + sin(a)*cos(a)*a'^2 = 0", refuted}};
    check_expected(straight_angle("-0.6", texts(turned)), turned);
}

TEST_CASE("check: a parallelogram and its crossed twin each decide on their own branch") {
    const std::vector<Expected> parallel{{"q1 = q2", proved, Elsewhere::fails},
                                         {"q3' = 0", proved, Elsewhere::fails},
                                         {"sin(q1) = sin(q2)", proved, Elsewhere::fails},
                                         {"L*cos(q1)*q1' - b*sin(q3)*q3' - L*cos(q2)*q2' = 0", proved},
                                         {"q1' + q2' = 0", refuted}};
    check_expected(parallelogram("0.3", "0", texts(parallel)), parallel);
    const std::vector<Expected> crossed{{"q3' = 0", refuted, Elsewhere::holds},
                                        {"q1' = q2'", refuted, Elsewhere::holds},
                                        {"L*cos(q1)*q1' - b*sin(q3)*q3' - L*cos(q2)*q2' = 0", proved},
                                        {"sin(q3)*(1 - cos(q3)) = 0", refuted, Elsewhere::holds}};
    check_expected(parallelogram("-2.1776", "1.2643", texts(crossed)), crossed);
}

TEST_CASE("check: branches that differ by the signs of roots are told apart, rational or not") {
    const std::vector<Expected> right{
        {"x = l", proved, Elsewhere::fails}, {"x = -l", refuted, Elsewhere::holds}, {"x^2 = l^2", proved}};
    check_expected(walls("2", texts(right)), right);
    const std::vector<Expected> left{
        {"x = l", refuted, Elsewhere::holds}, {"x = -l", proved, Elsewhere::fails}, {"x' = 0", proved}};
    check_expected(walls("-2", texts(left)), left);
    const std::vector<Expected> together{
        {"x = z", proved, Elsewhere::fails}, {"x = -z", refuted, Elsewhere::holds}, {"x^2 = z^2", proved}};
    check_expected(two_legs("1.4", texts(together)), together);
    const std::vector<Expected> apart{{"x'' = z''", refuted, Elsewhere::holds},
                                      {"x'' = -z''", proved, Elsewhere::fails}};
    check_expected(two_legs("-1.4", texts(apart)), apart);
}

TEST_CASE("check: a folded slider-crank of joints stands still, and the same one unfolded moves") {
    const std::vector<Expected> folded{{"x = 0", proved, Elsewhere::fails},
                                       {"psi' = 0", proved, Elsewhere::fails},
                                       {"psi' = -2*phi'", refuted, Elsewhere::holds}};
    check_expected(folded_slider_crank(true, texts(folded)), folded);
    const std::vector<Expected> open{{"x = 2*r*cos(phi)", proved, Elsewhere::fails},
                                     {"psi' = -2*phi'", proved, Elsewhere::fails},
                                     {"x = 0", refuted, Elsewhere::holds}};
    check_expected(folded_slider_crank(false, texts(open)), open);
}

// x − r cos θ = ±√(l² − r² sin² θ), and the same sign in the velocity, also where the scene starts at rest.
TEST_CASE("check: a root in a velocity has the sign of the scene's branch, at rest too") {
    const std::string root = "sqrt(l^2 - r^2*sin(theta)^2)", x = "x = r*cos(theta) ",
                      v = "x' = -r*sin(theta)*theta' ", slope = "r^2*sin(theta)*cos(theta)*theta'/" + root;
    for (const bool above : {true, false}) {
        const Checked result = checked(
            with_root(above ? "3.9" : "-2", {x + "+" + root, x + "-" + root, v + "-" + slope, v + "+" + slope})
                .scene());
        CAPTURE(above);
        for (std::size_t k = 0; k < 4; ++k) {
            CAPTURE(k);
            CHECK(result.claims[k].verdict == ((k % 2 == 0) == above ? proved : refuted));
            if (result.claims[k].verdict == proved)
                CHECK(conditions_of(result.claims[k]) ==
                      std::vector<std::string>{above ? "x - r*cos(theta) > 0" : "r*cos(theta) - x > 0"});
        }
    }
}

TEST_CASE("check: a reaction in terms of a constant of the motion is proved, and a wrong multiple of it refuted") {
    const Scene scene = parse_scene(R"(gravity = [0, "-g"]
[parameters]
m = 1
l = 1
g = 9.81
[coordinates]
x = { initial = "l", rate = 0 }
y = { initial = 0, rate_guess = 0 }
[[particle]]
name = "P"
mass = "m"
position = ["x", "y"]
[[constraint]]
name = "rod"
holonomic = "x^2 + y^2 = l^2"
)",
                                    "tension.toml");
    const std::string energy = "constants E\nm*(x'^2+y'^2)/2 + m*g*y = E\n";
    check_verdicts(checked(with_claims(scene, energy + "2*l^2*lambda_rod = 3*m*g*y - 2*E", "claims.txt")),
                   {proved, proved});
    check_verdicts(checked(with_claims(scene, energy + "2*l^2*lambda_rod = 2*m*g*y - 2*E", "claims.txt")),
                   {proved, refuted});
}

TEST_CASE("check: an identity is vacuous unless it holds something that the scene defines") {
    const Checked result = checked("double_pendulum", R"(
0 = 0
sin(theta1)^2 + cos(theta1)^2 = 1
m1*theta1'' - theta1''*m1 = 0
F' = 3/2*cos(3*t)
dot(vel(M1), vel(M1)) = l1^2*theta1'^2
)");
    check_verdicts(result, {Verdict::vacuous, Verdict::vacuous, Verdict::vacuous, proved, proved});
}

TEST_CASE("check: ten loops in a row are decided, though most draws of their roots leave no motion") {
    const Scene scene = read_scene(source_path("scenes/benchmark/large/four_bars_10.toml"));
    const Checked result = checked(with_claims(scene, "q0'' = 0\nq0'' = q1''\nq0' = q10'\n", "claims.txt"));
    check_verdicts(result, {refuted, proved, proved});
    CHECK(!result.claims[0].counterexample.empty());
    for (const std::size_t k : {1UL, 2UL}) {
        REQUIRE(result.claims[k].other_branch);
        CHECK(result.claims[k].other_branch->verdict == refuted);
    }
}

namespace {

/// Two particles on an axis, and others, bound to each other.
std::string bound(const std::string& coordinates, const std::vector<std::string>& constraints) {
    std::string scene = "[parameters]\nm = 1.5\nk = 3.5\n[coordinates]\n" + coordinates + "\n";
    for (const char* name : {"a", "b", "e"})
        if (("\n" + coordinates).find(fmt::format("\n{} = ", name)) != std::string::npos)
            scene += fmt::format("[[particle]]\nname = \"P{0}\"\nmass = \"m\"\nposition = [\"{0}\", 0]\n", name);
    scene += "[forces]\na = \"-k*a - 1.8\"\nb = 1.1\n";
    for (std::size_t k = 0; k < constraints.size(); ++k)
        scene += fmt::format("[[constraint]]\nname = \"z{}\"\nholonomic = \"{}\"\n", k, constraints[k]);
    return scene;
}

}  // namespace

TEST_CASE("check: on branches for whose numbers exact arithmetic has no place, their digits decide") {
    check_verdicts(
        checked_on_sheets(bound("a = -0.75\nb = -1.5", {"(a - 0.5*b)*(a - sqrt(3)*b)*(a + b)"}),
                          "a = 0.5*b\na*(a - 0.5*b) = 0\na' - 0.5*b' = 0\na = sqrt(3)*b\na = -b\na = 0.5001*b\n"
                          "m*a'' + 2*m*b'' = -k*a + 0.4\nm*a'' + 2*m*b'' = -k*a + 0.5\n"),
        {proved, proved, proved, refuted, refuted, refuted, proved, refuted});
    check_verdicts(
        checked_on_sheets(bound("a = { initial = \"0.485*sqrt(2)\" }\nb = -0.485", {"(a^2 - 2*b^2)*(a - 3)"}),
                          "a' + sqrt(2)*b' = 0\na' - sqrt(2)*b' = 0\na^2 = 2*b^2\na = 3\n"),
        {proved, refuted, proved, refuted});
    const std::string triple = "4*cos(a)^3 - 3*cos(a) - cos(3*b)";
    const std::string turned =
        "a = { initial = 0.2, rate = -0.9 }\nb = { initial = \"0.2 - 4/3*pi\", rate = -0.9 }";
    const std::string angles = "b' = a'\nb = a - 4*pi/3\ncos(3*a) = cos(3*b)\ncos(a) = cos(b)\nb = -a\n";
    for (const std::string& product : {triple, "sin(3*a - b + 1)*(" + triple + ")"})
        check_verdicts(checked_on_sheets(bound(turned, {product}), angles),
                       {proved, proved, proved, refuted, refuted});
    check_verdicts(checked_on_sheets(bound(turned + "\ne = 1", {triple, "(cos(a) - cos(b))*(e - 1)"}),
                                     angles + "e = 1\ne' = 0\ne = 2\n"),
                   {proved, proved, proved, refuted, refuted, proved, proved, refuted});
}

// Where a = 1 the constraint says what a'' is; on the other branch it would be a further equation.
TEST_CASE("check: the equations that are missing are counted on the scene's own branch") {
    for (const char* product : {"(a - 1)*(a + 2*b)", "(a - b)*(a - 1)", "(a + 5*b)*(1 - a)", "(a - 1)*(a - b*e)",
                                "(1 - a)*(a + e)", "(e - a*b)*(a - 1)"}) {
        CAPTURE(std::string(product));
        const Checked result = checked_on_sheets(bound("a = 1\nb = 3\ne = 0.5", {product}), "a'' = 0\n");
        check_verdicts(result, {proved});
        CHECK(!result.complete);
        CHECK(result.missing == 2);
        CHECK(result.freedom == 2);
    }
}

}  // namespace check_branches
