// SPDX-License-Identifier: MIT
// Periodic systems against Hill's determinant and published thresholds; the boundaries of the bicycle and of
// Ziegler's pendulum; and what is refused.
#include <doctest/doctest.h>
#include <fmt/format.h>

#include <array>
#include <cmath>
#include <utility>

#include "alembert/base/error.hpp"
#include "scenes.hpp"
#include "stability/stability.hpp"

namespace stability_periodic {

using namespace alembert;

namespace {

using V = StabilityVerdict;

Stability judged(const Scene& scene, const std::vector<std::string>& at, double period = 0) {
    StabilityOptions options{.period = period};
    for (const std::string& item : at) {
        const std::string name = item.substr(0, item.find('=')), number = item.substr(item.find('=') + 1);
        options.at.emplace_back(name, std::stod(number));
        options.exact_at.emplace_back(name, number);
    }
    return stability(scene, options);
}

/// 2 cos πν of x'' + (a − 2q cos 2t) x = 0 by Hill's determinant: sin²(πν/2) = Δ(0) sin²(π√a/2) (Whittaker &
/// Watson, §19.42), Δ of 2·4000 + 1 rows.
double trace_by_hill(double a, double q) {
    const auto xi = [&](int n) { return q / (4.0 * n * n - a); };
    double before = 1, last = 1;
    for (int n = -3999; n <= 4000; ++n) {
        const double next = last - xi(n) * xi(n - 1) * before;
        before = last;
        last = next;
    }
    const double s = std::sin(M_PI * std::sqrt(a) / 2);
    return 2 - 4 * last * s * s;
}

}  // namespace

TEST_CASE("stability: Floquet multipliers of Mathieu's equation agree with Hill's determinant to 1e-10") {
    const Scene scene = read_scene(test::source_path("scenes/stability/mathieu.toml"));
    for (const auto& [a, q] :
         {std::pair("1.3", "0.5"), std::pair("3", "0.5"), std::pair("2.1", "1.7"), std::pair("6.5", "3")}) {
        CAPTURE(a);
        const Stability s = judged(scene, {std::string("a=") + a, std::string("q=") + q});
        REQUIRE(s.multipliers.size() == 2);
        const double trace = s.multipliers[0].real() + s.multipliers[1].real(),
                     hill = trace_by_hill(std::stod(a), std::stod(q));
        CHECK(std::abs(trace - hill) < 1e-10);
        CHECK((s.verdict == V::unstable) == (std::abs(hill) > 2));
        CHECK((s.verdict == V::stable) == (std::abs(hill) < 2));
        CHECK(s.theorem == StabilityTheorem::floquet);
    }
}

TEST_CASE(
    "stability: multipliers on the circle decide where a linear force has a potential, and not where a damper "
    "acts") {
    const auto mathieu = [](const std::string& c, const std::string& force) {
        return parse_scene(
            "[parameters]\na = 0.5\nq = 0.2\nc = " + c +
                "\n[coordinates]\nx = 0\ny = 0\n[energy]\nkinetic = \"x'^2/2 + y'^2/2\"\n[forces]\n" + force,
            "case.toml");
    };
    const std::string along_x = "x = \"-(a - 2*q*cos(2*t))*x - c*x'\"\n";
    const std::string alone = along_x + "y = \"-2.3*y\"\n", turned = along_x + "y = \"-2.3*y + x*cos(2*t)/5\"\n",
                      both =
                          "x = \"-(a - 2*q*cos(2*t))*x - c*x' + y*cos(2*t)/5\"\ny = \"-2.3*y + x*cos(2*t)/5\"\n";
    CHECK(judged(mathieu("0", alone), {}).verdict == V::stable);
    CHECK(judged(mathieu("0", both), {}).verdict == V::stable);
    CHECK(judged(mathieu("0", turned), {}).verdict !=
          V::stable);  // no potential: nothing keeps the multipliers on the circle
    CHECK(judged(mathieu("0.1", along_x + "y = \"-2.3*y - c*y'\"\n"), {}).verdict == V::asymptotically_stable);
}

// x'' = −(0.5 ± 0.3) x, each for half of the period: the trace is 2 cos πa cos πb − (a/b + b/a) sin πa sin πb with
// a² = 0.8, b² = 0.2.
TEST_CASE("stability: a square wave of time is no constant") {
    const Stability s = judged(parse_scene("[coordinates]\nx = 0\n[energy]\nkinetic = \"x'^2/2\"\n[forces]\nx = "
                                           "\"-(0.5 + 0.3*sign(cos(t)))*x\"\n",
                                           "case.toml"),
                               {}, 2 * M_PI);
    const double a = std::sqrt(0.8), b = std::sqrt(0.2);
    const double trace =
        2 * std::cos(M_PI * a) * std::cos(M_PI * b) - (a / b + b / a) * std::sin(M_PI * a) * std::sin(M_PI * b);
    REQUIRE(s.multipliers.size() == 2);
    CHECK(std::abs(s.multipliers[0].real() + s.multipliers[1].real() - trace) < 1e-9);
    CHECK(s.verdict == V::stable);
}

TEST_CASE(
    "stability: Kapitza's pendulum has its threshold where Mathieu's equation has it, and near that of "
    "averaging") {
    const Scene scene = read_scene(test::source_path("scenes/stability/kapitza.toml"));
    // Mathieu's equation has it at Omega = 14.17289002081848 sqrt(g/l) for this amplitude, averaging at
    // sqrt(2)/0.1.
    const double threshold = 14.17289002081848 / (std::sqrt(2.0) / 0.1);
    CHECK(std::abs(threshold - 1) < 0.003);
    const auto at = [&](double part) { return "above=" + fmt::format("{:.17g}", part * threshold); };
    CHECK(judged(scene, {at(1.0000001)}).verdict ==
          V::undecided);  // on the circle: critical, as the scene is nonlinear
    const Stability below = judged(scene, {at(0.9999999)});
    CHECK(below.verdict == V::unstable);
    CHECK(below.theorem == StabilityTheorem::floquet);
}

TEST_CASE("stability: multipliers of a system with constraints or speeds are those in minimal coordinates") {
    const std::string minimal = R"toml([parameters]
A = 0.1
Omega = 40
c = 0
[inputs]
yp = "A*cos(Omega*t)"
[coordinates]
theta = 3.141592653589793
[energy]
lagrangian = "theta'^2/2 - yp'*theta'*sin(theta) + 9.81*cos(theta)"
[dissipation]
rayleigh = "c*theta'^2/2"
[simulation]
period = "2*pi/Omega"
)toml";
    std::string speeds = minimal;
    speeds.replace(speeds.find("[energy]"), 8, "[speeds]\nw = \"3*theta' + theta\"\n[energy]");
    const std::string constrained = R"toml([parameters]
A = 0.1
Omega = 40
c = 0
[inputs]
yp = "A*cos(Omega*t)"
[coordinates]
x = { guess = 0 }
y = { guess = 1.1 }
[energy]
kinetic = "(x'^2 + y'^2)/2"
potential = "9.81*y"
[dissipation]
rayleigh = "c*(x'^2 + (y' - yp')^2)/2"
[[constraint]]
name = "rod"
holonomic = "x^2 + (y - yp)^2 - 1"
[simulation]
period = "2*pi/Omega"
)toml";
    for (const std::vector<std::string>& at :
         {std::vector<std::string>{}, {"Omega=60"}, {"c=0.5"}, {"c=0.5", "Omega=60"}, {"A=0.15", "c=0.25"}}) {
        const Stability one = judged(parse_scene(minimal, "minimal.toml"), at);
        REQUIRE(one.multipliers.size() == 2);
        for (const std::string& text : {speeds, constrained}) {
            const Stability other = judged(parse_scene(text, "other.toml"), at);
            CAPTURE(other.reason);
            REQUIRE(other.multipliers.size() == 2);
            for (std::size_t k = 0; k < 2; ++k) {
                CHECK(std::abs(other.multipliers[k] - one.multipliers[k]) < 1e-13 + 2 * other.radii[k]);
                CHECK(other.radii[k] < 1e-8);
            }
            CHECK(other.verdict == one.verdict);
            CHECK(other.states.size() == 2);
        }
    }
}

TEST_CASE("stability: van der Pol's orbit is found from a guess, with its period and multiplier") {
    const Scene scene = parse_scene(R"toml([coordinates]
x = 2
[energy]
kinetic = "x'^2/2"
potential = "x^2/2"
[forces]
x = "(1 - x^2)*x'"
)toml",
                                    "vdp.toml");
    const Stability s = judged(scene, {}, 6.6);
    CHECK(s.verdict == V::asymptotically_stable);
    CHECK(std::abs(s.period - 6.6632868593231301) < 1e-14);  // Andersen & Geer, SIAM J. Appl. Math. 42 (1982) 678
    REQUIRE(s.multipliers.size() == 2);
    CHECK(std::abs(s.multipliers[0] - 1.0) < 1e-12);
    // Liouville: the product of the multipliers is exp of the integral of the divergence 1 - x^2, here by RK4.
    std::array<double, 3> y{s.periodic_start[0].second, s.periodic_start[1].second, 0};
    const auto f = [](const std::array<double, 3>& z) {
        return std::array<double, 3>{z[1], (1 - z[0] * z[0]) * z[1] - z[0], 1 - z[0] * z[0]};
    };
    const int steps = 20000;
    const double h = s.period / steps;
    for (int k = 0; k < steps; ++k) {
        const auto moved = [&](const std::array<double, 3>& by, double c) {
            return std::array<double, 3>{y[0] + c * by[0], y[1] + c * by[1], y[2] + c * by[2]};
        };
        const auto k1 = f(y), k2 = f(moved(k1, h / 2)), k3 = f(moved(k2, h / 2)), k4 = f(moved(k3, h));
        for (std::size_t i = 0; i < 3; ++i) y[i] += h / 6 * (k1[i] + 2 * k2[i] + 2 * k3[i] + k4[i]);
    }
    CHECK(std::abs(s.multipliers[1].real() - std::exp(y[2])) < 1e-12);
}

TEST_CASE("stability: the bicycle's weave and capsize speeds are the published ones to 1e-9") {
    const Scene scene = read_scene(test::source_path("scenes/gallery/bicycle.toml"));
    const auto real_part = [&](double v, bool weave) {  // of the pair, or of the slow real root
        const Stability s = stability(scene, {.at = {{"v", v}, {"kick", 0}}});
        double found = weave ? -1e9 : 1e9;
        for (const RootOf& root : s.eigenvalues) {
            if (std::abs(root.value) < 1e-12) continue;
            if (weave && root.value.imag() != 0) found = root.value.real();
            if (!weave && root.value.imag() == 0 && std::abs(root.value.real()) < std::abs(found))
                found = root.value.real();
        }
        return found;
    };
    for (const auto& [speed, weave] : {std::pair(4.29238253634111, true), std::pair(6.02426201538837, false)}) {
        double a = speed - 0.01, b = speed + 0.013, fa = real_part(a, weave), fb = real_part(b, weave);
        for (int k = 0; k < 6 && std::abs(b - a) > 1e-12; ++k) {
            const double c = b - fb * (b - a) / (fb - fa);
            a = std::exchange(b, c);
            fa = std::exchange(fb, real_part(c, weave));
        }
        CHECK(std::abs(b - speed) < 1e-9);
    }
}

TEST_CASE(
    "stability: Ziegler's pendulum flutters at (7/2 - sqrt 2) k/l, and with a little damping at 41/28 of it") {
    const Scene scene = read_scene(test::source_path("scenes/stability/ziegler.toml"));
    CHECK(judged(scene, {"P=2.08578"}).verdict == V::undecided);  // on the axis; the equations are nonlinear
    CHECK(judged(scene, {"P=2.08579"}).verdict == V::unstable);
    CHECK(judged(scene, {"P=1.4642", "c=0.0001"}).verdict == V::asymptotically_stable);
    CHECK(judged(scene, {"P=1.4643", "c=0.0001"}).verdict == V::unstable);
}

TEST_CASE(
    "stability: states without equilibrium, with touching contacts or time dependence are refused with reasons") {
    const auto refused = [](const std::string& text, const std::string& with, double period = 0) {
        try {
            judged(parse_scene(text, "case.toml"), {}, period);
        } catch (const ModelError& e) {
            CAPTURE(std::string(e.what()));
            CHECK(std::string(e.what()).find(with) != std::string::npos);
            return;
        }
        CHECK_MESSAGE(false, with);
    };
    const std::string pendulum =
        "[coordinates]\nx = 0.5\n[energy]\nkinetic = \"x'^2/2\"\npotential = \"-cos(x)\"\n";
    refused("[coordinates]\nx = 0.5\n[energy]\nkinetic = \"x'^2/2\"\npotential = \"x\"\n",
            "no equilibrium and no steady motion: x'' = -1");
    refused("[inputs]\nF = \"sin(t)\"\n" + pendulum + "[forces]\nx = \"F\"\n", "");
    refused(
        "[inputs]\nF = \"sin(t)\"\n[coordinates]\nx = 0\n[energy]\nkinetic = \"x'^2/2\"\npotential = "
        "\"x^2/2\"\n[forces]\nx = \"F\"\n",
        "the input F changes with time");
    refused(
        "[inputs]\nF = \"sin(t)\"\n[coordinates]\nx = 0\n[energy]\nkinetic = \"x'^2/2\"\npotential = "
        "\"x^2\"\n[forces]\nx = \"F\"\n",
        "do not have the period", 3);
    refused(
        "gravity = [0, -9.81]\n[coordinates]\ny = 0\n[[particle]]\nname = \"P\"\nmass = 1\nposition = [0, \"y\"]\n"
        "[[unilateral]]\nname = \"floor\"\ngap = \"y\"\n",
        "contact floor is closed");
    refused("[parameters]\nK = 0\n[polynomial]\ncoefficients = [\"K\", 1]\n",
            "the first coefficient of [polynomial] is zero");
    CHECK_THROWS_AS(parse_scene("[polynomial]\ncoefficients = [1]\n", "case.toml"), SceneError);
    CHECK_THROWS_AS(parse_scene("[polynomial]\n", "case.toml"), SceneError);
    CHECK_THROWS_AS(parse_scene("[coordinates]\nx = 0\n[polynomial]\ncoefficients = [1, 2]\n", "case.toml"),
                    SceneError);
    CHECK_THROWS_AS(build(parse_scene("[polynomial]\ncoefficients = [1, 2]\n", "case.toml")), ModelError);
}

}  // namespace stability_periodic
