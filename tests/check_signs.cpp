// SPDX-License-Identifier: MIT
// Signs, sizes and roots in claims. In exact arithmetic modulo 2^61 - 1 Legendre's symbol takes the place of a
// sign; that of 3 is -1, so a claim in which a constraint brings a factor of 3 about must be compared with real
// numbers too.
#include <doctest/doctest.h>

#include "checked.hpp"

namespace check_signs {

using namespace alembert;
using test::check_verdicts;
using test::checked;

namespace {

/// A particle on a curve in the plane.
Scene on_curve(const std::string& curve) {
    return parse_scene(
        "[coordinates]\nx = 1\ny = { guess = 1 }\n[[particle]]\nname = \"P\"\nmass = 1\n"
        "position = [\"x\", \"y\"]\n[[constraint]]\nname = \"curve\"\nholonomic = \"" +
            curve + "\"\n",
        "curve.toml");
}

Checked of(const Scene& scene, const std::string& claims) {
    return checked(with_claims(scene, claims, "claims.txt"));
}

}  // namespace

// On y = x the left side is 3 |x|, and the root of 9 x^2 that counts as positive is -3 |x|.
TEST_CASE("check: a root that a constraint multiplies by 3 keeps its sign") {
    check_verdicts(of(on_curve("y - x"), "sqrt(x^2 + 8*y^2) = -3*sqrt(x*y)\nsqrt(x^2 + 8*y^2) = -3*abs(x)\n"),
                   {Verdict::refuted, Verdict::refuted});
    CHECK(!of(on_curve("y - x"), "sqrt(x^2 + 8*y^2) = -3*sqrt(x*y)\n").claims[0].likely);
    check_verdicts(of(on_curve("y - x"), "sqrt(2*x^2 + 2*y^2) = 2*sqrt(x*y)\nsqrt(x^2 + 3*y^2) = 2*abs(x)\n"),
                   {Verdict::proved, Verdict::proved});
}

TEST_CASE("check: a root that a constraint makes a number has the sign of a root, and so has a force with it") {
    const Scene circle = on_curve("x^2 + y^2 - 9");
    CHECK(of(circle, "sqrt(x^2 + y^2) = -3\n").claims[0].verdict == Verdict::refuted);
    Scene pulled = parse_scene(R"toml(
[coordinates]
x = 1
y = { guess = 2 }
s = 0
[energy]
kinetic = "(x'^2 + y'^2 + s'^2)/2"
[forces]
s = "sqrt(x^2 + y^2)"
[[constraint]]
name = "curve"
holonomic = "x^2 + y^2 - 9"
)toml",
                               "pulled.toml");
    CHECK(of(pulled, "s'' = -3\n").claims[0].verdict == Verdict::refuted);
}

// The lengths of the bars are numbers, and hardly any position of the loop is a fraction. Both sides are made of
// X = c cos(gamma) + d, which is also a cos(alpha) + b cos(beta).
TEST_CASE("check: signs in a four-bar linkage are compared at positions that are no fractions") {
    std::string text = test::contents(test::source_path("scenes/textbook/four_bar.toml"));
    text = text.substr(0, text.find("[[claim]]"));
    const std::size_t loop = text.find("[parameters]"), end = text.find("m1 =");
    text.replace(loop, end - loop, "[parameters]\n");
    text.insert(text.find("[coordinates]"),
                "[definitions]\na = 1\nb = 4\nc = \"7/2\"\nd = 3\nX = \"c*cos(gamma) + d\"\n"
                "Y = \"a*cos(alpha) + b*cos(beta)\"\n");
    const Scene four_bar = parse_scene(text, "four_bar.toml");
    check_verdicts(of(four_bar, R"(
sign(X) = sign(Y)
sign(3*X + Y) = sign(X)
abs(3*X + Y) = 4*abs(Y)
)"),
                   std::vector(3, Verdict::proved));
    const Checked wrong = of(four_bar, R"(
sign(2*X + Y) = -sign(X)
abs(2*X + Y) = -3*abs(Y)
sqrt(X^2 + 8*Y^2) = -3*sqrt(X*Y)
)");
    check_verdicts(wrong, std::vector(3, Verdict::refuted));
    for (const CheckedClaim& claim : wrong.claims) CHECK(!claim.counterexample.empty());
}

TEST_CASE("check: a claim with a sign stays undecided where no real state obeys the constraints") {
    const Checked result = of(on_curve("x^2 + y^2 + 1"), "abs(x^2 + y^2) = 1\nx*x' + y*y' = 0\n");
    check_verdicts(result, {Verdict::undecided, Verdict::proved});
    CHECK(result.claims[0].reason.find("too few states in numbers") != std::string::npos);
}

// With r > 0 one of the two factors is zero. The first is 2 in numbers, and 0 in exact arithmetic.
TEST_CASE("check: signs are compared on the sheet of the initial state only") {
    const auto verdict = [](const std::string& r) {
        const Scene scene = with_claims(parse_scene(R"toml(
[coordinates]
r = )toml" + r + R"toml(
y = { guess = )toml" + r + R"toml( }
[energy]
kinetic = "(r'^2 + y'^2)/2"
[[spring]]
along = "sqrt(r^2)"
stiffness = 2
length = 1
[[constraint]]
name = "line"
holonomic = "y - r"
)toml",
                                                    "line.toml"),
                                        "(1 + sign(r^2 + 2*r*y))*(1 - sign(r)) = 0\n", "claims.txt");
        const Prepared on_sheet = prepared(scene, {}, true);
        return check(on_sheet.scene, on_sheet.mechanism, on_sheet.sheets).claims[0].verdict;
    };
    CHECK(verdict("1") == Verdict::proved);
    CHECK(verdict("-1") == Verdict::refuted);
}

}  // namespace check_signs
