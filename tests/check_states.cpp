// SPDX-License-Identifier: MIT
// Claims about mechanisms whose constraints are hard to solve, and about numbers that the field does not have.
#include <doctest/doctest.h>

#include <fmt/format.h>

#include "checked.hpp"
#include "model/formalism/routh.hpp"

namespace check_states {

using namespace alembert;
using test::check_verdicts;
using test::checked;

TEST_CASE(
    "check: sizes and signs are those of real numbers, tangents and half angles are known, and identities say "
    "nothing") {
    const Checked result = checked("double_pendulum", R"(
abs(theta1')^2 = theta1'^2
abs(theta1')^3 = theta1'^3
sqrt(theta1'^2) = abs(theta1')
norm(vel(M1)) = l1*abs(theta1')
F' = 3/2*cos(3*t)
0 = 0
1 = 0
((m1+m2)*l1*theta1'' + m2*l2*theta2''*cos(theta1-theta2) + m2*l2*theta2'^2*sin(theta1-theta2))/cos(theta1) + (m1+m2)*g*tan(theta1/2)*(1 + 1/cos(theta1)) = F
abs(theta1')*(m2*l1*theta1''*cos(theta1-theta2) + m2*l2*theta2'' - m2*l1*theta1'^2*sin(theta1-theta2) + m2*g*sin(theta2)) = F*cos(theta2)*abs(theta1')
)");
    const std::vector<Verdict> expected{Verdict::proved,  Verdict::refuted, Verdict::proved,
                                        Verdict::proved,  Verdict::proved,  Verdict::vacuous,
                                        Verdict::refuted, Verdict::proved,  Verdict::proved};
    check_verdicts(result, expected);
}

TEST_CASE("check: a drive with a decimal frequency and a constraint solved for an angle are possible together") {
    const Scene scene = parse_scene(R"toml([parameters]
m = 1
l = 2
[inputs]
yp = "0.1*cos(1.005*t) + 0.02*sin(0.375*t)"
[coordinates]
theta = 0.3
phi = { guess = 0.3 }
[energy]
kinetic = "m*(l^2*theta'^2 + 2*l*theta'*yp'*sin(theta) + yp'^2)/2 + phi'^2/2"
potential = "m*9.81*(yp - l*cos(theta))"
[[constraint]]
name = "tied"
holonomic = "sin(phi/2) - sin(theta)/2"
)toml",
                                    "drive.toml");
    const Checked result = checked(with_claims(scene, R"(
m*l^2*theta'' + m*l*(9.81 - 0.1*1.005^2*cos(1.005*t) - 0.02*0.375^2*sin(0.375*t))*sin(theta) = -1/2*cos(theta)*lambda_tied
m*l^2*theta'' + m*l*(9.81 - 0.1*1.005^2*cos(1.005*t) - 0.02*0.375^2*sin(0.375*t))*sin(theta) = -cos(theta)/cos(phi/2)*phi''
m*l^2*theta'' + m*l*(9.81 + 0.1*1.005^2*cos(1.005*t) - 0.02*0.375^2*sin(0.375*t))*sin(theta) = -1/2*cos(theta)*lambda_tied
cos(1.005*t) = 4*cos(0.25125*t)^3 - 3*cos(0.25125*t)
cos(1.005*t) = 2*cos(0.5025*t)^2 - 1
)",
                                               "claims.txt"));
    const std::vector<Verdict> expected{Verdict::proved, Verdict::proved, Verdict::refuted, Verdict::refuted,
                                        Verdict::proved};
    check_verdicts(result, expected);
}

// The angles at the coupler: a α' sin(α−β) = c γ' sin(γ−β), c = 7/2, from the loop's rates without β'.
TEST_CASE("check: a loop whose lengths are numbers is solved for two angles together") {
    const Scene scene = parse_scene(R"toml([coordinates]
alpha = { initial = 0.5, rate = 2.0 }
beta  = { guess = 0.6, rate_guess = 0 }
gamma = { guess = 1.4, rate_guess = 0 }
[energy]
kinetic = "alpha'^2 + beta'^2/2 + alpha'*beta'*cos(alpha-beta) + 3*gamma'^2"
[[constraint]]
name = "x"
holonomic = "cos(alpha) + 4*cos(beta) - 7/2*cos(gamma) - 3"
[[constraint]]
name = "y"
holonomic = "sin(alpha) + 4*sin(beta) - 7/2*sin(gamma)"
)toml",
                                    "loop.toml");
    const Checked result = checked(with_claims(scene, R"(
alpha'*sin(alpha-beta) = 7/2*gamma'*sin(gamma-beta)
alpha'*sin(alpha-beta) = 4*gamma'*sin(gamma-beta)
alpha'*sin(alpha-gamma) = -4*beta'*sin(beta-gamma)
beta = 2*atan(2/3)
6*gamma'' = 7/2*sin(gamma)*lambda_x - 7/2*cos(gamma)*lambda_y
(alpha'^2 + beta'^2/2 + alpha'*beta'*cos(alpha-beta) + 3*gamma'^2)' = 0
)",
                                               "claims.txt"));
    const std::vector<Verdict> expected{Verdict::proved,  Verdict::refuted, Verdict::proved,
                                        Verdict::refuted, Verdict::proved,  Verdict::proved};
    check_verdicts(result, expected);
    CHECK_FALSE(result.claims[1].counterexample.empty());
    CHECK_FALSE(result.claims[3].counterexample.empty());
}

// No constraint has an unknown of its own, and no two constraints have two. b' follows from the rows of the rates
// by Cramer's rule.
TEST_CASE("check: constraints that cannot be solved one after the other") {
    const Scene scene = parse_scene(R"toml([coordinates]
a = { initial = 0.5, rate = 2.0 }
b = { guess = 0.6, rate_guess = 0 }
c = { guess = 0.4, rate_guess = 0 }
d = { guess = 0.9, rate_guess = 0 }
[energy]
kinetic = "a'^2 + b'^2/2 + a'*b'*cos(a-b)/3 + 3*c'^2 + d'^2*(2 + sin(c))"
potential = "5*cos(d)"
[[constraint]]
name = "x"
holonomic = "cos(a) + cos(b)*sin(c) + sin(d)/3 = 13/10"
[[constraint]]
name = "y"
holonomic = "sin(a) + sin(b)*cos(d) + 2*cos(c) = 12/5"
[[constraint]]
name = "z"
holonomic = "2*sin(a+b) + 3*sin(c) + sin(d)*cos(b) = 4"
)toml",
                                    "loop.toml");
    const Checked result = checked(with_claims(scene, R"(
(a'^2 + b'^2/2 + a'*b'*cos(a-b)/3 + 3*c'^2 + d'^2*(2 + sin(c)) + 5*cos(d))' = 0
(a'^2 + b'^2/2 + a'*b'*cos(a-b)/3 + 3*c'^2 + d'^2*(2 - sin(c)) + 5*cos(d))' = 0
sin(a)*a' + sin(b)*sin(c)*b' - cos(b)*cos(c)*c' = cos(d)*d'/3
sin(a)*a' + sin(b)*sin(c)*b' + cos(b)*cos(c)*c' = cos(d)*d'/3
6*c'' = lambda_x*cos(b)*cos(c) - 2*lambda_y*sin(c) + 3*lambda_z*cos(c) + d'^2*cos(c)
6*c'' = lambda_x*cos(b)*cos(c) + 2*lambda_y*sin(c) + 3*lambda_z*cos(c) + d'^2*cos(c)
)",
                                               "claims.txt"));
    const std::vector<Verdict> expected{Verdict::proved,  Verdict::refuted, Verdict::proved,
                                        Verdict::refuted, Verdict::proved,  Verdict::refuted};
    check_verdicts(result, expected);
    for (std::size_t k = 0; k < expected.size(); ++k)
        CHECK(result.claims[k].counterexample.empty() == (expected[k] == Verdict::proved));
}

// There are two rows of one constraint, and the second is left out. A claim with its multiplier is about both, of
// which only the sum of forces is determined; a claim without it treats the first as the only one. The multipliers
// of least norm are in the ratio of the rows, 1 : 2, and together exert the force (1 + 2·2)·lambda_c1.
TEST_CASE("check: the multipliers of a constraint and of its double") {
    const Scene scene = parse_scene(
        "[parameters]\nm = 1\ng = 9.81\n[coordinates]\nx = 0.2\ny = 0.2\n"
        "[energy]\nkinetic = \"m*(x'^2+y'^2)/2\"\npotential = \"m*g*y\"\n"
        "[[constraint]]\nname = \"c1\"\nholonomic = \"x - y\"\n"
        "[[constraint]]\nname = \"c2\"\nholonomic = \"2*x - 2*y\"\n",
        "double.toml");
    const Mechanism all = prepared(scene).mechanism;
    const Checked result = check(with_claims(scene, R"(
m*x'' = lambda_c1 + 2*lambda_c2
m*y'' + m*g = -lambda_c1 - 2*lambda_c2
m*x'' = lambda_c1 - 2*lambda_c2
lambda_c2 = 2*lambda_c1
m*x'' = 5*lambda_c1
m*x'' = lambda_c1
m*x'' = 2*lambda_c2
m*x'' = 2*lambda_c1
2*x'' + g = 0
)",
                                             "claims.txt"),
                                 without_constraints(all, redundant_constraints(all)));
    const std::vector<Verdict> expected{Verdict::proved,  Verdict::proved,  Verdict::refuted,
                                        Verdict::proved,  Verdict::proved,  Verdict::refuted,
                                        Verdict::refuted, Verdict::refuted, Verdict::proved};
    check_verdicts(result, expected);
}

// Beyond the readable size the equations are in intermediate symbols z1, z2 …, which claims may name.
TEST_CASE("check: gears keep the sines of their angles related, whatever the ratio") {
    const auto verdicts = [](const std::string& mesh, const std::string& claims) {
        const Scene scene = parse_scene(fmt::format(R"--(
[parameters]
I1 = 1
I2 = 2
k = 3
[coordinates]
a = {{ guess = 0.4 }}
b = 0.2
[energy]
kinetic = "I1*a'^2/2 + I2*b'^2/2"
potential = "k*cos(a) + k*sin(b)"
[[constraint]]
name = "mesh"
holonomic = "{}"
)--",
                                                    mesh),
                                        "gears.toml");
        std::string letters;
        for (const CheckedClaim& c : checked(with_claims(scene, claims, "claims.txt")).claims)
            letters += "pruv"[static_cast<int>(c.verdict)];
        return letters;
    };
    // By hand: a'' = n b'' and the mesh's torque eliminated give (n²I1 + I2)·b'' = n·k·sin(a) − k·cos(b).
    for (const char* mesh : {"a = 2*b", "b = a/2"})
        CHECK(verdicts(mesh,
                       "cos(a) = 2*cos(b)^2 - 1\ncos(a) = cos(b)\n(4*I1+I2)*b'' = 2*k*sin(2*b) - "
                       "k*cos(b)\n(4*I1+I2)*b'' = 2*k*sin(b) - k*cos(b)\n") == "prpr");
    CHECK(verdicts("2*a = 3*b",
                   "cos(2*a) = cos(3*b)\ncos(a) = cos(b)\n(9*I1/4+I2)*b'' = 3*k/2*sin(a) - k*cos(b)\n") == "prp");
    CHECK(verdicts("a - 2*b = pi/2",
                   "cos(a) = -sin(2*b)\ncos(a) = sin(2*b)\n(4*I1+I2)*b'' = 2*k*cos(2*b) - k*cos(b)\n") == "prp");
    CHECK(verdicts("a - 2*b = pi/3", "2*cos(a) = cos(2*b) - sqrt(3)*sin(2*b)\ncos(a) = cos(2*b)\n") == "pr");
    // The field has no turn by π/5; a claim that cannot be decided is not called wrong.
    CHECK(verdicts("a - 2*b = pi/5", "cos(a) = cos(2*b + pi/5)\ncos(a) = cos(2*b)\n") == "ur");
}

TEST_CASE("check: roots of numbers that the field does not have, and the turns that go with them") {
    // Two masses at the corners of an equilateral triangle that hangs from the third: 2 m a² th'' = −2 m g a
    // sin(th) cos(π/6).
    const std::string triangle = R"--(
gravity = [0, "-g"]
[parameters]
m = 1
a = 1
g = 9.81
[coordinates]
th = 0.3
[[frame]]
name = "R"
rotate = [["z", "th"]]
[[body]]
name = "A"
mass = "m"
position = ["a/2", "-a*sqrt(3)/2"]
axes = "R"
[[body]]
name = "B"
mass = "m"
position = ["-a/2", "-a*sqrt(3)/2"]
axes = "R"
)--";
    const auto verdict = [&](const std::string& claim) {
        return checked(with_claims(parse_scene(triangle, "triangle.toml"), claim + "\n", "claims.txt"))
            .claims[0]
            .verdict;
    };
    for (const char* right :
         {"2*a*th'' + sqrt(3)*g*sin(th) = 0", "2*a*th'' = -3*g*sin(th)/sqrt(3)", "a*th'' = -cos(pi/6)*g*sin(th)",
          "2*a*th'' = g*(cos(th + pi/3) - cos(th - pi/3))", "sqrt(5)*a*th'' = -sqrt(15)/2*g*sin(th)",
          "sqrt(12*g/a)*a*th'' = -3*g*sqrt(g/a)*sin(th)"}) {
        CAPTURE(right);
        CHECK(verdict(right) == Verdict::proved);
    }
    for (const char* wrong : {"2*a*th'' = -3*g*sin(th)", "2*a*th'' = sqrt(3)*g*sin(th)",
                              "a*th'' = -cos(pi/3)*g*sin(th)", "2*a*th'' = g*(cos(th + pi/6) - cos(th - pi/6))"}) {
        CAPTURE(wrong);
        CHECK(verdict(wrong) == Verdict::refuted);
    }
}

TEST_CASE(
    "check: a chain of eight rods proves its own equations and refutes one with a sign changed, which it names") {
    std::string text = "gravity = [0, \"g\"]\n[parameters]\nm = 1\nl = 1\ng = 9.81\n[coordinates]\n", bodies;
    for (int k = 1; k <= 8; ++k) {
        text += fmt::format("q{} = 0.1\n", k);
        bodies += fmt::format(
            "[[frame]]\nname = \"R{0}\"\nparent = \"{1}\"\nrotate = [[\"z\", \"q{0}\"]]\n"
            "[[point]]\nname = \"J{0}\"\nfrom = \"{2}\"\noffset = [0, \"l\"]\naxes = \"R{0}\"\n"
            "[[body]]\nname = \"B{0}\"\nmass = \"m\"\ninertia = \"m*l^2/12\"\nframe = \"R{0}\"\nfrom = \"{2}\"\n"
            "position = [0, \"l/2\"]\naxes = \"R{0}\"\n",
            k, k == 1 ? "N" : fmt::format("R{}", k - 1), k == 1 ? "O" : fmt::format("J{}", k - 1));
    }
    const Scene scene = parse_scene(text + bodies, "chain.toml");
    const Mechanism m = prepared(scene).mechanism;
    const Derivation shown = derivation_of(m, routh(m));
    REQUIRE_FALSE(shown.definitions.empty());
    std::string claims, wrong;
    for (const ReadableEquation& equation : shown.equations) {
        claims += alembert::text(equation.lhs) + " = " + alembert::text(equation.rhs) + "\n";
        wrong = alembert::text(equation.lhs) + " = " + alembert::text(equation.rhs) + "\n";
    }
    wrong.replace(wrong.find(" + "), 3, " - ");
    const Checked right = checked(with_claims(scene, claims, "claims.txt"));
    REQUIRE(right.claims.size() == 8);
    for (const CheckedClaim& c : right.claims) CHECK(c.verdict == Verdict::proved);
    CHECK(right.complete);
    const Checked refuted = checked(with_claims(scene, wrong, "claims.txt"));
    REQUIRE(refuted.claims[0].verdict == Verdict::refuted);
    CHECK_FALSE(refuted.claims[0].counterexample.empty());
    REQUIRE(refuted.claims[0].likely);
    CHECK(refuted.claims[0].likely->kind == "sign");
}

namespace {

/// Particles joined by n links in a vertical plane, in Cartesian coordinates.
Scene linked_chain(int n) {
    std::string coordinates = "[coordinates]\n", rest;
    for (int k = 1; k <= n; ++k) {
        coordinates +=
            fmt::format("x{0} = {{ initial = \"{0}*0.6*l\" }}\ny{0} = {{ initial = \"-{0}*0.8*l\" }}\n", k);
        rest += fmt::format("[[particle]]\nname = \"P{0}\"\nmass = \"m\"\nposition = [\"x{0}\", \"y{0}\"]\n", k);
        const std::string x = k > 1 ? fmt::format("x{}-x{}", k, k - 1) : "x1",
                          y = k > 1 ? fmt::format("y{}-y{}", k, k - 1) : "y1";
        rest += fmt::format(
            "[[constraint]]\nname = \"link{0}\"\nholonomic = \"({1})^2 + ({2})^2 = l^2\"\nmultiplier = "
            "\"lambda{0}\"\n",
            k, x, y);
    }
    return parse_scene("title = \"chain\"\ngravity = [0, \"-g\"]\n[parameters]\nm = 1.0\nl = 0.5\ng = 9.81\n" +
                           coordinates + rest,
                       "chain.toml");
}

/// The equations that `derive` prints, as claims.
std::string printed_equations(const Scene& scene) {
    const Mechanism m = prepared(scene).mechanism;
    std::string claims;
    for (const ReadableEquation& e : derivation_of(m, routh(m)).equations)
        claims += text(e.lhs) + " = " + text(e.rhs) + "\n";
    return claims;
}

}  // namespace

// Newton's law for the last particle is written here by hand.
TEST_CASE("check: the printed equations of chains of links are proved, and a wrong one of 12 links refuted") {
    for (const int n : {7, 12}) {
        CAPTURE(n);
        const Scene scene = linked_chain(n);
        const std::string claims =
            printed_equations(scene) + fmt::format("m*x{0}'' = 2*lambda{0}*(x{0}-x{1})\n", n, n - 1);
        const Checked result = checked(with_claims(scene, claims, "claims.txt"));
        check_verdicts(result, std::vector<Verdict>(static_cast<std::size_t>(2 * n + 1), Verdict::proved));
    }
}

TEST_CASE(
    "check: the sine of pi/10 is known where it is written out, and a parameter with that value is a symbol") {
    const auto slope = [](const std::string& tilt) {
        return parse_scene(
            "[parameters]\ntilt = \"pi/10\"\n[coordinates]\nx = 0\n[[particle]]\nname = \"P\"\n"
            "mass = \"1\"\nposition = [\"x\", 0]\n[forces]\nx = \"sin(" +
                tilt + ")\"\n",
            "slope.toml");
    };
    const std::string claims = "x'' = sin(pi/10)\nx''^2 + cos(pi/10)^2 = 1\nx'' = sin(pi/5)\n";
    check_verdicts(checked(with_claims(slope("pi/10"), claims, "claims.txt")),
                   {Verdict::proved, Verdict::proved, Verdict::refuted});
    check_verdicts(checked(with_claims(slope("tilt"), claims + "x'' = sin(tilt)\n", "claims.txt")),
                   {Verdict::refuted, Verdict::refuted, Verdict::refuted, Verdict::proved});
}

// By hand: the tension of each link carries the weight of the particles below it, Σ m g = 2 λ_k (y_k − y_{k−1}).
TEST_CASE("check: static equations of a chain that cannot be solved one after the other are proved at rest") {
    const Checked result = checked(with_claims(linked_chain(7), R"(rest
m*g = 2*lambda7*(y7-y6)
2*m*g = 2*lambda6*(y6-y5)
7*m*g = 2*lambda1*y1
lambda7*(x7-x6) = lambda6*(x6-x5)
m*g = 2*lambda6*(y6-y5)
)",
                                               "claims.txt"));
    for (std::size_t k = 0; k < 4; ++k) CHECK(result.claims[k].verdict == Verdict::proved);
    CHECK(result.claims[4].verdict != Verdict::proved);
}

}  // namespace check_states
