// SPDX-License-Identifier: MIT
// Motions that stand in a kink of the potential, whose sign depends on positions alone, against closed forms.
#include <doctest/doctest.h>
#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "contacts.hpp"
#include "files.hpp"

namespace commands_kinks {

using namespace alembert::test;

namespace {

constexpr const char* methods[] = {"auto", "dop853", "verner98", "taylor", "radau"};

std::string two_masses(const std::string& start) {
    return temporary("kink_two.toml", R"toml(
[coordinates]
x = { initial = )toml" + start + R"toml( }
y = { initial = )toml" + start + R"toml( }
[energy]
kinetic = "x'^2/2 + y'^2/2"
potential = "abs(x - y) + x^2"
[simulation]
duration = 5
tolerance = 1e-11
)toml");
}

}  // namespace

// Together the masses obey 2 x'' = −2 x; the force between them is that of y, x'' ≤ 1. The runs have a tolerance
// of 1e-11, whose error grows over 5 s to less than 1e-9; the zero of x − y is restored after each step to
// rounding.
TEST_CASE("kinks: two masses that |x − y| holds together move as one") {
    for (const char* const method : methods) {
        CAPTURE(method);
        const Json motion = json_of({"simulate", two_masses("0.5"), "--method", method});
        CHECK(motion["completed"] == true);
        CHECK(coordinate(motion, "x") == doctest::Approx(0.5 * std::cos(5.0)).epsilon(1e-9));
        CHECK(std::abs(coordinate(motion, "x") - coordinate(motion, "y")) < 1e-14);
        CHECK(rate(motion, "y") == doctest::Approx(-0.5 * std::sin(5.0)).epsilon(1e-9));
        CHECK(motion["energy_drift"].get<double>() < 1e-9);
    }
}

// From 1.5 the force that would hold them is above 1: x = ½ + cos √2t, y = 1.5 − t²/2, until these meet.
TEST_CASE("kinks: two masses that |x − y| cannot hold together separate at once") {
    const Json first = json_of({"simulate", two_masses("1.5"), "--duration", "1"});
    CHECK(coordinate(first, "x") == doctest::Approx(0.5 + std::cos(std::sqrt(2.0))).epsilon(1e-9));
    CHECK(coordinate(first, "y") == doctest::Approx(1).epsilon(1e-9));
    CHECK_FALSE(first.contains("switches"));
}

// The load −t/2 stands against at most 1: the mass leaves at t = 2, and then x'' = t/2 − 1.
TEST_CASE("kinks: a mass at the bottom of |x| stays there until the load is larger than the slope") {
    const std::string scene = temporary("kink_leaves.toml", R"toml(
[coordinates]
x = 0
y = { initial = 1 }
[energy]
kinetic = "x'^2/2 + y'^2/2"
potential = "abs(x) + y^2/2"
[forces]
x = "t/2"
[simulation]
duration = 4
tolerance = 1e-11
)toml");
    for (const char* const method : methods) {
        CAPTURE(method);
        const Json motion = json_of({"simulate", scene, "--method", method});
        CHECK(motion["completed"] == true);
        CHECK(coordinate(motion, "x") == doctest::Approx(2.0 / 3).epsilon(1e-9));
        CHECK(coordinate(motion, "y") == doctest::Approx(std::cos(4.0)).epsilon(1e-9));
        REQUIRE(motion["switches"].size() == 2);  // from the start it stands
        CHECK(std::abs(motion["switches"][1]["time"].get<double>() - 2) < 1e-11);
    }
}

// Sums of forces of size 1 are exact to a few roundings.
TEST_CASE("kinks: eval gives the accelerations with which a motion goes on from a zero of a sign") {
    const Json together = json_of({"eval", two_masses("0.5"), "--json"});
    CHECK(together["accelerations"]["x"].get<double>() == doctest::Approx(-0.5).epsilon(1e-12));
    CHECK(together["accelerations"]["y"].get<double>() == doctest::Approx(-0.5).epsilon(1e-12));
    const Json apart = json_of({"eval", two_masses("1.5"), "--json"});
    CHECK(apart["accelerations"]["x"].get<double>() == doctest::Approx(-2).epsilon(1e-12));
    CHECK(apart["accelerations"]["y"].get<double>() == doctest::Approx(-1).epsilon(1e-12));
    for (const auto& [load, acceleration] : {std::pair("0.5", 0.0), {"3", 2.0}, {"-3", -2.0}}) {
        const Json json = json_of({"eval", temporary("kink_eval.toml", R"toml(
[coordinates]
x = 0
[energy]
kinetic = "x'^2/2"
[forces]
x = ")toml" + std::string(load) + R"toml( - sign(x')"
)toml"),
                                   "--json"});
        CHECK(std::abs(json["accelerations"]["x"].get<double>() - acceleration) < 1e-14);
    }
}

// The equations do not say where the motion goes on; eval then takes 0 for sign(0).
TEST_CASE("kinks: a mass on top of −|x| may fall to either side, and the message says so") {
    const std::string scene = temporary("kink_top.toml", R"toml(
[coordinates]
x = 0
[energy]
kinetic = "x'^2/2"
potential = "-abs(x)"
[simulation]
duration = 1
)toml");
    CHECK(json_of({"eval", scene, "--json"})["accelerations"]["x"] == 0);
    const auto result = run({"simulate", scene});
    CHECK(result.exit == 4);
    CHECK(result.err.find("to either side of sign(x) = 0") != std::string::npos);
}

// v' = t − 3 |v| from rest: v = t/3 − 1/9 + exp(−3t)/9, and x its integral. At t = 0 neither side is pushed.
TEST_CASE("kinks: a motion from rest leaves the kink of |x'| to the side to which a growing force pushes it") {
    for (const double push : {1.0, -1.0})
        for (const char* const method : {"auto", "dop853", "radau"}) {
            const std::string scene = temporary("pushed.toml", fmt::format(R"toml(
[coordinates]
x = 0
[energy]
kinetic = "x'^2/2"
[forces]
x = "{0}*t - {0}*3*abs(x')"
[simulation]
duration = 2
tolerance = 1e-12
)toml",
                                                                           push));
            CAPTURE(method);
            const Json motion = simulated(scene, {"--method", method});
            const double t = 2;
            CHECK(std::abs(rate(motion, "x") - push * (t / 3 - 1.0 / 9 + std::exp(-3 * t) / 9)) < 1e-11);
            CHECK(std::abs(coordinate(motion, "x") - push * (t * t / 6 - t / 9 + (1 - std::exp(-3 * t)) / 27)) <
                  1e-11);
        }
}

// ∫ (1 + |x|) dx from −1 on; the speed of a particle on a path that only turns it stays.
TEST_CASE("kinks: a constraint whose row holds |x| is kept by the sign that the run holds") {
    const std::string scene = temporary("turning_row.toml", R"toml(
[coordinates]
x = { initial = -1, rate = 1 }
z = { initial = 0.2, rate_guess = 0 }
[[particle]]
name = "p"
mass = 1
position = ["x", "z"]
[[constraint]]
name = "c"
nonholonomic = "z' = (1 + abs(x))*x'"
)toml");
    const Json motion = simulated(scene, {"--duration", "3", "--tolerance", "1e-12"});
    const double x = coordinate(motion, "x");
    CHECK(x > 0);
    CHECK(motion["energy_drift"].get<double>() < 1e-11);
    CHECK(std::abs(coordinate(motion, "z") - (0.2 + x + x * x / 2 + 1.5)) < 1e-10);
}

// Numbers of scipy 1.14, DOP853 with 3e-14 from zero to zero.
TEST_CASE("kinks: what is zero as a whole stays so by every method, and leaves where it grows") {
    const auto scene = [](const std::string& rate_of_N, const std::string& more) {
        return temporary("kink_idle.toml", fmt::format(R"toml(
[coordinates]
x = {{ initial = 1, rate = 0 }}
[states]
N = {{ rate = "{}" }}
w = {{ rate = "abs(N*x)" }}
[energy]
kinetic = "x'^2/2"
[forces]
x = "-x - abs(N*x')"
[simulation]
duration = 4
{})toml",
                                                       rate_of_N, more));
    };
    struct Case {
        const char *rate_of_N, *more;
        double x, rate, w;
    };
    const Case cases[] = {{"0", "[[event]]\nname = \"on\"\nwhen = \"t - 2\"\nset = { N = 1 }\n", -1.99228879839,
                           0.243784352837, 2.76159432458},
                          {"max(0, t - 1)", "", -6.33695857471, -15.6073134118, 11.9730234394},
                          {"exp(-1/(t + 1e-9))", "", -3.204878136045, -0.7620153389306, 6.039433048155},
                          {"-N", "", std::cos(4.0), -std::sin(4.0), 0}};
    for (const Case& one : cases)
        for (const char* const method : {"auto", "dopri5", "verner98", "radau", "bdf"}) {
            CAPTURE(one.x);
            CAPTURE(std::string(method));
            const Json motion = json_of({"simulate", scene(one.rate_of_N, one.more), "--method", method});
            CHECK(motion["completed"] == true);
            CHECK(motion["error_estimate"]["trustworthy"] == true);
            const double allowed = std::string(method) == "bdf" ? 3e-6 : 1e-7;
            CHECK(std::abs(coordinate(motion, "x") - one.x) < allowed);
            CHECK(std::abs(rate(motion, "x") - one.rate) < allowed);
            CHECK(std::abs(motion["final"]["states"]["w"].get<double>() - one.w) < allowed);
        }
}

// The clutch has no normal force until t = 1. Then N = 1 − exp(1 − t), and it brakes the mass with 0.3 N.
TEST_CASE("kinks: friction without a normal force is followed by implicit methods, and holds when there is one") {
    const std::string scene = temporary("kink_clutch.toml", R"toml(
[coordinates]
a = { initial = 0, rate = 3 }
b = 0
[states]
on = {}
N = { rate = "on - N" }
lost = { rate = "abs(0.3*N*(a' - b'))" }
[energy]
kinetic = "(a'^2 + 2*b'^2)/2"
[[friction]]
name = "c"
coefficient = 0.3
slip = "a' - b'"
normal = "N"
[[event]]
name = "close"
when = "t - 1"
set = { on = 1 }
[simulation]
duration = 3
)toml");
    const double force = 0.3 * (2 - (1 - std::exp(-2.0)));  // of the impulse of N over 2 s
    for (const char* const method : {"auto", "dopri5", "radau", "bdf"}) {
        CAPTURE(std::string(method));
        const Json motion = json_of({"simulate", scene, "--method", method});
        CHECK(motion["error_estimate"]["trustworthy"] == true);
        CHECK(std::abs(rate(motion, "a") - (3 - force)) < 1e-6);
        CHECK(std::abs(rate(motion, "b") - force / 2) < 1e-6);
    }
}

}  // namespace commands_kinks
