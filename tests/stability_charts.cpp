// SPDX-License-Identifier: MIT
// Charts over two parameters, root loci over one, and Lyapunov exponents, against closed forms, series, published
// numbers and other integrations.
#include <doctest/doctest.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

#include "alembert/base/error.hpp"
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

using Vector = Eigen::VectorXd;

/// The logarithm of the growth of the vector behind the first `size` entries of the state, from one time to the
/// end of the motion, by the method of Runge and Kutta.
template <typename F>
double growth_by_hand(const F& f, Vector state, int size, double from, double duration) {
    const int steps = 60000;
    const double h = duration / steps;
    double before = 0;
    for (int k = 0; k < steps; ++k) {
        if (k == std::lround(from / h)) before = std::log(state.tail(size).norm());
        const double t = k * h;
        const Vector a = f(t, state), b = f(t + h / 2, state + h / 2 * a), c = f(t + h / 2, state + h / 2 * b),
                     d = f(t + h, state + h * c);
        state += h / 6 * (a + 2 * b + 2 * c + d);
    }
    return std::log(state.tail(size).norm()) - before;
}

/// The same from the estimates, which are means over all but the first tenth of the motion.
double growth_of(const LyapunovExponents& found, double from) {
    const double T = found.duration, left_out = std::floor(0.1 * std::round(T / found.interval)) * found.interval;
    const auto row = std::find_if(found.rows.begin(), found.rows.end(),
                                  [&](const LyapunovExponents::Row& r) { return r.time == from; });
    return found.exponents[0] * (T - left_out) - row->estimates[0] * (from - left_out);
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

TEST_CASE("charts: the roots are those of one state that is followed, and a fold ends it") {
    const Scene hoop = scene_of_text(R"toml(
[parameters]
W = 1
[coordinates]
th = 0.1
[energy]
kinetic = "th'^2/2"
potential = "-cos(th) - W^2*sin(th)^2/2"
[dissipation]
rayleigh = "0.05*th'^2"
)toml");
    const RootLocus at_rest = root_locus(hoop, {"W", 0.5, 1.5, 11});
    REQUIRE(at_rest.crossings.size() == 1);
    CHECK(std::abs(at_rest.crossings[0].value - 1) < 1e-9);
    CHECK(at_rest.jumps.empty());
    // A first-order state is followed as a coordinate is.
    const Scene state = scene_of_text(R"toml(
[parameters]
p = -1
[states]
z = { initial = 0.9, rate = "3*z - z^3 - p" }
)toml");
    CHECK(root_locus(state, {"p", -1.5, 1.9, 41}).jumps.empty());
    // x² = p − 0.3 of a fold: no state before.
    const Scene fold = scene_of_text(R"toml(
[parameters]
p = 1
[coordinates]
x = 0.8
[forces]
x = "-x' + p - 0.3 - x^2"
[energy]
kinetic = "x'^2/2"
)toml");
    const RootLocus ended = root_locus(fold, {"p", 1, 0, 21});
    REQUIRE(ended.gaps().size() == 1);
    CHECK(std::abs(ended.gaps()[0].first - 0.3) < 0.06);
    CHECK(ended.gaps()[0].second == 0);
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
    const LyapunovExponents found = lyapunov_exponents(
        read_scene(test::source_path("scenes/stability/henon_heiles.toml")), {.count = 0, .duration = 4000});
    REQUIRE(found.exponents.size() == 4);
    // A regular orbit would have about log(4000)/4000 = 0.002 for all four.
    CHECK(found.exponents[0] > 0.05);
    CHECK(std::abs(found.exponents[0] + found.exponents[3]) < 0.01);
    CHECK(std::abs(found.exponents[1] + found.exponents[2]) < 0.01);
    CHECK(std::abs(*found.sum) < 1e-6);
}

TEST_CASE("exponents: chaotic motions grow as in an integration of variational equations written by hand") {
    // Over times in which the rounding does not grow to anything that could be seen.
    const double henon_rate = std::sqrt(1.0 / 3 - 0.15 * 0.15 - 2 * std::pow(0.15, 3) / 3);
    const auto henon = [](double, const Vector& s) {
        const double x = s[0], y = s[1], dx = s[4], dy = s[5];
        Vector rate(8);
        rate << s[2], s[3], -x - 2 * x * y, -y - x * x + y * y, s[6], s[7], -(1 + 2 * y) * dx - 2 * x * dy,
            -2 * x * dx - (1 - 2 * y) * dy;
        return rate;
    };
    Vector start(8);
    start << 0, -0.15, henon_rate, 0, 1, 0.3, -0.2, 0.1;
    const LyapunovExponents orbit = lyapunov_exponents(
        read_scene(test::source_path("scenes/stability/henon_heiles.toml")), {.duration = 90, .tolerance = 1e-13});
    double from = orbit.rows[9].time;
    CHECK(std::abs(growth_of(orbit, from) - growth_by_hand(henon, start, 4, from, 90)) < 5e-3);

    const auto ueda = [](double t, const Vector& s) {
        Vector rate(4);
        rate << s[1], 7.5 * std::sin(t) - 0.05 * s[1] - std::pow(s[0], 3), s[3],
            -0.05 * s[3] - 3 * s[0] * s[0] * s[2];
        return rate;
    };
    start.resize(4);
    start << 0.1, 0, 1, 0.3;
    const LyapunovExponents driven = lyapunov_exponents(
        scene_of_text("[inputs]\nF = \"7.5*sin(t)\"\n[coordinates]\nx = 0.1\n[energy]\nkinetic = "
                      "\"x'^2/2\"\npotential = \"x^4/4\"\n[dissipation]\nrayleigh = "
                      "\"x'^2/40\"\n[forces]\nx = \"F\"\n"),
        {.count = 0, .duration = 90, .tolerance = 1e-13});
    from = driven.rows[9].time;
    CHECK(std::abs(growth_of(driven, from) - growth_by_hand(ueda, start, 2, from, 90)) < 1e-3);
    CHECK(std::abs(*driven.sum + 0.05) < 1e-9);
}

TEST_CASE("exponents: those of a limit cycle are its Floquet exponents, and constraints are kept") {
    const Scene oscillator = scene_of_text(
        "[coordinates]\nx = { initial = 2, rate = 0 }\n[energy]\nkinetic = \"x'^2/2\"\npotential = "
        "\"x^2/2\"\n[forces]\nx = \"(1 - x^2)*x'\"\n");
    const LyapunovExponents cycle = lyapunov_exponents(oscillator, {.count = 0, .duration = 400});
    const Stability floquet = stability(oscillator, {.period = 6.66});
    CHECK(floquet.verdict == StabilityVerdict::asymptotically_stable);
    REQUIRE(floquet.multipliers.size() == 2);
    CHECK(std::abs(cycle.exponents[0]) < 5e-3);  // the speed on the cycle at two times, over t
    CHECK(std::abs(cycle.exponents[1] - std::log(std::abs(floquet.multipliers[1])) / floquet.period) < 1e-2);
    CHECK(std::abs(*cycle.sum - *cycle.divergence) < 1e-8);
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
