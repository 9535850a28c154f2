// SPDX-License-Identifier: MIT
// `bench` and the error estimate of `simulate` are compared with digits from other sources (Kepler's equation in
// 50 digits, Taylor series in 110).
#include <doctest/doctest.h>

#include <array>
#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>
#include <set>
#include <sstream>

#include "codegen/machine/can_run.hpp"
#include "json.hpp"
#include "program.hpp"
#include "scenes.hpp"

namespace commands_bench {

using alembert::test::Json;
using alembert::test::json_of;
using alembert::test::run;
using alembert::test::source_path;
using alembert::test::temporary;

namespace {

std::string scene(const std::string& name) {
    return source_path("scenes/benchmark/" + name + ".toml");
}

}  // namespace

TEST_CASE(
    "bench: the reference of Kepler's comet agrees with Kepler's equation in all the digits that it claims") {
    const std::string svg = temporary("kepler.svg", ""), csv = temporary("kepler.csv", "");
    const Json result =
        json_of({"bench", scene("kepler"), "--json", "--method", "dop853", "--svg", svg, "--csv", csv});
    const Json& reference = result["reference"];
    CHECK(reference["digits"].get<int>() >= 18);
    // The leading 20 digits as text: a double would lose the last four.
    CHECK(reference["text"]["coordinates"]["x"].get<std::string>().substr(0, 22) == "-0.1351664773678210293");
    CHECK(reference["text"]["rates"]["x"].get<std::string>().substr(0, 21) == "3.3757472100490509819");
    CHECK(std::abs(reference["final"]["coordinates"]["y"].get<double>() + 0.07320018447262802682) < 1e-16);
    REQUIRE(result["runs"].size() == 12);
    double first = 0, last = 0;
    for (const Json& one : result["runs"]) {
        if (one["tolerance"].get<double>() > 0.9e-5 && one["tolerance"].get<double>() < 1.1e-5)
            first = one["error"];
        last = one["error"];
        CHECK(one["seconds"].get<double>() > 0);
        CHECK(one["evaluations"].get<long>() > one["steps"].get<long>());
        CHECK(one.contains("energy_drift"));
    }
    CHECK(last < 1e-8);
    CHECK(first > 1e3 * last);
    const std::string picture = alembert::test::contents(svg);
    CHECK(picture.find("dop853") != std::string::npos);
    CHECK(picture.ends_with("</svg>\n"));
    std::ifstream table(csv);
    int lines = 0;
    for (std::string line; std::getline(table, line);) ++lines;
    CHECK(lines == 13);
}

TEST_CASE("bench: auto is measured too, with the method that it has chosen at each tolerance") {
    const Json result =
        json_of({"bench", scene("kepler"), "--json", "--duration", "0.01", "--method", "auto", "--no-tuning"});
    REQUIRE(result["runs"].size() == 12);
    for (const Json& one : result["runs"]) {
        CHECK(one["method"] == "auto");
        const double tolerance = one["tolerance"];
        const double strict = alembert::machine::can_run() ? 2e-5 : 0.9e-10;
        CHECK(one["chosen"] == (tolerance > 3e-5 ? "rkn86" : tolerance > strict ? "rkn1210" : "taylor"));
        CHECK(one["error"].get<double>() <= tolerance);
    }
}

TEST_CASE("bench: methods for separable systems are left out where the system is not") {
    const auto methods = [](const Json& result) {
        std::set<std::string> names;
        for (const Json& one : result["runs"]) names.insert(one["method"].get<std::string>());
        return names;
    };
    const auto coupled = methods(
        json_of({"bench", scene("double_pendulum_regular"), "--json", "--duration", "0.1", "--budget", "20000"}));
    CHECK(!coupled.contains("kahanli8"));
    CHECK(coupled.contains("gauss"));
    CHECK(coupled.contains("radau"));
    CHECK(methods(json_of({"bench", scene("kepler"), "--json", "--duration", "0.01", "--method", "kahanli8"}))
              .contains("kahanli8"));
}

TEST_CASE("bench: constraints are kept, and their error is reported") {
    const Json result =
        json_of({"bench", scene("cartesian_pendulum"), "--json", "--duration", "10", "--method", "dop853"});
    const Json& end = result["reference"]["text"]["coordinates"];
    // Exact by elliptic functions: the mass at t = 10.
    CHECK(end["x"].get<std::string>().substr(0, 19) == "-0.2750874625761168");
    CHECK(end["y"].get<std::string>().substr(0, 19) == "-0.9614192050991250");
    for (const Json& one : result["runs"]) CHECK(one["constraint_error"].get<double>() < 1e-12);
}

// One step of 5 s and another of 5 s would agree to the last digit. x = cos t.
TEST_CASE("simulate: the second run of a step beyond the duration takes half of the step that was taken") {
    const std::string one =
        temporary("one.toml", "[coordinates]\nx = 1\n[energy]\nkinetic = \"x'^2/2\"\npotential = \"x^2/2\"\n");
    const Json result =
        json_of({"simulate", one, "--json", "--duration", "5", "--method", "rk4", "--step", "100"});
    const double error = std::abs(result["final"]["coordinates"]["x"].get<double>() - std::cos(5));
    CHECK(error > 1);
    CHECK(result["error_estimate"]["value"].get<double>() > error / 30);
    CHECK(result["error_estimate"]["trustworthy"] == false);
}

TEST_CASE("simulate: options that are out of range, or without use for the method, are refused") {
    const std::string one =
        temporary("one.toml", "[coordinates]\nx = 1\n[energy]\nkinetic = \"x'^2/2\"\npotential = \"x^2/2\"\n");
    for (const std::vector<std::string>& more : {std::vector<std::string>{"--duration", "nan"},
                                                 {"--duration", "-1"},
                                                 {"--tolerance", "0"},
                                                 {"--tolerance", "inf"},
                                                 {"--method", "dop853", "--step", "0.1"}}) {
        std::vector<std::string> words{"simulate", one};
        words.insert(words.end(), more.begin(), more.end());
        const auto result = run(words);
        CAPTURE(result.err);
        CHECK(result.exit == 3);
        CHECK(result.err.find(more[more.size() - 2].substr(2)) != std::string::npos);
        CHECK(result.err.size() < 200);
    }
}

// x = 1/(1 − t)² is the motion of x'' = 6 x².
TEST_CASE("bench: if no method reaches the end, the message says what stops them, and where") {
    const std::string pole = temporary("pole.toml",
                                       "[coordinates]\nx = { initial = 1, rate = 2 }\n[energy]\nkinetic = "
                                       "\"x'^2/2\"\npotential = \"-2*x^3\"\n[simulation]\nduration = 2\n");
    const auto result = run({"bench", pole, "--reference-seconds", "0.2"});
    CHECK(result.exit == 4);
    CHECK(result.err.find("no method reaches the end") != std::string::npos);
    const std::size_t at = result.err.find("step size underflow at t = ");
    REQUIRE(at != std::string::npos);
    CHECK(std::stod(result.err.substr(at + 27)) == doctest::Approx(1).epsilon(1e-6));
}

TEST_CASE("simulate: the estimated error is within a factor of 30 of the true one") {
    for (const auto& [name, x, method] : {std::tuple{"kepler", -0.13516647736782103, "dop853"},
                                          std::tuple{"kepler", -0.13516647736782103, "verner98"}}) {
        const Json result =
            json_of({"simulate", scene(name), "--json", "--tolerance", "1e-9", "--method", method});
        const Json& end = result["final"];
        const double error = std::max({std::abs(end["coordinates"]["x"].get<double>() - x),
                                       std::abs(end["coordinates"]["y"].get<double>() + 0.073200184472628027),
                                       std::abs(end["rates"]["x"].get<double>() - 3.3757472100490510) / 3.37,
                                       std::abs(end["rates"]["y"].get<double>() - 0.78449894364958458)});
        const double estimate = result["error_estimate"]["value"];
        CAPTURE(error);
        CAPTURE(estimate);
        CHECK(estimate > error / 30);
        CHECK(estimate < error * 30);
    }
    const Json without = json_of({"simulate", scene("kepler"), "--json", "--no-estimate"});
    CHECK(!without.contains("error_estimate"));
}

// Measured: errors grow 10^6 to 10^7 fold in 10 s, 10^13 in 20 s: an exponent of 1.4 to 1.6.
TEST_CASE("simulate: chaos is reported with its exponent, and the first line of a result without digits says so") {
    const std::string chaotic = scene("double_pendulum_chaotic");
    const Json good = json_of({"simulate", chaotic, "--json"});
    CHECK(good["error_estimate"]["trustworthy"] == true);
    const auto bad = run({"simulate", chaotic, "--duration", "40", "--tolerance", "1e-9"});
    CHECK(bad.exit == 0);
    CHECK(bad.out.starts_with("NOT TRUSTWORTHY"));
    const Json same = json_of({"simulate", chaotic, "--json", "--duration", "40", "--tolerance", "1e-9"});
    const Json& estimate = same["error_estimate"];
    REQUIRE(estimate.contains("lyapunov_exponent"));
    CHECK(estimate["lyapunov_exponent"].get<double>() > 0.7);
    CHECK(estimate["lyapunov_exponent"].get<double>() < 3);
    CHECK(estimate["no_digit_after"].get<double>() > 5);
    CHECK(estimate["no_digit_after"].get<double>() < 30);
    const Json regular = json_of({"simulate", scene("double_pendulum_regular"), "--json"});
    CHECK(!regular["error_estimate"].contains("lyapunov_exponent"));
    CHECK(regular["error_estimate"]["value"].get<double>() < 1e-10);
}

// The time at which runs differ by 0.1 is found in the rows; the estimate uses two other runs of its own.
TEST_CASE(
    "simulate: the time after which no digit is left is the time at which a hundred times stricter run has "
    "parted") {
    const std::string chaotic = scene("double_pendulum_chaotic");
    const auto rows = [&](const std::string& tolerance) {
        const std::string file = temporary("chaos" + tolerance + ".csv", "");
        const Json result = json_of({"simulate", chaotic, "--json", "--duration", "40", "--sample", "0.1",
                                     "--tolerance", tolerance, "-o", file});
        std::ifstream in(file);
        std::vector<std::array<double, 3>> list;
        std::string line;
        for (std::getline(in, line); std::getline(in, line);) {
            std::stringstream cells(line);
            std::array<double, 3> row{};
            char comma = 0;
            cells >> row[0] >> comma >> row[1] >> comma >> row[2];
            list.push_back(row);
        }
        return std::pair(result, list);
    };
    const auto [loose, first] = rows("1e-8");
    const auto [strict, second] = rows("1e-12");
    REQUIRE(first.size() == second.size());
    double parted = 0;
    for (std::size_t k = 0; k < first.size() && parted == 0; ++k)
        for (int i = 1; i <= 2; ++i)
            if (std::abs(first[k][i] - second[k][i]) > 0.1 * std::max(1.0, std::abs(second[k][i])))
                parted = first[k][0];
    CAPTURE(parted);
    REQUIRE(loose["error_estimate"].contains("no_digit_after"));
    CHECK(std::abs(loose["error_estimate"]["no_digit_after"].get<double>() - parted) < 2);
    CHECK(strict["error_estimate"]["no_digit_after"].get<double>() > parted + 2);
    CHECK(loose["warning"].get<std::string>().starts_with("NOT TRUSTWORTHY"));
}

// The true errors are found by comparison with a run of another method at a tolerance three decades stricter,
// whose own error is a hundredth of them or less.
TEST_CASE("simulate: the estimated error is within a factor of 10 of the true one, whatever the scene") {
    for (const char* name : {"kepler", "pleiades", "andrews", "free_body", "car_axis", "stiff_spring_pendulum",
                             "double_pendulum_regular", "four_bars_2"}) {
        CAPTURE(name);
        const Json result =
            json_of({"simulate", scene(name), "--json", "--tolerance", "1e-8", "--method", "dop853"});
        const Json better = json_of(
            {"simulate", scene(name), "--json", "--no-estimate", "--tolerance", "1e-11", "--method", "verner98"});
        double error = 0;
        for (const char* group : {"coordinates", "rates"})
            for (const auto& [key, value] : better["final"][group].items())
                error = std::max(error, std::abs(result["final"][group][key].get<double>() - value.get<double>()) /
                                            std::max(1.0, std::abs(value.get<double>())));
        const double estimate = result["error_estimate"]["value"];
        CAPTURE(error);
        CAPTURE(estimate);
        CHECK(estimate > error / 10);
        CHECK(estimate < error * 10);
    }
}

// The ball first touches the floor at sqrt(2h/g), and the bounces end at sqrt(2h/g)(1 + e)/(1 - e); `error`
// compares these times with those of a strict run.
TEST_CASE("bench: the error of a bouncing ball includes the times of its contacts") {
    const Json result = json_of({"bench", scene("bouncing_ball"), "--json", "--method", "dop853"});
    CHECK(result["reference"]["digits"].get<int>() >= 10);
    REQUIRE(result["runs"].size() == 11);
    CHECK(result["runs"].front()["error"].get<double>() < 1e-2);
    CHECK(result["runs"].back()["error"].get<double>() < 1e-11);
    for (const Json& one : result["runs"]) CHECK(one["seconds"].get<double>() > 0);
}

}  // namespace commands_bench
