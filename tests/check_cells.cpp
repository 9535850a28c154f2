// SPDX-License-Identifier: MIT
// Absolute values, signs, smaller and larger values cut the states into cells, and a claim is proved only if it
// holds in all of them. What is right in each cell is known by hand.
#include <doctest/doctest.h>
#include <fmt/format.h>

#include "algebra/symbolic/impossible.hpp"
#include "checked.hpp"

namespace check_cells {

using namespace alembert;
using GiNaC::symbol;
using test::check_verdicts;
using test::checked_on_sheets;

namespace {

/// A mass on a line with this force.
std::string pushed_by(const std::string& force, const std::string& start = "{ initial = 0.02, rate = 0.1 }") {
    return fmt::format(R"toml(
[parameters]
m = 1.5
k = 30
h = 200
c = 0.7
b = 20
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

TEST_CASE("check: a stop beside the start or far from it belongs to the equation") {
    for (const std::string stop : {"max(0, -x - 0.05)", "max(0, x - 20)", "max(0, x - b)", "max(0, x - 0.021)",
                                   "(abs(x + 3) - x - 3)/2", "-min(0, 4 - x)"}) {
        CAPTURE(stop);
        const Checked checked = checked_on_sheets(pushed_by("-k*x + h*" + stop), fmt::format(R"(
m*x'' + k*x = 0
m*x'' + k*x - h*{0} = 0
m*x'' + k*x + h*{0} = 0
)",
                                                                                             stop));
        check_verdicts(checked, {refuted, proved, refuted});
        CHECK(checked.claims[0].holds_where.size() == 1);
    }
}

TEST_CASE("check: a refuted claim tells on which side it holds") {
    const Checked checked =
        checked_on_sheets(pushed_by("-k*x + h*max(0, -x - 0.05)"), "m*x'' + k*x = 0\nabs(x - 20) = 20 - x\n");
    check_verdicts(checked, {refuted, refuted});
    CHECK(checked.claims[0].holds_where == std::vector<std::string>{"x > -0.05"});
    CHECK(checked.claims[1].holds_where == std::vector<std::string>{"x < 20"});
}

TEST_CASE("check: sides of free coordinates and rates are not those of the start") {
    check_verdicts(checked_on_sheets(pushed_by("-k*x"), R"(
abs(x - 20) = 20 - x
abs(x + 2) = x + 2
sign(x' + 4) = 1
max(0, x' + 6) = 0
m*x'' - k*x*sign(x' - 10) = 0
abs(x + 2) = max(x + 2, -x - 2)
max(x, 3) + min(x, 3) = x + 3
abs(x*x') = abs(x)*abs(x')
sign(x)*abs(x) = x
abs(x + b) = x + b
)"),
                   {refuted, refuted, refuted, refuted, refuted, proved, proved, proved, proved, refuted});
}

TEST_CASE("check: cells without states do not count") {
    check_verdicts(checked_on_sheets(pushed_by("-k*x"), R"(
abs(x^2 + 1) = x^2 + 1
abs(k + m) = k + m
abs(2 + sin(x)) = 2 + sin(x)
sign(x - b)*sign(x + b) = sign(x^2 - b^2)
)"),
                   {proved, proved, proved, proved});
}

// With c|v|v a throw upwards is slowed and a fall too; with c v² the fall is sped up.
TEST_CASE("check: a root of a rate has no sheet of its own") {
    const std::string thrown = R"toml(
gravity = [0, "-g"]
[parameters]
m = 1
g = 9.81
c = 0.2
[coordinates]
y = { initial = 0, rate = 5 }
[[particle]]
name = "P"
mass = "m"
position = [0, "y"]
[forces]
y = "-c*norm(vel(P))*y'"
)toml";
    check_verdicts(checked_on_sheets(thrown, R"(
m*y'' + m*g = -c*y'^2
m*y'' + m*g = -c*y'*abs(y')
m*y'' + m*g = -c*y'*sqrt(y'^2)
m*y'' + m*g = -c*y'^2*sign(y')
)"),
                   {refuted, proved, proved, proved});
}

TEST_CASE("check: parameters are symbols, however their values are written") {
    for (const std::string value :
         {"0.7", "\"pi/4\"", "{ value = 45, unit = \"deg\" }", "\"sqrt(2)/2\"", "\"40 deg\""}) {
        CAPTURE(value);
        const std::string slope = fmt::format(R"toml(
gravity = [0, "-g"]
[parameters]
m = 1
g = 9.81
alpha = {0}
beta = {0}
[coordinates]
s = 0
[[particle]]
name = "block"
mass = "m"
position = ["s*cos(alpha)", "-s*sin(alpha)"]
)toml",
                                              value);
        const Checked checked =
            checked_on_sheets(slope, "s'' = g*sin(alpha)\ns'' = g*cos(alpha)\ns'' = g*sin(beta)\n");
        check_verdicts(checked, {proved, refuted, refuted});
        CHECK(checked.claims[2].reason.find("scene's values") != std::string::npos);
    }
}

TEST_CASE("check: what is assumed of the sign of parameters is told, unless positive parameters imply it") {
    using Words = std::vector<std::string>;
    const Checked checked = checked_on_sheets(R"toml(
[parameters]
m = 1
a = 3
b = 1
F = -2
z = 0
alpha = 1
[coordinates]
x = 1
[[particle]]
name = "P"
mass = "m"
position = ["x", 0]
[forces]
x = "-a*x + b*x + F*cos(alpha) + z"
)toml",
                                              R"(
m*x'' + abs(a - b)*x = F*cos(alpha) + z
m*x'' + (max(a, b) - min(a, b))*x = F*cos(alpha) + z
m*x'' + (a - b)*x + abs(F)*cos(alpha) = z
m*x'' + (a - b)*x = F*abs(cos(alpha)) + z
m*x'' + (a - b)*x = F*abs(m*cos(alpha))/m*sign(a^2 + b) + z
m*x'' + (a - b)*x = F*abs(a*m/b)*b/(a*m)*cos(alpha) + z
m*abs(x'')*sign(F) = abs((a - b)*x - F*cos(alpha) - z)
m*x'' + sign(b - a)*x = F*cos(alpha) + z
m*x'' + (a - b)*x = F*cos(alpha) + abs(z)
m*x'' + (max(F, a, b) - max(b, F))*x = F*cos(alpha) + z
)");
    check_verdicts(checked, {proved, proved, proved, proved, proved, proved, refuted, refuted, refuted, proved});
    const std::vector<Words> where{{"a - b > 0"},      {"a - b > 0"},      {"F < 0"},
                                   {"cos(alpha) > 0"}, {"cos(alpha) > 0"}, {},
                                   {"F < 0"},          {"a - b > 0"}};
    for (std::size_t k = 0; k < where.size(); ++k) {
        CAPTURE(k);
        CHECK(conditions_of(checked.claims[k]) == where[k]);
    }
}

TEST_CASE("check: absolute values within absolute values cut the states into cells") {
    for (const std::string zone : {"sign(x)*max(0, abs(x) - b)", "max(0, x - b) + min(0, x + b)",
                                   "max(0, x - b) - max(0, -x - b)", "x - max(-b, min(b, x))"}) {
        CAPTURE(zone);
        const std::string claims = fmt::format(R"(
m*x'' + k*({0}) = 0
m*x'' + k*sign(x)*max(0, abs(x) - b) = 0
m*x'' + k*(x - max(-b, min(b, x))) = 0
m*x'' + k*max(0, x - b) = 0
m*x'' + k*sign(x)*abs(abs(x) - b) = 0
)",
                                               zone);
        check_verdicts(checked_on_sheets(pushed_by("-k*sign(x)*max(0, abs(x) - b)"), claims),
                       {proved, proved, proved, refuted, refuted});
    }
}

TEST_CASE("check: the start tells no sign of a root to a claim whose condition excludes the start") {
    const auto verdict = [](const std::string& equation, const std::string& where) {
        const std::string scene = pushed_by("0", "{ initial = 1.1 }") +
                                  fmt::format("[[claim]]\nequation = \"{}\"\nwhere = \"{}\"\n", equation, where);
        const Prepared made = prepared(parse_scene(scene, "scene.toml"), {}, true);
        return check(made.scene, made.mechanism, made.sheets).claims[0].verdict;
    };
    for (const std::string where : {"x^2 > 3", "x' > x + 5", "sin(x) < 0"}) {
        CAPTURE(where);
        CHECK(verdict("sqrt(1 - sin(x - 20)^2) = cos(x - 20)", where) == refuted);
    }
    CHECK(verdict("sqrt(x^2) = -x", "x < 0") == Verdict::vacuous);
    CHECK(verdict("sqrt(x^2) = x", "x < 0") == refuted);
}

TEST_CASE("check: a cell that arithmetic modulo a prime takes for another one proves nothing") {
    for (const std::string start : {"-1.9", "9", "20"}) {  // |x − 7| − |x| is −7 from 7 on
        CAPTURE(start);
        const Checked checked = checked_on_sheets(pushed_by("-k*x", "{ initial = " + start + " }"), R"(
where x - 7 > 0
abs(abs(x - 7) - abs(x)) = abs(20)
abs(abs(x - 7) - abs(x)) = 8
abs(abs(x - 7) - x) = 13
)");
        for (const CheckedClaim& claim : checked.claims) CHECK(claim.verdict == refuted);
    }
    const Checked right = checked_on_sheets(pushed_by("-k*x", "{ initial = 9 }"), R"(
where x - 7 > 0
abs(abs(x - 7) - abs(x)) = 7
abs(abs(x - 7) - abs(x)) + x' = 7 + x'
)");
    for (const CheckedClaim& claim : right.claims) CHECK(claim.verdict != refuted);
}

TEST_CASE("check: the square of a root has a meaning where the root has one") {
    const Checked checked = checked_on_sheets(pushed_by("-k*abs(x + 20)", "{ initial = 2 }"), R"(
m*x'' = -k*sqrt(x + 20)^2
m*x'' = -k*sqrt(x + 20)*sqrt(x + 20)
m*x'' = k*sqrt(x + 20)^2
)");
    check_verdicts(checked, {proved, proved, refuted});
}

TEST_CASE("check: a claim with absolute values is judged on the scene's own branch") {
    const std::string scene = R"toml(
[parameters]
m = 1.9
[coordinates]
a = { initial = -6 }
b = { initial = 2 }
[[particle]]
name = "A"
mass = "m"
position = ["a", 0]
[[particle]]
name = "B"
mass = 2
position = ["b", 0]
[[constraint]]
name = "z"
holonomic = "(b + 4)*(a + 3*b)"
)toml";
    const Checked checked = checked_on_sheets(scene, "abs(a) = abs(3*b)\nabs(a) = abs(2*b)\n");
    CHECK(checked.claims[0].verdict != refuted);
    CHECK(checked.claims[1].verdict == refuted);
}

TEST_CASE("impossible: sums of what is positive cannot be negative") {
    const symbol x("x"), y("y"), a("a");
    CHECK(is_impossible({x - a, -x - a}, {a}));
    CHECK(is_impossible({x - a, a - x}, {a}));
    CHECK_FALSE(is_impossible({x - a, x + a}, {a}));
    CHECK(is_impossible({-x * x - 1}, {}));
    CHECK(is_impossible({2 * x * y - x * x - y * y}, {}));
    CHECK_FALSE(is_impossible({3 * x * y - x * x - y * y}, {}));
    CHECK(is_impossible({-2 - sin(x)}, {}));
    CHECK_FALSE(is_impossible({-GiNaC::ex(1) / 2 - sin(x)}, {}));
    CHECK(is_impossible({-a - a * cos(x)}, {a}));
    CHECK_FALSE(is_impossible({x}, {}));
    CHECK_FALSE(is_impossible({}, {a}));
}

}  // namespace check_cells
