// SPDX-License-Identifier: MIT
// Whole runs against references of higher precision: tests/reference/double_pendulum.py (Taylor series in 60-digit
// decimal arithmetic; its two runs agree to 1e-49 and 1e-57).
#include <doctest/doctest.h>

#include <array>
#include <cmath>
#include <nlohmann/json.hpp>

#include "json.hpp"
#include "program.hpp"
#include "scenes.hpp"

namespace commands_accuracy {

using alembert::test::Json;
using alembert::test::json_of;
using alembert::test::run;
using alembert::test::source_path;

namespace {

// double_pendulum.py 2 2.5 10 4000
constexpr std::array chaotic{-0.753128874294911353223357535590158, 1.627933082053704084089166810917118,
                             -4.087368851344196933636715656350413, -8.869702578387532608722507158526325};
// double_pendulum.py 0.1 0.2 10
constexpr std::array regular{0.039779782745713516062980828117451, 0.070595183251635647111309249798902,
                             0.385134598145132234527361345726697, 0.214004028911156241008800065274654};

struct Outcome {
    double error, drift;
};

Outcome simulated(const std::string& scene, const std::string& tolerance, const std::array<double, 4>& reference) {
    const auto result = run({"simulate", source_path(scene), "--json", "--tolerance", tolerance});
    REQUIRE(result.exit == 0);
    const Json json = Json::parse(result.out);
    const Json& end = json["final"];
    const std::array found{end["coordinates"]["theta1"].get<double>(), end["coordinates"]["theta2"].get<double>(),
                           end["rates"]["theta1"].get<double>(), end["rates"]["theta2"].get<double>()};
    double error = 0;
    for (std::size_t i = 0; i < 4; ++i) error = std::max(error, std::abs(found[i] - reference[i]));
    return {error, json["energy_drift"].get<double>()};
}

}  // namespace

// The local error of each component is at most the tolerance; until t = 10 errors grow 10⁷-fold.
TEST_CASE("commands: the chaotic double pendulum at t = 10 is within what its error growth allows") {
    const Outcome at_13 = simulated("scenes/benchmark/double_pendulum_chaotic.toml", "1e-13", chaotic);
    CAPTURE(at_13.error);
    CHECK(at_13.error < 1e-4);
    CHECK(at_13.drift < 1e-11);
    const Outcome at_14 = simulated("scenes/benchmark/double_pendulum_chaotic.toml", "1e-14", chaotic);
    CAPTURE(at_14.error);
    CHECK(at_14.error < 1e-5);
    CHECK(at_14.drift < 1e-11);
}

// There is no exponential growth here: a few hundred steps have errors of at most 1e-13 each.
TEST_CASE("commands: the regular double pendulum is within 1e-11 of 30 digits at t = 10") {
    const Outcome outcome = simulated("scenes/benchmark/double_pendulum_regular.toml", "1e-13", regular);
    CAPTURE(outcome.error);
    CHECK(outcome.error < 1e-11);
    CHECK(outcome.drift < 1e-11);
}

// The fastest formalism runs, without the derivation of the others; the one that a teacher would choose is shown.
TEST_CASE(
    "commands: a tree of many bodies runs by the recursion at once, accelerates as by Lagrange, and is shown by "
    "Lagrange") {
    const std::string scene = source_path("scenes/benchmark/trees/pend16.toml");
    const Json own = json_of({"eval", scene, "--json"}),
               lagrange = json_of({"eval", scene, "--json", "--by", "lagrange"});
    double largest = 0;
    for (const auto& [name, value] : lagrange["accelerations"].items())
        largest = std::max(largest, std::abs(value.get<double>()));
    for (const auto& [name, value] : lagrange["accelerations"].items())
        CHECK(std::abs(own["accelerations"][name].get<double>() - value.get<double>()) < 1e-11 * largest);
    CHECK(json_of({"emit", scene, "--json", "-o", alembert::test::temporary("emitted", "") + ".d"})["formulation"]
              .get<std::string>()
              .starts_with("recursive"));
    CHECK(json_of({"derive", scene, "--json"})["formalism"] == "lagrange");
}

}  // namespace commands_accuracy
