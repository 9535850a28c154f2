// SPDX-License-Identifier: MIT
// `[[event]]` of a scene: its time, its order, and that one with `stop` ends the run.
#include <doctest/doctest.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "program.hpp"

namespace commands_events {

using alembert::test::run;
using alembert::test::temporary;
using Json = nlohmann::json;

namespace {

const char* const thrown = R"toml(
gravity = [0, "-g"]
[parameters]
g = 9.81
[coordinates]
x = { initial = 0, rate = 1 }
y = { initial = 10, rate = 0 }
[[particle]]
name = "P"
mass = 1
position = ["x", "y"]
[[event]]
name = "late"
when = "y - 3"
[[event]]
name = "half"
when = "y - 5"
[[event]]
name = "abreast"
when = "x - sqrt(10/g)"
[[event]]
name = "end"
when = "y"
stop = true
[[event]]
name = "ground"
when = "x^2 - 20/g"
[[event]]
name = "never"
when = "y + 1"
[simulation]
duration = 5
)toml";

}  // namespace

// y = 10 − g t²/2 and x = t: every method but euler and verlet's dense output is exact up to rounding; bdf to its
// tolerance.
TEST_CASE(
    "events: a scene's guards are met to 1e-12 by every method, simultaneous ones as declared, and stop ends the "
    "run") {
    const std::string scene = temporary("thrown.toml", thrown);
    const double half = std::sqrt(10 / 9.81), late = std::sqrt(14 / 9.81), end = std::sqrt(20 / 9.81);
    const std::vector<std::pair<std::string, double>> expected = {
        {"half", half}, {"abreast", half}, {"late", late}, {"end", end}, {"ground", end}};
    for (const std::string method : {"dopri5", "dop853", "verner76", "verner98", "rkn86", "rkn1210", "taylor",
                                     "abm", "radau", "rk4", "gauss", "rattle", "kahanli8"}) {
        std::vector<std::string> words = {"simulate", scene, "--json", "--no-estimate", "--method", method};
        if (method == "rk4" || method == "gauss" || method == "rattle" || method == "kahanli8")
            words.insert(words.end(), {"--step", "0.01"});
        else
            words.insert(words.end(), {"--tolerance", "1e-13"});
        const auto result = run(words);
        INFO(method << " " << result.err);
        REQUIRE(result.exit == 0);
        const Json motion = Json::parse(result.out);
        REQUIRE(motion["events"].size() == expected.size());
        for (std::size_t k = 0; k < expected.size(); ++k) {
            CHECK(motion["events"][k]["name"] == expected[k].first);
            CHECK(std::abs(motion["events"][k]["time"].get<double>() - expected[k].second) <
                  1e-12 * expected[k].second);
        }
        CHECK(motion["final"]["time"] == motion["events"][3]["time"]);
        CHECK(std::abs(motion["final"]["coordinates"]["y"].get<double>()) < 1e-11);
    }
}

// cos t = 0 at t = π/2; the second run stops at another time, and the difference of these times is an error too.
TEST_CASE("events: the estimated error of a run that an event stops includes that of the time") {
    const std::string scene = temporary("quarter.toml", R"toml(
[coordinates]
x = 1
[energy]
kinetic = "x'^2/2"
potential = "x^2/2"
[[event]]
name = "middle"
when = "x"
stop = true
[simulation]
duration = 5
)toml");
    for (const auto& [method, option, value] : {std::tuple{"rk2", "--step", "0.05"},
                                                {"verlet", "--step", "0.05"},
                                                {"bdf", "--tolerance", "1e-5"},
                                                {"dop853", "--tolerance", "1e-6"}}) {
        const auto result = run({"simulate", scene, "--json", "--method", method, option, value});
        INFO(result.err);
        REQUIRE(result.exit == 0);
        const Json motion = Json::parse(result.out);
        const double error =
            std::max(std::abs(motion["final"]["time"].get<double>() - std::acos(0)) / std::acos(0),
                     std::abs(motion["final"]["rates"]["x"].get<double>() + 1));
        REQUIRE(motion["error_estimate"]["value"].is_number());
        CHECK(motion["error_estimate"]["value"].get<double>() > error / 10);
        CHECK(motion["error_estimate"]["value"].get<double>() < error * 10);
        CHECK(motion["error_estimate"]["trustworthy"] == true);
    }
}

TEST_CASE("events: a constrained motion has them at the times found with the angle") {
    const std::string scene = temporary("swing.toml", R"toml(
gravity = [0, "-g"]
[parameters]
g = 9.81
[coordinates]
x = { initial = 1, rate = 0 }
y = { initial = 0, rate = 0 }
[[particle]]
name = "P"
mass = 1
position = ["x", "y"]
[[constraint]]
name = "rod"
holonomic = "x^2 + y^2 = 1"
[[event]]
name = "lowest"
when = "x"
stop = true
[simulation]
duration = 5
)toml");
    const double quarter =
        std::comp_ellint_1(std::sin(M_PI / 4)) / std::sqrt(9.81);  // of the period from the horizontal
    for (const std::vector<std::string>& method : {std::vector<std::string>{"dop853", "--tolerance", "1e-14"},
                                                   {"taylor", "--tolerance", "1e-14"},
                                                   {"rattle8", "--step", "0.01"}}) {
        std::vector<std::string> words = {"simulate", scene, "--json", "--no-estimate", "--method"};
        words.insert(words.end(), method.begin(), method.end());
        const auto result = run(words);
        INFO(method[0] << " " << result.err);
        REQUIRE(result.exit == 0);
        const Json motion = Json::parse(result.out);
        REQUIRE(motion["events"].size() == 1);
        CHECK(std::abs(motion["events"][0]["time"].get<double>() - quarter) < 1e-12);
    }
}

}  // namespace commands_events
