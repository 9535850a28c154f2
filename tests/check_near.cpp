// SPDX-License-Identifier: MIT
// Claims to first order about scenes with constraints. The right ones are known in closed form, or from the same
// system in coordinates without constraints.
#include <doctest/doctest.h>

#include "checked.hpp"

namespace check_near {

using namespace alembert;
using namespace alembert::test;

namespace {

struct Near {
    std::string place, equation;
    Verdict verdict;
};

constexpr Verdict proved = Verdict::proved, refuted = Verdict::refuted, undecided = Verdict::undecided;

std::vector<CheckedClaim> check_expected(const std::string& scene, const std::vector<Near>& expected) {
    std::string text = scene;
    for (const Near& e : expected)
        text += "[[claim]]\nnear = { " + e.place + " }\nequation = \"" + e.equation + "\"\n";
    const Checked result = checked(parse_scene(text, "near.toml"));
    for (std::size_t k = 0; k < expected.size(); ++k) {
        CAPTURE(expected[k].equation);
        INFO(result.claims[k].reason);
        CHECK(result.claims[k].verdict == expected[k].verdict);
    }
    return result.claims;
}

const std::string down = "gravity = [0, \"-g\"]\n";

}  // namespace

// Goldstein, Classical Mechanics, gives 5/7 of the pendulum's g/(R − r) for a sphere that rolls.
TEST_CASE("check: a ball that rolls in a bowl swings as its constraint makes it") {
    const auto claims = check_expected(
        down +
            "[parameters]\nm = 1\nr = 0.1\nR = 0.6\ng = 9.81\n[coordinates]\nth = 0.1\n"
            "phi = { initial = 0, rate_guess = 0 }\n[[frame]]\nname = \"B\"\nrotate = [[\"z\", \"phi\"]]\n"
            "[[body]]\nname = \"ball\"\nmass = \"m\"\nframe = \"B\"\ninertia = \"2/5*m*r^2\"\n"
            "position = [\"(R-r)*sin(th)\", \"-(R-r)*cos(th)\"]\n"
            "[[constraint]]\nname = \"roll\"\nnonholonomic = \"r*phi' + (R-r)*th'\"\n",
        {{"th = 0", "th'' + 5*g/(7*(R-r))*th = 0", proved},
         {"th = 0", "th'' + g/(R-r)*th = 0", refuted},
         {"th = 0", "phi'' = 5*g/(7*r)*th", proved},
         {"th = 0", "lambda_roll = 2/7*m*g*th", proved},
         {"th = 0", "lambda_roll = -2/7*m*g*th", refuted},
         {"th = \"pi/2\"", "th'' = 0", undecided}});
    CHECK(claims[1].nearest == "7*th'' - 5*g*th/(r-R) = 0");
    CHECK(claims[5].reason.find("no equilibrium") != std::string::npos);
}

TEST_CASE("check: coordinates that a constraint gives at the point need not be named") {
    const std::string bowl = down +
                             "[parameters]\nm = 1\na = 0.5\ng = 9.81\n[coordinates]\nx = 0.1\n"
                             "y = { guess = -0.49 }\n[[particle]]\nname = \"P\"\nmass = \"m\"\n"
                             "position = [\"x\", \"y\"]\n[[constraint]]\nname = \"bowl\"\n";
    check_expected(bowl + "holonomic = \"x^2 + y^2 - a^2\"\n", {{"x = 0", "x'' + g/a*x = 0", proved},
                                                                {"x = 0, y = \"-a\"", "x'' + g/a*x = 0", proved},
                                                                {"x = 0", "x'' + 2*g/a*x = 0", refuted},
                                                                {"x = 0", "y = -a", proved},
                                                                {"x = 0", "y' = x'", refuted},
                                                                {"x = 0", "2*a*lambda_bowl = -m*g", proved},
                                                                {"x = 0, y = \"a\"", "x'' - g/a*x = 0", proved}});
    check_expected(bowl + "holonomic = \"y - x^2/(2*a) + a\"\n",
                   {{"x = 0", "x'' + g/a*x = 0", proved}, {"x = 0", "x'' + g/(2*a)*x = 0", refuted}});
}

// In angles: (m1 + m2) l1 θ1'' + m2 l2 θ2'' + (m1 + m2) g θ1 = 0, l1 θ1'' + l2 θ2'' + g θ2 = 0, with x1 = l1 θ1
// and x2 − x1 = l2 θ2.
TEST_CASE("check: a double pendulum of particles and rods has the small swings of that in angles") {
    check_expected(down +
                       "[parameters]\nm1 = 1\nm2 = 2\nl1 = 0.5\nl2 = 0.7\ng = 9.81\n[coordinates]\nx1 = 0.1\n"
                       "y1 = { guess = -0.5 }\nx2 = 0.1\ny2 = { guess = -1.2 }\n"
                       "[[particle]]\nname = \"P\"\nmass = \"m1\"\nposition = [\"x1\", \"y1\"]\n"
                       "[[particle]]\nname = \"Q\"\nmass = \"m2\"\nposition = [\"x2\", \"y2\"]\n"
                       "[[constraint]]\nname = \"a\"\nholonomic = \"x1^2 + y1^2 - l1^2\"\n"
                       "[[constraint]]\nname = \"b\"\nholonomic = \"(x2-x1)^2 + (y2-y1)^2 - l2^2\"\n",
                   {{"x1 = 0, x2 = 0", "(m1+m2)*x1'' + m2*(x2''-x1'') + (m1+m2)*g*x1/l1 = 0", proved},
                    {"x1 = 0, x2 = 0", "x2'' + g*(x2-x1)/l2 = 0", proved},
                    {"x1 = 0, x2 = 0", "m1*x1'' + (m1+m2)*g*x1/l1 - m2*g*(x2-x1)/l2 = 0", proved},
                    {"x1 = 0, x2 = 0", "m1*x1'' + m1*g*x1/l1 - m2*g*(x2-x1)/l2 = 0", refuted},
                    {"x1 = 0, x2 = 0", "x2'' + g*x2/l2 = 0", refuted},
                    {"x1 = 0, x2 = 0", "y2 = -l1-l2", proved}});
}

// (m + J/r²) x'' = -k x with J = 2/5 m r².
TEST_CASE("check: a ball on a floor and a spring rolls to and fro, with three multipliers") {
    const std::string at = "x = 0, y = 0, z = \"r\", theta = \"pi/2\"";
    check_expected(
        R"toml(gravity = [0, 0, "-g"]
[parameters]
m = 0.4
r = 0.05
g = 9.81
k = 3
[coordinates]
x = 0
y = 0
z = { initial = "r" }
psi = 0
theta = { initial = "pi/2" }
phi = 0
[[frame]]
name = "B"
rotate = [["z", "psi"], ["x", "theta"], ["z", "phi"]]
[[body]]
name = "ball"
mass = "m"
frame = "B"
inertia = ["2/5*m*r^2", "2/5*m*r^2", "2/5*m*r^2"]
position = ["x", "y", "z"]
[forces]
x = "-k*x"
y = "-k*y"
[[constraint]]
name = "floor"
holonomic = "z - r"
[[constraint]]
name = "rolling_x"
nonholonomic = "x' - r*dot(omega(ball), ey(N)) = 0"
[[constraint]]
name = "rolling_y"
nonholonomic = "y' + r*dot(omega(ball), ex(N)) = 0"
)toml",
        {{at, "7*m*x'' + 5*k*x = 0", proved}, {at, "7*m*y'' = -5*k*y", proved}, {at, "m*x'' + k*x = 0", refuted}});
}

// Mathieu's equation and a support that is shaken sideways; what stays of them where the shaking is small.
TEST_CASE("check: an input near a state has its values in time, or is small, which is told") {
    const auto shaken = [](const std::string& position) {
        return down +
               "[parameters]\nm = 1\nl = 1\na = 0.1\nw = 20\ng = 9.81\n[inputs]\ny = \"a*cos(w*t)\"\n"
               "[coordinates]\ntheta = 0.1\n[[particle]]\nname = \"P\"\nmass = \"m\"\nposition = " +
               position + "\n";
    };
    const auto up = check_expected(shaken("[\"l*sin(theta)\", \"y - l*cos(theta)\"]"),
                                   {{"theta = 0", "l*theta'' + (g + y'')*theta = 0", proved},
                                    {"theta = 0", "l*theta'' + (g - a*w^2*cos(w*t))*theta = 0", proved},
                                    {"theta = 0", "l*theta'' + (g + a*w^2*cos(w*t))*theta = 0", refuted},
                                    {"theta = 0", "l*theta'' + g*theta = 0", proved},
                                    {"theta = \"pi\"", "l*theta'' = (g + y'')*(theta - pi)", proved},
                                    {"theta = \"pi\"", "l*theta'' = (g + 2*y'')*(theta - pi)", proved}});
    for (const std::size_t k : {0, 1, 4}) CHECK(up[k].assumed.empty());
    for (const std::size_t k : {3, 5}) {
        REQUIRE(up[k].assumed.size() == 1);
        CHECK(up[k].assumed[0].kind == Assumption::Kind::small);
    }
    check_expected(shaken("[\"y + l*sin(theta)\", \"-l*cos(theta)\"]"),
                   {{"theta = 0", "l*theta'' + g*theta = -y''", proved},
                    {"theta = 0", "l*theta'' + g*theta = a*w^2*cos(w*t)", proved},
                    {"theta = 0", "l*theta'' + g*theta = -a*w^2*cos(w*t)", refuted},
                    {"theta = 0", "l*theta'' + g*theta = 0", refuted}});
}

}  // namespace check_near
