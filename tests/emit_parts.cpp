// SPDX-License-Identifier: MIT
// Long functions in parts.
#include <doctest/doctest.h>

#include <fmt/format.h>

#include <cmath>
#include <random>

#include "alembert/batch/packs.hpp"
#include "alembert/native/compilation.hpp"
#include "alembert/native/module.hpp"
#include "analysis/state/prepared.hpp"
#include "codegen/emit/emit.hpp"
#include "codegen/emit/parts.hpp"
#include "model/formalism/formalisms.hpp"
#include "model/formalism/recursive.hpp"
#include "program/lower/choose.hpp"
#include "scenes.hpp"

namespace emit_parts {

using namespace alembert;

TEST_CASE("parts: a value that one part makes and a later one uses is carried once") {
    const FunctionParts parts = in_parts({{.names = {"a"}, .uses = {"x"}, .text = "const Real a = x + 1.5e3;"},
                                          {.names = {"b"}, .uses = {"a"}, .text = "const Real b = 2 * a;"},
                                          {.names = {"c"}, .uses = {"a", "b"}, .text = "const Real c = a * b;"},
                                          {.uses = {"out", "c", "b"}, .text = "out[0] = c + b;"},
                                          {.uses = {"out", "a"}, .text = "out[1] = a;"}},
                                         2, CodeLanguage::cpp);
    REQUIRE(parts.list.size() == 3);
    CHECK(parts.carried == 2);
    CHECK(parts.list[0].lines == std::vector<std::string>{"const Real a = x + 1.5e3;", "carried[0] = a;",
                                                          "const Real b = 2 * a;", "carried[1] = b;"});
    CHECK(parts.list[1].lines == std::vector<std::string>{"const Real& a = carried[0];",
                                                          "const Real& b = carried[1];", "const Real c = a * b;",
                                                          "out[0] = c + b;"});
    CHECK(parts.list[2].lines == std::vector<std::string>{"const Real& a = carried[0];", "out[1] = a;"});
    CHECK(parts.list[0].names.contains("x"));
    CHECK_FALSE(parts.list[1].names.contains("x"));
}

TEST_CASE(
    "parts: the place of a value that no later part needs is used again, but not in the part that reads it last") {
    const FunctionParts parts = in_parts({{.names = {"a"}, .uses = {"x"}, .text = "const Real a = x + 1;"},
                                          {.names = {"b"}, .uses = {"a"}, .text = "const Real b = 2 * a;"},
                                          {.names = {"c"}, .uses = {"b"}, .text = "const Real c = 3 * b;"},
                                          {.uses = {"out", "c"}, .text = "out[0] = c;"}},
                                         1, CodeLanguage::cpp);
    REQUIRE(parts.list.size() == 4);
    CHECK(parts.carried == 2);
    CHECK(parts.list[1].lines ==
          std::vector<std::string>{"const Real& a = carried[0];", "const Real b = 2 * a;", "carried[1] = b;"});
    CHECK(parts.list[2].lines ==
          std::vector<std::string>{"const Real& b = carried[1];", "const Real c = 3 * b;", "carried[0] = c;"});
}

TEST_CASE("parts: all names of a statement can be carried") {
    const FunctionParts parts = in_parts(
        {{.names = {"s0", "c0"},
          .uses = {"q"},
          .text = "const auto trig0 = sincos(p, q);\nconst Real s0 = trig0.sine[0], c0 = trig0.cosine[0];"},
         {.uses = {"out", "s0"}, .text = "out[0] = s0;"},
         {.uses = {"out", "c0"}, .text = "out[1] = c0;"}},
        1, CodeLanguage::cpp);
    REQUIRE(parts.list.size() == 3);
    CHECK(parts.carried == 2);
    CHECK(parts.list[0].lines.size() == 3);
    CHECK(parts.list[2].lines.front() == "const Real& c0 = carried[1];");
}

TEST_CASE("parts: a file whose functions are in parts computes the same as the whole one, packs too") {
    const Mechanism m = prepared(read_scene(test::source_path("scenes/benchmark/trees/arm7.toml"))).mechanism;
    const Program program = choose(m, recursive(m)).program;
    const auto module_of = [&](std::size_t longest) {
        const std::string text = emit(program, {.batch = true, .longest_function = longest}).text;
        CHECK((text.find("rhs_1(") != std::string::npos) == (longest < 100));
        return load(compile(text, "parts", {}).object);
    };
    const Module whole = module_of(100000), parts = module_of(40);
    const int n = whole.table().coordinates;
    std::mt19937_64 random(7);
    std::uniform_real_distribution<double> any(-2, 2);
    const std::vector<double> par = prepared(whole);
    const std::vector<Lanes> pars = prepared_packs(parts);
    Lanes time{};
    std::vector<Lanes> states(2 * n), rates(2 * n);
    for (int lane = 0; lane < lanes; ++lane)
        for (int i = 0; i < 2 * n; ++i) states[i][lane] = any(random);
    parts.pack()->rhs(reals(&time), reals(states.data()), reals(pars.data()), reals(rates.data()));
    for (int lane = 0; lane < lanes; ++lane) {
        std::vector<double> y(2 * n), a(2 * n), b(2 * n), M(n * n), M_parts(n * n), f(n), f_parts(n);
        for (int i = 0; i < 2 * n; ++i) y[i] = states[i][lane];
        whole.table().rhs(0, y.data(), par.data(), a.data());
        parts.table().rhs(0, y.data(), par.data(), b.data());
        whole.table().mass_forcing(0, y.data(), par.data(), M.data(), f.data());
        parts.table().mass_forcing(0, y.data(), par.data(), M_parts.data(), f_parts.data());
        double size = 1;
        for (const double x : a) size = std::max(size, std::abs(x));
        for (int i = 0; i < 2 * n; ++i) {
            CHECK(std::abs(a[i] - b[i]) <
                  1e-11 * size);  // products are fused with other sums; M has a condition of about 1e4
            CHECK(std::abs(a[i] - rates[i][lane]) < 1e-11 * size);
        }
        for (int i = 0; i < n * n; ++i) CHECK(std::abs(M[i] - M_parts[i]) < 1e-13);
        for (int i = 0; i < n; ++i) CHECK(std::abs(f[i] - f_parts[i]) < 1e-12 * size);
    }
}

TEST_CASE("parts: scenes of every kind can be written in the shortest parts") {
    for (const char* scene :
         {"textbook/four_bar.toml", "textbook/heavy_top_quaternion.toml", "textbook/rattleback.toml",
          "benchmark/pleiades.toml", "benchmark/flyball_governor.toml"}) {
        CAPTURE(scene);
        const Mechanism m = prepared(read_scene(test::source_path(std::string("scenes/") + scene))).mechanism;
        const Equations equations = m.speeds.empty() ? formalism("routh").derive(m) : formalism("kane").derive(m);
        const Program program = choose(m, equations).program;
        const Module whole = load(compile(emit(program).text, "whole", {}).object),
                     parts = load(compile(emit(program, {.longest_function = 5}).text, "parts", {}).object);
        const alembert_solver_table &a = whole.table(), &b = parts.table();
        const State<double> start = start_of(m).state();
        const auto width = static_cast<std::size_t>(a.coordinates + a.speeds),
                   rows = static_cast<std::size_t>(a.constraints);
        std::vector<double> y = start.q;
        y.insert(y.end(), start.qdot.begin(), start.qdot.end());
        y.resize(width, 0.3);
        const std::vector<double> par = prepared(whole), par_parts = prepared(parts);
        CHECK(par == par_parts);
        const auto of = [&](const alembert_solver_table& table) {
            std::vector<double> all(width + 5 + static_cast<std::size_t>(table.outputs) + 2 * rows +
                                    2 * rows * width);
            double* to = all.data();
            table.rhs(0.1, y.data(), par.data(), to);
            table.energy(0.1, y.data(), to, par.data(), to + width, to + width + 4);
            table.outputs_at(0.1, y.data(), to, par.data(), to + width + 5);
            if (rows > 0)
                table.constraints_at(
                    0.1, y.data(), par.data(), all.data() + all.size() - 2 * rows - 2 * rows * width,
                    all.data() + all.size() - rows - 2 * rows * width, all.data() + all.size() - 2 * rows * width);
            return all;
        };
        const std::vector<double> x = of(a), z = of(b);
        double size = 1;
        for (const double value : x) size = std::max(size, std::abs(value));
        for (std::size_t i = 0; i < x.size(); ++i)
            CHECK(std::abs(x[i] - z[i]) <=
                  1e-11 * size);  // sums are fused otherwise: some ulps, times M's condition
    }
}

}  // namespace emit_parts
