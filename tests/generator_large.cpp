// SPDX-License-Identifier: MIT
// Systems of 30 to 1000 particles and bodies run by every method that applies, along motions with a closed form.
#include <doctest/doctest.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>

#include "alembert/ode/method.hpp"
#include "sanitized.hpp"
#include "simulate/simulate.hpp"
#include "simulate/sweep.hpp"

namespace generator_large {

using namespace alembert;

namespace {

/// A scene and its motion.
struct Large {
    std::string name, text;
    std::function<double(std::size_t, double)> coordinate;  ///< by its place and the time
};

/// Particles on a line between two walls, with a spring of stiffness k = 1 between any two neighbours, in the mode
/// of vibration in which neighbours move against each other: x_i = sin(i n π/(n + 1)) cos(ω t), ω = 2 sin(n π/(2
/// (n + 1))).
Large particles_on_a_line(int n) {
    const double phase = n * M_PI / (n + 1), omega = 2 * std::sin(phase / 2);
    std::string text = "[coordinates]\n", parts;
    for (int i = 1; i <= n; ++i) {
        text += fmt::format("x{} = {}\n", i, std::sin(i * phase));
        parts += fmt::format("[[particle]]\nname = \"p{}\"\nmass = 1\nposition = [\"{} + x{}\", 0]\n", i, i, i);
        parts += fmt::format("[[spring]]\nalong = \"x{}{}\"\nstiffness = 1\n", i,
                             i > 1 ? fmt::format(" - x{}", i - 1) : "");
    }
    parts += fmt::format("[[spring]]\nalong = \"x{}\"\nstiffness = 1\n", n);
    return {fmt::format("line of {}", n), text + parts, [=](std::size_t i, double t) {
                return std::sin(static_cast<double>(i + 1) * phase) * std::cos(omega * t);
            }};
}

/// Bodies at the corners of a regular polygon, each drawn to both neighbours by a spring of stiffness 1 and length
/// l at the distance d = 1. They turn about the middle at R with ω² = 2 (d − l) sin(π/n)/R, and each spins by
/// itself.
Large ring_of_bodies(int n) {
    const double turn = M_PI / n, R = 0.5 / std::sin(turn), omega = std::sqrt(std::sin(turn) / R), spin = 3;
    std::string text = "[coordinates]\n", parts;
    for (int i = 0; i < n; ++i) {
        const double x = R * std::cos(2 * turn * i), y = R * std::sin(2 * turn * i);
        text += fmt::format(
            "x{0} = {{ initial = {1}, rate = {3} }}\ny{0} = {{ initial = {2}, rate = {4} }}\n"
            "a{0} = {{ initial = 0, rate = {5} }}\n",
            i, x, y, -omega * y, omega * x, spin);
        parts += fmt::format(
            "[[frame]]\nname = \"F{0}\"\nrotate = [[\"z\", \"a{0}\"]]\n[[body]]\nname = \"b{0}\"\nmass = 1\n"
            "frame = \"F{0}\"\ninertia = 0.2\nposition = [\"x{0}\", \"y{0}\"]\n"
            "[[spring]]\nbetween = [\"b{0}\", \"b{1}\"]\nstiffness = 1\nlength = 0.5\n",
            i, (i + 1) % n);
    }
    return {fmt::format("ring of {}", n), text + parts, [=](std::size_t k, double t) {
                const double angle = 2 * turn * static_cast<double>(k / 3) + omega * t;
                return k % 3 == 2 ? spin * t : R * (k % 3 == 0 ? std::cos(angle) : std::sin(angle));
            }};
}

/// Two steps or so, with a bound for methods of low order in a step of 0.01 s.
void follow(const Large& large, std::string_view method) {
    CAPTURE(large.name);
    CAPTURE(method);
    constexpr double end = 0.02;
    RunOptions wishes{.method = std::string(method), .duration = end, .estimate = false};
    const std::optional<Method> known = method_named(method);
    if (known && has_fixed_step(*known)) wishes.step = end / 2;
    const Run run = simulate(parse_scene(large.text, "large.toml"), wishes);
    CHECK_FALSE(run.failure);
    const double allowed = method == "euler"                                             ? 1e-3
                           : method == "rk2" || method == "verlet" || method == "rattle" ? 1e-6
                                                                                         : 1e-8;
    double worst = 0;
    for (std::size_t k = 0; k < run.final_coordinates.size(); ++k)
        worst = std::max(worst, std::abs(run.final_coordinates[k] - large.coordinate(k, end)));
    CHECK(worst < allowed);
}

}  // namespace

TEST_CASE("large: 30 and 100 particles on a line and bodies in a ring move as closed forms say, by every method") {
    for (const int n : {30, test::is_sanitized ? 40 : 100})
        for (const Large& one : {particles_on_a_line(n), ring_of_bodies(n)}) {
            // In coordinates with momenta a step solves for 600 unknowns by elimination, many times.
            const bool is_dear = n > 30 && one.name.starts_with("ring");
            for (const Method method : all_methods())
                if (!is_dear || !needs_canonical(method)) follow(one, name(method));
        }
}

TEST_CASE("large: 300 and 1000 particles on a line and bodies in a ring move as closed forms say") {
    const int many = test::is_sanitized ? 100 : 300, most = test::is_sanitized ? 150 : 1000;
    for (const char* const method : {"auto", "verlet", "kahanli8", "taylor", "bdf"})
        follow(particles_on_a_line(many), method);
    follow(ring_of_bodies(many), "auto");
    for (const Large& one : {particles_on_a_line(most), ring_of_bodies(most)}) follow(one, "auto");
}

TEST_CASE("large: members of a sweep of 100 bodies in a ring move as closed forms say") {
    const Large one = ring_of_bodies(100);
    constexpr double end = 0.02;
    const Sweep swept = sweep(parse_scene(one.text, "large.toml"), {{{"a0", 0, 1, 2}}}, {.duration = end});
    REQUIRE(swept.members.size() == 2);
    for (std::size_t member = 0; member < 2; ++member) {
        const std::vector<double> values = end_values(swept.members[member]);
        REQUIRE(values.size() > 300);
        for (std::size_t k = 0; k < 300; ++k) {
            const double start = k == 2 ? static_cast<double>(member) : 0;  // of a0
            CHECK(std::abs(values[1 + k] - start - one.coordinate(k, end)) < 1e-8);
        }
    }
}

}  // namespace generator_large
