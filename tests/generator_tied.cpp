// SPDX-License-Identifier: MIT
// Rows that depend on each other so that each of them is needed at some pose, against the same mechanism with
// independent constraints, and against itself turned by an angle that changes nothing.
#include <doctest/doctest.h>

#include <Eigen/Dense>
#include <numbers>

#include "alembert/batch/packs.hpp"
#include "alembert/native/compile.hpp"
#include "codegen/emit/emit.hpp"
#include "codegen/machine/memory_solver.hpp"
#include "redundant_plate.hpp"
#include "scenes.hpp"
#include "simulate/emission.hpp"
#include "simulate/evaluate.hpp"
#include "simulate/simulate.hpp"

namespace generator_tied {

using namespace alembert;
using std::numbers::pi;

namespace {

const double headings[] = {0,   0.3, pi / 4,     1.5,     pi / 2 - 1e-5, pi / 2 - 1e-8, pi / 2, pi / 2 + 1e-11,
                           2.5, pi,  3 * pi / 2, -pi / 2, -0.1};

std::string replaced(std::string text, const std::string& from, const std::string& to) {
    const std::size_t at = text.find(from);
    REQUIRE(at != std::string::npos);
    return text.replace(at, from.size(), to);
}

/// The cart of test::redundant_wheels, whose wheels roll by three constraints that are independent at every
/// heading.
std::string cart_in_its_own_axes() {
    std::string text = test::redundant_wheels;
    const std::size_t from = text.find("[[rolling]]"), to = text.find("[[torque]]");
    return text.replace(
        from, to - from,
        "[[constraint]]\nname = \"side\"\nnonholonomic = \"y'*cos(th) - x'*sin(th)\"\n"
        "[[constraint]]\nname = \"left_rolls\"\nnonholonomic = \"x'*cos(th) + y'*sin(th) - h*th' - "
        "r*w1'\"\n"
        "[[constraint]]\nname = \"right_rolls\"\nnonholonomic = \"x'*cos(th) + y'*sin(th) + h*th' "
        "- r*w2'\"\n");
}

/// Rates that let both wheels roll, with a speed of 0.5 m/s and a turn of 0.7 rad/s.
Overrides rolling_at(double th) {
    const double v = 0.5, turn = 0.7, r = 0.1, h = 0.25;
    return {{"x", 0.2},  {"y", -0.4},  {"th", th},    {"x'", v * std::cos(th)},    {"y'", v * std::sin(th)},
            {"w1", 0.1}, {"w2", -0.6}, {"th'", turn}, {"w1'", (v - h * turn) / r}, {"w2'", (v + h * turn) / r}};
}

double largest_difference(const std::vector<double>& a, const std::vector<double>& b) {
    double largest = 0;
    REQUIRE(a.size() == b.size());
    for (std::size_t i = 0; i < a.size(); ++i) largest = std::max(largest, std::abs(a[i] - b[i]));
    return largest;
}

double value_of(const Evaluation& e, const std::string& multiplier) {
    for (const auto& [name, value] : e.multipliers)
        if (name == multiplier) return value;
    FAIL("no multiplier of this name");
    return 0;
}

/// (λ_x, λ_y) of a rolling condition, along axes that are turned by this angle.
Eigen::Vector2d force(const Evaluation& e, const std::string& rolling, double angle) {
    return Eigen::Rotation2Dd(-angle) *
           Eigen::Vector2d(value_of(e, "lambda_" + rolling + "_x"), value_of(e, "lambda_" + rolling + "_y"));
}

}  // namespace

TEST_CASE("tied: a cart with two wheels accelerates at every heading as with independent constraints") {
    const Scene wheels = parse_scene(test::redundant_wheels, "wheels.toml"),
                own = parse_scene(cart_in_its_own_axes(), "own.toml");
    for (const double th : headings) {
        CAPTURE(th);
        const Overrides at = rolling_at(th);
        const Evaluation a = evaluate(wheels, {.at = at}), b = evaluate(own, {.at = at});
        CHECK(largest_difference(a.accelerations, b.accelerations) < 1e-11);
    }
    // At rest in turning: the values of the scene's own torques, by hand.
    const double v = 0.5;
    for (const double th : headings) {
        CAPTURE(th);
        const Evaluation e = evaluate(wheels, {.at = {{"th", th},
                                                      {"th'", 0},
                                                      {"x'", v * std::cos(th)},
                                                      {"y'", v * std::sin(th)},
                                                      {"w1'", v / 0.1},
                                                      {"w2'", v / 0.1}}});
        // J th'' = h (F2 - F1) and m v' = F1 + F2 with the forces F at the wheels, T - r F = mw r²/2 w''.
        const double mass = 5 + 2 * 0.3, spin = 0.3 * 0.01 / 2, turn = 0.25 + 2 * (0.3 * 0.01 / 4 + 0.3 * 0.0625);
        const double forward = (0.2 + 0.3) / 0.1 / (mass + 2 * spin / 0.01),
                     turning = 0.25 / 0.1 * (0.3 - 0.2) / (turn + 2 * spin * 0.0625 / 0.01);
        CHECK(e.accelerations[2] == doctest::Approx(turning).epsilon(1e-12));
        CHECK(e.accelerations[4] == doctest::Approx((forward + 0.25 * turning) / 0.1).epsilon(1e-12));
    }
}

TEST_CASE("tied: the forces on the wheels turn with the cart, and are the least") {
    const Scene wheels = parse_scene(test::redundant_wheels, "wheels.toml");
    const Evaluation first = evaluate(wheels, {.at = rolling_at(0)});
    for (const double th : headings) {
        CAPTURE(th);
        const Evaluation e = evaluate(wheels, {.at = rolling_at(th)});
        for (const char* rolling : {"rl", "rr"})
            CHECK((force(e, rolling, th) - force(first, rolling, 0)).norm() < 1e-11);
        // Forces along the axle that are opposite change nothing: the least are equal.
        CHECK(force(e, "rl", th)[1] == doctest::Approx(force(e, "rr", th)[1]).epsilon(1e-11));
    }
}

TEST_CASE("tied: compiled code, code in memory and packs of a cart hold at every heading") {
    const Emission e = emission(parse_scene(test::redundant_wheels, "wheels.toml"), {.jacobian = true});
    const Scene own = parse_scene(cart_in_its_own_axes(), "own.toml");
    std::vector<Module> modules{load(compile(e.source.text, "wheels", {}).object)};
    if (const auto solver = memory_solver(e.choice.program)) modules.push_back(solver->module);
    for (const Module& module : modules) {
        const std::vector<double> par = prepared(module);
        for (const double th : headings) {
            CAPTURE(th);
            const Evaluation expected = evaluate(own, {.at = rolling_at(th)});
            std::vector<double> state = expected.q, rate(10);
            state.insert(state.end(), expected.rates.begin(), expected.rates.end());
            module.table().rhs(0, state.data(), par.data(), rate.data());
            CHECK(largest_difference({rate.begin() + 5, rate.end()}, expected.accelerations) < 1e-11);
        }
    }
}

TEST_CASE("tied: a cart that is steered to a heading of 90 degrees drives there as with independent constraints") {
    const auto with_steering = [](const std::string& text) {
        std::string result =
            replaced(text, "[[frame]]", "[definitions]\nu = \"2*(pi/2 - th) - 1.2*th'\"\n[[frame]]");
        result = replaced(result, "[0,\"T1\",0]", "[0,\"0.1 - u\",0]");
        return replaced(result, "[0,\"T2\",0]", "[0,\"0.1 + u\",0]");
    };
    for (const char* method : {"auto", "taylor", "dop853", "radau"}) {
        CAPTURE(method);
        RunOptions wishes{.method = method};
        wishes.duration = 30;
        const Run a = simulate(parse_scene(with_steering(test::redundant_wheels), "wheels.toml"), wishes),
                  b = simulate(parse_scene(with_steering(cart_in_its_own_axes()), "own.toml"), wishes);
        REQUIRE_FALSE(a.failure.has_value());
        CHECK(largest_difference(a.final_coordinates, b.final_coordinates) < 1e-5);
        REQUIRE(a.estimate.has_value());
        CHECK(a.estimate->value.value_or(1) < 1e-5);
    }
}

TEST_CASE("tied: the forces at the teeth of planets turn with their carrier") {
    const auto scene = parse_scene(R"toml(
[parameters]
rs = 0.05
rp = 0.03
[coordinates]
s = { initial = 0, rate = 0 }
a = { initial = 0.3 }
p1 = { initial = 0 }
p2 = { initial = 0 }
[[frame]]
name = "S"
rotate = [["z", "s"]]
[[frame]]
name = "C"
rotate = [["z", "a"]]
[[frame]]
name = "P1"
rotate = [["z", "p1"]]
[[frame]]
name = "P2"
rotate = [["z", "p2"]]
[[body]]
name = "sun"
mass = 1
inertia = 0.002
frame = "S"
position = [0, 0]
[[body]]
name = "carrier"
mass = 1
inertia = 0.003
frame = "C"
position = [0, 0]
[[body]]
name = "first"
mass = 0.4
inertia = 0.0002
frame = "P1"
position = ["(rs+rp)*cos(a)", "(rs+rp)*sin(a)"]
[[rolling]]
name = "ring1"
body = "first"
contact = ["rp*cos(a)", "rp*sin(a)"]
[[rolling]]
name = "mesh1"
body = "first"
on = "sun"
contact = ["-rp*cos(a)", "-rp*sin(a)"]
[[body]]
name = "second"
mass = 0.4
inertia = 0.0002
frame = "P2"
position = ["-(rs+rp)*sin(a)", "(rs+rp)*cos(a)"]
[[rolling]]
name = "ring2"
body = "second"
contact = ["-rp*sin(a)", "rp*cos(a)"]
[[rolling]]
name = "mesh2"
body = "second"
on = "sun"
contact = ["rp*sin(a)", "-rp*cos(a)"]
[[torque]]
on = "sun"
vector = 1.0
)toml",
                                   "planets.toml");
    const auto at = [&](double a) {
        return evaluate(scene, {.at = {{"a", a}, {"s'", 9.6}, {"a'", 3}, {"p1'", -8}, {"p2'", -8}}});
    };
    const Evaluation first = at(0.3);
    for (const double a : headings) {
        CAPTURE(a);
        const Evaluation e = at(a);
        CHECK(largest_difference(e.accelerations, first.accelerations) < 1e-9);
        for (const char* rolling : {"ring1", "mesh1", "ring2", "mesh2"})
            CHECK((force(e, rolling, a) - force(first, rolling, 0.3)).norm() < 1e-9);
    }
}

}  // namespace generator_tied
