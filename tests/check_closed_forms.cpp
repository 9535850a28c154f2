// SPDX-License-Identifier: MIT
// Claims that are not equations of motion: motions in closed form, and equations that hold to first order.
#include <doctest/doctest.h>

#include <fmt/format.h>

#include "analysis/state/prepared.hpp"
#include "check/check.hpp"
#include "checked.hpp"
#include "scene/claims_file.hpp"
#include "scenes.hpp"

namespace check_closed_forms {

using namespace alembert;

namespace {

Checked checked(const std::string& scene, const std::string& claims) {
    const Scene read = with_claims(parse_scene(scene, "s.toml"), claims, "claims.txt");
    return check(read, prepared(read).mechanism);
}

void check_verdicts(const Checked& result, const std::vector<Verdict>& expected) {
    REQUIRE(result.claims.size() == expected.size());
    for (std::size_t k = 0; k < expected.size(); ++k) {
        CAPTURE(k);
        CAPTURE(result.claims[k].reason);
        CHECK(result.claims[k].verdict == expected[k]);
    }
}

const std::string chain =  // a chain that slides off a smooth table: T = m x'^2/2, V = -m g x^2/(2 l)
    "parameters = { m = 1, g = 9.81, l = 2 }\ncoordinates = { x = 0.1 }\n[energy]\nkinetic = \"m*x'^2/2\"\n"
    "potential = \"-m*g*x^2/(2*l)\"\n";

const std::string driven =
    "parameters = { m = 1, k = 4, F = 1, W = 3 }\ninputs = { f = \"F*cos(W*t)\" }\ncoordinates = { x = 0.1 }\n"
    "[energy]\nkinetic = \"m*x'^2/2\"\npotential = \"k*x^2/2\"\n[forces]\nx = \"f\"\n";

const std::string pendulum_on_cart =
    "gravity = [0, \"-g\"]\nparameters = { M = 2, m = 1, l = 0.5, g = 9.81 }\n"
    "coordinates = { x = 0, theta = 0.1 }\n[[particle]]\nname = \"C\"\nmass = \"M\"\nposition = [\"x\", 0]\n"
    "[[particle]]\nname = \"P\"\nmass = \"m\"\nposition = [\"x + l*sin(theta)\", \"-l*cos(theta)\"]\n";

const std::string bead_on_hoop =
    "parameters = { m = 1, R = 1, g = 9.81, w = 5 }\ncoordinates = { theta = 0.1 }\n[energy]\n"
    "kinetic = \"m*R^2*(theta'^2 + w^2*sin(theta)^2)/2\"\npotential = \"-m*g*R*cos(theta)\"\n";

}  // namespace

TEST_CASE("closed forms: a motion is proved by inserting it into the equations, for all values of its constants") {
    check_verdicts(checked(chain, "constants x0\nsolution\nx = x0*cosh(sqrt(g/l)*t)\n"), {Verdict::proved});
    check_verdicts(checked(chain,
                           "constants x0 v0\nsolution\n"
                           "x = x0*cosh(sqrt(g/l)*t) + v0*sqrt(l/g)*sinh(sqrt(g/l)*t)\n"),
                   {Verdict::proved});
    check_verdicts(checked(chain, "constants x0\nsolution\nx = x0*exp(-sqrt(g/l)*t)\n"), {Verdict::proved});

    const std::string swing =  // tuned by a parameter that follows another
        "parameters = { m = 1, w = 3, k = \"m*w^2\" }\ncoordinates = { x = 0.1 }\n[energy]\n"
        "kinetic = \"m*x'^2/2\"\npotential = \"k*x^2/2\"\n";
    check_verdicts(checked(swing, "constants a\nsolution\nx = a*sin(w*t)\n"), {Verdict::proved});
    check_verdicts(checked(swing, "constants a\nsolution\nx = a*sin(2*w*t)\n"), {Verdict::refuted});

    const Checked wrong = checked(chain, "constants x0\nsolution\nx = x0*cos(sqrt(g/l)*t)\n");
    check_verdicts(wrong, {Verdict::refuted});
    CHECK(wrong.claims[0].reason.find("the equation of motion of x") != std::string::npos);
    CHECK(wrong.claims[0].counterexample.size() == 5);  // m, g, l, x0 and t
    check_verdicts(checked(chain, "constants x0\nsolution\nx = x0*cosh(g/l*t)\n"), {Verdict::refuted});
}

TEST_CASE("closed forms: inputs are known functions of time") {
    check_verdicts(checked(driven, "solution\nx = F*cos(W*t)/(k - m*W^2)\n"), {Verdict::proved});
    check_verdicts(checked(driven, "solution\nx = f/(k - m*W^2)\n"), {Verdict::proved});
    check_verdicts(checked(driven, "solution\nx = F*cos(W*t)/(k + m*W^2)\n"), {Verdict::refuted});
}

TEST_CASE("closed forms: with constraints the multipliers belong to the solution") {
    const std::string circle =
        "parameters = { m = 1, r = 2, w = 3 }\ncoordinates = { x = 2, y = { initial = 0, rate = 6 } }\n"
        "[[particle]]\nname = \"P\"\nmass = \"m\"\nposition = [\"x\", \"y\"]\n[[constraint]]\nname = \"c\"\n"
        "holonomic = \"(x^2 + y^2 - r^2)/2\"\n";
    const std::string motion = "solution\nx = r*cos(w*t)\ny = r*sin(w*t)\n";
    check_verdicts(checked(circle, motion + "lambda_c = -m*w^2\n"),
                   {Verdict::proved, Verdict::proved, Verdict::proved});
    check_verdicts(checked(circle, motion + "lambda_c = m*w^2\n"),
                   {Verdict::refuted, Verdict::refuted, Verdict::refuted});
    check_verdicts(checked(circle, motion), {Verdict::proved, Verdict::proved});
    check_verdicts(checked(circle, "solution\nx = r*cos(w*t)\n"), {Verdict::undecided});
}

TEST_CASE("closed forms: linear equations hold to first order near an equilibrium") {
    // (M + m) x'' + m l th'' = 0 and l th'' + x'' + g th = 0
    check_verdicts(checked(pendulum_on_cart,
                           "near theta = 0\n(M+m)*x'' + m*l*theta'' = 0\n"
                           "l*theta'' + x'' + g*theta = 0\nM*l*theta'' + (M+m)*g*theta = 0\n"
                           "l*theta'' + x'' + g*theta*cos(theta) + theta'^2*x'' = 0\n"),
                   {Verdict::proved, Verdict::proved, Verdict::proved, Verdict::proved});
    const Checked wrong = checked(pendulum_on_cart,
                                  "near theta = 0\nM*l*theta'' + m*g*theta = 0\n"
                                  "l*theta'' - x'' + g*theta = 0\nx'' = g\n");
    check_verdicts(wrong, {Verdict::refuted, Verdict::refuted, Verdict::refuted});
    CHECK(wrong.claims[0].difference == "-M*g*theta");
    CHECK(wrong.claims[2].reason == "it does not even hold at the point itself");
    // In the inverted position the term of gravity has the opposite sign.
    check_verdicts(checked(pendulum_on_cart,
                           "near theta = pi\nM*l*theta'' - (M+m)*g*(theta - pi) = 0\n"
                           "M*l*theta'' + (M+m)*g*(theta - pi) = 0\n"),
                   {Verdict::proved, Verdict::refuted});
}

TEST_CASE("closed forms: an equilibrium may depend on parameters, and at no other point is a claim decided") {
    check_verdicts(checked(bead_on_hoop,
                           "near theta = acos(g/(R*w^2))\n"
                           "theta'' + (w^2 - g^2/(R^2*w^2))*(theta - acos(g/(R*w^2))) = 0\n"
                           "theta'' + w^2*(theta - acos(g/(R*w^2))) = 0\n"),
                   {Verdict::proved, Verdict::refuted});
    const Checked none = checked(bead_on_hoop, "near theta = pi/2\ntheta'' + theta = 0\n");
    check_verdicts(none, {Verdict::undecided});
    CHECK(none.claims[0].reason.find("no equilibrium") != std::string::npos);
}

TEST_CASE("closed forms: third derivatives are those of the differentiated equations") {
    const std::string pendulum =
        "gravity = [0, \"-g\"]\nparameters = { m = 1, l = 0.5, g = 9.81 }\ncoordinates = { theta = 0.1 }\n"
        "[[particle]]\nname = \"P\"\nmass = \"m\"\nposition = [\"l*sin(theta)\", \"-l*cos(theta)\"]\n";
    check_verdicts(checked(pendulum,
                           "l*theta''' + g*theta'*cos(theta) = 0\n"
                           "l*theta''' + g*cos(theta) = 0\nl*theta''' + g*theta'*sin(theta) = 0\n"),
                   {Verdict::proved, Verdict::refuted, Verdict::refuted});
    // The same pendulum, described with a constraint: x''' from two equations and the constraint, with its
    // multiplier.
    const std::string cartesian =
        "gravity = [0, \"-g\"]\nparameters = { m = 1, l = 0.5, g = 9.81 }\n"
        "coordinates = { x = 0.3, y = -0.4 }\n[[particle]]\nname = \"P\"\nmass = \"m\"\nposition = [\"x\", "
        "\"y\"]\n"
        "[[constraint]]\nname = \"c\"\nholonomic = \"(x^2 + y^2 - l^2)/2\"\n";
    check_verdicts(checked(cartesian,
                           "x*x''' + y*y''' + 3*x'*x'' + 3*y'*y'' = 0\n"
                           "m*(x'''*y - y'''*x) + m*(x''*y' - y''*x') = m*g*x'\n"
                           "x*x''' + y*y''' + x'*x'' + y'*y'' = 0\n"),
                   {Verdict::proved, Verdict::proved, Verdict::refuted});
}

TEST_CASE("closed forms: a claim that cannot be read is reported with its place") {
    const auto message = [](const std::string& claims) {
        try {
            checked(chain, claims);
        } catch (const SceneError& error) {
            return std::string(error.what());
        }
        return std::string();
    };
    CHECK(message("solution\nx' = t\n").find("claims.txt:2:1") != std::string::npos);
    CHECK(message("solution\nx = x0*t\n").find("'x0'") != std::string::npos);
    CHECK(message("solution\nx = x*t\n").find("a solution may depend on the time and parameters only") !=
          std::string::npos);
    CHECK(message("near y = 0\nx'' = 0\n").find("unknown name 'y'; expected a coordinate") != std::string::npos);
    CHECK(message("near m = 0\nx'' = 0\n").find("'near' gives the values of coordinates") != std::string::npos);
    CHECK(message("near x = t\nx'' = 0\n").find("may depend on parameters only") != std::string::npos);
}

TEST_CASE("check: a motion in closed form need not give the multipliers of constraints") {
    const auto verdicts = [](const std::string& scene, const std::vector<std::string>& motion) {
        std::string text = scene;
        for (const std::string& line : motion)
            text += "[[claim]]\nat = \"solution\"\nequation = \"" + line + "\"\n";
        std::vector<Verdict> result;
        for (const CheckedClaim& claim : test::checked(parse_scene(text, "closed.toml")).claims)
            result.push_back(claim.verdict);
        return result;
    };
    const std::string point =
                          "[coordinates]\nx = { guess = 0.5, rate_guess = 0 }\ny = { guess = 0, rate_guess = 1 }\n"
                          "[[particle]]\nname = \"P\"\nmass = \"m\"\nposition = [\"x\", \"y\"]\n[[constraint]]\n",
                      incline = "gravity = [0, \"-g\"]\n[parameters]\nm = 1\nbe = \"pi/6\"\ng = 9.81\n" + point +
                                "name = \"incline\"\nholonomic = \"y + x*tan(be)\"\n",
                      ring = "[parameters]\nm = 1\na = 0.5\nw = 2\n" + point +
                             "name = \"ring\"\nholonomic = \"x^2 + y^2 - a^2\"\n";
    using Verdicts = std::vector<Verdict>;
    constexpr Verdict proved = Verdict::proved, refuted = Verdict::refuted;
    CHECK(verdicts(incline, {"x = g*sin(be)*cos(be)*t^2/2", "y = -g*sin(be)^2*t^2/2"}) ==
          Verdicts{proved, proved});
    CHECK(verdicts(incline, {"x = g*sin(be)*t^2/2", "y = -g*sin(be)*tan(be)*t^2/2"}) ==
          Verdicts{refuted, refuted});
    CHECK(verdicts(ring, {"x = a*cos(w*t)", "y = a*sin(w*t)"}) == Verdicts{proved, proved});
    CHECK(verdicts(ring, {"x = a*cos(w*t^2)", "y = a*sin(w*t^2)"}) == Verdicts{refuted, refuted});
    CHECK(verdicts(ring, {"x = a*cos(w*t)", "y = a*sin(w*t)", "lambda_ring = -m*w^2/2"}) ==
          Verdicts{proved, proved, proved});
    CHECK(verdicts(ring, {"x = a*cos(w*t)", "y = a*sin(w*t)", "lambda_ring = m*w^2/2"})[2] == refuted);
    CHECK(verdicts(ring, {"x = a*cos(w*t)"})[0] == Verdict::undecided);
}

// y = f(x) as a constraint: no polynomial in x has its zeros, so that it is solved for y.
TEST_CASE("check: claims about a bead on a curve of any function are proved or refuted") {
    const std::vector<std::array<std::string, 3>> curves{
        {"a*cos(k*x)", "-a*k*sin(k*x)", "-a*sin(k*x)"},
        {"a*cosh(x/a)", "sinh(x/a)", "cosh(x/a)"},
        {"a*exp(-k*x)", "-a*k*exp(-k*x)", "a*k*exp(-k*x)"},
        {"a*log(1 + k*x)", "a*k/(1 + k*x)", "a/(1 + k*x)"},
        {"a*sin(k*x^2)", "2*a*k*x*cos(k*x^2)", "a*k*cos(k*x^2)"},
        {"a*tan(k*x)", "a*k/cos(k*x)^2", "a/cos(k*x)^2"},
        {"a*sin(x)*exp(k*x)", "a*(cos(x) + k*sin(x))*exp(k*x)", "a*cos(x)*exp(k*x)"}};
    for (const auto& [f, slope, wrong] : curves) {
        CAPTURE(f);
        const std::string scene =
            "gravity = [0, \"-g\"]\n[parameters]\nm = 1\na = 0.2\nk = 2\ng = 9.81\n"
            "[coordinates]\nx = { initial = 0.3, rate = 0.2 }\n"
            "y = { guess = 0.1, rate_guess = 0 }\n[[particle]]\nname = \"P\"\nmass = \"m\"\n"
            "position = [\"x\", \"y\"]\n[[constraint]]\nname = \"wire\"\nholonomic = \"y - " +
            f + "\"\n";
        const auto claim = [](const std::string& equation) {
            return "[[claim]]\nequation = \"" + equation + "\"\n";
        };
        const Checked result =
            test::checked(parse_scene(scene + claim("y' = (" + slope + ")*x'") + claim("y' = (" + wrong + ")*x'") +
                                          claim("m*x'' + (" + slope + ")*m*(y'' + g) = 0") +
                                          claim("m*x'' - (" + slope + ")*m*(y'' + g) = 0"),
                                      "curve.toml"));
        CHECK(result.claims[0].verdict == Verdict::proved);
        CHECK(result.claims[1].verdict == Verdict::refuted);
        CHECK(result.claims[2].verdict == Verdict::proved);
        CHECK(result.claims[3].verdict == Verdict::refuted);
    }
}

}  // namespace check_closed_forms
