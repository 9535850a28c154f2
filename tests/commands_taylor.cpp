// SPDX-License-Identifier: MIT
// The method taylor in whole runs is compared with digits from other sources (Kepler's equation, 110-digit
// series), closed forms, and the same pendulum in other coordinates.
#include <doctest/doctest.h>
#include <fmt/format.h>

#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>
#include <numbers>
#include <sstream>

#include "alembert/ode/series_length.hpp"
#include "json.hpp"
#include "program.hpp"
#include "scenes.hpp"
#include "tables.hpp"

namespace commands_taylor {

using alembert::test::Json;
using alembert::test::json_of;
using alembert::test::run;
using alembert::test::source_path;
using alembert::test::temporary;

namespace {

Json simulated(const std::string& scene, const std::vector<std::string>& more, const char* method = "taylor") {
    return json_of({"simulate", scene, "--no-estimate", "--method", method}, more);
}

double coordinate(const Json& run, const std::string& name) {
    return run["final"]["coordinates"][name].get<double>();
}
double rate(const Json& run, const std::string& name) {
    return run["final"]["rates"][name].get<double>();
}

std::string benchmark(const std::string& name) {
    return source_path("scenes/benchmark/" + name + ".toml");
}

const char* const oscillator = R"toml(
[coordinates]
x = 1
[energy]
kinetic = "x'^2/2"
potential = "x^2/2"
[simulation]
duration = 20
tolerance = 1e-13
method = "taylor"
)toml";

}  // namespace

TEST_CASE("taylor: Kepler's comet, the Pleiades and the outer planets end where the pages say") {
    // 10 orbits amplify a relative error of the energy about 100-fold in time, and the comet moves at 3.4: 1e-8
    // leaves room for 4e-11 of it. A local error at pericentre of 1e-14 is 1e-10 there.
    const Json comet = simulated(benchmark("kepler"), {"--tolerance", "1e-14"});
    CHECK(std::abs(coordinate(comet, "x") + 0.1351664773678210293925794571396607994198) < 1e-8);
    CHECK(std::abs(rate(comet, "y") - 0.7844989436495845826968187373479917536626) < 1e-8);
    const Json stars = simulated(benchmark("pleiades"), {"--tolerance", "1e-13"});
    // Because of close encounters rounding alone causes errors of 2e-12 to 3e-11, for any tolerance from 1e-11 to
    // 1e-14.
    CHECK(std::abs(coordinate(stars, "x1") - 0.37061391439705129009) < 1e-10);
    CHECK(std::abs(rate(stars, "y7") + 1.947020434263291900674262585469) < 1e-10);
    const Json planets = simulated(benchmark("outer_solar_system"), {"--tolerance", "1e-13"});
    CHECK(std::abs(coordinate(planets, "xJupiter") - 2.6110795701128633600809602078737) < 1e-8);
    CHECK(std::abs(coordinate(planets, "ySun") + 0.48994382114427497636788620635032) < 1e-10);
    CHECK(std::abs(coordinate(planets, "zPluto") + 15.043469221823263493829179433668) < 1e-10);
}

// Let go horizontally, a pendulum has the powers t², t⁶, t¹⁰ … alone, and series of most orders end in terms that
// are zero. After half of the period 4 K(sin(π/4)) √(l/g) it is at −π/2 and at rest.
TEST_CASE("taylor: a series that lacks most of its powers takes steps that the others allow") {
    const double half = 2 * std::comp_ellint_1(std::sqrt(0.5)) / std::sqrt(10.0);
    const std::string scene = temporary("horizontal.toml", R"toml(
gravity = [0, -10]
[coordinates]
q = "pi/2"
[[particle]]
name = "P"
mass = 1
position = ["sin(q)", "-cos(q)"]
[simulation]
method = "taylor"
duration = )toml" + fmt::format("{:.17g}\n", half));
    for (const char* tolerance : {"1e-6", "1e-9", "1e-11", "1e-13"}) {
        const Json motion = simulated(scene, {"--tolerance", tolerance});
        const double bound = 100 * std::stod(tolerance);
        CHECK(std::abs(coordinate(motion, "q") + std::numbers::pi / 2) < bound);
        CHECK(std::abs(rate(motion, "q")) < bound);
    }
}

// These scenes have lanes of a pack that wait for the accelerations or have other equal arguments, and entries of
// M that rows need only through M.
TEST_CASE("taylor: linkages and odd frames move as by Runge and Kutta") {
    for (const std::string name : {"scenes/textbook/four_bar.toml", "tests/odd/space.toml"}) {
        CAPTURE(name);
        const auto end = [&](const char* method) {
            return simulated(source_path(name), {"--duration", "0.3", "--tolerance", "1e-11"}, method)["final"];
        };
        const Json series = end("taylor"), stages = end("verner98");
        for (const char* const part : {"coordinates", "rates"})
            for (const auto& entry : stages[part].items()) {
                const double expected = entry.value();
                CHECK(std::abs(series[part][entry.key()].get<double>() - expected) <
                      1e-9 * std::max(1.0, std::abs(expected)));
            }
    }
}

// v' = −µ tanh(v/w) has sinh(v/w) = sinh(v₀/w) e^(−µt/w). While v is large, the coefficients of the series are
// those of a constant force, whatever the order: nothing in them tells that the force will end.
TEST_CASE("taylor: a steep change that the series cannot know of is not passed over") {
    const std::string scene = temporary(
        "steep.toml",
        "[parameters]\nmu = 0.3\nw = 1e-3\n[coordinates]\nx = { initial = 0, rate = 1 }\n[energy]\nkinetic = "
        "\"x'^2/2\"\n[forces]\nx = \"-mu*tanh(x'/w)\"\n[simulation]\nduration = 3.334\n");
    const double v = 1e-3 * std::asinh(std::exp(1000 - std::numbers::ln2 - 0.3 * 3.334 / 1e-3));
    for (const char* tolerance : {"1e-8", "1e-10", "1e-12"}) {
        const Json motion = simulated(scene, {"--tolerance", tolerance});
        CHECK(std::abs(rate(motion, "x") - v) < 10 * std::stod(tolerance));
    }
}

// v' = 1 − c tanh(v/w): for c = 4e-4 the rate changes by less than a thousandth, and the polynomials on either
// side are exact. v is 0 after 1/(1 + c), but for the width w of the change.
TEST_CASE("taylor: a small steep change is not passed over either") {
    const std::string scene = temporary(
        "small.toml",
        "[parameters]\nc = 4e-4\nw = 1e-6\n[coordinates]\nx = { initial = 0, rate = -1 }\n[energy]\nkinetic = "
        "\"x'^2/2\"\n[forces]\nx = \"1 - c*tanh(x'/w)\"\n[simulation]\nduration = 2\n");
    const Json motion = simulated(scene, {"--tolerance", "1e-9"});
    CHECK(std::abs(rate(motion, "x") - (1 - 4e-4) * (2 - 1 / (1 + 4e-4))) < 1e-8);
}

// A mass with the speed 1 comes to V = h exp(−((x − b)/w)²) and is late by w ∫ (1/√(1 − 2 h exp(−s²)) − 1) ds
// after it.
TEST_CASE("taylor: a hill that a free flight passes within a step is seen, as by other methods and in sweeps") {
    const double h = 0.3, ds = 0.01;
    double late = 0;
    for (int k = -1000; k <= 1000; ++k)  // by the trapezoidal rule, which is exact to rounding here
        late += ds * (1 / std::sqrt(1 - 2 * h * std::exp(-ds * k * ds * k)) - 1);
    for (const auto& [b, w] : {std::pair(3.3, 0.1), {5.2, 0.1}, {8.1, 0.05}, {3.3, 0.5}}) {
        CAPTURE(b);
        CAPTURE(w);
        const std::string scene = temporary("hill.toml", fmt::format(R"toml(
[coordinates]
x = {{ initial = 0, rate = 1 }}
[[particle]]
name = "P"
mass = 1
position = ["x", 0]
[energy]
potential = "{}*exp(-((x - {})/{})^2)"
[simulation]
duration = 10
tolerance = 1e-10
)toml",
                                                                     h, b, w));
        const double end = 10 - w * late;
        for (const char* const method : {"taylor", "auto"})
            CHECK(std::abs(coordinate(simulated(scene, {}, method), "x") - end) < 1e-8);
        for (const char* const method : {"dop853", "verner98"})
            CHECK(std::abs(coordinate(simulated(scene, {}, method), "x") - end) < 1e-8);
        for (const char* const method : {"taylor", "dopri5", "dop853", "verner98"}) {
            CAPTURE(method);
            const std::string table = temporary("hill.csv", "");
            json_of({"sweep", scene, "--method", method, "--vary", "x=0:0:1", "-o", table});
            CHECK(std::abs(alembert::test::column(table, "final_x").back() - end) < 1e-8);
        }
    }
}

// The length of a step at which the last terms of a series are as large as allowed, where nothing shortens it.
TEST_CASE(
    "taylor: the terms before the last two shorten a step where powers are missing, and not for entire "
    "functions") {
    constexpr int order = 17;
    const double allowed = 1e-12, share = std::pow(allowed, 1. / order);
    const alembert::SeriesLength lengths(order, std::log(allowed));
    const auto length = [&](const auto& size) {
        return lengths(size, [&](int first, int end, double ratio) {
            double most = 0;
            for (int k = first; k < end; ++k) most = std::max(most, size(k) * std::pow(ratio, k));
            return most;
        });
    };
    const auto by_last = [&](const auto& size) {
        return std::min(std::pow(allowed / size(order - 1), 1. / (order - 1)),
                        std::pow(allowed / size(order), 1. / order));
    };
    for (const double speed : {0.1, 1., 50.}) {
        const auto rotation = [&](int k) { return std::pow(speed, k) / std::tgamma(k + 1.); };
        CHECK(length(rotation) == doctest::Approx(by_last(rotation)).epsilon(1e-12));
        const auto geometric = [&](int k) { return std::pow(speed, k); };
        CHECK(length(geometric) == doctest::Approx(by_last(geometric)).epsilon(1e-12));
        const auto every_fourth = [&](int k) { return k % 4 == 2 ? std::pow(speed, k) : 0; };
        CHECK(length(every_fourth) == doctest::Approx(share / speed).epsilon(1e-12));
        const auto tiny_last = [&](int k) { return std::pow(speed, k) * (k < order - 1 ? 1 : 1e-40); };
        CHECK(length(tiny_last) == doctest::Approx(share / speed).epsilon(1e-12));
    }
    const auto none = [](int) { return 0.; };
    CHECK(length(none) == HUGE_VAL);
    CHECK(length([](int k) { return k == order ? std::nan("") : 1.; }) == 0);
}

// At 1e-9 the last two terms alone would give 112 steps.
TEST_CASE("taylor: a fast top takes the steps that its series allows") {
    const Json motion = simulated(benchmark("heavy_top_sleeping"), {"--tolerance", "1e-9"});
    CHECK(motion["steps"].get<int>() < 125);
}

TEST_CASE("taylor: where nothing changes that the rates depend on, a step is not looked into") {
    const std::string scene = source_path("scenes/textbook/double_atwood.toml");
    CHECK(simulated(scene, {"--no-estimate"}, "taylor")["evaluations"].get<int>() < 10);
    CHECK(simulated(scene, {"--no-estimate"}, "dopri5")["evaluations"].get<int>() < 40);
}

TEST_CASE("taylor: steps that are kept short are not looked into") {
    const Json motion =
        simulated(benchmark("double_pendulum_regular"), {"--duration", "5", "--max-step", "0.005"});
    CHECK(motion["steps"].get<int>() >= 1000);
    CHECK(motion["evaluations"].get<int>() < 1.1 * motion["steps"].get<int>());
}

TEST_CASE("taylor: the double pendulum at t = 10 agrees with 50 digits, as far as its error growth allows") {
    // 10⁷-fold growth of local errors of 1e-14.
    const Json chaotic = simulated(benchmark("double_pendulum_chaotic"), {"--tolerance", "1e-14"});
    CHECK(std::abs(coordinate(chaotic, "theta1") + 0.75312887429491135322) < 1e-5);
    CHECK(std::abs(rate(chaotic, "theta2") + 8.8697025783875326087) < 1e-5);
    const Json regular = simulated(benchmark("double_pendulum_regular"), {"--tolerance", "1e-13"});
    CHECK(std::abs(coordinate(regular, "theta1") - 0.039779782745713516063) < 1e-11);
    CHECK(std::abs(rate(regular, "theta2") - 0.21400402891115624101) < 1e-11);
}

TEST_CASE("taylor: rows between steps are as good as their ends") {
    const std::string file = temporary("rows.csv", "");
    const Json result = simulated(temporary("oscillator.toml", oscillator), {"--sample", "0.01", "-o", file});
    std::ifstream table(file);
    std::string line;
    std::getline(table, line);
    double worst = 0;
    int rows = 0;
    for (; std::getline(table, line); ++rows) {
        double t = 0, x = 0, v = 0;
        char comma = 0;
        std::istringstream(line) >> t >> comma >> x >> comma >> v;
        worst = std::max({worst, std::abs(x - std::cos(t)), std::abs(v + std::sin(t))});
    }
    CHECK(rows == 2001);
    CHECK(result["steps"].get<int>() < 40);  // fifty rows a step
    CHECK(worst < 40 * 1e-13);               // each with one local error
}

TEST_CASE("taylor: events are found on its polynomial, to 1e-12") {
    const std::string text = std::string(oscillator) +
                             "[[event]]\nname = \"through\"\nwhen = \"x\"\n[[event]]\nname = \"end\"\nwhen = \"x' "
                             "+ x - 100*(t - 10)\"\nstop = true\n";
    const Json result = simulated(temporary("events.toml", text), {});
    REQUIRE(result["events"].size() == 4);
    for (int k = 0; k < 3; ++k)
        CHECK(std::abs(result["events"][k]["time"].get<double>() - (k + 0.5) * std::numbers::pi) < 1e-12);
    const double t = result["final"]["time"];
    CHECK(std::abs(-std::sin(t) + std::cos(t) - 100 * (t - 10)) < 1e-10);
}

TEST_CASE("taylor: a pendulum in Cartesian coordinates is the one in its angle") {
    const char* const cartesian = R"toml(
gravity = [0, -9.81]
[coordinates]
x = "sin(1)"
y = "-cos(1)"
[[particle]]
name = "bob"
mass = 2
position = ["x", "y"]
[[constraint]]
name = "rod"
holonomic = "x^2 + y^2 - 1"
[simulation]
duration = 10
)toml";
    const char* const angle = R"toml(
[coordinates]
phi = 1
[energy]
kinetic = "phi'^2"
potential = "-2*9.81*cos(phi)"
[simulation]
duration = 10
)toml";
    const Json one = simulated(temporary("cartesian.toml", cartesian), {"--tolerance", "1e-13"}),
               other = simulated(temporary("angle.toml", angle), {"--tolerance", "1e-13"});
    const double phi = coordinate(other, "phi");
    // An amplitude of 1 rad at 3 rad/s for 10 s: errors of some 50 steps at 1e-13 grow by 30 at most.
    CHECK(std::abs(coordinate(one, "x") - std::sin(phi)) < 2e-10);
    CHECK(std::abs(coordinate(one, "y") + std::cos(phi)) < 2e-10);
    CHECK(one["constraint_drift"].get<double>() < 1e-13);
    CHECK(one["energy_drift"].get<double>() < 1e-11);
}

// x'' = −|x| x from x = 1 at rest: x'²/2 = (1 − |x|³)/3, so that it is at 0 with the speed −√(2/3), and at −1
// after twice the time to there, 2 ∫₀¹ dx/√(2(1 − x³)/3) = 2·√(3/2)·B(1/3, 1/2)/3.
TEST_CASE("taylor: a motion through a kink is followed piece by piece") {
    const double half = 2 * std::sqrt(1.5) * std::beta(1.0 / 3, 0.5) / 3;
    const std::string scene =
        temporary("kink.toml",
                  fmt::format("[coordinates]\nx = 1\n[energy]\nkinetic = \"x'^2/2\"\n[forces]\nx = \"-abs(x)*x\"\n"
                              "[simulation]\nduration = {:.17g}\n",
                              half));
    for (const char* const method : {"taylor", "dop853", "radau"}) {
        CAPTURE(method);
        const Json run = simulated(scene, {"--tolerance", "1e-13"}, method);
        CHECK(std::abs(coordinate(run, "x") + 1) < 1e-11);
        REQUIRE(run["switches"].size() == 1);
        CHECK(std::abs(run["switches"][0]["time"].get<double>() - half / 2) < 1e-11);
    }
}

// The normal forces are multipliers, which M u' = f does not contain.
TEST_CASE("taylor: friction on constraints and contacts brakes as with dop853") {
    for (const char* scene : {"trammel", "braking_box", "sliding_coin"}) {
        CAPTURE(scene);
        const std::string file = source_path(std::string("scenes/friction/") + scene + ".toml");
        const Json series = simulated(file, {"--duration", "0.15", "--tolerance", "1e-11"}),
                   other = simulated(file, {"--duration", "0.15", "--tolerance", "1e-11"}, "dop853");
        for (const auto& [name, value] : other["final"]["coordinates"].items())
            CHECK(std::abs(coordinate(series, name) - value.get<double>()) < 1e-8);
        CHECK(series["work_balance"].get<double>() < 1e-8);
    }
}

}  // namespace commands_taylor
