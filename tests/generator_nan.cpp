// SPDX-License-Identifier: MIT
// A value that is not a number stays so through min, max and sign, in every evaluator.
#include <doctest/doctest.h>

#include <cmath>

#include "alembert/batch/packs.hpp"
#include "alembert/native/compilation.hpp"
#include "alembert/native/module.hpp"
#include "codegen/emit/emit.hpp"
#include "model/formalism/lagrange.hpp"
#include "program/jet.hpp"
#include "program/lower/choose.hpp"
#include "program/tape.hpp"
#include "scenes.hpp"

namespace generator_nan {

using namespace alembert;

namespace {

struct Case {
    const char* text;
    double at_four, at_zero;  ///< its values at x = 4 and x = 0; none at x = −1
};

constexpr Case cases[] = {{"min(1, sqrt(x))", 1, 0},
                          {"min(sqrt(x), 1)", 1, 0},
                          {"max(1, sqrt(x))", 2, 1},
                          {"max(sqrt(x), 1)", 2, 1},
                          {"sign(sqrt(x))", 1, 0},
                          {"sign(-sqrt(x))", -1, 0},
                          {"max(min(1, sqrt(x)), sign(sqrt(x)))", 1, 0}};

bool same(double found, double expected) {
    return std::isnan(expected) ? std::isnan(found) : found == expected;
}

}  // namespace

TEST_CASE(
    "nan: min, max and sign of what is no number are none, interpreted, in 34 digits, emitted and eight side by "
    "side") {
    std::string text = "title = \"nan\"\n[coordinates]\nx = 4\n[energy]\nkinetic = \"x'^2/2\"\n[outputs]\n";
    for (int k = 0; const Case& one : cases) text += fmt::format("o{} = \"{}\"\n", k++, one.text);
    const Mechanism m = build(parse_scene(text, "nan.toml"));
    const Program program = choose(m, lagrange(m)).program;
    const Module module = load(compile(emit(program, {.batch = true}).text, "nan", {}).object);
    const std::vector<int> outputs = program.nodes_of(Group::output);
    Tape<Quad> tape(program, outputs, {});
    Lanes time{};
    std::vector<Lanes> states(2), rates(2), side_by_side(std::size(cases));
    for (int lane = 0; lane < lanes; ++lane) states[0][lane] = lane % 3 == 0 ? 4 : lane % 3 == 1 ? 0 : -1;
    module.pack()->outputs_at(reals(&time), reals(states.data()), reals(rates.data()), nullptr,
                              reals(side_by_side.data()));
    for (int lane = 0; lane < 3; ++lane) {
        const double x = states[0][lane], state[] = {x, 0}, rate[] = {0, 0};
        std::vector<double> emitted(std::size(cases));
        module.table().outputs_at(0, state, rate, nullptr, emitted.data());
        const Quad q = x, u = 0;
        std::vector<Quad> quad(std::size(cases));
        tape(0, &q, &u, quad.data());
        const std::vector<double> value =
            interpret<double>(program, {.parameters = {}, .q = {x}, .qdot = {0}, .qddot = {}});
        const auto jets = interpret<Jet<double>>(
            program, {.parameters = {}, .q = {Jet<double>(x, {1})}, .qdot = {Jet<double>(0)}, .qddot = {}});
        for (std::size_t k = 0; k < std::size(cases); ++k) {
            CAPTURE(cases[k].text);
            CAPTURE(x);
            const double expected = x == 4 ? cases[k].at_four : x == 0 ? cases[k].at_zero : std::nan("");
            CHECK(same(emitted[k], expected));
            CHECK(same(static_cast<double>(quad[k]), expected));
            CHECK(same(value[outputs[k]], expected));
            CHECK(same(jets[outputs[k]].value, expected));
            for (int other = lane; other < lanes; other += 3) CHECK(same(side_by_side[k][other], expected));
        }
    }
}

}  // namespace generator_nan
