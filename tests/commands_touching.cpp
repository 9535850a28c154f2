// SPDX-License-Identifier: MIT
// Points that distances hold on a line: what follows from the others runs, what is held by second derivatives
// alone is refused with that reason. Held against the same mechanisms described by angles, and closed forms.
#include <doctest/doctest.h>

#include <fmt/format.h>
#include <cmath>
#include <nlohmann/json.hpp>
#include <tuple>

#include "json.hpp"
#include "program.hpp"
#include "scenes.hpp"

namespace commands_touching {

using alembert::test::Json;
using alembert::test::json_of;
using alembert::test::run;
using alembert::test::temporary;

namespace {

std::string distance(const std::string& p, const std::string& q, double length) {
    return fmt::format(
        "[[constraint]]\nname = \"{0}{1}\"\nholonomic = \"(x{0} - x{1})^2 + (y{0} - y{1})^2 = {2}^2\"\n", p, q,
        length);
}

std::string particle(const std::string& name, double mass) {
    return fmt::format("[[particle]]\nname = \"P{0}\"\nmass = {1}\nposition = [\"x{0}\", \"y{0}\"]\n", name, mass);
}

/// Cranks of length 1 on pivots at x = 0, 1, 2, whose tips a, b, c are held together by distances. All but the x
/// of a are guesses if these are off.
std::string cranks(double middle, bool third, double off = 0) {
    std::string scene = "gravity = [0, -9.81]\n[parameters]\nth = 0.5\n[coordinates]\n";
    const auto value = [&](const std::string& formula, double by) {
        return off == 0 ? fmt::format("\"{}\"", formula)
                        : fmt::format("{{ guess = \"{} + {}\", rate_guess = 0 }}", formula, by);
    };
    scene += fmt::format("xa = \"sin(th)\"\nya = {}\n", value("-cos(th)", off));
    for (const auto& [p, x, way] : {std::tuple("b", 1, -1.0), std::tuple("c", 2, 0.7)})
        scene += fmt::format("x{0} = {1}\ny{0} = {2}\n", p, value(fmt::format("{} + sin(th)", x), way * off),
                             value("-cos(th)", -0.5 * way * off));
    scene += "[simulation]\nduration = 10\ntolerance = 1e-11\n";
    scene += particle("a", 1) + particle("b", middle) + particle("c", 1);
    for (const auto& [p, x] : {std::pair("a", 0), std::pair("b", 1), std::pair("c", 2)})
        scene += fmt::format("[[constraint]]\nname = \"crank{0}\"\nholonomic = \"(x{0} - {1})^2 + y{0}^2 = 1\"\n",
                             p, x);
    scene += distance("a", "b", 1) + distance("b", "c", 1);
    return third ? scene + distance("a", "c", 2) : scene;
}

/// Points at 0, 1 and 3 of a rod that turns at 1 rad/s.
std::string rod(double middle, const std::string& last) {
    std::string scene =
        "gravity = [0, -9.81]\n[coordinates]\n"
        "xa = { initial = 0, rate = 0.3 }\nya = 0\n"
        "xb = { initial = 1, rate = 0.3 }\nyb = { initial = 0, rate = 1 }\n"
        "xc = { initial = 3, rate = 0.3 }\nyc = { initial = 0, rate = 3 }\n"
        "[simulation]\nduration = 5\ntolerance = 1e-11\n";
    scene += particle("a", 1) + particle("b", middle) + particle("c", 1);
    return scene + distance("a", "b", 1) + distance("b", "c", 2) + last;
}

const std::string line =
    "[[constraint]]\nname = \"line\"\nholonomic = \"(xb - xa)*(yc - ya) = (yb - ya)*(xc - xa)\"\n";

Json end_of(const std::string& scene) {
    return json_of({"simulate", temporary("points.toml", scene), "--no-estimate"})["final"];
}

}  // namespace

// All tips move as pendulums of length 1 do: the same angle, whatever the middle one weighs.
TEST_CASE("touching: three parallel cranks run, with a third distance that follows and a massless middle") {
    const Json pendulum = end_of(R"toml(
gravity = [0, -9.81]
[coordinates]
phi = 0.5
[[particle]]
name = "P"
mass = 1
position = ["sin(phi)", "-cos(phi)"]
[simulation]
duration = 10
tolerance = 1e-12
)toml");
    const double phi = pendulum["coordinates"]["phi"].get<double>();
    for (const double middle : {1.0, 0.0})
        for (const bool third : {false, true})
            for (const double off : {0.0, 0.1}) {  // of guesses, with which the tips are on no line
                INFO("middle " << middle << ", third distance " << third << ", guesses off by " << off);
                const Json end = end_of(cranks(middle, third, off))["coordinates"];
                for (const auto& [p, x] : {std::pair("a", 0), std::pair("b", 1), std::pair("c", 2)}) {
                    CHECK(std::abs(end[fmt::format("x{}", p)].get<double>() - x - std::sin(phi)) < 1e-8);
                    CHECK(std::abs(end[fmt::format("y{}", p)].get<double>() + std::cos(phi)) < 1e-8);
                }
            }
}

// |ac| = |ab| + |bc| keeps b on the line ac, but not by its row: at every pose the three rows have rank 2.
TEST_CASE("touching: a rod given by three distances is refused, and one given by its line is right") {
    for (const double middle : {1.0, 0.0}) {
        const auto refused = run({"simulate", temporary("rod.toml", rod(middle, distance("a", "c", 3)))});
        INFO(refused.err);
        CHECK(refused.exit == 3);
        CHECK(refused.err.find("constraints 'ab', 'bc', 'ac' only touch") != std::string::npos);

        // The mass centre falls on a parabola, and the rod turns evenly.
        const double centre = (middle + 3) / (2 + middle), t = 5;
        const Json end = end_of(rod(middle, line))["coordinates"];
        const double x = centre + 0.3 * t, y = centre * t - 9.81 / 2 * t * t;
        for (const auto& [p, at] : {std::pair("a", 0), std::pair("b", 1), std::pair("c", 3)}) {
            CHECK(std::abs(end[fmt::format("x{}", p)].get<double>() - x - (at - centre) * std::cos(t)) < 1e-7);
            CHECK(std::abs(end[fmt::format("y{}", p)].get<double>() - y - (at - centre) * std::sin(t)) < 1e-7);
        }
    }
}

// A parallelogram lies flat twice in a turn, and two branches meet there: the second derivatives have both signs.
TEST_CASE("touching: a linkage that lies flat at the start is not refused for that") {
    std::string scene =
        "[coordinates]\nxa = { initial = 1, rate = 0 }\nya = { initial = 0, rate = 1 }\n"
        "xb = { initial = 3, rate = 0 }\nyb = { initial = 0, rate = 1 }\n[simulation]\nduration = 1\n";
    scene += particle("a", 1) + particle("b", 1);
    scene += "[[constraint]]\nname = \"left\"\nholonomic = \"xa^2 + ya^2 = 1\"\n";
    scene += "[[constraint]]\nname = \"right\"\nholonomic = \"(xb - 2)^2 + yb^2 = 1\"\n";
    scene += distance("a", "b", 2);
    CHECK(run({"derive", temporary("flat.toml", scene)}).exit == 0);
}

}  // namespace commands_touching
