// SPDX-License-Identifier: MIT
// Charts over two parameters, root loci over one, and Lyapunov exponents, against closed forms, Hill's determinant
// and published numbers.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>

#include "alembert/error.hpp"
#include "scenes.hpp"
#include "stability/exponents.hpp"
#include "stability/locus.hpp"

namespace stability_charts {

using namespace alembert;

namespace {

const std::string ziegler = test::source_path("scenes/stability/ziegler.toml");

Scene scene_of_text(const std::string& text) {
    return parse_scene(text, "case.toml");
}

/// The boundary's distance in pixels from the curve f = 0, to first order.
template <typename F>
double off_by(const StabilityChart& chart, const F& f) {
    double worst = 0;
    const double per_x = (chart.x.to - chart.x.from) / chart_width,
                 per_y = (chart.y.to - chart.y.from) / chart_height;
    for (const auto& line : chart.boundaries)
        for (const ChartPoint& p : line) {
            const double dx = (f(p.x + 1e-6, p.y) - f(p.x - 1e-6, p.y)) / 2e-6 * per_x,
                         dy = (f(p.x, p.y + 1e-6) - f(p.x, p.y - 1e-6)) / 2e-6 * per_y;
            worst = std::max(worst, std::abs(f(p.x, p.y)) / std::hypot(dx, dy));
        }
    return worst;
}

}  // namespace

TEST_CASE(
    "charts: the boundary of a regulator's polynomial is Vishnegradsky's hyperbola to a hundredth of a pixel") {
    const StabilityChart chart = stability_chart(
        scene_of_text("[parameters]\nx = 1\ny = 1\n[polynomial]\ncoefficients = [1, \"x\", \"y\", 1]\n"),
        {"x", 0.1, 4.1, 41}, {"y", 0.1, 4.1, 31});
    REQUIRE(chart.boundaries.size() == 1);
    CHECK(off_by(chart, [](double x, double y) { return x * y - 1; }) < 0.01);
    for (std::size_t i = 0; i < chart.x.count; ++i)
        for (std::size_t j = 0; j < chart.y.count; ++j) {
            const double x = 0.1 + 0.1 * static_cast<double>(i), y = 0.1 + 4.0 / 30 * static_cast<double>(j);
            if (std::abs(x * y - 1) > 1e-3)
                CHECK(chart.kind(i, j) == (x * y > 1 ? SpectrumKind::inside : SpectrumKind::flutter));
        }
    // The pieces between the points do not leave the curve either.
    double worst = 0;
    for (std::size_t k = 0; k + 1 < chart.boundaries[0].size(); ++k) {
        const ChartPoint &a = chart.boundaries[0][k], &b = chart.boundaries[0][k + 1];
        const double x = (a.x + b.x) / 2, y = (a.y + b.y) / 2;
        worst = std::max(worst, std::abs(x * y - 1) / std::hypot(y * 4 / chart_width, x * 4 / chart_height));
    }
    CHECK(worst < 0.02);
}

TEST_CASE("charts: Strutt's diagram has the boundaries that the series of Mathieu's functions give") {
    const Scene scene = read_scene(test::source_path("scenes/stability/mathieu.toml"));
    const StabilityChart chart = stability_chart(scene, {"a", -0.5, 3, 36}, {"q", 0, 1, 11});
    REQUIRE(chart.boundaries.size() >= 2);
    // a0, b1, a1 to q⁴ (Abramowitz & Stegun 20.2.25), for small q; the boundary is one of them there.
    const auto near_one = [](double a, double q) {
        const double a0 = -q * q / 2 + 7 * std::pow(q, 4) / 128,
                     b1 = 1 - q - q * q / 8 + std::pow(q, 3) / 64 - std::pow(q, 4) / 1536,
                     a1 = 1 + q - q * q / 8 - std::pow(q, 3) / 64 - std::pow(q, 4) / 1536;
        return std::min({std::abs(a - a0), std::abs(a - b1), std::abs(a - a1)});
    };
    int looked_at = 0;
    for (const auto& line : chart.boundaries)
        for (const ChartPoint& p : line) {
            if (p.y > 0.3 || p.x > 2) continue;
            ++looked_at;
            CHECK(near_one(p.x, p.y) < 1e-4 + 0.02 * 3.5 / chart_width);
        }
    CHECK(looked_at > 20);
}

TEST_CASE("charts: Ziegler's pendulum diverges and flutters, and its locus finds the published loads") {
    const Scene scene = read_scene(ziegler);
    const RootLocus ideal = root_locus(scene, {"P", 0, 3, 31});
    REQUIRE(ideal.crossings.size() == 1);
    CHECK(std::abs(ideal.crossings[0].value - (3.5 - std::sqrt(2.0))) < 1e-9);
    CHECK(ideal.crossings[0].kind == SpectrumKind::flutter);
    // Herrmann & Jong: with equal small dampers 41/28; with damping c the critical load is 41/28 + c²/2.
    const RootLocus damped = root_locus(scene, {"P", 0, 3, 31}, {.stability = {.at = {{"c", 0.2}}}});
    REQUIRE(damped.crossings.size() >= 1);
    CHECK(std::abs(damped.crossings[0].value - (41.0 / 28 + 0.02)) < 1e-12);
    const StabilityChart chart = stability_chart(scene, {"c", 0.05, 1, 11}, {"P", 0, 3, 11});
    CHECK(off_by(chart, [](double c, double P) { return P - 41.0 / 28 - c * c / 2; }) < 0.01);
}

TEST_CASE("charts: the locus of the bicycle has the published weave and capsize speeds to 1e-9") {
    const Scene scene = read_scene(test::source_path("scenes/gallery/bicycle.toml"));
    const RootLocus locus = root_locus(scene, {"v", 3.5, 7, 8}, {.stability = {.at = {{"kick", 0}}}});
    REQUIRE(locus.crossings.size() == 2);
    CHECK(std::abs(locus.crossings[0].value - 4.29238253634111) < 1e-9);
    CHECK(locus.crossings[0].kind == SpectrumKind::flutter);
    CHECK(std::abs(locus.crossings[1].value - 6.02426201538837) < 1e-9);
    CHECK(locus.crossings[1].kind == SpectrumKind::divergence);
}

TEST_CASE("exponents: linear systems have the real parts of their eigenvalues, and the sum is the divergence") {
    const LyapunovExponents damped = lyapunov_exponents(
        scene_of_text(
            "[coordinates]\nx = 1\n[energy]\nkinetic = \"x'^2/2\"\npotential = \"x^2/2\"\n[dissipation]\n"
            "rayleigh = \"x'^2/10\"\n"),
        {.count = 0, .duration = 400});
    REQUIRE(damped.exponents.size() == 2);
    for (const double one : damped.exponents)
        CHECK(std::abs(one + 0.1) < 5e-3);  // the phase of the last turn, over t
    REQUIRE(damped.sum);
    REQUIRE(damped.divergence);
    CHECK(std::abs(*damped.sum + 0.2) < 1e-8);
    CHECK(std::abs(*damped.divergence + 0.2) < 1e-12);
    // ±1 and ±2 at a saddle, where the motion stays; the vectors have turned to theirs but for exp(-20).
    const LyapunovExponents saddle = lyapunov_exponents(
        scene_of_text("[coordinates]\nx = 0\ny = 0\n[energy]\nkinetic = \"(x'^2 + y'^2)/2\"\npotential = "
                      "\"-x^2/2 - 2*y^2\"\n"),
        {.count = 0, .duration = 200});
    const double expected[] = {2, 1, -1, -2};
    for (std::size_t k = 0; k < 4; ++k) CHECK(std::abs(saddle.exponents[k] - expected[k]) < 1e-8);
    CHECK(std::abs(*saddle.sum) < 1e-8);
}

TEST_CASE("exponents: those of a Hamiltonian come in pairs, and Henon and Heiles' orbit at E = 1/6 is chaotic") {
    // Benettin, Galgani & Strelcyn (1976): the entropy is about 0.13 at E = 1/6 in the large chaotic region.
    const LyapunovExponents found = lyapunov_exponents(
        read_scene(test::source_path("scenes/stability/henon_heiles.toml")), {.count = 0, .duration = 20000});
    REQUIRE(found.exponents.size() == 4);
    CHECK(std::abs(found.exponents[0] - 0.13) < 0.02);
    CHECK(std::abs(found.exponents[0] + found.exponents[3]) < 0.005);
    CHECK(std::abs(found.exponents[1]) < 0.01);
    CHECK(std::abs(*found.sum) < 1e-6);
}

TEST_CASE(
    "exponents: the driven pendulum and Ueda's oscillator have the published ones, and constraints are kept") {
    // Sprott, Chaos and Time-Series Analysis (2003), appendix A: 0.1400, 0, -0.1900 of x'' = -sin x - 0.05 x' +
    // 0.6 sin 0.7 t, and 0.1034, 0, -0.1534 of x'' = -x^3 - 0.05 x' + 7.5 sin t. An average over t is known to
    // about 1/sqrt(t); the sum is the damping.
    const auto driven = [](const std::string& F, const std::string& V, double duration) {
        return lyapunov_exponents(
            scene_of_text("[inputs]\nF = \"" + F +
                          "\"\n[coordinates]\nx = 0.1\n[energy]\nkinetic = " + "\"x'^2/2\"\npotential = \"" + V +
                          "\"\n[dissipation]\nrayleigh = \"x'^2/40\"\n[forces]\nx = \"F\"\n"),
            {.count = 0, .duration = duration});
    };
    const LyapunovExponents pendulum = driven("0.6*sin(0.7*t)", "-cos(x)", 12000);
    CHECK(std::abs(pendulum.exponents[0] - 0.14) < 0.01);
    CHECK(std::abs(*pendulum.sum + 0.05) < 1e-7);
    const LyapunovExponents ueda = driven("7.5*sin(t)", "x^4/4", 6000);
    CHECK(std::abs(ueda.exponents[0] - 0.1034) < 0.013);
    CHECK(std::abs(*ueda.sum + 0.05) < 1e-7);
    // A pendulum at rest in Cartesian coordinates, damped: −1/4 twice, on the tangent space of the circle.
    const LyapunovExponents circle = lyapunov_exponents(
        scene_of_text("[coordinates]\nx = 0\ny = -1\n[energy]\nkinetic = \"(x'^2 + y'^2)/2\"\npotential = \"y\"\n"
                      "[dissipation]\nrayleigh = \"(x'^2 + y'^2)/4\"\n[[constraint]]\nname = \"rod\"\nholonomic = "
                      "\"x^2 + y^2 - 1\"\n"),
        {.count = 0, .duration = 400});
    REQUIRE(circle.exponents.size() == 2);
    CHECK(std::abs(*circle.sum + 0.5) < 1e-8);
    CHECK(!circle.divergence);
    CHECK(circle.exponents[0] >= circle.exponents[1]);
    for (const LyapunovExponents::Row& row : circle.rows) CHECK(row.estimates.size() == 2);
    CHECK(circle.rows.back().estimates == circle.exponents);
    CHECK(std::abs(circle.exponents[0] + 0.25) < 5e-3);
}

}  // namespace stability_charts
