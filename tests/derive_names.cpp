// SPDX-License-Identifier: MIT
// The scene's definitions appear as names in the derived equations; and the sign of a printed equation.
#include <doctest/doctest.h>

#include "algebra/notation/operations.hpp"
#include "algebra/notation/text.hpp"
#include "analysis/derive/derive.hpp"
#include "analysis/state/prepared.hpp"
#include "check/check.hpp"
#include "scene/claims_file.hpp"

namespace derive_names {

using namespace alembert;

namespace {

std::vector<std::string> equations_of(const Derivation& shown) {
    std::vector<std::string> result;
    for (const ReadableEquation& e : shown.equations) result.push_back(text(e.lhs) + " = " + text(e.rhs));
    return result;
}

/// Every printed equation is a right claim about the scene.
void check_printed(const std::string& scene, const std::vector<std::string>& equations) {
    std::string claims;
    for (const std::string& equation : equations) claims += equation + "\n";
    const Scene read = with_claims(parse_scene(scene, "s.toml"), claims, "claims.txt");
    for (const CheckedClaim& claim : check(read, prepared(read).mechanism).claims)
        CHECK(claim.verdict == Verdict::proved);
}

const std::string relativistic =
    "parameters = { m = 1, c = 2, e = 1, B = 0.5, k = 1 }\n"
    "coordinates = { x = { initial = 0, rate = 0.2 }, y = { initial = 0, rate = 0.1 } }\n"
    "[definitions]\ngamma = \"1/sqrt(1 - (x'^2+y'^2)/c^2)\"\n"
    "[energy]\nlagrangian = \"-m*c^2/gamma + e*B/2*(x*y' - y*x') - k*x^2/2\"\n";

}  // namespace

TEST_CASE("derive: the factor of a relativistic particle stays a name, and the equations are right") {
    const DerivedScene d = derive(parse_scene(relativistic, "s.toml"), {});
    REQUIRE(d.shown.abbreviations.size() == 1);
    CHECK(text(d.shown.abbreviations[0].first) == "gamma");
    const std::vector<std::string> equations = equations_of(d.shown);
    for (const std::string& equation : equations) {
        CAPTURE(equation);
        CHECK(equation.find("gamma") != std::string::npos);
        CHECK(equation.find("sqrt") == std::string::npos);
    }
    check_printed(relativistic, equations);
}

TEST_CASE("derive: an angle between two rods and a distance stay names where that is shorter") {
    const std::string scene =
        "parameters = { m = 1, k = 2, q = 3, a = 1 }\ncoordinates = { x = 1, y = 0.5 }\n"
        "[definitions]\nr = \"sqrt((x-a)^2 + y^2)\"\nunused = \"x + y\"\n"
        "[energy]\nkinetic = \"m*(x'^2+y'^2)/2\"\npotential = \"-k/r + q/r^3\"\n";
    const DerivedScene d = derive(parse_scene(scene, "s.toml"), {});
    REQUIRE(d.shown.abbreviations.size() == 1);
    CHECK(text(d.shown.abbreviations[0].first) == "r");
    check_printed(scene, equations_of(d.shown));
}

TEST_CASE("derive: definitions that make nothing shorter are written out") {
    const std::string scene =
        "parameters = { m = 1, g = 9.81, l = 1 }\ncoordinates = { theta = 0.1 }\n"
        "[definitions]\nheight = \"-l*cos(theta)\"\nangle = \"theta + theta\"\n"
        "[energy]\nkinetic = \"m*l^2*theta'^2/2\"\npotential = \"m*g*height\"\n";
    const DerivedScene d = derive(parse_scene(scene, "s.toml"), {});
    CHECK(d.shown.abbreviations.empty());
    CHECK(equations_of(d.shown) == std::vector<std::string>{"l*theta'' + g*sin(theta) = 0"});
}

TEST_CASE("derive: a row keeps the sign with which its own acceleration has a positive inertia") {
    const std::string scene =
        "parameters = { m = 1, J = 2, k = 1 }\ncoordinates = { x = 0, y = 0 }\n"
        "[energy]\nkinetic = \"m*x'^2/2 - k*x'*y' + J*y'^2/2\"\n[forces]\ny = \"-k*x\"\n";
    const std::vector<std::string> equations = equations_of(derive(parse_scene(scene, "s.toml"), {}).shown);
    CHECK(equations == std::vector<std::string>{"m*x'' - k*y'' = 0", "-k*x'' + J*y'' = -k*x"});
}

// With axes that turn by themselves, some coefficients are sums of sines and cosines that vanish in one of their
// forms.
TEST_CASE("derive: speeds along axes that are not the body's own have equations, each of them a right claim") {
    const std::string begin =
                          "parameters = { J = 1 }\ncoordinates = { phi = 0, a1 = 0.1, a2 = 0.2, a3 = 0 }\n"
                          "[[frame]]\nname = \"A\"\nrotate = [[\"z\", \"phi\"]]\n"
                          "[[frame]]\nname = \"B\"\nrotate = ",
                      end =
                          "\n[[body]]\nname = \"ball\"\nmass = 1\nframe = \"B\"\ninertia = [\"J\", \"J\", \"J\"]\n"
                          "position = [0, 0, 0]\n"
                          "[[particle]]\nname = \"arm\"\nmass = 1\nposition = [1, 0, 0]\naxes = \"A\"\n"
                          "[speeds]\nu = \"phi'\"\nw1 = \"dot(omega(ball), ex(A))\"\n"
                          "w2 = \"dot(omega(ball), ey(A))\"\nw3 = \"dot(omega(ball), ez(A))\"\n";
    for (const char* turns : {"[[\"z\", \"a1\"], [\"x\", \"a2\"], [\"y\", \"a3\"]]",
                              "[[\"y\", \"a1\"], [\"z\", \"a2\"], [\"x\", \"a3\"]]",
                              "[[\"x\", \"a1\"], [\"y\", \"a2\"], [\"x\", \"a3\"]]"}) {
        CAPTURE(turns);
        const std::string scene = begin + turns + end;
        const Derivation shown = derive(parse_scene(scene, "s.toml"), {}).shown;
        CHECK(shown.equations.size() == 4);
        if (shown.definitions.empty()) check_printed(scene, equations_of(shown));
        // The angular velocity of a ball without a couple is constant; the axes turn at the rate u about z.
        check_printed(scene, {"u' = 0", "w1' = u*w2", "w2' = -u*w1", "w3' = 0"});
    }
}

TEST_CASE("derive: operations are counted as they stand on paper") {
    const GiNaC::symbol x("x"), y("y");
    const Phrase a = phrases::symbol(x, {.name = "x"}), b = phrases::symbol(y, {.name = "y"});
    CHECK(operations_in(a) == 0);
    CHECK(operations_in(phrases::sum({a, b, phrases::negative(a)})) == 2);
    CHECK(operations_in(phrases::product({phrases::number(2), phrases::power(a, 2), phrases::call("sin", {b})})) ==
          4);
}

}  // namespace derive_names
