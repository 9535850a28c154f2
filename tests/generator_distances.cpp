// SPDX-License-Identifier: MIT
// Places given in numbers: right-hand sides keep the digits of distances from them. The reference has parameters
// in the places of the numbers, the derivatives of its potential by hand, and long double arithmetic.
#include <doctest/doctest.h>

#include <fmt/format.h>

#include <cmath>
#include <random>

#include "algebra/notation/readable.hpp"
#include "algebra/notation/text.hpp"
#include "algebra/symbolic/fourier.hpp"
#include "analysis/derive/derived.hpp"
#include "program/interpret.hpp"
#include "program/lower/start.hpp"
#include "scenes.hpp"

namespace generator_distances {

using namespace alembert;

namespace {

/// Halves, quarters, …: exact in binary and in decimals.
double dyadic(std::mt19937& random, double size) {
    const double unit = std::exp2(std::floor(std::log2(size)) - 10);
    return unit * static_cast<double>(1 + random() % 1023);
}

std::vector<double> accelerations(const std::string& scene) {
    const Derived d = derived(parse_scene(scene, "distances.toml"), {.use = Use::run});
    const Program program = lowered(d).program;
    const State<double> state = start_of(d.mechanism).state();
    const std::vector<double> value = interpret(program, state);
    std::vector<double> result;
    for (const int node : program.nodes_of(Group::acceleration))
        result.push_back(value[static_cast<std::size_t>(node)]);
    return result;
}

std::string decimal(double value) {
    return fmt::format("{:.40g}", value);
}

}  // namespace

TEST_CASE("distances: springs, pulses, potentials and drags around places in numbers keep their digits") {
    std::mt19937 random(20);
    for (int k = 0; k < 120; ++k) {
        const double a = dyadic(random, std::pow(10.0, static_cast<int>(random() % 10) - 1)),
                     b = dyadic(random, std::pow(10.0, static_cast<int>(random() % 10) - 1)),
                     dx = a * std::exp2(-12.0 - static_cast<double>(random() % 16)),
                     dy = b * std::exp2(-12.0 - static_cast<double>(random() % 16)),
                     s = dyadic(random, std::abs(dx)), stiffness = dyadic(random, 100);
        const double x = a + dx, y = b + dy;
        const std::string head = fmt::format(
            "[coordinates]\nx = {}\ny = {}\n[[particle]]\nname = \"P\"\nmass = 2\nposition = [\"x\", \"y\"]\n",
            decimal(x), decimal(y));
        const long double X = x, Y = y, A = a, B = b, S = s, K = stiffness;
        const long double u = X - A, v = Y - B, r = std::sqrt(u * u + v * v);
        struct Kind {
            std::string text;
            long double fx, fy;
        };
        const std::vector<Kind> kinds{
            {fmt::format(
                 "[[point]]\nname = \"C\"\noffset = [{}, {}]\n[[spring]]\nbetween = [\"C\", \"P\"]\nstiffness = "
                 "{}\nlength = {}\n",
                 decimal(a), decimal(b), decimal(stiffness), decimal(s)),
             -K * (r - S) * u / r, -K * (r - S) * v / r},
            {fmt::format("[forces]\nx = \"{}*{}^2/((x-{})^2 + {}^2)\"\n", decimal(stiffness), decimal(s),
                         decimal(a), decimal(s)),
             K * S * S / (u * u + S * S), 0},
            {fmt::format("[forces]\nx = \"-{}*(x-{})\"\ny = \"-{}*(y-{})^3\"\n", decimal(stiffness), decimal(a),
                         decimal(stiffness), decimal(b)),
             -K * u, -K * v * v * v},
            {fmt::format("[forces]\nx = \"{}*(x-{})*(y-{})\"\ny = \"{}/(({}-x)^2 + (y-{})^2)\"\n",
                         decimal(stiffness), decimal(a), decimal(b), decimal(stiffness), decimal(a), decimal(b)),
             K * u * v, K / (r * r)},
        };
        const Kind& kind = kinds[static_cast<std::size_t>(k) % kinds.size()];
        CAPTURE(head + kind.text);
        const std::vector<double> is = accelerations(head + kind.text);
        REQUIRE(is.size() == 2);
        const long double size = std::max(std::abs(kind.fx), std::abs(kind.fy)) / 2;
        CHECK(std::abs(is[0] - kind.fx / 2) <= 1e-14L * size);
        CHECK(std::abs(is[1] - kind.fy / 2) <= 1e-14L * size);
    }
}

TEST_CASE("distances: what is printed keeps a coordinate and a number together") {
    const auto printed = [](const std::string& force) {
        const Derived d =
            derived(parse_scene("[parameters]\nk = 2\n[coordinates]\nx = 1\ny = 2\n[[particle]]\nname = \"P\"\n"
                                "mass = 1\nposition = [\"x\", \"y\"]\n[forces]\nx = \"" +
                                    force + "\"\n",
                                "distances.toml"));
        const auto f = fourier(d.mechanism.z->expand(d.equations.applied[0]), *d.mechanism.symbols);
        REQUIRE(f);
        return text(readable(*f));
    };
    CHECK(printed("k*(x-5)^2") == "k*(x-5)^2");
    CHECK(printed("k*sqrt((x-100000)^2 + (y-50000)^2)") == "k*sqrt((x-100000)^2+(y-50000)^2)");
    CHECK(printed("k*((x-5)^2 + 1)") == "k*(x-5)^2 + k");
}

}  // namespace generator_distances
