// SPDX-License-Identifier: MIT
// Events with impulses in units whose importer takes large steps: motions in closed form, and the same motion with
// small steps.
#include <doctest/doctest.h>

#include "fmu_exports.hpp"

namespace fmu_events {

using namespace alembert::test;

namespace {

std::string ball(double restitution, double height) {
    return temporary("ball.toml", fmt::format(R"toml(title = "A ball that bounces, by an event"
[parameters]
m = 1.0
g = 9.81
e = {}
[coordinates]
h = {{ initial = {}, rate = 0, unit = "m" }}
[[particle]]
name = "b"
mass = "m"
position = [0, "h"]
[[force]]
at = "b"
vector = [0, "-m*g"]
[[event]]
name = "floor"
when = "h"
direction = "down"
impulses = {{ h = "-m*(1+e)*h'" }}
)toml",
                                              restitution, height));
}

/// Parabolas between the bounces.
double height_at(double restitution, double height, double end) {
    double t = std::sqrt(2 * height / 9.81), v = 9.81 * t;
    if (end < t) return height - 9.81 / 2 * end * end;
    for (v *= restitution; t + 2 * v / 9.81 < end; v *= restitution) t += 2 * v / 9.81;
    return v * (end - t) - 9.81 / 2 * (end - t) * (end - t);
}

}  // namespace

TEST_CASE("fmu: a ball bounces as in closed form, whatever steps the importer takes") {
    CHECK(height_at(0.7, 1, 2) == doctest::Approx(0.0424335478026).epsilon(1e-10));
    for (const auto& [restitution, height, end] :
         {std::array{0.7, 1.0, 2.0}, {0.95, 0.3, 5.0}, {1.0, 2.0, 20.0}, {0.5, 1.0, 1.3}})
        for (const int version : {2, 3}) {
            CAPTURE(restitution);
            const Unit unit = exported(ball(restitution, height), version);
            for (const double step : {end, end / 4, end / 40, 0.01}) {
                CAPTURE(step);
                Instance one(unit, true, 1e-9);
                one.begin();
                bool goes_on = true;
                const int count = static_cast<int>(std::lround(end / step));
                for (int k = 0; k < count && goes_on; ++k) goes_on = one.step(k * step, step);
                CHECK(goes_on);
                CHECK(one.get("h") == doctest::Approx(height_at(restitution, height, end)).epsilon(1e-8));
            }
        }
}

// The particle passes zeros of cos(4x) at x = (2k + 1) π/8, on its way at 1 m/s, and is slowed down by a tenth at
// each where the cosine falls.
TEST_CASE("fmu: kicks at zeros of a periodic function are all found in one large step") {
    const std::string scene = temporary("marks.toml", R"toml([coordinates]
x = { initial = 0, rate = 1, unit = "m" }
[[particle]]
name = "P"
mass = 1
position = ["x", 0]
[[event]]
name = "mark"
when = "cos(4*x)"
direction = "down"
impulses = { x = "-0.1*x'" }
)toml");
    const double pi = 3.14159265358979323846;
    double t = pi / 8, v = 0.9, x = pi / 8;
    for (; t + pi / 2 / v < 10; v *= 0.9) t += pi / 2 / v, x += pi / 2;
    x += v * (10 - t);
    const Unit unit = exported(scene, 2);
    for (const double step : {10.0, 2.5, 0.1}) {
        CAPTURE(step);
        Instance one(unit, true, 1e-9);
        one.begin();
        for (int k = 0; k * step < 10 - 1e-9; ++k) CHECK(one.step(k * step, step));
        CHECK(one.get("x") == doctest::Approx(x).epsilon(1e-10));
    }
}

}  // namespace fmu_events
