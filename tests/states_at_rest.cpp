// SPDX-License-Identifier: MIT
// Equilibrium, stability and the questions about constraints for scenes with first-order states, compared with
// other coordinates for the same system and with linear algebra by hand.
#include <doctest/doctest.h>

#include <fmt/format.h>

#include <cmath>

#include "json.hpp"
#include "program.hpp"
#include "scenes.hpp"

namespace states_at_rest {

using namespace alembert::test;

namespace {

const char* const loads = R"toml(
[parameters]
g = 9.81
m = 2
F = 5
d = 0.3
[states]
l = { rate = "0.5*(1 - l) + 0.7*x + 0.2*y*l", initial = 1 }
[[particle]]
name = "p"
mass = "m"
position = ["x", "y"]
[energy]
potential = "m*g*y - F*x"
[dissipation]
rayleigh = "d*(x'^2 + y'^2)/2"
)toml";

std::string on_rope() {
    return temporary("rope.toml", std::string(loads) + R"toml(
[coordinates]
x = { guess = 0.4 }
y = { guess = -0.9 }
[[constraint]]
name = "rope"
holonomic = "x^2 + y^2 = l^2"
)toml");
}

std::string by_angle() {
    return temporary("angle.toml", std::string(loads) + R"toml(
[coordinates]
theta = 0.3
[definitions]
x = "l*sin(theta)"
y = "-l*cos(theta)"
)toml");
}

Json found(const std::vector<std::string>& words) {
    const Run result = run(words);
    INFO(result.err);
    REQUIRE(result.exit < 3);
    return Json::parse(result.out);
}

std::string verdict(const std::vector<std::string>& rates) {
    std::string text = "[states]\n";
    int k = 0;
    for (const std::string& rate : rates) text += fmt::format("z{} = {{ rate = \"{}\" }}\n", ++k, rate);
    return found({"stability", temporary("linear.toml", text), "--json"})["verdict"];
}

}  // namespace

// x = l sin θ, y = −l cos θ: the same four states of rest, and the same three eigenvalues at each.
TEST_CASE("rest with states: a constraint that moves with a state has the equilibria of independent coordinates") {
    const Json rope = found({"equilibrium", on_rope(), "--json"})["equilibria"],
               angle = found({"equilibrium", by_angle(), "--json"})["equilibria"];
    REQUIRE(rope.size() == 4);
    REQUIRE(angle.size() == 4);
    for (const Json& one : angle) {
        const double theta = one["coordinates"]["theta"], l = one["states"]["l"], x = l * std::sin(theta),
                     y = -l * std::cos(theta);
        int alike = 0;
        for (const Json& other : rope)
            if (std::abs(other["coordinates"]["x"].get<double>() - x) < 1e-12 &&
                std::abs(other["coordinates"]["y"].get<double>() - y) < 1e-12) {
                ++alike;
                CHECK(other["stable"] == one["stable"]);
            }
        CHECK(alike == 1);
        const auto near = [](const std::string& scene, const std::vector<std::string>& at) {
            std::vector<std::string> words{"stability", scene, "--json"};
            for (const std::string& value : at) words.insert(words.end(), {"--at", value});
            return found(words)["eigenvalues"];
        };
        const Json a = near(by_angle(), {fmt::format("theta={:.17g}", theta), fmt::format("l={:.17g}", l)}),
                   b = near(on_rope(), {fmt::format("x={:.17g}", x), fmt::format("y={:.17g}", y),
                                        fmt::format("l={:.17g}", l)});
        REQUIRE(a.size() == 3);
        for (std::size_t k = 0; k < 3; ++k)
            for (const int part : {0, 1})
                CHECK(std::abs(a[k][part].get<double>() - b[k][part].get<double>()) < 1e-11);
    }
}

// z − z³ = 0 with w = z; a mode stays as it is given.
TEST_CASE("rest with states: all values of states at rest are found, with and without coordinates") {
    const std::string scene = temporary("cubic.toml", R"toml(
[states]
z = { rate = "z - z^3 + n" }
n = { initial = 0 }
w = { rate = "z - w" }
)toml");
    const Json list = found({"equilibrium", scene, "--json"})["equilibria"];
    REQUIRE(list.size() == 3);
    for (std::size_t k = 0; k < 3; ++k) {
        CHECK(std::abs(list[k]["states"]["z"].get<double>() - (static_cast<double>(k) - 1)) < 1e-14);
        CHECK(list[k]["states"]["w"] == list[k]["states"]["z"]);
        CHECK(list[k]["states"]["n"] == 0);
        CHECK(list[k]["stable"] == (k == 1 ? "no" : "yes"));
    }
    const Json moved = found({"equilibrium", scene, "--at", "n=6", "--json"})["equilibria"];  // z³ − z = 6 at 2
    REQUIRE(moved.size() == 1);
    CHECK(std::abs(moved[0]["states"]["z"].get<double>() - 2) < 1e-14);
}

TEST_CASE("rest with states: linear equations are decided by their eigenvalues and Jordan blocks") {
    CHECK(verdict({"-z1", "z1 - z2", "z2 - z3"}) == "asymptotically stable");
    CHECK(verdict({"-z2", "z1", "0"}) == "stable");                   // a circle
    CHECK(verdict({"0", "z1"}) == "unstable");                        // z2 = t z1
    CHECK(verdict({"-z2", "z1", "-z4 + z1", "z3"}) == "unstable");    // driven at its own frequency
    CHECK(verdict({"-z2", "z1", "-2*z4 + z1", "2*z3"}) == "stable");  // beside it: √(2·2) against 1
    const std::string driven = temporary("driven.toml", R"toml(
[coordinates]
x = 0
[states]
z1 = { rate = "-z2" }
z2 = { rate = "z1" }
[energy]
kinetic = "x'^2/2"
potential = "k*x^2/2"
[parameters]
k = 4
[forces]
x = "z1 + z2'"
)toml");
    CHECK(found({"stability", driven, "--json"})["verdict"] == "stable");
    CHECK(found({"stability", driven, "--at", "k=1", "--json"})["verdict"] == "unstable");
}

TEST_CASE("rest with states: Lyapunov functions are judged where the equations hold states, but not time") {
    const std::string scene = temporary("lag.toml", R"toml(
[parameters]
a = 1
[states]
z1 = { rate = "-a*z1" }
z2 = { rate = "z1 - a*z2 - z2^3" }
)toml");
    const Json proved = found({"stability", scene, "--lyapunov", "z1^2 + z2^2", "--json"});
    CHECK(proved["verdict"] == "asymptotically stable");
    CHECK(proved["theorem"].get<std::string>().find("Lyapunov") != std::string::npos);
    const Run in_time = run({"stability", temporary("time.toml", "[states]\nz = { rate = \"-z*(2 + sin(t))\" }\n"),
                             "--lyapunov", "z^2"});
    CHECK(in_time.exit == 3);
}

TEST_CASE("rest with states: questions about constraints and loads of a scene of states alone") {
    const std::string scene = temporary("alone.toml", "[states]\nz = { rate = \"-z\" }\n");
    CHECK(found({"audit", scene, "--json"})["degrees_of_freedom"] == 0);
    const Run loads_of = run({"eval", scene, "--inverse"});
    CHECK(loads_of.exit == 3);
    CHECK(loads_of.err.find("states alone") != std::string::npos);
}

TEST_CASE("rest with states: claims about their rates say what they follow from, and --at says what they are") {
    const std::string coupled = temporary("coupled.toml", R"toml(
[coordinates]
x = 1
[states]
z = { rate = "x - z" }
[energy]
kinetic = "x'^2/2"
potential = "x^2"
[forces]
x = "z"
[[claim]]
equation = "z' = x - z"
[[claim]]
equation = "(z^2)' = 2*z*(x - z)"
[[claim]]
equation = "x'' + 2*x = z"
)toml"),
                      alone = temporary("alone.toml",
                                        "[states]\nz = { rate = \"-z\" }\n[[claim]]\n"
                                        "equation = \"z' = -z\"\n");
    const Json judged = found({"check", coupled, "--json"});
    for (const int k : {0, 1})
        CHECK(judged["claims"][k]["reason"] == "it follows from the rates of the states, which the scene gives");
    CHECK(run({"check", coupled})
              .out.find("With the constraints and the rates of the states, the claims that hold "
                        "determine the motion.") != std::string::npos);
    CHECK(run({"check", alone, "--complete"}).exit == 0);
    CHECK(run({"check", alone}).out.find("the scene has states alone") != std::string::npos);
    const Run rate = run({"eval", coupled, "--at", "z'=3"}), none = run({"eval", coupled, "--at", "q=3"});
    CHECK(rate.exit == 3);
    CHECK(rate.err.find("the scene gives the rate of the state 'z'") != std::string::npos);
    CHECK(none.err.find("is no coordinate, rate, state, parameter or t") != std::string::npos);
}

// At φ = n p the pawl's force has a kink: the slopes are k and 0.
TEST_CASE("rest with states: a kink at which states stand too is told with the function that has it") {
    const Run kink = run({"stability", temporary("kink.toml", R"toml(
[coordinates]
phi = 0
[states]
n = { rate = "-n" }
[energy]
kinetic = "phi'^2/2"
[forces]
phi = "-3*min(0, phi - n)"
)toml")});
    CHECK(kink.exit == 3);
    CHECK(kink.err.find("min(0,phi-n)") != std::string::npos);
}

}  // namespace states_at_rest
