// SPDX-License-Identifier: MIT
// One-sided derivatives against closed forms, and which states linearize accepts where functions of the scene have
// kinks.
#include <doctest/doctest.h>

#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "alembert/base/error.hpp"
#include "model/formalism/formalisms.hpp"
#include "program/lower/start.hpp"
#include "program/puiseux_series.hpp"
#include "scenes.hpp"
#include "stability/linear/linearize.hpp"

namespace analysis_kinks {

using namespace alembert;

namespace {

PuiseuxSeries along(double x, double slope) {
    return PuiseuxSeries::path(x, 1e-13L, {static_cast<long double>(slope)});
}

/// Σ c_k ε^k of this germ equals the given function of ε up to the power of ε to which it is known.
void check_series(const PuiseuxSeries& germ, long double (*f)(long double)) {
    REQUIRE(germ.defined());
    const long double epsilon = 0.01L;
    long double sum = 0;
    for (const PuiseuxSeries::Term& term : germ.terms())
        sum += term.value * std::pow(epsilon, static_cast<long double>(term.exponent));
    CHECK(std::abs(sum - f(epsilon)) < 1e-9L);  // (0.01)^5 times a coefficient of ten
}

/// A particle of mass 2 in x and y with this force along x and −3 y along y, and this potential.
Linearization linearized(const std::string& force, const std::string& potential, double x, double y = 0) {
    const std::string text = fmt::format(
        "[parameters]\nk = 2\nnone = 0\n[coordinates]\nx = {}\ny = {}\n[[particle]]\nname = \"P\"\nmass = "
        "2\nposition = [\"x\", \"y\"]\n"
        "[[force]]\nat = \"P\"\nvector = [\"{}\", \"-3*y\"]\n{}",
        x, y, force, potential.empty() ? "" : "[energy]\npotential = \"" + potential + "\"\n");
    const Mechanism m = build(parse_scene(text, "kink.toml"));
    const Equations equations = formalism("lagrange").derive(m);
    return linearize(m, equations, start_of(m, {}));
}

std::string refusal(const std::string& force, const std::string& potential, double x = 0, double y = 0) {
    CAPTURE(force);
    CAPTURE(potential);
    try {
        linearized(force, potential, x, y);
    } catch (const ModelError& e) {
        return e.what();
    }
    FAIL("linearized");
    return "";
}

bool has(const std::string& text, const std::string& part) {
    return text.find(part) != std::string::npos;
}

}  // namespace

TEST_CASE("germ: each function is the series of its closed form on a path through its critical point") {
    check_series(sqrt(along(0, 1) * along(0, 1)), [](long double e) { return e; });
    check_series(sqrt(along(0, 2)), [](long double e) { return std::sqrt(2 * e); });
    check_series(abs(along(0, -3)), [](long double e) { return 3 * e; });
    check_series(asin(along(1, -1)), [](long double e) { return std::asin(1 - e); });
    check_series(acos(along(-1, 1)), [](long double e) { return std::acos(-1 + e); });
    check_series(atan2(along(0, -2), along(-1, 1)), [](long double e) { return std::atan2(-2 * e, -1 + e); });
    check_series(atan2(along(0, 3), along(0, 2)), [](long double) { return std::atan2(3.0L, 2.0L); });
    check_series(pow(along(0, 1), PuiseuxSeries(2.5L)), [](long double e) { return std::pow(e, 2.5L); });
    check_series(pow(along(0, -1), PuiseuxSeries(3)), [](long double e) { return -e * e * e; });
    check_series(sin(along(0, 1)) / abs(along(0, 1)), [](long double e) { return std::sin(e) / e; });
    check_series(tan(along(0.4, 1)) + exp(along(-1, 2)),
                 [](long double e) { return std::tan(0.4 + e) + std::exp(-1 + 2 * e); });
    check_series(tanh(along(0.3, 1)) * log(along(2, 1)),
                 [](long double e) { return std::tanh(0.3 + e) * std::log(2 + e); });
    check_series(sinh(along(0.3, 1)) - atan(along(2, 1)) * cosh(along(1, 1)),
                 [](long double e) { return std::sinh(0.3 + e) - std::atan(2 + e) * std::cosh(1 + e); });
    CHECK_FALSE(sqrt(along(0, -1)).defined());
    CHECK_FALSE((PuiseuxSeries(1) / PuiseuxSeries(0)).defined());
    CHECK(sin(PuiseuxSeries::path(std::numbers::pi, 1e-13L, {1})).side() ==
          -1);  // π is not exact in floating point; the slope decides
}

TEST_CASE("linearize: kinks are refused, with the slopes of both sides") {
    const auto slopes = [](const std::string& force, const char* grows, const char* falls) {
        const std::string said = refusal(force, "");
        CAPTURE(said);
        CHECK(has(said, fmt::format("has the slope {} in x where x grows, and {} where it falls", grows, falls)));
    };
    slopes("-k*abs(x)", "-2", "2");
    slopes("min(x, 2*x)", "1", "2");
    slopes("max(x, 0)", "1", "0");
    slopes("min(x, -x)", "-1", "1");
    slopes("-sqrt(x^2)", "-1", "1");
    slopes("-sqrt(x^2 + y^2)", "-1", "1");
    slopes("-x*sign(x)", "-1", "1");
    slopes("none*x + abs(sin(x))", "1", "-1");
    CHECK(has(refusal("-k*abs(x)", ""), "x = 0"));
    CHECK(has(refusal("-k*abs(x)", ""), "abs(x) in force 1 at P"));
    CHECK(has(refusal("-sign(x)", ""), "jumps where x grows: from 0 to -1"));
    CHECK(has(refusal("-sqrt(x)", ""), "has an infinite slope where x grows"));
    CHECK(has(refusal("-x^1.5", ""), "has no value where x falls: the state is on the border of its domain"));
    CHECK(has(refusal("-1/x", ""), "grows without bound where x grows"));
    CHECK(has(refusal("-log(x)", ""), "has no value at this state"));
    CHECK(has(refusal("-atan2(y, x)", ""), "atan2(y,x)"));
    CHECK(has(refusal("-atan2(y, x)", "", -1), "jumps where y"));
    CHECK(has(refusal("asin(x) - pi/2", "", 1), "has no value where x grows"));
    CHECK(has(refusal("asin(1 - x^2) - pi/2", ""),
              "has the slope -1.41421 in x where x grows, and 1.41421 where it falls"));
    CHECK(has(refusal("-sign(x)*y", ""), "sign(x)"));  // zero along both axes
    CHECK(has(refusal("-min(abs(x), abs(y))", ""), "min(abs(x),abs(y))"));
    CHECK(has(refusal("-max(0, min(x, y) - 10*abs(x - y))", ""), "max"));  // not zero only in a narrow cone
    CHECK(has(refusal("abs(sin(x))", "", std::numbers::pi), "x = 3.14159"));
}

TEST_CASE("linearize: a potential without a second derivative is refused, and the message says so") {
    CHECK(has(refusal("0", "x^1.5"), "sqrt(x) in [energy] potential"));
    CHECK(has(refusal("0", "x^1.5"), "has an infinite slope where x grows"));
    CHECK(has(refusal("0", "x^2.5"), "has no value where x falls: the state is on the border of its domain"));
    CHECK(has(refusal("0", "x*abs(x)"), "has the slope -2 in x where x grows, and 2 where it falls"));
    CHECK(has(refusal("0", "k*max(x, 0)^2"), "has the slope -4 in x where x grows, and 0 where it falls"));
    CHECK(has(refusal("0", "k/2*(sqrt(x^2 + y^2) - 1)^2"), "two limits: 2 where x grows, and -2 where x falls"));
}

TEST_CASE(
    "linearize: what is differentiable although a function in it is not has the matrices of its derivative") {
    const auto stiffness = [](const std::string& force, const std::string& potential, double x = 0) {
        const Linearization near = linearized(force, potential, x);
        CAPTURE(force);
        CAPTURE(potential);
        CHECK(near.P(1, 1) == doctest::Approx(3).epsilon(1e-14));
        CHECK(std::abs(near.P(1, 0)) < 1e-14);
        return near.P(0, 0);
    };
    for (const char* force :
         {"-5*x - k*x*abs(x)", "-5*x - abs(x)^3", "-5*x + max(x, 0)^2", "-5*x - sign(x)*y^2", "-5*x + abs(x)^1.5",
          "-5*x - sqrt(x^2)^3", "-5*x - x*sqrt(x^2 + y^2)", "-5*x + min(x, -x) + max(x, -x)",
          "-5*x + abs(x) - max(x, -x)", "-5*x + x'*abs(x)", "-5*x + none*abs(x)", "-5*x*sign(x)^2"})
        CHECK(stiffness(force, "") == doctest::Approx(5).epsilon(1e-14));
    CHECK(stiffness("0", "abs(x)^3 + x^2") == doctest::Approx(2).epsilon(1e-14));
    CHECK(stiffness("-5*abs(x) + 5", "", 1) == doctest::Approx(5).epsilon(1e-14));  // away from the kink
    CHECK(stiffness("x^1.5 - 1", "", 1) == doctest::Approx(-1.5).epsilon(1e-14));
    CHECK(stiffness("-tanh(x/0.001)", "") == doctest::Approx(1000).epsilon(1e-14));
    CHECK(stiffness("-sqrt(x^2 + 0.01) + 0.1 - 5*x", "") == doctest::Approx(5).epsilon(1e-14));  // smoothed
}

}  // namespace analysis_kinks
