// SPDX-License-Identifier: MIT
// Closed loops that pass poses in which they lie flat, where the constraints lose rank: units and the main program
// beside the emitted C move as `simulate` does, which has a projection of its own in C++ and integrates by another
// method. Where constraints or energy are lost, the exports say so.
#include <doctest/doctest.h>

#include <filesystem>
#include <map>
#include <sstream>

#include "fmu_exports.hpp"

namespace fmu_poses {

using namespace alembert::test;

namespace {

/// Cranks of length 1 at distance 1 with masses at their ends, coupled two by two.
std::string cranks(int count, double mass, double rate, const std::string& more = "") {
    std::string text = "gravity = [0, -9.81]\n[coordinates]\n", rest;
    for (int k = 0; k < count; ++k) {
        text += fmt::format("q{} = {{ initial = 0, rate = {}, unit = \"rad\" }}\n", k, rate);
        rest += fmt::format(
            "[[particle]]\nname = \"P{0}\"\nmass = {1}\nposition = [\"{0} - sin(q{0})\", \"cos(q{0})\"]\n", k,
            k == 0 ? 1.0 : mass);
        if (k > 0)
            rest += fmt::format(
                "[[constraint]]\nname = \"c{0}\"\nholonomic = \"(1 - sin(q{0}) + sin(q{1}))^2 + (cos(q{0}) - "
                "cos(q{1}))^2 - 1\"\n",
                k, k - 1);
    }
    return text + rest + more;
}

/// The last row that the main program beside the emitted file prints.
std::vector<double> end_of_program(const std::string& scene, const std::string& language, double duration,
                                   double tolerance = 1e-12, int rows = 3) {
    const std::string folder = temporary_folder("standalone-" + language);
    REQUIRE(run({"emit", scene, "-o", folder, "--language", language, "--standalone"}).exit == 0);
    const std::string name = std::filesystem::path(scene).stem().string();
    const std::string compiled =
        language == "c" ? fmt::format("cc -std=c99 -pedantic -Wall -Wextra -Werror -O1 {0}_main.c {0}.c -lm", name)
                        : fmt::format("c++ -std=c++20 -O1 {}_main.cpp", name);
    const auto result = run_shell(fmt::format("cd {} && {} -o run && ./run {} {} {} > rows && tail -n 1 rows",
                                              folder, compiled, duration, tolerance, rows));
    REQUIRE_MESSAGE(result.exit == 0, result.err);
    std::vector<double> row;
    std::istringstream line(result.out);
    for (std::string item; std::getline(line, item, ',');) row.push_back(std::stod(item));
    return row;
}

/// The motion passes the pose several times; each time rounding of about 1e-10 of the rates may remain.
void compare(const std::string& scene, double duration) {
    const Json final = simulated(scene, duration);
    for (const int version : {2, 3}) {
        CAPTURE(version);
        const Unit unit = exported(scene, version);
        for (const double step : {0.3, duration}) {
            Instance one(unit, true, 1e-12);
            one.begin();
            const double before = one.get("energy.total");
            for (int k = 0; step * k < duration - 1e-9; ++k)
                REQUIRE(one.step(step * k, std::min(step, duration - step * k)));
            CHECK(difference(one, final) < 1e-6);
            CHECK(one.get("energy.total") == doctest::Approx(before).epsilon(1e-7));
        }
        Instance exchanged(unit, false, 1e-9);
        exchanged.begin();
        exchange(exchanged, duration, 6000);
        CHECK(difference(exchanged, final) < 1e-5);
    }
    for (const char* const language : {"c", "cpp"}) {
        CAPTURE(language);
        const std::vector<double> row = end_of_program(scene, language, duration);
        std::size_t k = 1;
        for (const auto& [name, value] : final["coordinates"].items()) {
            const double wanted = value;
            CHECK(std::abs(row.at(k++) - wanted) < 1e-6 * std::max(1.0, std::abs(wanted)));
        }
    }
}

}  // namespace

TEST_CASE("fmu: a parallelogram turns through its flat pose with all its energy, in units and in the C program") {
    const std::string scene = temporary("parallelogram.toml", cranks(2, 1, -3));
    CHECK(simulated(scene, 3)["coordinates"]["q0"] == doctest::Approx(-13.890156).epsilon(1e-7));
    compare(scene, 3);
    compare(temporary("unequal.toml", cranks(2, 2.5, -4)), 2);
}

TEST_CASE("fmu: cranks without mass, and more loops than one, pass the pose too") {
    compare(temporary("massless.toml", cranks(2, 0, -3)), 3);
    compare(temporary("three.toml", cranks(3, 0.5, -5)), 2);
}

// The digits of two methods in 110 digits, as in "hard: Andrews' squeezer". The error at the end is about 50 times
// the tolerance of a step, in rates beside 1425.
TEST_CASE("fmu: Andrews' squeezer ends where it should, the nearer the smaller the tolerance") {
    const std::map<std::string, double> end{
        {"beta", 15.810771195153707097},      {"Theta", -15.756371058411839470},
        {"gamma", 0.040822240119645804858},   {"delta", 0.52440996587995406937},
        {"der(beta)", 1139.9203022591060642}, {"der(gamma)", 11.032911910618593745},
        {"der(Phi)", 19.293374105032040832},  {"der(eps)", 0.32317914924913087499}};
    const Unit unit = exported(ALEMBERT_SOURCE_DIR "/scenes/benchmark/andrews.toml", 2);
    for (const double tolerance : {1e-6, 1e-8, 1e-10, 0.0}) {
        Instance one(unit, true, tolerance);
        one.begin();
        for (int k = 0; k < 10; ++k) REQUIRE(one.step(0.003 * k, 0.003));
        const double step = tolerance > 0 ? tolerance : 1e-12;  // the scene's
        for (const auto& [name, value] : end) {
            CAPTURE(name);
            CAPTURE(tolerance);
            CHECK(std::abs(one.get(name) - value) < 200 * step * std::max(1.0, std::abs(value)));
        }
    }
}

// A mass at rest that a pulse starts: v = ∫ F dt, and from the pulse on it moves steadily.
TEST_CASE("emit: the main program beside a file passes over no pulse in time, and may start from rest") {
    const double root = std::sqrt(std::acos(-1.0));
    struct Pulse {
        const char* force;
        double rate;
    };
    for (const Pulse& pulse : {Pulse{"exp(-((t - 5.2345)/0.001)^2)/0.001", root},
                               Pulse{"1000*(sign(t - 5.2345) - sign(t - 5.2355))/2", 1},
                               Pulse{"exp(-((t - 5.2345)/0.05)^2)/0.05", root}}) {
        CAPTURE(pulse.force);
        const std::string scene = temporary(
            "pulse.toml",
            fmt::format("[inputs]\nF = \"{}\"\n[coordinates]\nx = 0\n[[particle]]\nname = \"P\"\nmass = 1\n"
                        "position = [\"x\", 0]\n[forces]\nx = \"F\"\n",
                        pulse.force));
        for (const char* const language : {"c", "cpp"}) {
            CAPTURE(language);
            const std::vector<double> row = end_of_program(scene, language, 10);
            REQUIRE(row.size() == 3);
            CHECK(std::abs(row[2] - pulse.rate) < 1e-7);
            CHECK(std::abs(row[1] - pulse.rate * (10 - 5.2345)) < 1e-3);
        }
    }
}

// x = 5^(p+2)/(p+1)/(p+2) and v = 5^(p+1)/(p+1) at t = 10. The first step behind t = 5 is never a small one: the
// force is the same in all sizes.
TEST_CASE("emit: a force that begins like a power of time loses no energy, in units and in the main program") {
    for (const double power : {1.0, 2.5, 3.0, 4.0, 7.0}) {
        CAPTURE(power);
        const std::string scene = temporary(
            "power.toml",
            fmt::format("[inputs]\nF = \"max(0, t - 5)^{}\"\n[coordinates]\nx = 0\n[[particle]]\nname = \"P\"\n"
                        "mass = 1\nposition = [\"x\", 0]\n[forces]\nx = \"F\"\n",
                        power));
        const double v = std::pow(5, power + 1) / (power + 1), x = 5 * v / (power + 2);
        const Unit unit = exported(scene, 2);
        for (const double tolerance : {1e-6, 1e-8, 1e-10})
            for (const int steps : {1, 10, 100}) {
                CAPTURE(tolerance);
                CAPTURE(steps);
                Instance one(unit, true, tolerance);
                one.begin();
                for (int k = 0; k < steps; ++k) REQUIRE(one.step(10.0 * k / steps, 10.0 / steps));
                CHECK(one.get("x") == doctest::Approx(x).epsilon(100 * tolerance));
                CHECK(one.get("der(x)") == doctest::Approx(v).epsilon(100 * tolerance));
            }
        for (const int rows : {1, 100}) {
            const std::vector<double> row = end_of_program(scene, "c", 10, 1e-9, rows);
            REQUIRE(row.size() == 3);
            CHECK(row[1] == doctest::Approx(x).epsilon(1e-6));
            CHECK(row[2] == doctest::Approx(v).epsilon(1e-6));
        }
    }
}

// A torque of 0.1 N m that the energies do not know, put into the emitted text.
TEST_CASE("emit: the main program beside a file ends with an error where energy comes from nowhere") {
    const std::string scene = temporary("pendulum.toml", R"toml(gravity = [0, -9.81]
[coordinates]
theta = { initial = 0.5, unit = "rad" }
[[particle]]
name = "bob"
mass = 2
position = ["sin(theta)", "-cos(theta)"]
)toml"),
                      folder = temporary_folder("spoiled");
    REQUIRE(run({"emit", scene, "-o", folder, "--language", "c", "--standalone"}).exit == 0);
    const std::string command =
        "cd " + folder + " && cc -std=c99 -O1 pendulum_main.c pendulum.c -lm -o run && ./run 10 > table";
    CHECK(run_shell(command).exit == 0);
    const auto spoiled =
        run_shell("cd " + folder + " && sed -i 's/rate\\[1\\] = /rate[1] = 0.1 + /' pendulum.c && " + command);
    CHECK(spoiled.exit == 4);
    CHECK(spoiled.err.find("energy") != std::string::npos);
}

}  // namespace fmu_poses
