// SPDX-License-Identifier: GPL-2.0-or-later
// Forces of places: hills, layers and kicks that are narrow beside a step. All results are held against closed
// forms, most of them against the work: a mass that has passed a force has v²/2 = v₀²/2 + ∫ F dx, one that has
// passed a layer of drag D(x) has v = v₀ − ∫ D dx, and one that a hill has turned back has −v₀.
#include <doctest/doctest.h>
#include <fmt/format.h>

#include <cmath>
#include <random>
#include <string>
#include <vector>

#include "json.hpp"
#include "program.hpp"
#include "shell.hpp"

namespace commands_places {

using alembert::test::Json;
using alembert::test::number;
using alembert::test::run;
using alembert::test::simulated;
using alembert::test::temporary;

namespace {

/// A function of z that is flat but for a small region, and its integral over the whole line.
struct Shape {
    std::string text;
    double integral;
};

std::vector<Shape> shapes(const std::string& z) {
    const double pi = std::acos(-1.0);
    return {{fmt::format("exp(-{}^2)", z), std::sqrt(pi)},
            {fmt::format("exp(-{}^4)", z), 2 * std::tgamma(1.25)},
            {fmt::format("exp(-{}^10)", z), 2 * std::tgamma(1.1)},
            {fmt::format("(tanh({0} + 2) - tanh({0} - 2))/2", z), 4},
            {fmt::format("1/cosh({})", z), pi},
            {fmt::format("1/cosh({})^2", z), 2},
            {fmt::format("exp(-{0})/(1 + exp(-{0}))^2", z), 1}};
}

struct Random {
    std::mt19937_64 engine;
    double operator()(double low, double high) {
        return low + (high - low) * static_cast<double>(engine() >> 11) * 0x1p-53;
    }
    std::size_t below(std::size_t count) { return engine() % count; }
};

std::string mass(double v, double duration, const std::string& more) {
    return temporary(
        "place.toml",
        fmt::format("[parameters]\nw = 1\n[coordinates]\nx = {{ initial = 0, rate = {} }}\n[[particle]]\n"
                    "name = \"P\"\nmass = 1\nposition = [\"x\", 0]\n{}[simulation]\nduration = {}\n",
                    v, more, duration));
}

double rate(const Json& result) {
    return result["final"]["rates"]["x"].get<double>();
}
double place(const Json& result) {
    return result["final"]["coordinates"]["x"].get<double>();
}
bool trusted(const Json& result) {
    return result["error_estimate"]["trustworthy"].get<bool>();
}

}  // namespace

TEST_CASE("simulate: no method that chooses its steps passes over a narrow hill, layer or force of a place") {
    Random random{std::mt19937_64(67)};
    const std::vector<std::string> methods = {"auto",   "auto",     "auto",  "auto", "taylor", "dop853",
                                              "dopri5", "verner98", "radau", "bdf",  "abm"};
    for (int k = 0; k < 220; ++k) {
        const double w = std::pow(10, random(-3, -0.7)), at = random(1 + 5 * w, 6), v = random(0.5, 2);
        const std::string z = fmt::format("((x - {})/{})", at, w);
        const std::vector<Shape> all = shapes(z);
        const std::size_t kind = random.below(3);
        const Shape& shape =
            all[random.below(all.size() - (kind == 2 ? 1 : 0))];  // the slope of the last overflows
        std::string method = methods[random.below(methods.size())];
        if (method == "taylor" &&
            (shape.text.find("cosh") != std::string::npos || shape.text.find("+ exp") != std::string::npos))
            method = "auto";  // the coefficients of their series overflow
        const double part = random(0.2, 0.8);
        std::string more;
        double exact = 0;
        if (kind == 0) {  // a force: the work is known
            const double F = part * v * v / w * (random.below(2) == 0 ? 1 : -0.3);
            more = fmt::format("[forces]\nx = \"{}*{}\"\n", F, shape.text);
            exact = std::sqrt(v * v + 2 * F * w * shape.integral);
            if (!(v * v + 2 * F * w * shape.integral > 0.04)) continue;
        } else if (kind == 1) {  // a layer of drag
            const double D = part * v / (w * shape.integral);
            more = fmt::format("[forces]\nx = \"-{}*{}*x'\"\n", D, shape.text);
            exact = (1 - part) * v;
        } else {  // a hill that is too high
            more = fmt::format("[energy]\npotential = \"{}*({})\"\n", (1.5 + part) * v * v, shape.text);
            exact = -v;
        }
        const double slowest = std::min(v, std::abs(exact)), duration = at / v + (30 * w + 1) / slowest;
        const Json result = simulated(mass(v, duration, more), {"--method", method});
        CAPTURE(more);
        CAPTURE(method);
        CAPTURE(k);
        CHECK(std::abs(rate(result) - exact) < 1e-5);
        CHECK(trusted(result));
    }
}

TEST_CASE("sweep, bench, between rows: nothing passes over a narrow force either") {
    const std::string scene =
        mass(1, 10, "[forces]\nx = \"0.5/w*exp(-((x - 3.3)/w)^2)\"\n");  // v² = 1 + √π, whatever w is
    const double exact = std::sqrt(1 + std::sqrt(std::acos(-1.0)));
    for (const char* const method : {"auto", "dop853", "verner98", "taylor"}) {
        const auto swept = run({"sweep", scene, "--json", "--vary", "w=1e-3:0.05:12", "--method", method});
        REQUIRE(swept.exit == 0);
        for (const Json& row : Json::parse(swept.out)["rows"])
            CHECK(std::abs(row["final"]["rates"]["x"].get<double>() - exact) < 1e-6);
    }
}

// v² = 1 + 2 ∫ F dx; the shapes are bounded by bends, or peaks of powers.
TEST_CASE("places: strips between bends and peaks of powers are passed by no run and no sweep") {
    const std::vector<Shape> bends = {{"max(0, 1 - abs((x - 1.3)/w))", 1},
                                      {"max(0, 1 - ((x - 1.3)/w)^2)", 4.0 / 3},
                                      {"(max(0, x - 1.3) - 2*max(0, x - 1.3 - w) + max(0, x - 1.3 - 2*w))/w", 1},
                                      {"min(1, max(0, 2 - abs((x - 1.3)/w)))", 3}},
                             peaks = {{"1/(1 + ((x - 1.3)/w)^2)^4", 5 * std::acos(-1.0) / 16},
                                      {"1/sqrt(1 + ((x - 1.3)/w)^2)^5", 4.0 / 3},
                                      {"1/(1 + ((x - 1.3)/w)^4)^3", 21 * std::acos(-1.0) / (32 * std::sqrt(2.0))}};
    for (const std::vector<Shape>* const shapes : {&bends, &peaks})
        for (const Shape& shape : *shapes)
            for (const double w : {0.01, 1e-3, 1e-5}) {
                if (w < 1e-4 && shape.text[0] == '(') continue;  // the rounding of three terms is what is left
                CAPTURE(shape.text);
                CAPTURE(w);
                const std::string scene = mass(1, 4, fmt::format("[forces]\nx = \"0.3/w*({})\"\n", shape.text));
                const double exact = std::sqrt(1 + 0.6 * shape.integral);
                const std::vector<std::string> at = {"--at", fmt::format("w={}", w)};
                CHECK(std::abs(rate(simulated(scene, at)) - exact) < 1e-6);
                for (const char* const method : {"auto", "dop853", "verner98"}) {
                    const auto swept = run(
                        {"sweep", scene, "--json", "--vary", fmt::format("w={0}:{0}:1", w), "--method", method});
                    REQUIRE(swept.exit == 0);
                    const Json row = Json::parse(swept.out)["rows"][0];
                    CHECK(std::abs(row["final"]["rates"]["x"].get<double>() - exact) < 1e-6);
                }
            }
}

// A layer of drag D between bends takes ∫ D dx = k w from the speed: v = 1 − k w.
TEST_CASE("places: derivatives of the end know the strip that the motion has met") {
    const std::string scene = mass(1, 3, "[forces]\nx = \"-30*w*max(0, 1 - abs(x - 1)/0.01)*x'\"\n");
    const auto result = run({"simulate", scene, "--json", "--sensitivity", "w"});
    REQUIRE(result.exit == 0);
    const Json all = Json::parse(result.out);
    CHECK(std::abs(rate(all) - 0.7) < 1e-8);
    CHECK(all["sensitivity"]["of"][1] == "x'");
    CHECK(std::abs(all["sensitivity"]["values"][1][0].get<double>() + 0.3) < 1e-5);
}

TEST_CASE("places: steps of a fixed length that pass a place are told") {
    const auto layer = [](const char* force) { return mass(1, 3, fmt::format("[forces]\nx = \"{}\"\n", force)); };
    const auto narrow = [&] { return layer("-2e4*exp(-((x - 1)/1e-5)^2)*x'"); };
    const auto mild = [&] { return layer("-0.1*exp(-(x - 1)^2)*x'"); };
    for (const std::vector<std::string>& method : {std::vector<std::string>{"--method", "rk4", "--step", "0.003"},
                                                   {"--method", "gauss", "--step", "0.02"}}) {
        const Json passed = simulated(narrow(), method);
        CHECK(!trusted(passed));
        CHECK(passed["error_estimate"].dump().find("where a force changes fast") != std::string::npos);
        CHECK(trusted(simulated(mild(), method)));
    }
    CHECK(run({"emit", narrow(), "--standalone", "-o", alembert::test::temporary_folder("narrow")})
              .err.find("changes fast in a narrow region") != std::string::npos);
    CHECK(run({"emit", narrow(), "--fmu", alembert::test::temporary_folder("narrow_unit") + ".fmu"})
              .err.find("changes fast in a narrow region") != std::string::npos);
    CHECK(run({"emit", mild(), "--standalone", "-o", alembert::test::temporary_folder("mild")})
              .err.find("changes fast") == std::string::npos);
}

// The work of V = k max(0, x − 1)ⁿ: the turning point, and the way back with the speed of before.
TEST_CASE("places: energies of powers of max and abs, and steep steps, have forces where the power is zero") {
    for (const std::string potential :
         {"0.3*max(0, x - 1)^2.5", "0.3*max(0, x - 1)^1.5", "0.3*max(0, x - 1)^(3/2)",
          "0.6/(1 + exp(-(x - 1)/1e-5))", "0.6/cosh((x - 1)/1e-4)^2", "0.6*(1 + tanh((x - 1)/1e-3))"}) {
        CAPTURE(potential);
        const Json result = simulated(mass(1, 20, fmt::format("[energy]\npotential = \"{}\"\n", potential)));
        CHECK(std::abs(rate(result) + 1) < 1e-7);
        CHECK(trusted(result));
    }
    const std::string hertz = mass(1, 2, "[energy]\npotential = \"w*max(0, x - 1)^2.5\"\n");
    CHECK(run({"derive", hertz}).out.find("sign") == std::string::npos);
    CHECK(run({"simulate", hertz, "--sensitivity", "w"}).exit == 0);
    CHECK(simulated(mass(-1, 1, "[forces]\nx = \"((abs(x) - x)/2)^1.5\"\n"))["exit"].is_null());
}

TEST_CASE("simulate: a bead turns where a bump of its track uses up its energy") {
    const std::string scene = temporary(
        "bump.toml",
        "gravity = [0, -9.81]\n[coordinates]\nx = { initial = 0, rate = 1 }\n[[particle]]\nname = \"bead\"\nmass "
        "= 1\n"
        "position = [\"x\", \"0.06*exp(-((x - 5)/0.1)^2) + 0.0005*x^2\"]\n[simulation]\nduration = 10\n");
    for (const char* const method : {"auto", "taylor", "dop853", "dopri5", "verner98", "radau", "bdf", "abm"}) {
        CAPTURE(method);
        CHECK(std::abs(place(simulated(scene, {"--method", method})) - 0.53397) < 1e-5);
    }
}

// At rest on a plain whose only hill is far away, or with a tanh that changes in time alone, steps stay long.
TEST_CASE("simulate: functions that change little cost no steps") {
    const Json still = simulated(mass(0, 10, "[energy]\npotential = \"exp(-((x - 3)/0.01)^2)\"\n"));
    CHECK(still["steps"].get<int>() == 1);
    const Json far = simulated(mass(-1, 10, "[energy]\npotential = \"exp(-((x - 3)/0.01)^2)\"\n"));
    CHECK(far["steps"].get<int>() == 1);
    CHECK(far["evaluations"].get<int>() < 100);
}

TEST_CASE("simulate: narrow regions that are passed more than once, of waves and of a ring") {
    // v² after passing pulses of the height F where cos(4 x) = 0.87: each adds 2 F w √π/|4 sin(4 x)| to it.
    constexpr double F = 30, w = 3e-4, c = 0.87;
    const double each = 2 * F * w * std::sqrt(std::acos(-1.0)) / (4 * std::sqrt(1 - c * c));
    const std::string waves =
        temporary("waves.toml",
                  "[coordinates]\nx = { initial = 0, rate = 1 }\n[energy]\nkinetic = \"x'^2/2\"\n[forces]\nx = "
                  "\"30*exp(-((cos(4*x)-0.87)/3e-4)^2)\"\n[simulation]\nduration = 1.5\n");
    for (const std::string method : {"auto", "dop853", "verner98"}) {
        CAPTURE(method);
        const Json motion = Json::parse(run({"simulate", waves, "--method", method, "--json"}).out);
        CHECK(number(motion["final"], "rates", "x") == doctest::Approx(std::sqrt(1 + 2 * each)).epsilon(1e-6));
    }
    // A central force does no work between points of the same potential outside of the ring.
    const std::string ring = temporary("ring.toml",
                                       "[coordinates]\nx = { initial = -2, rate = 1 }\ny = { initial = 0.3, rate "
                                       "= 0.1 }\n[energy]\nkinetic = \"(x'^2 + "
                                       "y'^2)/2\"\n[forces]\nx = \"20*x*exp(-((sqrt(x^2+y^2)-1)/0.001)^2)\"\ny = "
                                       "\"20*y*exp(-((sqrt(x^2+y^2)-1)/0.001)^2)\"\n[simulation]\nduration = 4\n");
    for (const std::string method : {"auto", "dop853", "verner98"}) {
        CAPTURE(method);
        const Json motion = Json::parse(run({"simulate", ring, "--method", method, "--json"}).out);
        const double u = number(motion["final"], "rates", "x"), v = number(motion["final"], "rates", "y");
        CHECK(u * u + v * v == doctest::Approx(1.01).epsilon(1e-8));
    }
}

}  // namespace commands_places
