// SPDX-License-Identifier: MIT
// Events with impulses in units whose importer takes large steps: motions in closed form, and the same motion with
// small steps.
#include <doctest/doctest.h>

#include <cstdarg>

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
// A mass at rest that a pulse starts: v = ∫ F dt.
TEST_CASE(
    "fmu: a unit passes over no pulse in time, also where a parameter moves it or it comes after the duration") {
    const double root = std::sqrt(std::acos(-1.0));
    const auto scene = [](const std::string& force) {
        return temporary(
            "pulse.toml",
            "[parameters]\na = 5.2345\nb = 1\n[inputs]\nF = \"" + force +
                "\"\n[coordinates]\nx = 0\n[[particle]]\nname = \"P\"\nmass = \"b\"\nposition = [\"x\", "
                "0]\n[forces]\nx = \"F\"\n[simulation]\nduration = 10\n");
    };
    for (const int version : {2, 3}) {
        const Unit gauss = exported(scene("exp(-((t - a)/0.001)^2)/0.001"), version);
        for (const auto& [name, value, speed] : {std::tuple("a", 5.2345, root), std::tuple("a", 7.1234, root),
                                                 std::tuple("b", 2.0, root / 2), std::tuple("a", 14.25, root)}) {
            CAPTURE(value);
            Instance one(gauss, true, 1e-9);
            one.set(name, value);
            one.begin();
            for (int k = 0; k < 4; ++k) REQUIRE(one.step(5. * k, 5));
            CHECK(std::abs(one.get("der(x)") - speed) < 1e-6);
        }
        // A train of one pulse a second, each of 0.001 s: ∫ exp(−(π t)²·10⁶) 10³ dt = 1/√π.
        const Unit train = exported(scene("1000*exp(-500000*(1 - cos(2*pi*(t - 0.31))))"), version);
        Instance one(train, true, 1e-9);
        one.begin();
        REQUIRE(one.step(0, 10));
        CHECK(std::abs(one.get("der(x)") - 10 / root) < 1e-5);
        // An importer is told when one begins.
        Instance exchanged(train, false);
        exchanged.begin();
        exchanged.update();
        CHECK(exchanged.next_event() < 0.31);
        CHECK(exchanged.next_event() > 0.29);
    }
}

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

namespace {

std::vector<std::string> logged;

extern "C" void log_of_2(void*, const char*, int, const char* category, const char* format, ...) {
    va_list values;
    va_start(values, format);
    logged.push_back(std::string(category) + ": " + va_arg(values, const char*));
    va_end(values);
}

}  // namespace

// √(1 − x) + 1 has no zero, and no value beyond x = 1, where the particle is after 1 s.
TEST_CASE("fmu: where the function of an event ceases to be a number, a unit says so, once") {
    const Unit unit = exported(temporary("ends.toml", R"toml([coordinates]
x = { initial = 0, rate = 1 }
[[particle]]
name = "P"
mass = 1
position = ["x", 0]
[[event]]
name = "root"
when = "sqrt(1 - x) + 1"
stop = true
)toml"),
                               2);
    const void* callbacks[5] = {reinterpret_cast<const void*>(log_of_2)};
    const char *name = "one", *nowhere = nullptr;
    void* const one = unit.call<void*>("fmi2Instantiate", name, 1, unit.token.c_str(), nowhere,
                                       static_cast<const void*>(callbacks), 0, 0);
    REQUIRE((one != nullptr));
    logged.clear();
    CHECK(unit.call("fmi2SetupExperiment", one, 0, 0.0, 0.0, 0, 0.0) == 0);
    CHECK(unit.call("fmi2EnterInitializationMode", one) == 0);
    CHECK(unit.call("fmi2ExitInitializationMode", one) == 0);
    CHECK(unit.call("fmi2DoStep", one, 0.0, 0.9, 1) == 0);
    CHECK(logged.empty());
    for (int k = 0; k < 4; ++k) CHECK(unit.call("fmi2DoStep", one, 0.9 + 0.5 * k, 0.5, 1) == 0);
    REQUIRE(logged.size() == 1);
    CHECK(logged[0].find("logStatusWarning: ") == 0);
    CHECK_MESSAGE(logged[0].find("the function of event.root is no number") != std::string::npos, logged[0]);
    unit.call<void>("fmi2FreeInstance", one);
}

}  // namespace fmu_events
