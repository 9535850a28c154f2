// SPDX-License-Identifier: GPL-2.0-or-later
// Events, gaps, forces and power series that have a value, a derivative or a finite size in a part of the motion
// only, and contacts that a force leaves smoothly. All results are closed forms, but two of SciPy's at 1e-12.
#include <doctest/doctest.h>
#include <fmt/format.h>

#include <cmath>
#include <random>
#include <string>

#include "json.hpp"
#include "program.hpp"

namespace commands_partly {

using alembert::test::Json;
using alembert::test::simulated;
using alembert::test::temporary;

namespace {

std::string mass(double x, double v, double duration, const std::string& more) {
    return temporary("partly.toml",
                     fmt::format("{}[coordinates]\nx = {{ initial = {}, rate = {} }}\n[[particle]]\nname = \"P\"\n"
                                 "mass = 1\nposition = [\"x\", 0]\n[simulation]\nduration = {}\n",
                                 more, x, v, duration));
}

std::string forced(double x, double v, double duration, const std::string& force) {
    return mass(x, v, duration, fmt::format("[forces]\nx = \"{}\"\n", force));
}

double place(const Json& result, const std::string& name = "x") {
    return result["final"]["coordinates"][name].get<double>();
}
double rate(const Json& result, const std::string& name = "x") {
    return result["final"]["rates"][name].get<double>();
}
double end(const Json& result) {
    return result["final"]["time"].get<double>();
}

}  // namespace

TEST_CASE("events: one that has a value in a part of the motion only, or overflows elsewhere, is found") {
    const auto stopped = [](const std::string& when) {
        return end(simulated(mass(0, 1, 10, "[[event]]\nname = \"e\"\nwhen = \"" + when + "\"\nstop = true\n")));
    };
    CHECK(std::abs(stopped("sqrt(25 - x^2) - 3") - 4) < 1e-12);
    CHECK(std::abs(stopped("acos(x/5) - 0.1") - 5 * std::cos(0.1)) < 1e-12);
    CHECK(std::abs(stopped("log(5 - x) + 3") - (5 - std::exp(-3.0))) < 1e-12);
    CHECK(std::abs(stopped("1/cosh(1000*(x - 5)) - 0.5") - (5 - std::acosh(2.0) / 1000)) < 1e-12);
    CHECK(std::abs(stopped("sqrt(0.01^2 - (x - 5.037)^2) - 0.006") - 5.029) < 1e-9);
    std::mt19937_64 engine(67);
    for (int k = 0; k < 60; ++k) {  // islands
        const auto random = [&] { return static_cast<double>(engine() >> 11) * 0x1p-53; };
        const double r = std::pow(10, -3 * random()), a = 1 + r + 8 * random(), level = (0.1 + 0.8 * random()) * r;
        CAPTURE(r);
        CAPTURE(a);
        CHECK(std::abs(stopped(fmt::format("sqrt({0}^2 - (x - {1})^2) - {2}", r, a, level)) -
                       (a - std::sqrt(r * r - level * level))) < 1e-8);
    }
}

TEST_CASE("contacts: a round obstacle whose gap is a root is struck") {
    const double r = 0.01, a = 5.037;
    const Json result = simulated(
        temporary("pebble.toml",
                  "[coordinates]\nx = { initial = 0, rate = 1 }\ny = { initial = 0.005, rate = 0 "
                  "}\n[[particle]]\nname = \"P\"\n"
                  "mass = 1\nposition = [\"x\", \"y\"]\n[[unilateral]]\nname = \"pebble\"\n"
                  "gap = \"y - sqrt(0.01^2 - (x - 5.037)^2)\"\nrestitution = 1\n[simulation]\nduration = 10\n"));
    // It comes in along x at the height r/2 and is mirrored at the normal (-√3, 1)/2: the rate becomes (-1, √3)/2.
    const double strike = a - r * std::sqrt(3.0) / 2;
    CHECK(std::abs(rate(result) + 0.5) < 1e-7);
    CHECK(std::abs(rate(result, "y") - std::sqrt(0.75)) < 1e-7);
    CHECK(std::abs(place(result) - (strike - (10 - strike) / 2)) < 1e-6);
}

TEST_CASE("simulate: roots and powers of abs and max end no run at a finite force") {
    // v²/2 = (2/5) k δ^(5/2); the time of contact is 2 δ ∫ (1 − s^(5/2))^(−1/2) ds / v (Hertz 1881).
    const double depth = std::pow(5.0 / 400, 0.4),
                 both = 2 * std::sqrt(std::acos(-1.0)) * std::tgamma(1.4) / std::tgamma(0.9);
    for (const char* const method : {"auto", "dop853", "radau"}) {
        CAPTURE(method);
        const Json ball = simulated(forced(0, 1, 5, "-100*max(0, x - 1)^1.5"), {"--method", method});
        CHECK(std::abs(rate(ball) + 1) < 1e-7);
        CHECK(std::abs(place(ball) - (1 - (4 - both * depth))) < 1e-6);
    }
    // Energy: in V = |x|^p/p a mass comes back to its start with the opposite rate, and goes on.
    for (const std::string force : {"-sqrt(abs(x))*sign(x)", "-abs(x)^1.5*sign(x)", "-abs(x)^0.3*sign(x)"}) {
        CAPTURE(force);
        const double p = force[1] == 's' ? 1.5 : force[8] == '1' ? 2.5 : 1.3;
        const Json result = simulated(forced(0, 1, 7, force));
        CHECK(std::abs(rate(result) * rate(result) / 2 + std::pow(std::abs(place(result)), p) / p - 0.5) < 1e-6);
    }
    // v' = −v^1.8: v^(−0.8) = 1 + 0.8 t.
    const Json slowed = simulated(forced(0, 1, 5, "-sign(x')*abs(x')^1.8"));
    CHECK(std::abs(rate(slowed) - std::pow(5.0, -1.25)) < 1e-8);
    const Json swing = simulated(forced(1, 0, 5, "-x - 0.3*sign(x')*abs(x')^1.8"));
    CHECK(swing["completed"] == true);
}

TEST_CASE("simulate: where there is no power series, or its coefficients overflow, the run goes on") {
    const double pi = std::acos(-1.0), w = 0.001;
    CHECK(std::abs(place(simulated(forced(0, 1, 1, "sqrt(t)"))) - (1 + 4.0 / 15)) < 1e-8);
    const auto of_time = [&](const std::string& F) {
        return simulated(mass(0, 0, 10, "[inputs]\nF = \"" + F + "\"\n[forces]\nx = \"F\"\n"));
    };
    const Json step = of_time("1/(1 + exp(-(t - 5)/0.001))");
    CHECK(std::abs(rate(step) - 5) < 1e-7);
    CHECK(std::abs(place(step) - (12.5 + w * w * pi * pi / 6)) < 1e-7);
    const Json pulse = of_time("1/cosh((t - 5)/0.001)/0.001");
    CHECK(std::abs(rate(pulse) - pi) < 1e-7);
    CHECK(std::abs(place(pulse) - 5 * pi) < 1e-7);
    // It comes back from a logistic step of the place with the rate that it had.
    for (const char* const method : {"auto", "dop853", "radau", "bdf"}) {
        CAPTURE(method);
        const Json back = simulated(forced(0, 1, 10, "-1/(1 + exp(-(x - 5)/0.001))"), {"--method", method});
        CHECK(std::abs(rate(back) + 1) < 1e-6);
    }
}

TEST_CASE("contacts: one that a smooth force leaves opens, whatever rounding says") {
    const std::string stop = "[forces]\nx = \"-cos(t) - 0.2\"\n[[unilateral]]\nname = \"stop\"\ngap = \"x\"\n";
    // x'' = −cos t − 0.2 from the instant t₀ at which this is 0.
    const double t0 = std::acos(-0.2), s = 3 - t0;
    const Json left = simulated(mass(0, 0, 3, stop));
    CHECK(std::abs(place(left) - (std::cos(3) - std::cos(t0) + std::sin(t0) * s - 0.1 * s * s)) < 1e-8);
    const Json held = simulated(
        mass(0, 0, 3, stop + "[[friction]]\nname = \"seal\"\ncoefficient = 0.5\nslip = \"x'\"\nnormal = 1\n"));
    CHECK(std::abs(place(held) - 0.02730662) < 1e-7);
    for (int k = 0; k < 40; ++k) {
        const double b = -0.9 + 1.8 * k / 40, w = 0.5 + 0.1 * (k % 7), from = std::acos(b) / w,
                     duration = from + 0.5, u = 0.5;
        const Json one =
            simulated(mass(0, 0, duration,
                           fmt::format("[forces]\nx = \"{} - cos({}*t)\"\n[[unilateral]]\nname = \"stop\"\n"
                                       "gap = \"x\"\n",
                                       b, w)));
        CAPTURE(b);
        CAPTURE(w);
        const double exact =
            b * u * u / 2 + (std::cos(w * duration) - std::cos(w * from)) / (w * w) + std::sin(w * from) / w * u;
        CHECK(std::abs(place(one) - exact) < 1e-8);
    }
}

// A mass slides from rest off a sphere of radius 2 from the angle α and leaves it where cos θ = (2/3) cos α; after
// that it falls freely, and its energy stays.
TEST_CASE("contacts: a mass leaves a sphere where its weight no longer holds it") {
    for (const double alpha : {0.1, 0.3, 0.5, 0.7, 0.9, 1.1}) {
        CAPTURE(alpha);
        const Json result = simulated(temporary(
            "sphere.toml",
            fmt::format("gravity = [0, -9.81]\n[coordinates]\nr = {{ initial = 2 }}\nth = {{ initial = {} }}\n"
                        "[[particle]]\nname = \"p\"\nmass = 1\nposition = [\"r*sin(th)\", \"r*cos(th)\"]\n"
                        "[[unilateral]]\nname = \"sphere\"\ngap = \"r - 2\"\n[simulation]\nduration = 1.6\n",
                        alpha)));
        const double r = place(result, "r"), th = place(result, "th"), c = 2 * std::cos(alpha) / 3,
                     v = std::sqrt(9.81 * 2 * c), rise = rate(result, "r"), turn = rate(result, "th");
        const double across = rise * std::sin(th) + r * turn * std::cos(th);
        CHECK(r > 2);
        CHECK(std::abs(across - v * c) < 1e-6);  // the horizontal rate with which it left
        CHECK(std::abs((rise * rise + r * r * turn * turn) / 2 + 9.81 * (r * std::cos(th) - 2 * std::cos(alpha))) <
              1e-6);
    }
}

// Kepler's orbit with the semi-major axis 1: after whole periods it is where it was.
TEST_CASE("simulate: the size of a motion does not depend on whether rows are in step with it") {
    for (const int periods : {50, 99, 100, 101, 200}) {
        CAPTURE(periods);
        const Json result = simulated(temporary(
            "orbit.toml",
            fmt::format(
                "[coordinates]\nx = {{ initial = 0.5, rate = 0 }}\ny = {{ initial = 0, rate = \"sqrt(3)\" }}\n"
                "[energy]\nkinetic = \"(x'^2 + y'^2)/2\"\npotential = \"-1/sqrt(x^2 + y^2)\"\n"
                "[simulation]\nduration = \"{}*pi\"\n",
                2 * periods)));
        CHECK(result["error_estimate"]["trustworthy"] == true);
        CHECK(result["error_estimate"]["scaled"].get<double>() < 1e-4);
        CHECK(std::abs(place(result) - 0.5) < 1e-4);
    }
}

}  // namespace commands_partly
