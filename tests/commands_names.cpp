// SPDX-License-Identifier: MIT
// The names of the geometry's functions are names of quantities wherever no parenthesis follows.
#include <doctest/doctest.h>

#include <nlohmann/json.hpp>
#include <string>
#include <utility>
#include <vector>

#include "program.hpp"

namespace commands_names {

using alembert::test::run;
using alembert::test::temporary;
using Json = nlohmann::json;

namespace {

/// A disc on a spring whose support turns: #1 … #6 stand where the names of its quantities come.
std::string scene_with(const std::vector<std::string>& names) {
    std::string text = R"toml(
[parameters]
#1 = 2.0
#2 = { value = 3.0, unit = "kg m^2" }
[inputs]
#3 = "cos(t)"
[coordinates]
#4 = 0.3
[definitions]
#5 = "#4 + #3*#1"
[[frame]]
name = "B"
rotate = [["z", "#5"]]
[[body]]
name = "R"
at = "O"
frame = "B"
mass = 1
inertia = "#2"
[forces]
#4 = "-#1*#5^2 - #3'*#4"
[outputs]
w = "dot(omega(B), ez(N)) - #5'"
[[claim]]
equation = "#2*(#5)'' = -#1*#5^2 - #3'*#4"
)toml";
    for (std::size_t k = 0; k < names.size(); ++k) {
        const std::string key = "#" + std::to_string(k + 1);
        for (std::size_t at = text.find(key); at != std::string::npos; at = text.find(key))
            text.replace(at, key.size(), names[k]);
    }
    return temporary("names.toml", text);
}

}  // namespace

TEST_CASE(
    "commands: parameters, inputs, coordinates and definitions may have the names of the geometry's functions") {
    const std::string plain = scene_with({"a", "b", "c", "q", "d"});
    const auto reference = run({"eval", plain, "--json", "--at", "t=1"});
    REQUIRE(reference.exit == 0);
    const double expected = Json::parse(reference.out)["accelerations"]["q"];
    const std::vector<std::string> free{"omega", "ex", "ey", "alpha", "pos", "vel", "dot", "norm", "cross", "ez"};
    for (std::size_t k = 0; k < free.size(); ++k) {
        const auto name = [&](std::size_t i) { return free[(k + i) % free.size()]; };
        const std::string scene = scene_with({name(0), name(1), name(2), name(3), name(4)});
        const auto result = run({"eval", scene, "--json", "--at", "t=1"});
        INFO(result.err);
        REQUIRE(result.exit == 0);
        const Json json = Json::parse(result.out);
        CHECK(json["accelerations"][name(3)].get<double>() == expected);
        CHECK(json["outputs"]["w"].get<double>() == doctest::Approx(0).epsilon(1e-14));
        CHECK(run({"check", scene}).exit == 0);
    }
    const std::string last = scene_with({"omega", "ex", "vel", "pos", "norm"});
    CHECK(run({"agree", last}).exit == 0);
    CHECK(run({"simulate", last, "--duration", "0.1"}).exit == 0);
    // What derive prints is a claim again.
    const auto derived = run({"derive", last, "--json"});
    REQUIRE(derived.exit == 0);
    const std::string claims = temporary("names.claims", Json::parse(derived.out)["equations"][0]["text"]);
    CHECK(run({"check", last, claims}).exit == 0);
}

TEST_CASE("commands: a geometric function without its parenthesis is recognized in the message") {
    const auto result = run({"derive", temporary("nameless.toml", R"toml(
[coordinates]
x = 0
[energy]
kinetic = "x'^2/2"
potential = "omega*x + (vel'(O))"
)toml")});
    CHECK(result.exit == 3);
    CHECK(result.err.find("a function has no prime") != std::string::npos);
    const auto plain = run({"derive", temporary("nameless.toml", R"toml(
[coordinates]
x = 0
[energy]
kinetic = "x'^2/2"
potential = "omega*x"
)toml")});
    CHECK(plain.err.find("unknown name 'omega'") != std::string::npos);
    CHECK(plain.err.find("omega(B)") != std::string::npos);
}

}  // namespace commands_names
