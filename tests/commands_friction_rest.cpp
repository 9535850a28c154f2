// SPDX-License-Identifier: MIT
// Motions that come to rest after infinitely many changes of sign in a finite time, against closed forms.
#include <doctest/doctest.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "contacts.hpp"
#include "files.hpp"

namespace commands_friction_rest {

using namespace alembert::test;

TEST_CASE("friction: a mass comes to rest at the bottom of a groove |x| after infinitely many changes of sign") {
    // Between turns x_n and x_(n+1) the forces are −3 sign(x) ∓ 1: |x_(n+1)| = |x_n| (3 − 1)/(3 + 1), and the
    // times are √(2 |x_n|/2) towards the bottom and √(2 |x_(n+1)|/4) away from it.
    const std::string scene = R"toml(
[coordinates]
x = { initial = 0.8 }
[energy]
kinetic = "x'^2/2"
potential = "3*abs(x)"
[[friction]]
name = "rub"
coefficient = 0.5
slip = "x'"
normal = "2"
[simulation]
duration = 10
tolerance = 1e-12
)toml";
    const double ends = (std::sqrt(0.8) + std::sqrt(0.2)) / (1 - std::sqrt(0.5));
    for (const char* method : {"verner98", "taylor", "radau"}) {
        CAPTURE(method);
        const Json motion = simulated(temporary("groove.toml", scene), {"--method", method});
        CHECK(motion["completed"] == true);
        CHECK(std::abs(coordinate(motion, "x")) < 1e-15);
        CHECK(std::abs(rate(motion, "x")) < 1e-15);
        CHECK(std::abs(coordinate(motion, "x")) <= motion["error_estimate"]["value"].get<double>());
        const auto sticks = of_kind(motion, "stick");
        REQUIRE(sticks.size() == 1);
        // What is left after a swing of size a lasts 1.5 √a/(1 − √½); rounding keeps swings from becoming less
        // than 1e-10.
        CHECK(std::abs(value(sticks[0], "time") - ends) < 6e-5);
        CHECK(motion["evaluations"].get<long>() < 20'000);
    }
}

TEST_CASE("signs: the twisting controller brings a mass to rest in the finite time of its closed form") {
    // x'' = −3 sign(x) − sign(x'): from the first turn the same as above, with 2 and 4 in turn.
    const std::string scene = R"toml(
[coordinates]
x = { initial = 1, rate = 0.3 }
[energy]
kinetic = "x'^2/2"
[forces]
x = "-3*sign(x) - sign(x')"
[simulation]
duration = 10
tolerance = 1e-12
)toml";
    const double turn = 1 + 0.3 * 0.3 / 8;
    const double ends = 0.3 / 4 + (std::sqrt(turn) + std::sqrt(turn) / 2) / (1 - std::sqrt(0.5));
    for (const char* method : {"dop853", "taylor"}) {
        CAPTURE(method);
        const Json motion = simulated(temporary("twisting.toml", scene), {"--method", method});
        CHECK(motion["completed"] == true);
        CHECK(std::abs(coordinate(motion, "x")) < 1e-15);
        double last = 0;
        for (const Json& change : motion["switches"]) last = std::max(last, change["time"].get<double>());
        CHECK(std::abs(last - ends) < 6e-5);
        CHECK(motion["switches"].size() < 200);
    }
}

}  // namespace commands_friction_rest
