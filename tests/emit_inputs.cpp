// SPDX-License-Identifier: MIT
// Inputs that are given from outside: arguments of emitted functions, functions of time of a run, columns of B.
#include <doctest/doctest.h>
#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "analysis/state/given_functions.hpp"
#include "emitted.hpp"
#include "files.hpp"
#include "near.hpp"
#include "scene/scene.hpp"
#include "simulate/emission.hpp"
#include "simulate/evaluate.hpp"
#include "simulate/fmu/unit.hpp"
#include "simulate/simulate.hpp"

namespace emit_inputs {

using namespace alembert;

namespace {

constexpr const char* cart_text = R"toml(gravity = [0, "-g"]
[parameters]
m = { value = 0.3, unit = "kg" }
l = { value = 500, unit = "mm" }
g = 9.81
[inputs]
F = { value = 0.5, unit = "N", about = "of the motor", given = "outside" }
wind = "0.1*sin(2*t)"
brake = { value = 20, unit = "mN*m", given = "outside" }
[coordinates]
x = { initial = 0, unit = "m" }
theta = { initial = 0.15, rate = 0.3, unit = "rad" }
[[particle]]
name = "cart"
mass = 1
position = ["x", 0]
[[particle]]
name = "bob"
mass = "m"
position = ["x + l*sin(theta)", "l*cos(theta)"]
[[force]]
at = "cart"
vector = ["F*(1 + l*g) + wind", 0]
[forces]
theta = "-brake*theta'"
[outputs]
pushed = "F*x'"
[simulation]
duration = 2
)toml";

Scene cart(const std::string& name = "cart.toml") {
    return parse_scene(cart_text, name);
}

/// Coordinates' accelerations with these values of F [N] and brake [N m].
std::vector<double> accelerations(double F, double brake) {
    const Evaluation e = evaluate(cart(), {.at = {{"F", F}, {"brake", brake}}});
    return e.accelerations;
}

void write(const test::Folder& folder, const EmissionOptions& options) {
    for (const SourceFile& file : files_of(emission(cart(), options))) folder.write(file.name, file.text);
}

constexpr const char* strict = "-Wall -Wextra -Wpedantic -Wconversion -Wshadow -Werror";

}  // namespace

TEST_CASE("emit: inputs from outside are arguments of all functions, in C++, C and JavaScript") {
    std::vector<double> wanted = accelerations(2, 0.05);
    const std::vector<double> as_given = accelerations(0.5, 0.02);
    wanted.insert(wanted.end(), as_given.begin(), as_given.end());
    const test::Folder folder;
    for (const bool batch : {false, true}) {
        write(folder, {.jacobian = true, .batch = batch, .functions = {"inverse"}});
        folder.write("main.cpp", R"(#include <cstdio>
#include "cart.hpp"
int main() {
    const cart::Parameters par = cart::defaults();
    cart::Inputs given;
    for (int k = 0; k < 2; ++k) {
        if (k == 0) given.F = 2, given.brake = 0.05; else given = cart::Inputs();
        const cart::State rate = cart::rhs(0, cart::initial_state, par, given);
        std::printf("%.17g\n%.17g\n", rate.x_dot, rate.theta_dot);
    }
}
)");
        test::check_near(
            folder.numbers(fmt::format(
                "c++ -std=c++17 {} -Wno-unused-parameter main.cpp cart.cpp -o program && ./program", strict)),
            wanted, 1e-13);
    }
    write(folder, {.language = CodeLanguage::c});
    folder.write("main.c", R"(#include <stdio.h>
#include "cart.h"
int main(void) {
    const double state[] = {0, 0.15, 0, 0.3}, given[2][cart_inputs] = {{2, 0.05}, {0.5, 0.02}};
    double par[cart_par], rate[cart_state];
    cart_defaults(par);
    for (int k = 0; k < 2; ++k) {
        cart_rhs(0, state, par, given[k], rate);
        printf("%.17g\n%.17g\n", rate[2], rate[3]);
    }
    return 0;
}
)");
    test::check_near(
        folder.numbers(fmt::format("cc -std=c99 {} main.c cart.c -lm -o program && ./program", strict)), wanted,
        1e-13);
    const std::string module = emission(cart(), {.language = CodeLanguage::javascript}).source.text;
    CHECK(module.find("export function rhs(t, state, par, inputs, rate)") != std::string::npos);
    CHECK(module.find("export const input_names = [\"F\", \"brake\"]") != std::string::npos);
}

TEST_CASE("emit: nothing that prepare computes depends on an input from outside, and folding leaves inputs") {
    for (const bool fold : {false, true}) {
        const std::string text = emission(cart(), {.fold = fold}).source.text;
        const std::size_t begin = text.find("void prepare(");
        if (begin != std::string::npos)
            CHECK(text.substr(begin, text.find("\n}", begin) - begin).find("inputs") == std::string::npos);
        CHECK(text.find("inputs[0]") != std::string::npos);
        CHECK(text.find("inputs[1]") != std::string::npos);
    }
}

TEST_CASE("emit: a main program beside a file, which nobody gives inputs, has their values of the scene") {
    const test::Folder folder;
    for (const CodeLanguage language : {CodeLanguage::c, CodeLanguage::cpp}) {
        const Emission e = emission(cart(), {.language = language, .standalone = true});
        CHECK(e.source.text.find("inputs[") == std::string::npos);
    }
}

TEST_CASE("inputs from outside: a run has their values of the scene, or functions that are given") {
    const auto ends = [](const Scene& scene) {
        const Run run = simulate(scene, {.estimate = false});
        const std::span<const double> state = run.motion.final_state();
        return std::vector<double>(state.begin(), state.begin() + 4);
    };
    const auto with = [](const char* F, const char* brake) {
        std::string text = cart_text;
        const auto put = [&text](const std::string& from, const std::string& to) {
            text.replace(text.find(from), from.size(), to);
        };
        put("F = { value = 0.5, unit = \"N\", about = \"of the motor\", given = \"outside\" }",
            fmt::format("F = {{ value = \"{}\", unit = \"N\" }}", F));
        put("brake = { value = 20, unit = \"mN*m\", given = \"outside\" }",
            fmt::format("brake = {{ value = \"{}\", unit = \"mN*m\" }}", brake));
        return parse_scene(text, "cart.toml");
    };
    test::check_near(ends(cart()), ends(with("0.5", "20")), 1e-9);
    const Scene given = with_input(with_input(cart(), "F", "cos(3*t)"), "brake", "50");
    test::check_near(ends(given), ends(with("cos(3*t)", "50")), 1e-12);
}

// With u linear between (0, 0), (1, 2), (1.5, -1) and constant afterwards, x'' = u gives x' = 1 + 0.25 − 1.5 at 3.
TEST_CASE("inputs from outside: a table of times and values is linear between its rows, and holds its ends") {
    const test::Folder folder;
    folder.write("u.csv", "t,u\n0.5,0\n1,2\n1.5,-1\n");
    const Scene scene = parse_scene(
        "[inputs]\nu = { value = 0, given = \"outside\" }\n[coordinates]\nx = 0\n[[particle]]\nname = \"P\"\nmass "
        "= 1\n"
        "position = [\"x\", 0]\n[forces]\nx = \"u\"\n[simulation]\nduration = 3\n",
        "x.toml");
    for (const char* const method : {"auto", "taylor", "dop853", "radau"}) {
        CAPTURE(method);
        const Run run = simulate(with_input(scene, "u", (folder.path / "u.csv").string()), {.method = method});
        CHECK(std::abs(run.motion.final_state()[1] - (0.5 + 0.25 - 1.5)) < 1e-12);
    }
    const auto refused = [&](const std::string& text, const char* words) {
        folder.write("u.csv", text);
        try {
            with_input(scene, "u", (folder.path / "u.csv").string());
            FAIL("taken: ", text);
        } catch (const ModelError& e) {
            CHECK_MESSAGE(std::string(e.what()).find(words) != std::string::npos, e.what());
        }
    };
    refused("0,1\n1\n", "line 2");
    refused("0,1\n0,2\n", "line 2: t is 0 after 0");
    refused("t,u\n", "fewer than two points");
    refused("0,inf\n", "line 1");
}

TEST_CASE("inputs from outside: they are inputs of a unit, and their value is a number") {
    const FunctionalUnit unit = functional_unit(cart(), {});
    const auto kind_of = [&](const std::string& name) {
        for (const UnitVariable& v : unit.variables)
            if (v.name == name) return v.kind;
        return UnitVariable::Kind::time;
    };
    CHECK(kind_of("F") == UnitVariable::Kind::input);
    CHECK(kind_of("brake") == UnitVariable::Kind::input);
    CHECK_THROWS_AS(
        parse_scene(
            "[parameters]\nm = 1\n[inputs]\nu = { value = \"m\", given = \"outside\" }\n[coordinates]\nx = 0\n"
            "[[particle]]\nname = \"P\"\nmass = \"m\"\nposition = [\"x\", 0]\n[forces]\nx = \"u\"\n",
            "x.toml"),
        SceneError);
}

}  // namespace emit_inputs
