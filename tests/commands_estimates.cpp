// SPDX-License-Identifier: GPL-2.0-or-later
// The error that `simulate` tells contains the rounding of the run. The motions here have closed forms, which are
// evaluated in long double: a mass that passes steep places whose width is of the order of many roundings of where
// they are, and Kepler's orbits.
#include <doctest/doctest.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

#include "json.hpp"
#include "program.hpp"

namespace commands_estimates {

using alembert::test::Json;
using alembert::test::simulated;
using alembert::test::temporary;

namespace {

using Real = long double;

/// Random numbers of a fixed seed.
struct Random {
    std::mt19937_64 engine;
    double operator()(double low, double high) {
        return low + (high - low) * static_cast<double>(engine() >> 11) * 0x1p-53;
    }
    double power(double low, double high) { return std::pow(10.0, (*this)(low, high)); }
    template <typename T>
    const T& of(const std::vector<T>& list) {
        return list[engine() % list.size()];
    }
};

/// A number as the scene reads it: the shortest decimals of the double.
std::string text(double value) {
    return fmt::format("({})", value);
}

/// A scene with its state at the end.
struct Motion {
    std::string scene;
    std::vector<Real> coordinates, rates;
};

/// One mass with the coordinate x.
std::string one_mass(double x, double v, double duration, const std::string& more) {
    return fmt::format(
        "[coordinates]\nx = {{ initial = {}, rate = {} }}\n[[particle]]\nname = \"P\"\nmass = 1\n"
        "position = [\"x\", 0]\n{}[simulation]\nduration = {}\n",
        x, v, more, duration);
}

/// True and told errors of a family of motions.
struct Family {
    std::vector<double> truth, told;

    void add(const Motion& motion, const std::vector<std::string>& options = {}) {
        const Json result = simulated(temporary("estimates.toml", motion.scene), options);
        CAPTURE(motion.scene);
        REQUIRE(result["error_estimate"].contains("value"));
        double off = 0;
        const auto compare = [&](const char* group, const std::vector<Real>& right) {
            std::size_t i = 0;
            for (const auto& [name, value] : result["final"][group].items()) {
                const Real y = value.get<double>(), exact = right[i++];
                off = std::max(off, static_cast<double>(std::abs(y - exact) / std::max<Real>(1, std::abs(exact))));
            }
        };
        compare("coordinates", motion.coordinates);
        compare("rates", motion.rates);
        truth.push_back(off);
        told.push_back(result["error_estimate"]["value"].get<double>());
        CAPTURE(truth.back());
        CAPTURE(told.back());
        CHECK(truth.back() <= 3 * told.back());
    }

    /// At most one in twenty is told too small by a factor below 3, and what is told is no excess: within a factor
    /// of 300 of the truth, or of a few roundings, in the middle of the family, and of 1e4 in all but a twentieth.
    void check() const {
        std::vector<double> excess;
        std::size_t low = 0;
        for (std::size_t k = 0; k < told.size(); ++k) {
            low += truth[k] > told[k] ? 1 : 0;
            excess.push_back(told[k] / std::max(truth[k], 1e-15));
        }
        std::sort(excess.begin(), excess.end());
        CHECK(20 * low <= told.size());
        CHECK(excess[excess.size() / 2] < 300);
        CHECK(excess[excess.size() * 19 / 20] < 1e4);
    }
};

}  // namespace

// x'' = A from t₀ to t₁ and 0 elsewhere.
TEST_CASE("estimates: a strong force that is switched on and off in time") {
    Random random{std::mt19937_64(1)};
    Family family;
    for (int k = 0; k < 60; ++k) {
        const double from = random(1, 9), to = from + random.power(-9, -2), x = random(-1, 1), v = random(-1, 1);
        const Real width = Real(to) - Real(from);
        const double A = static_cast<double>(random(0.2, 5) / width);
        const Real later = v + A * width;
        family.add({one_mass(x, v, 10,
                             fmt::format("[forces]\nx = \"{}*(sign(t - {}) - sign(t - {}))/2\"\n", text(A),
                                         text(from), text(to))),
                    {x + v * Real(to) + A * width * width / 2 + later * (10 - Real(to))},
                    {later}});
    }
    family.check();
}

// x'' = A between two places; v² grows by 2 A w there.
TEST_CASE("estimates: a strong force between two places") {
    Random random{std::mt19937_64(2)};
    Family family;
    for (int k = 0; k < 60; ++k) {
        const double from = random(1, 9), to = from + random.power(-9, -2), v = random(0.5, 3),
                     duration = random(1.2, 3) * from / v;
        const Real width = Real(to) - Real(from);
        const double A = static_cast<double>(random(0.2, 2) / width);
        const Real later = std::sqrt(Real(v) * v + 2 * A * width), gone = Real(from) / v + 2 * width / (v + later);
        family.add({one_mass(0, v, duration,
                             fmt::format("[forces]\nx = \"{}*(sign(x - {}) - sign(x - {}))/2\"\n", text(A),
                                         text(from), text(to))),
                    {to + later * (duration - gone)},
                    {later}});
    }
    family.check();
}

// Two events give the momenta J and −J; between them is the width w.
TEST_CASE("estimates: two strong impulses one soon after the other") {
    Random random{std::mt19937_64(3)};
    Family family;
    for (int k = 0; k < 60; ++k) {
        const double from = random(1, 9), to = from + random.power(-6, -1), v = random(0.5, 3),
                     J = random.power(0, 4), duration = random(1.2, 3) * from / v;
        const Real width = Real(to) - Real(from);
        family.add(
            {one_mass(0, v, duration,
                      fmt::format("[[event]]\nname = \"on\"\nwhen = \"x - {}\"\nimpulses = {{ x = {} }}\n"
                                  "[[event]]\nname = \"off\"\nwhen = \"x - {}\"\nimpulses = {{ x = -{} }}\n",
                                  text(from), J, text(to), J)),
             {to + v * (duration - Real(from) / v - width / (Real(v) + J))},
             {v}});
    }
    family.check();
}

// x'' = A w²/((t − t₀)² + w²).
TEST_CASE("estimates: narrow pulses in time") {
    Random random{std::mt19937_64(4)};
    Family family;
    for (int k = 0; k < 60; ++k) {
        const double at = random(1, 9), w = random.power(-8, -2), A = static_cast<double>(random(0.1, 3) / w),
                     x = random(-2, 2), v = random(-1, 1);
        const auto speed = [&](Real t) { return A * Real(w) * std::atan((t - at) / w); };
        const auto way = [&](Real t) {
            const Real u = (t - at) / w;
            return A * Real(w) * w * (u * std::atan(u) - std::log1p(u * u) / 2);
        };
        family.add({one_mass(x, v, 10,
                             fmt::format("[forces]\nx = \"{}*{}^2/((t - {})^2 + {}^2)\"\n", text(A), text(w),
                                         text(at), text(w))),
                    {x + v * Real(10) + way(10) - way(0) - 10 * speed(0)},
                    {v + speed(10) - speed(0)}},
                   {"--method", random.of<std::string>({"auto", "dop853", "verner98"})});
    }
    family.check();
}

// In V = U (1 − tanh²((x − a)/w)) a mass of the energy E > U moves as sinh((x − a)/w) = √(1 − U/E) sinh(√(2E)
// t/w).
TEST_CASE("estimates: narrow hills and dips") {
    Random random{std::mt19937_64(5)};
    Family family;
    for (int k = 0; k < 40; ++k) {
        const double a = random(1, 9), w = random.power(-4, -2), U = random(-2, 0.9), v = random(1.4, 3),
                     duration = random(1.2, 1.6) * a / v;
        const auto rise = [&](Real y) { return std::abs(y) > 1000 ? 0 : U / (std::cosh(y) * std::cosh(y)); };
        const Real E = Real(v) * v / 2 + rise(-a / Real(w)), far = std::sqrt(2 * E), turn = std::sqrt(1 - U / E),
                   begin = -a / Real(w) + std::log(turn);  // far away sinh is exp
        const Real end = begin + far * duration / w,
                   y = end > 100 ? end + std::log(turn) : std::asinh(turn * std::sinh(end));
        const std::string hill = fmt::format("tanh((x - {})/{})", text(a), text(w));
        family.add({one_mass(0, v, duration,
                             fmt::format("[forces]\nx = \"2*{0}/{1}*{2}*(1 - {2}^2)\"\n", text(U), text(w), hill)),
                    {a + w * y},
                    {std::sqrt(2 * (E - rise(y)))}},
                   {"--method", random.of<std::string>({"dopri5", "dop853", "verner98"}), "--tolerance", "1e-12",
                    "--max-step", fmt::format("{}", w / v)});
    }
    family.check();
}

// Kepler's equation M = E − e sin E, from the far end.
TEST_CASE("estimates: regularized orbits") {
    Random random{std::mt19937_64(6)};
    Family family;
    for (int k = 0; k < 40; ++k) {
        const double e0 = 1 - random.power(-4, -1), r = 1 + e0, duration = random(3, 60),
                     v = std::sqrt((1 - e0) / (1 + e0));
        const Real a = 1 / (2 / Real(r) - Real(v) * v), n = 1 / (a * std::sqrt(a)), h = Real(r) * v,
                   e = std::sqrt(1 - h * h / a), pi = std::acos(Real(-1)), M = n * duration + pi,
                   turns = std::floor(M / (2 * pi));
        Real low = 2 * pi * turns, high = low + 2 * pi;
        for (int i = 0; i < 70; ++i) {
            const Real middle = (low + high) / 2;
            (middle - e * std::sin(middle) < M ? low : high) = middle;
        }
        const Real E = (low + high) / 2, b = a * std::sqrt(1 - e * e), rate = n / (1 - e * std::cos(E));
        const std::string method = random.of<std::string>({"kahanli8", "kahanli8", "gauss", "verner98", "dop853"});
        const bool fixed = method == "kahanli8" || method == "gauss";
        std::vector<std::string> options{"--regularize", "--method", method};
        options.push_back(fixed ? "--step" : "--tolerance");
        options.push_back(fixed ? fmt::format("{}", random.of<double>({0.02, 0.05})) : "1e-13");
        family.add({fmt::format("[coordinates]\nx = {}\ny = {{ initial = 0, rate = {} }}\n[[particle]]\n"
                                "name = \"P\"\nmass = 1\nposition = [\"x\", \"y\"]\n[energy]\n"
                                "potential = \"-1/norm(pos(P))\"\n[simulation]\nduration = {}\n",
                                r, v, duration),
                    {-a * (std::cos(E) - e), -b * std::sin(E)},
                    {a * std::sin(E) * rate, -b * std::cos(E) * rate}},
                   options);
    }
    family.check();
}

// A ball from the height h strikes the ground at √(2h/g), where the run ends; a mass reaches an event with an
// impulse at the end. Both sides of a jump are the same instant.
TEST_CASE("estimates: a run may end at the very instant of an impact or impulse") {
    Random random{std::mt19937_64(7)};
    for (int k = 0; k < 24; ++k) {
        const double h = random(0.2, 30), v = random(0.3, 5), a = random(0.5, 4);
        const auto fall = static_cast<double>(std::sqrt(2 * Real(h) / 9.81L)),
                   way = static_cast<double>(Real(a) / v);
        const std::string ball = fmt::format(
            "gravity = [0, -9.81]\n[coordinates]\nx = {{ initial = 0, rate = 1 }}\ny = {}\n[[particle]]\nname = "
            "\"P\"\nmass = 1\nposition = [\"x\", \"y\"]\n[[unilateral]]\nname = \"floor\"\ngap = \"y\"\n"
            "restitution = {}\n[simulation]\nduration = {}\n",
            h, k % 3 == 0 ? 0.0 : 0.7, fall);
        const std::string kicked = one_mass(
            0, v, way, fmt::format("[[event]]\nname = \"e\"\nwhen = \"x - {}\"\nimpulses = {{ x = 3 }}\n", a));
        for (const bool is_ball : {true, false})
            for (const std::string method : {"auto", "dop853", "radau", "rk4"}) {
                std::vector<std::string> options{"--method", method};
                if (method == "rk4") options.insert(options.end(), {"--step", "0.01"});
                const Json result = simulated(temporary("instant.toml", is_ball ? ball : kicked), options);
                CAPTURE(is_ball ? ball : kicked);
                CAPTURE(method);
                const Json& estimate = result["error_estimate"];
                CHECK(estimate["trustworthy"] == true);
                CHECK(estimate["value"].get<double>() < 1e-7);
                const double place = result["final"]["coordinates"][is_ball ? "y" : "x"];
                CHECK(std::abs(place - (is_ball ? 0 : a)) <= estimate["value"].get<double>() * std::max(1.0, a));
            }
    }
}

// With a coarse tolerance it is not known whether the impact has come: that is no instant.
TEST_CASE("estimates: an impact near the end whose time is not known leaves the end unknown") {
    const std::string scene = temporary(
        "near.toml",
        "[parameters]\nw = 40\n[coordinates]\nx = { initial = 1, rate = 0 }\n[[particle]]\nname = \"P\"\nmass = "
        "1\n"
        "position = [\"x\", 0]\n[forces]\nx = \"-w^2*x\"\n[[unilateral]]\nname = \"wall\"\ngap = \"x + 0.5\"\n"
        "restitution = 0.9\n[simulation]\nduration = 0.0523\n");
    const Json result = simulated(scene, {"--method", "euler", "--step", "0.001"});
    CHECK(result["error_estimate"]["trustworthy"] == false);
}

// A mass at rest where nothing acts on it stays there exactly, although the place is unstable.
TEST_CASE("estimates: what rests exactly has no error") {
    const Json result = simulated(temporary("rest.toml", one_mass(0.3, 0, 50, "[forces]\nx = \"x - 0.3\"\n")),
                                  {"--method", "dop853"});
    CHECK(result["final"]["coordinates"]["x"] == 0.3);
    CHECK(result["error_estimate"]["value"].get<double>() < 1e-14);
}

}  // namespace commands_estimates
