// SPDX-License-Identifier: MIT
// `sweep`: each row is the result of `simulate` from that state; a member that cannot run says so in its row.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "json.hpp"
#include "program.hpp"
#include "scenes.hpp"
#include "simulate/samples.hpp"

namespace commands_sweep {

using alembert::test::Json;
using alembert::test::json_of;
using alembert::test::run;
using alembert::test::source_path;
using alembert::test::swept;
using alembert::test::temporary;

namespace {

/// A spring whose mass starts at x = k/10, so that the start changes with the parameter.
const char* const spring = R"toml(
[parameters]
m = 1
k = 4
[coordinates]
x = { initial = "k/10", rate = 0 }
[[particle]]
name = "P"
mass = "m"
position = ["x", 0]
[[spring]]
along = "x"
stiffness = "k"
[simulation]
duration = 3
tolerance = 1e-12
)toml";

}  // namespace

TEST_CASE("sweep: each row is the result of simulate from that state") {
    const std::string scene = source_path("scenes/benchmark/double_pendulum_regular.toml");
    const Json table = swept({scene, "--vary", "theta1=0.1:0.7:3", "--vary", "l1=1:1.5:2", "--vary",
                              "theta2'=-0.5:0.5:2", "--duration", "3"});
    REQUIRE(table["rows"].size() == 12);
    for (const std::size_t k : {0UL, 5UL, 10UL}) {
        const Json& row = table["rows"][k];
        const Json at = [&] {
            std::vector<std::string> words{"eval", scene, "--json"};
            for (const auto& [name, value] : row["varied"].items()) {
                words.emplace_back("--at");
                words.push_back(name + "=" + value.dump());
            }
            return json_of(words);
        }();
        // The energy of the row's start is kept until its end: both states belong to the same parameters.
        std::vector<std::string> words{"eval", scene, "--json", "--at", "l1=" + row["varied"]["l1"].dump()};
        for (const char* name : {"theta1", "theta2"}) {
            words.insert(words.end(),
                         {"--at", std::string(name) + "=" + row["final"]["coordinates"][name].dump()});
            words.insert(words.end(), {"--at", std::string(name) + "'=" + row["final"]["rates"][name].dump()});
        }
        const auto end = run(words);
        REQUIRE(end.exit == 0);
        CHECK(std::abs(Json::parse(end.out)["energy"].get<double>() - at["energy"].get<double>()) < 1e-10);
        CHECK(row["energy_drift"].get<double>() < 1e-10);
        CHECK(row["status"] == "done");
    }
    const auto plain = run({"simulate", scene, "--json", "--duration", "3"});
    const Json whole = Json::parse(plain.out),
               same = swept({scene, "--vary", "t=0:0:1", "--duration", "3"})["rows"][0];
    for (const char* part : {"coordinates", "rates"})
        for (const char* name : {"theta1", "theta2"})
            CHECK(std::abs(same["final"][part][name].get<double>() - whole["final"][part][name].get<double>()) <
                  1e-12);
    CHECK(same["steps"] == whole["steps"]);
}

TEST_CASE("sweep: initial values follow the parameters that they depend on, and the motion is the closed form") {
    const Json table = swept({temporary("spring.toml", spring), "--vary", "k=1:9:5"});
    for (const Json& row : table["rows"]) {
        const double k = row["varied"]["k"], w = std::sqrt(k);
        CHECK(std::abs(row["final"]["coordinates"]["x"].get<double>() - k / 10 * std::cos(3 * w)) < 1e-10);
        CHECK(std::abs(row["final"]["rates"]["x"].get<double>() + k / 10 * w * std::sin(3 * w)) < 1e-10);
    }
    CHECK(table["side_by_side"] == 8);
}

TEST_CASE("sweep: the table has a header and a row for each point, the same for any number of threads") {
    const std::string scene = temporary("spring.toml", spring);
    const auto one = run({"sweep", scene, "--vary", "k=1:9:17", "--vary", "x'=0:1:3", "--threads", "1"});
    const auto many = run({"sweep", scene, "--vary", "k=1:9:17", "--vary", "x'=0:1:3", "--threads", "4"});
    CHECK(one.exit == 0);
    CHECK(one.out == many.out);
    CHECK(one.out.starts_with(
        "k,x',final_t,final_x,final_x',energy_drift,steps,rejected,evaluations,status\n1,0,3,"));
    CHECK(std::count(one.out.begin(), one.out.end(), '\n') == 52);
    const std::string file = temporary("table.csv", "");
    CHECK(run({"sweep", scene, "--vary", "k=1:9:17", "--vary", "x'=0:1:3", "-o", file}).exit == 0);
    std::ifstream in(file);
    CHECK(std::string(std::istreambuf_iterator<char>(in), {}) == one.out);
}

TEST_CASE(
    "sweep: rows with constraints and from guesses are those of simulate; a start that cannot be had is told in "
    "its row") {
    const std::string scene = source_path("scenes/textbook/cartesian_pendulum.toml");
    const Json table = swept({scene, "--vary", "g=5:9.81:2", "--duration", "1"});
    CHECK(table["side_by_side"] == 1);
    const auto whole = run({"simulate", scene, "--json", "--duration", "1"});
    const Json expected = Json::parse(whole.out)["final"], found = table["rows"][1]["final"];
    for (const auto& [name, value] : expected["coordinates"].items())
        CHECK(std::abs(found["coordinates"][name].get<double>() - value.get<double>()) < 1e-9);

    const Json broken = swept({scene, "--vary", "l=1:-100:2", "--duration", "1"}, 4);
    CHECK(broken["failed"].get<int>() >= 1);
}

TEST_CASE("sweep: mistakes in --vary are reported, with exit code 3") {
    const std::string scene = temporary("spring.toml", spring);
    for (const auto& [vary, words] : std::vector<std::pair<std::string, std::string>>{
             {"kk=0:1:2", "no coordinate, rate, parameter"},
             {"k=0:1", "is no range"},
             {"k", "no NAME="},
             {"k=0:1:0", "nothing to do"},
             {"k=0:1:-3", "nothing to do"},
             {"k=0:inf:3", "no finite number"},
             {"k=0:1:2.5", "no whole number"},
             {"k=0:1:9999999999999999", "more than 1000000000000000"}}) {
        const auto result = run({"sweep", scene, "--vary", vary});
        CHECK(result.exit == 3);
        CHECK(result.err.find(words) != std::string::npos);
    }
    CHECK(run({"sweep", scene, "--vary", "k=1:2:3", "--vary", "k=1:2:3"}).err.find("varied twice") !=
          std::string::npos);
}

// Loads that depend on time and drag do work, which is one more component of the series.
TEST_CASE("sweep: taylor ends where verner98 and the closed form do, and its rows balance energy and work") {
    const Json springs = swept({temporary("spring.toml", spring), "--vary", "k=1:9:21", "--method", "taylor"});
    CHECK(springs["method"] == "taylor");
    for (const Json& row : springs["rows"]) {
        const double k = row["varied"]["k"], w = std::sqrt(k);
        CHECK(std::abs(row["final"]["coordinates"]["x"].get<double>() - k / 10 * std::cos(3 * w)) < 1e-12);
        CHECK(std::abs(row["final"]["rates"]["x"].get<double>() + k / 10 * w * std::sin(3 * w)) < 1e-12);
    }
    CHECK(springs["states_per_second"].get<double>() > 0);
    const std::string driven = source_path("scenes/textbook/double_pendulum.toml");
    const auto rows = [&](const char* method) {
        return swept({driven, "--vary", "theta1=0.1:1:5", "--vary", "t=0:2:3", "--duration", "4", "--tolerance",
                      "1e-12", "--method", method})["rows"];
    };
    const Json series = rows("taylor"), expected = rows("verner98");
    for (std::size_t k = 0; k < expected.size(); ++k) {
        for (const char* name : {"theta1", "theta2"})
            CHECK(std::abs(series[k]["final"]["coordinates"][name].get<double>() -
                           expected[k]["final"]["coordinates"][name].get<double>()) < 1e-9);
        CHECK(series[k]["work_balance"].get<double>() < 1e-12);
    }
}

TEST_CASE(
    "sweep: taylor with constraints is that of simulate, and auto leaves it where it does not go side by side") {
    const std::string bar = source_path("scenes/textbook/cartesian_pendulum.toml"),
                      plain = temporary("spring.toml", spring);
    const Json table = swept({bar, "--vary", "g=5:9.81:2", "--duration", "1", "--method", "taylor"});
    CHECK(table["side_by_side"] == 1);
    const Json whole =
        Json::parse(run({"simulate", bar, "--json", "--duration", "1", "--method", "taylor"}).out)["final"];
    CHECK(table["rows"][1]["final"]["coordinates"] == whole["coordinates"]);
    CHECK(swept({plain, "--vary", "k=1:2:2", "--code", "compiled"})["method"] == "verner98");
    CHECK(swept({plain, "--vary", "k=1:2:2", "--along", "max"})["method"] == "dop853");
    CHECK(swept({plain, "--vary", "k=1:2:2", "--tolerance", "1e-4"})["method"] == "dop853");
    CHECK(swept({plain, "--vary", "k=1:2:2", "--method", "taylor", "--code", "compiled"})["side_by_side"] == 1);
    const auto rattle = run({"sweep", plain, "--vary", "k=1:2:2", "--method", "rattle"});
    CHECK(rattle.exit == 3);
    CHECK(rattle.err.find("rattle") != std::string::npos);
}

// x = k/10 cos wt. A step of the series is up to 5/w long, a sixteenth of that 0.3/w; there the polynomial of
// fifth degree errs by 0.3⁶/46080 of the amplitude, that of third degree by 0.3⁴/384 of the rate's. Over whole
// steps nothing of the extremes would be known.
TEST_CASE("sweep: --along looks within the long steps of taylor, side by side and one by one") {
    const std::string scene = temporary("spring.toml", spring);
    for (const char* code : {"auto", "compiled"}) {
        const Json table = swept({scene, "--vary", "k=2:9:15", "--method", "taylor", "--tolerance", "1e-9",
                                  "--along", "min,mean", "--code", code});
        for (const Json& row : table["rows"]) {
            const double k = row["varied"]["k"], w = std::sqrt(k), size = k / 10;
            const auto along = [&](const char* name) { return row["along"][name].get<double>(); };
            CHECK(std::abs(along("min_x") + size) < 1e-7 * size);
            CHECK(std::abs(along("min_x'") + size * w) < 1e-4 * size * w);
            CHECK(std::abs(along("mean_x") - size * std::sin(3 * w) / (3 * w)) < 1e-7 * size);
        }
    }
}

// x = 1 - t²/2: a scene with plain numbers only has no parameters to pass on.
TEST_CASE("sweep: a scene without parameters is swept, side by side and by every packed method") {
    const std::string scene =
        temporary("plain.toml",
                  "[coordinates]\nx = 1\n[[particle]]\nname = \"P\"\nmass = 1\nposition = [\"x\", 0]\n[[force]]\n"
                  "at = \"P\"\nvector = [-1, 0]\n[simulation]\nduration = 0.5\n");
    for (const char* method : {"rk4", "dopri5", "dop853", "verner76", "verner98"}) {
        std::vector<std::string> words{scene, "--vary", "x=1:2:11", "--method", method};
        if (std::string(method) == "rk4") words.insert(words.end(), {"--step", "0.1"});
        const Json table = swept(words);
        CHECK(table["side_by_side"] == 8);
        for (const Json& row : table["rows"])
            CHECK(row["final"]["coordinates"]["x"].get<double>() ==
                  doctest::Approx(row["varied"]["x"].get<double>() - 0.125).epsilon(1e-14));
    }
}

TEST_CASE("sweep: the points of a file give the rows of the grid that has the same points") {
    const std::string scene = temporary("spring.toml", spring),
                      points = temporary("points.csv", "\xEF\xBB\xBFx , k\n0.5,4\n\n 1, 2*3 \r\n\"0.5\",6\n");
    const Json listed = swept({scene, "--vary-from", points}),
               grid = swept({scene, "--vary", "k=4:6:2", "--vary", "x=0.5:1:2"});
    REQUIRE(listed["rows"].size() == 3);
    const std::size_t same[] = {0, 3, 2};
    for (std::size_t k = 0; k < 3; ++k) CHECK(listed["rows"][k]["final"] == grid["rows"][same[k]]["final"]);
    CHECK(listed["vary"][1] == Json{{"name", "k"}, {"from", 4.0}, {"to", 6.0}, {"count", 3}});
    CHECK(listed["vary_from"] == points);

    const auto refused = [&](const char* text, const char* words) {
        const std::string table = temporary("wrong.csv", text);
        const auto result = run({"sweep", scene, "--vary-from", table});
        CHECK(result.exit == 3);
        if (words != std::string("'y'"))
            CHECK(result.err.starts_with(table));  // the place of the mistake comes first
        CHECK_MESSAGE(result.err.find(words) != std::string::npos, result.err);
    };
    refused("x\n1\n1,2\n", "wrong.csv:3: there are 2 values for 1 names");
    refused("x,x\n", "wrong.csv:1: 'x' stands there twice");
    refused("x\nmany\n", "'many' is no finite number");
    refused("x\n", "wrong.csv:1: there are no points");
    refused("", "wrong.csv: the table is empty");
    refused("y\n1\n", "'y'");
    CHECK(run({"sweep", scene, "--vary", "x=0:1:2", "--vary-from", points}).exit == 3);
    CHECK(run({"sweep", scene, "--vary-from", points, "-o", points}).exit == 3);
    CHECK(run({"sweep", scene, "--vary-from", points, "--svg", temporary("s.svg", "")}).exit == 3);
}

TEST_CASE("sweep: samples lie as their kind says, and the seed decides which they are") {
    const std::string scene = temporary("spring.toml", spring);
    const auto points = [&](const char* sampling, const char* seed) {
        std::vector<std::vector<double>> result;
        const Json all = swept({scene, "--vary", "x=1:3", "--vary", "k=4:8", "--vary", "m=1:2", "--duration", "0",
                                "--samples", "64", "--sampling", sampling, "--seed", seed});
        for (const Json& row : all["rows"]) {
            const Json& v = row["varied"];
            result.push_back(
                {(v["x"].get<double>() - 1) / 2, (v["k"].get<double>() - 4) / 4, v["m"].get<double>() - 1});
        }
        return result;
    };
    /// Whether each of 64 equal parts of each range has one point.
    const auto is_spread = [](const std::vector<std::vector<double>>& list) {
        for (std::size_t axis = 0; axis < 3; ++axis) {
            std::vector<int> hits(64);
            for (const auto& p : list) ++hits.at(static_cast<std::size_t>(64 * p[axis]));
            if (hits != std::vector<int>(64, 1)) return false;
        }
        return true;
    };
    for (const char* const sampling : {"sobol", "latin"})
        for (const char* const seed : {"0", "5"}) CHECK(is_spread(points(sampling, seed)));
    const auto uniform = points("uniform", "5");
    CHECK(!is_spread(uniform));
    for (const auto& p : uniform)
        for (const double x : p) CHECK((x >= 0 && x < 1));
    CHECK(points("uniform", "5") == uniform);
    for (const char* const sampling : {"sobol", "latin", "uniform"})
        CHECK(points(sampling, "1") != points(sampling, "2"));
    // The first two coordinates of Sobol's sequence: each of 8 × 8 squares has one of 64 points.
    std::vector<int> squares(64);
    for (const auto& p : points("sobol", "0"))
        ++squares[static_cast<std::size_t>(8 * std::floor(8 * p[0]) + 8 * p[1])];
    CHECK(squares == std::vector<int>(64, 1));
    CHECK(run({"sweep", scene, "--vary", "x=0:1:3", "--samples", "5"}).exit == 3);
}

TEST_CASE("sweep: Sobol's points lie one in each equal part of every one of 21 ranges") {
    std::vector<alembert::Axis> axes(21, {.name = "x", .from = 0, .to = 1});
    const alembert::Grid grid = alembert::sampled(axes, 256, alembert::Sampling::sobol, 0);
    for (std::size_t axis = 0; axis < 21; ++axis) {
        std::vector<int> hits(256);
        for (std::size_t k = 0; k < 256; ++k) ++hits.at(static_cast<std::size_t>(256 * grid.point(k)[axis]));
        CHECK(hits == std::vector<int>(256, 1));
    }
    axes.push_back(axes[0]);
    CHECK_THROWS(alembert::sampled(axes, 8, alembert::Sampling::sobol, 0));
}

TEST_CASE("sweep: an event whose expression ends is told once, as by simulate") {
    const std::string scene = temporary("ends.toml", R"toml(
[coordinates]
x = { initial = 0, rate = 1 }
[[particle]]
name = "P"
mass = 1
position = ["x", 0]
[[event]]
name = "edge"
when = "sqrt(1 - x)"
stop = true
[simulation]
duration = 3
)toml");
    const auto result = run({"sweep", scene, "--vary", "x=0:0.5:20"});
    const std::string told = "the expression of event 'edge' has a value at t = ";
    CHECK(result.exit == 0);
    const auto first = result.err.find(told);
    REQUIRE(first != std::string::npos);
    CHECK(result.err.find(told, first + 1) == std::string::npos);
    CHECK(run({"sweep", scene, "--vary", "x=-9:-8:3"}).err.empty());  // it does not come so far
}

}  // namespace commands_sweep
