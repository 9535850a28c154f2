// SPDX-License-Identifier: MIT
// What people type for names, functions and derivatives. A name of the scene keeps its own meaning.
#include <doctest/doctest.h>

#include <algorithm>

#include "alembert/base/error.hpp"
#include "scene/known_names.hpp"
#include "scene/lists.hpp"
#include "scene/scene.hpp"
#include "scene/typed_toml.hpp"
#include "scene/typed_words.hpp"

namespace scene_words {

using namespace alembert;

namespace {

KnownNames names_of(std::initializer_list<const char*> moving, std::initializer_list<const char*> still = {}) {
    KnownNames names;
    for (const char* const name : moving) names.add(name, true);
    for (const char* const name : still) names.add(name);
    return names;
}

std::string written(std::string text, const KnownNames& names) {
    std::vector<Place> places;
    for (std::size_t k = 0; k <= text.size(); ++k) places.push_back({1, static_cast<int>(k) + 1});
    write_in_words(text, places, names);
    CHECK(places.size() == text.size() + 1);
    CHECK(std::is_sorted(places.begin(), places.end()));
    std::string again = text;
    std::vector<Place> none;
    write_in_words(again, none, names);
    CHECK(again == text);
    return text;
}

const KnownNames usual = names_of({"theta", "phi_1", "x", "x2", "r"}, {"m", "k"});

}  // namespace

TEST_CASE("typed words: rates") {
    for (const char* const text :
         {"thetadot", "theta_dot", "θdot", "θ̇", "θ′", "dot(theta)", "dot(θ)", "\\dot{theta}", "\\dot\\theta",
          "\\dot{\\theta}", "\\dot θ", "Derivative(theta, t)", "Derivative(theta(t), t)", "der(theta)",
          "dtheta/dt", "dθ/dt", "theta'(t)", "theta_dot(t)"}) {
        CAPTURE(text);
        std::string result = written(text, usual);
        std::erase(result, ' ');
        CHECK(result == "theta'");
    }
    for (const char* const text :
         {"xddot", "x_ddot", "xdotdot", "ddot(x)", "\\ddot{x}", "Derivative(x, t, 2)", "Derivative(x, (t, 2))",
          "Derivative(x(t), t, t)", "d2x/dt2", "d2x/dt^2", "ẍ", "x''(t)"}) {
        CAPTURE(text);
        CHECK(written(text, usual) == "x''");
    }
    CHECK(written("der(m*x)", usual) == "(m*x)'");
    CHECK(written("\\dot{x + r}^2", usual) == "(x + r)'^2");
    CHECK(written("Derivative(x*Derivative(r, t), t)", usual) == "(x*r')'");
}

TEST_CASE("typed words: names, functions, powers of e") {
    CHECK(written("φ_1 + \\varphi_1 + \\phi_{1} + phi_{1}", usual) == "phi_1 + phi_1 + phi_1 + phi_1");
    CHECK(written("x_{2}", usual) == "x2");
    CHECK(written("ln(x) + arcsin(x)*sgn(r) - Sqrt(m)", usual) == "log(x) + asin(x)*sign(r) - sqrt(m)");
    CHECK(written("np.sin(x) + math.pi*sympy.ln(x)", usual) == "sin(x) + pi*log(x)");
    CHECK(written("m\\theta + \\cos\\theta", usual) == "m theta + cos theta");  // then refused
    CHECK(written("e^x", usual) == "exp(x)");
    CHECK(written("2*e^-x*m", usual) == "2*exp(-x)*m");
    CHECK(written("e^(-k*x)^2 + 1", usual) == "exp((-k*x)^2) + 1");
    CHECK(written("e^sin(x)*m", usual) == "exp(sin(x))*m");
    CHECK(written("e^x' - e^2^x", usual) == "exp(x') - exp(2^x)");
    CHECK(written("e^{-x/k}*m", usual) == "exp((-x/k))*m");
    CHECK(written("(e^)", usual) == "(e^)");
    CHECK(written("\\frac{1}{2} \\cdot m*x^{2}", usual) == "((1)/(2)) * m*x^(2)");
    CHECK(written("π*\\sin(\\theta)", usual) == "pi*sin(theta)");
    CHECK(written("3 Ω + 2 deg", names_of({"Omega"})) == "3 Ω + 2 deg");  // a unit right after a number
}

TEST_CASE("typed words: a name of the scene keeps its own meaning") {
    CHECK(written("thetadot + ln(x) + e^x", names_of({"theta", "x"}, {"thetadot", "ln", "e"})) ==
          "thetadot + ln(x) + e^x");
    CHECK(written("θ + theta", names_of({"theta", "θ"})) == "θ + theta");
    // alpha and omega are functions of a body, and yet the letters of a scene where nothing is called.
    const KnownNames angles = names_of({"α", "ω", "θ"});
    CHECK(written("a*sin(alpha) + omega^2 + alphadot + alpha(t)", angles) == "a*sin(α) + ω^2 + α' + α");
    CHECK(written("\\alpha + \\dot\\omega + \\dot{\\theta}", angles) == "α + ω' + θ'");
    CHECK(written("dot(omega(B), ex(B)) + alpha(B)", angles) == "dot(omega(B), ex(B)) + alpha(B)");
    CHECK(written("alpha", usual) == "alpha");
    CHECK(written("ϑ + θ", names_of({"ϑ", "θ"})) == "ϑ + θ");
    CHECK(written("ϕ", names_of({"φ", "phi"})) == "ϕ");  // which of the two is not known
    CHECK(written("k(t)", names_of({"x"}, {"k"})) == "k(t)");
    CHECK(written("m_dot", names_of({"x"}, {"m"})) == "m_dot");
    CHECK(written("dx/dt", names_of({"x"}, {"dx"})) == "dx/dt");
    CHECK(written("dx/dt", names_of({"x"}, {"dt"})) == "dx/dt");
    CHECK(written("V(r) + Derivative(r)", names_of({"r"}, {"V", "Derivative"})) == "V(r) + Derivative(r)");
    CHECK(written("bη", names_of({}, {"beta"})) == "bη");
    CHECK(written("omega(B) + omega", names_of({"omega"}, {"B"})) == "omega(B) + omega");
    CHECK(written("dot(vel(P), ex(A))", usual) == "dot(vel(P), ex(A))");
    CHECK(written("x'(-)", usual) == "x'(-)");
}

TEST_CASE("typed words: an own function ln of a scene stays the scene's") {
    const Scene scene = parse_scene(
        "[functions]\nln = [\"x\"]\n[coordinates]\nx = 1\n[energy]\nkinetic = \"x'^2/2\"\npotential = \"ln(x)\"\n",
        "scene.toml");
    CHECK(scene.potential.text == "ln(x)");
    const Scene speed = parse_scene(
        "[coordinates]\nx = 1\nxdot = 2\n[energy]\nkinetic = \"x'^2/2 + xdot'^2/2\"\n"
        "potential = \"xdot\"\n",
        "scene.toml");
    CHECK(speed.potential.text == "xdot");
}

TEST_CASE("typed words: keys and names that refer to others are spelled as the scene has them") {
    const Scene scene = parse_scene(
        "[coordinates]\ntheta_1 = 1\n[[point]]\nname = \"Ω\"\noffset = [1, 0]\n"
        "[[particle]]\nname = \"m₁\"\nmass = 1\nat = \"Omega\"\n[forces]\nθ_1 = "
        "\"-θ_1dot\"\n[[claim]]\nequation = \"θ_1'' = 0\"\nnear = { θ_1dot = 0 }\n",
        "scene.toml");
    CHECK(scene.particles[0].name.text == "m1");
    CHECK(scene.particles[0].position.from.text == "Ω");
    CHECK(scene.generalized_forces[0].coordinate.text == "theta_1");
    CHECK(scene.generalized_forces[0].value.text == "-theta_1'");
    CHECK(scene.claims[0].near[0].first.text == "theta_1'");
}

TEST_CASE("typed words: the signs of a file are written plainly outside of its strings and comments") {
    CHECK(with_plain_signs("m ＝ 1 ＃ ＝") == "m = 1 # ＝");
    CHECK(with_plain_signs("a = “x＝1” # “c”\nb = 「y」") == "a = \"x＝1\" # “c”\nb = \"y\"");
    CHECK(with_plain_signs("a = \"“＝”\"\nb = '＝'") == "a = \"“＝”\"\nb = '＝'");
    CHECK(with_plain_signs("a = \"\"\"\n＝\"＝\n\"\"\"\nb ＝ 1") == "a = \"\"\"\n＝\"＝\n\"\"\"\nb = 1");
    CHECK(with_plain_signs("a = “open\nb ＝ 1") == "a = “open\nb = 1");
    CHECK(with_plain_signs("【【x】】\u3000、−1") == "[[x]] ,-1");
}

TEST_CASE("lists: what stands between commas is taken as it is, and names must be there") {
    using Words = std::vector<std::string>;
    CHECK(alembert::at_commas("min, 0.5,") == Words{"min", " 0.5", ""});
    CHECK(alembert::at_commas("") == Words{""});
    CHECK(alembert::names_of("").empty());
    CHECK(alembert::names_of("theta1,theta2") == Words{"theta1", "theta2"});
    for (const char* const wrong : {",", "a,", ",a", "a,,b"})
        CHECK_THROWS_WITH_AS(alembert::names_of(wrong),
                             doctest::Contains("has a comma beside which there is no name"), alembert::ModelError);
}

}  // namespace scene_words
