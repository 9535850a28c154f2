// SPDX-License-Identifier: MIT
// cvode and ida through contacts, and ida through friction with constraints: against closed forms, and against
// dop853 at a tighter tolerance.
#include <doctest/doctest.h>

#include <cmath>
#include <string>
#include <vector>

#include "contacts.hpp"
#include "tools.hpp"

namespace commands_sundials {

using namespace alembert::test;

namespace {

std::string friction(const std::string& name) {
    return source_path("scenes/friction/" + name + ".toml");
}

const std::vector<std::string> both = {"cvode", "ida"};

}  // namespace

// Between impacts y is a polynomial of degree 2, which the methods follow from their second order on; the first
// steps of each piece have local errors below the tolerance 1e-11, and there are some ten of them. Of bounces that
// are not higher than that nothing is known: they take the time 2 √(2 h/g)/(1 − e) together.
TEST_CASE("sundials: a ball bounces at the times of the closed form, and comes to rest") {
    if (!has_part("alembert-sundials.so")) return;
    const double fall = std::sqrt(2 / g), e = 0.7, off = 1e-8;
    for (const std::string& method : both) {
        CAPTURE(method);
        const Json motion = simulated(source_path("scenes/textbook/bouncing_ball.toml"), {"--method", method});
        CHECK(motion["method"] == method);
        const auto hits = of_kind(motion, "impact");
        REQUIRE(hits.size() > 20);
        double time = fall, flight = 2 * e * fall;
        for (std::size_t k = 0; k < 12; ++k) {
            CHECK(std::abs(value(hits[k], "time") - time) < off);
            time += flight;
            flight *= e;
        }
        const auto rest = of_kind(motion, "rest");
        REQUIRE(rest.size() == 1);
        CHECK(std::abs(value(rest[0], "time") - fall * (1 + e) / (1 - e)) <
              2 * std::sqrt(2 * 1e-10 / g) / (1 - e));
        CHECK(std::abs(coordinate(motion, "y")) < off);
    }
}

// The ball slides until t = 2 v0/(7 mu g), then rolls with 5/7 of its speed: the friction acts on the reaction of
// a contact, which is a constraint of its mode.
TEST_CASE("sundials: a billiard ball begins to roll at the time of the closed form") {
    if (!has_part("alembert-sundials.so")) return;
    for (const std::string& method : both) {
        CAPTURE(method);
        const Json motion = simulated(friction("billiard_ball"), {"--method", method, "--tolerance", "1e-10"});
        const auto sticks = of_kind(motion, "stick");
        REQUIRE(sticks.size() == 1);
        CHECK(std::abs(value(sticks[0], "time") - 2 * 2.0 / (7 * 0.2 * g)) < 1e-8);
        CHECK(std::abs(rate(motion, "x") - 5.0 / 7 * 2) < 1e-8);
        CHECK(std::abs(coordinate(motion, "y") - 0.028575) < 1e-9);
    }
}

// dop853 at 1e-12 is right to about 1e-11. Methods of orders up to 5 at 1e-10 take some hundred steps, whose
// errors add up.
TEST_CASE("sundials: contacts, impacts with friction, sticking and slipping are those of dop853") {
    if (!has_part("alembert-sundials.so")) return;
    std::vector<std::string> scenes{source_path("scenes/textbook/slack_pendulum.toml")};
    for (const char* const name : {"block_on_slope", "trammel", "spinning_ball", "rocking_block", "falling_tripod",
                                   "belt_blocks", "superball"})
        scenes.push_back(friction(name));
    for (const std::string& scene : scenes) {
        const Json exact = simulated(scene, {"--method", "dop853", "--tolerance", "1e-12"});
        for (const std::string& method : both) {
            const Json motion = simulated(scene, {"--method", method, "--tolerance", "1e-10"});
            CAPTURE(scene);
            CAPTURE(method);
            REQUIRE(motion["contacts"].size() == exact["contacts"].size());
            for (std::size_t k = 0; k < exact["contacts"].size(); ++k) {
                const Json &event = motion["contacts"][k], &other = exact["contacts"][k];
                CHECK(event["event"] == other["event"]);
                CHECK(event["name"] == other["name"]);
                CHECK(std::abs(value(event, "time") - value(other, "time")) < 1e-6);
            }
            for (const auto& [name, number] : exact["final"]["coordinates"].items())
                CHECK(std::abs(coordinate(motion, name.c_str()) - number.get<double>()) < 1e-6);
        }
    }
}

}  // namespace commands_sundials
