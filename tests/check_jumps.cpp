// SPDX-License-Identifier: MIT
// What is called a constant may jump on the border of two cells, exact arithmetic takes multiples of its prime for
// zero and lacks some square roots, and a later claim may hide an earlier one. What is right is known by hand.
#include <doctest/doctest.h>
#include <fmt/format.h>

#include "alembert/base/error.hpp"
#include "analysis/audit/audit.hpp"
#include "checked.hpp"

namespace check_jumps {

using namespace alembert;
using test::check_verdicts;
using test::checked_on_sheets;

namespace {

/// A mass with this force; the parameters are those of all tests here.
std::string pushed_by(const std::string& force, const std::string& start = "{ initial = 0.5, rate = -1.2 }") {
    return fmt::format(R"toml(
[parameters]
m = 3
k = 1.9
a = 0.9
b = 0.4
[coordinates]
x = {}
[[particle]]
name = "P"
mass = "m"
position = ["x", 0]
[forces]
x = "{}"
)toml",
                       start, force);
}

const auto proved = Verdict::proved, refuted = Verdict::refuted;

}  // namespace

TEST_CASE("check: a constant of the motion does not jump") {
    const Checked spring = checked_on_sheets(pushed_by("-k*x"), R"(
constants C D E F G H
sign(x') = C
x/abs(x) = D
m*x'^2 + k*x^2 = E
m*x'^2*sign(x)^2 + k*abs(x)^2 = F
atan2(1, x) - atan(1/x) = G
sign(2 + sin(x)) = H
)");
    check_verdicts(spring, {refuted, refuted, proved, proved, refuted, proved});
    CHECK(spring.claims[0].reason.find("x' = 0") != std::string::npos);
    CHECK(spring.claims[0].residual_value == doctest::Approx(2));
    check_verdicts(checked_on_sheets(pushed_by("-(a + b*sign(5 - t))*x"), R"(
constants C D
sign(5 - t) = C
m*x'^2 + (a + b*sign(5 - t))*x^2 = D
)"),
                   {refuted, refuted});
}

TEST_CASE("check: what no motion crosses is no jump, and an angle may jump on half of its border") {
    check_verdicts(checked_on_sheets(pushed_by("0"), "constants C D\nsign(x') = C\natan2(x', 2) = D\n"),
                   {proved, proved});
    check_verdicts(checked_on_sheets(pushed_by("-k*x"), "constants C\natan2(x', sqrt(k/m)*x) + sqrt(k/m)*t = C\n"),
                   {refuted});
}

TEST_CASE("check: claims that share a constant or a name are each wrong on their own side") {
    check_verdicts(checked_on_sheets(pushed_by("-k*max(x, 0) - a*min(x, 0)"),
                                     "constants C\nm*x'^2 + k*x^2 = C\nm*x'^2 + a*x^2 = C\n"),
                   {refuted, refuted});
    check_verdicts(
        checked_on_sheets(pushed_by("-k*max(0, x - a)"), "unknowns R\nm*x'' = -R\nR = 0\nR = k*(x - a)\n"),
        {refuted, refuted, refuted});
    check_verdicts(
        checked_on_sheets(pushed_by("-k*max(0, x - a)"), "unknowns R\nm*x'' = -R\nR = k*max(0, x - a)\n"),
        {proved, proved});
}

TEST_CASE("check: an integral holds on all sides, and its constant has a value on each") {
    check_verdicts(checked_on_sheets(pushed_by("-k*sign(x - 0.05)"), R"(
constants C D E
m*x'^2/2 + k*(x - 0.05) = C
m*x'^2/2 + k*abs(x - 0.05) = D
max(x, 30) = E
)"),
                   {refuted, proved, refuted});
}

TEST_CASE("check: coefficients near the prime of exact arithmetic are compared in numbers") {
    const Checked big = checked_on_sheets(pushed_by("-k*x"), R"(
m*x'' + 2305843009213693952*k*x = 0
2305843009213693952*x'' = x''
m*x'' + k*x + 2305843009213693951*x^3 = 0
cos(2305843009213693952*x) = 1
exp(1152921504606846975*x) = 1
2147483648*m*x'' + 2147483648*k*x = 0
)");
    check_verdicts(big, {refuted, refuted, refuted, refuted, refuted, proved});
    for (const CheckedClaim& claim : big.claims)
        CHECK_FALSE((claim.likely.has_value() && !claim.likely->repair.empty()));
}

TEST_CASE("check: a root of rates has the sign of no initial state") {
    const std::string blade = R"toml(
[parameters]
m = 0.5
J = 2
[coordinates]
x = { initial = 0, rate = "1.1*cos(2.5)" }
y = { initial = 0, rate = "1.1*sin(2.5)" }
phi = { initial = 2.5, rate = -0.9 }
[[particle]]
name = "P"
mass = "m"
position = ["x", "y"]
[energy]
kinetic = "J*phi'^2/2"
[[constraint]]
name = "blade"
nonholonomic = "x'*sin(phi) - y'*cos(phi)"
)toml";
    check_verdicts(checked_on_sheets(blade, R"(
sqrt(x'^2 + y'^2) = x'*cos(phi) + y'*sin(phi)
x'^2 + y'^2 = (x'*cos(phi) + y'*sin(phi))^2
)"),
                   {refuted, proved});
}

TEST_CASE("check: rest at roots that the prime field lacks is rest, in all combinations") {
    const std::string wells = R"toml(
[parameters]
m = 2
[coordinates]
x = 0
y = "sqrt(2)"
[[particle]]
name = "P"
mass = "m"
position = ["x", "y"]
[forces]
x = "6*x - x^3"
y = "(y^2 - 2)*y"
)toml";
    check_verdicts(checked_on_sheets(wells, "rest\nx*(y^2 - 2) = 0\nx^3 = 6*x\ny^3 = 2*y\nx = 0\n"),
                   {refuted, proved, proved, refuted});
    check_verdicts(checked_on_sheets(pushed_by("(x^2 - 3)*(x^2 - 2)*x", "\"sqrt(2)\""),
                                     "rest\nx = 0\nx*(x^4 - 5*x^2 + 6) = 0\nx^3 = 3*x\n"),
                   {refuted, proved, refuted});
    check_verdicts(checked_on_sheets(pushed_by("-a*sin(6*x) - 0.1*x'", "\"pi/2\""),
                                     "rest\nsin(x)*cos(x) = 0\nsin(6*x) = 0\n"),
                   {refuted, proved});
}

TEST_CASE("check: rest where a factor is there twice, and its corrections, are looked at in all factors") {
    for (const std::string start : {"0", "\"sqrt(7)\""}) {
        const Checked found = checked_on_sheets(pushed_by("-(x^2 - 7)*(x^2 - 7)*x", start),
                                                "rest\nx = 0\nx^2 = 7\nx^4 + 49 = 14*x^2\nx*(x^2 - 7) = 0\n");
        for (std::size_t k = 0; k < 3; ++k) CHECK(found.claims[k].verdict == refuted);
        for (const CheckedClaim& claim : found.claims) CHECK(claim.nearest.empty());
    }
    check_verdicts(checked_on_sheets(pushed_by("(x^2 - 3)*(x^2 - 3)", "\"sqrt(3)\""), "rest\nx = 0\n"), {refuted});
    for (const CheckedClaim& claim : checked_on_sheets(pushed_by("-(x^2 - 1.5)*(x^2 - 2)*x", "\"sqrt(1.5)\""),
                                                       "rest\nx*(x^2 - 1.5) = 0\n(x^2 - 1.5)*(x^2 - 2) = 0\n")
                                         .claims) {
        CHECK(claim.verdict == refuted);
        CHECK(claim.nearest.empty());
    }
}

// Where two branches cross a constraint has no direction, and nothing balances a weight; and without a state of
// rest nothing is proved of it.
TEST_CASE("check: rest is rest on the scene's own branch, and there must be some") {
    const auto tied = [](const std::string& constraint) {
        return fmt::format(R"toml(
gravity = [0, "-g"]
[parameters]
g = 9.8
l = 1
[coordinates]
x = 0.6
y = -0.8
[[particle]]
name = "P"
mass = 1
position = ["x", "y"]
[[constraint]]
name = "c"
holonomic = "{}"
)toml",
                           constraint);
    };
    const Checked crossed =
        checked_on_sheets(tied("(x^2 + y^2 - l^2)*(x - y)"), "rest\nx = 0\ny^2 = l^2\nx = l\n");
    CHECK(crossed.claims[0].verdict != refuted);
    CHECK(crossed.claims[1].verdict != refuted);
    CHECK(crossed.claims[2].verdict == refuted);
    const Checked circles = checked_on_sheets(tied("(x^2 + y^2 - 1)*(x^2 + y^2 - 4)"), "rest\ny^2 = 1\ny^2 = 4\n");
    CHECK(circles.claims[0].verdict != refuted);
    CHECK(circles.claims[1].verdict != proved);
    const Checked none = checked_on_sheets(
        "[coordinates]\nr = 2\n[energy]\nkinetic = \"r'^2/2\"\npotential = \"log(r)\"\n", "rest\nr = 5\n0 = 1\n");
    for (const CheckedClaim& claim : none.claims) CHECK(claim.verdict == Verdict::vacuous);
}

// Of logarithms, hyperbolic tangents and arcs exact arithmetic knows little; what holds on both sides is no
// mistake.
TEST_CASE("check: identities of elementary functions hold on all sides, and their neighbours do not") {
    check_verdicts(checked_on_sheets(pushed_by("-k*abs(x)"), R"(
m*x''*log((x' - 2)^2) = -2*k*abs(x)*log(abs(x' - 2))
m*x'' = -k*abs(x)*(acos(x) + asin(x))*2/pi
m*x''*abs(tanh(x - 1)) = -k*abs(x)*tanh(abs(x - 1))
m*x''*atan2(x', 3) = -k*abs(x)*atan(x'/3)
m*x''*asin(7 - x') = k*abs(x)*asin(x' - 7)
m*x''*log((x' - 2)^2) = -2*k*abs(x)*log(abs(x' + 2))
m*x'' = -k*abs(x)*(acos(x) - asin(x))*2/pi
m*x''*abs(tanh(x - 1)) = -k*abs(x)*tanh(x - 1)
m*x''*atan2(x', x) = -k*abs(x)*atan(x'/x)
)"),
                   {proved, proved, proved, proved, proved, refuted, refuted, refuted, refuted});
}

TEST_CASE("check: an equation of rest that is solved for a parameter has its other factors too") {
    const std::string across = R"toml(
[parameters]
m = 1
k = 10
l = 0.5
h = 0.4
[coordinates]
x = 0.8
[[particle]]
name = "P"
mass = "m"
position = ["x", 0]
[[point]]
name = "H"
offset = [0, "h"]
[[spring]]
between = ["H", "P"]
stiffness = "k"
length = "l"
)toml";
    const std::vector<std::string> claims{"abs(x) = sqrt(l^2 - h^2)", "x*(abs(x) - sqrt(l^2 - h^2)) = 0",
                                          "x = sqrt(l^2 - h^2)", "x^2 = l^2 - h^2", "x = 0"};
    const std::vector<Verdict> right{refuted, proved, refuted, refuted, refuted};
    std::string all = "rest\n";
    for (std::size_t k = 0; k < claims.size(); ++k) {
        check_verdicts(checked_on_sheets(across, "rest\n" + claims[k] + "\n"), {right[k]});
        all += claims[k] + "\n";
    }
    check_verdicts(checked_on_sheets(across, all), right);
}

// Each factor of each equation is zero in some state of rest.
TEST_CASE("check: rest has all combinations of the factors of its equations") {
    const std::string two = R"toml(
[parameters]
m = 1
a = 0.5
b = 2
[coordinates]
x = 0.5
y = 1
[[particle]]
name = "P"
mass = "m"
position = ["x", "y"]
[forces]
x = "x*(a - sqrt(x^2 + b^2))"
y = "y*(b - sqrt(y^2 + a^2))"
)toml";
    const std::string x = "x*(a - sqrt(x^2 + b^2))", y = "y*(b - sqrt(y^2 + a^2))";
    check_verdicts(checked_on_sheets(two, "rest\n" + x + " = 0\n" + y +
                                              " = 0\nx = 0\ny = 0\nx*y = 0\n"
                                              "y^2 = b^2 - a^2\n(x^2 + b^2 - a^2)*(y^2 + a^2 - b^2) = 0\n"),
                   {proved, proved, refuted, refuted, proved, refuted, refuted});
    check_verdicts(
        checked_on_sheets(pushed_by("x*(k - x)*(x + a)"), "rest\nx*(k - x) = 0\nx*(k - x)*(x + a) = 0\n"),
        {refuted, proved});
}

TEST_CASE("check: rest at the scene's own values, where parameters are zero or equal, is rest too") {
    const auto plane = [](const char* parameters, const char* x, const char* y, const char* start) {
        return fmt::format(R"toml(
[parameters]
{}
[coordinates]
{}
[[particle]]
name = "P"
mass = 1
position = ["x", "y"]
[forces]
x = "{}"
y = "{}"
)toml",
                           parameters, start, x, y);
    };
    for (const char* start : {"x = 1\ny = 0.5", "x = 0\ny = 0.5"})
        check_verdicts(checked_on_sheets(plane("k = 1\np = 2\nq = 0", "-k*x*(y - p)", "-k*y*(x - q)", start),
                                         "rest\ny*(y - p) = 0\ny*(y - p)*(y + 3) = 0\nx*(y - p) = 0\n"),
                       {refuted, refuted, proved});
    for (const char* values : {"a = 1\nb = 2\nc = 2", "a = 1\nb = 1\nc = 2"})
        check_verdicts(checked_on_sheets(plane(values, "-(x - a)*(y - b)", "-(x - b)*(y - c)", "x = 1\ny = 0.5"),
                                         "rest\n(x - a)*(x - b) = 0\n(x - a)*(y - b) = 0\n"),
                       {refuted, proved});
}

TEST_CASE("check: a state is looked for in numbers that are near") {
    const std::string hoop = R"toml(
gravity = [0, 0, "-g"]
[parameters]
m = 1
R = 0.5
O = 6
g = 9.81
[coordinates]
a = 0.3
[[particle]]
name = "P"
mass = "m"
position = ["R*sin(a)*cos(O*t)", "R*sin(a)*sin(O*t)", "-R*cos(a)"]
)toml";
    check_verdicts(checked_on_sheets(hoop, "abs(R*a'') = abs(sin(a))*abs(R*O^2*cos(a) - g)\n"), {proved});
}

TEST_CASE("check: motions in closed form are differentiated on all sides") {
    check_verdicts(checked_on_sheets(pushed_by("-k*max(x, 0)"), "constants A\nsolution\nx = A*cos(sqrt(k/m)*t)\n"),
                   {refuted});
    check_verdicts(checked_on_sheets(pushed_by("k*abs(t - 1)"), R"(
constants A B
solution
x = k*abs(t - 1)^3/(6*m) + A
x = -k*abs(t - 1)^3/(6*m)
x = k*(t - 1)^3/(6*m) + B
)"),
                   {proved, refuted, refuted});
}

TEST_CASE("check: sines of inverse functions, on all sides") {
    check_verdicts(checked_on_sheets(pushed_by("-k*x"), R"(
sin(asin(x)) = x
cos(atan(x))*sqrt(1 + x^2) = 1
tan(atan(x)) = x
sin(acos(x))^2 = 1 - x^2
sin(atan2(x, x'))*sqrt(x^2 + x'^2) = x
sin(2*atan(x)) = x/(1 + x^2)
)"),
                   {Verdict::vacuous, proved, Verdict::vacuous, Verdict::vacuous, proved, refuted});
}

TEST_CASE("check: of two motions claimed for one coordinate each is judged") {
    const std::string two = R"(
solution
constants A B
x = A*cos(5*t)
x = A*cos(sqrt(k/m)*t)
x = B*sin(sqrt(k/m)*t)
)";
    check_verdicts(checked_on_sheets(pushed_by("-k*x"), two), {refuted, proved, proved});
}

TEST_CASE("check: where an impact is, angles that constraints relate have no other values") {
    const std::string tied = R"toml(
[parameters]
m = 1.1
S = 0.4
l = 1.3
[coordinates]
a = { initial = 1.1, rate = -0.9 }
b = { initial = "pi - 1.1", rate = 0.9 }
[[particle]]
name = "A"
mass = "m"
position = ["l*sin(a)", "-l*cos(a)"]
[[particle]]
name = "B"
mass = "2*m"
position = ["l*sin(b)", "-l*cos(b)"]
[impulses]
a = "S"
[[constraint]]
name = "tie"
holonomic = "sin(a) - sin(b)"
)toml";
    check_verdicts(checked_on_sheets(tied, "impact\na' = -b'\na' - a'(-) = S/(3*m*l^2)\na' = b'\n"),
                   {proved, proved, refuted});
}

TEST_CASE("constraints whose rates stand in absolute values, roots, larger and smaller values are refused") {
    for (const std::string rate :
         {"abs(x')", "sqrt(x'^2)", "max(x', 0)", "sign(x')*x'", "min(x', 2*x')", "norm(vel(P))"}) {
        CAPTURE(rate);
        const std::string scene = fmt::format(R"toml(
[coordinates]
x = {{ initial = 0, rate = 1 }}
y = {{ initial = 0, rate = 1 }}
[[particle]]
name = "P"
mass = 1
position = ["x", "y"]
[[constraint]]
name = "c"
nonholonomic = "y' - {}"
)toml",
                                              rate);
        CHECK_THROWS_AS(prepared(parse_scene(scene, "scene.toml"), {}, true), SceneError);
    }
}

TEST_CASE("check: the sine of an arc has its sign on one half of a circle, whatever other branches there are") {
    for (const std::string factor : {"", "(x + y)*", "(2*y + x - 5)*", "(x*y - 2)*"}) {
        CAPTURE(factor);
        const Checked found = checked_on_sheets(fmt::format(R"toml(
gravity = [0, "-g"]
[parameters]
l = 2
m = 1.5
g = 9.81
[coordinates]
x = {{ initial = "l*cos(pi/6)" }}
y = {{ initial = "l*sin(pi/6)" }}
[[particle]]
name = "P"
mass = "m"
position = ["x", "y"]
[[constraint]]
name = "z0"
holonomic = "{}(x^2 + y^2 - l^2)"
)toml",
                                                            factor),
                                                "y = l*sin(acos(x/l))\n");
        check_verdicts(found, {proved});
        CHECK(conditions_of(found.claims[0]) == std::vector<std::string>{"y/l > 0"});
    }
}

// On the branch b = a + 2π/3 of cos 3a = cos 3b the second constraint holds e; on a = b it holds nothing.
TEST_CASE("audit: the degrees of freedom are those of the scene's own branch") {
    const std::string scene = R"toml(
[coordinates]
a = 0.2
b = "0.2 + 2/3*pi"
e = 1
[energy]
kinetic = "(a'^2 + b'^2 + e'^2)/2"
[forces]
e = 5
[[constraint]]
name = "z0"
holonomic = "4*cos(a)^3 - 3*cos(a) - cos(3*b)"
[[constraint]]
name = "z1"
holonomic = "(cos(a) - cos(b))*(e - 1)"
)toml";
    const Audit found = audit(parse_scene(scene, "scene.toml")).audit;
    CHECK(found.degrees_of_freedom == 1);
    CHECK_FALSE(found.exact_rank);
}

}  // namespace check_jumps
