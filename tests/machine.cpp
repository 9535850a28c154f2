// SPDX-License-Identifier: MIT
// Machine code in memory against the interpreter of the same program, which knows nothing of registers, of signs
// that are carried along, or of fused operations.
#include <doctest/doctest.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <set>

#include "alembert/base/error.hpp"
#include "alembert/native/simd_math.hpp"
#include "analysis/state/prepared.hpp"
#include "codegen/machine/can_run.hpp"
#include "codegen/machine/lines.hpp"
#include "codegen/machine/memory_solver.hpp"
#include "machine_values.hpp"
#include "model/formalism/formalisms.hpp"
#include "program/differentiate.hpp"
#include "program/lower/choose.hpp"
#include "random_program.hpp"
#include "random_scene.hpp"
#include "scenes.hpp"

namespace machine_code {

using namespace alembert;
using namespace alembert::test;

namespace {

/// All functions of a solver in memory at a state. `rate` holds the accelerations that energies and outputs
/// take.
int differences(const Program& p, const Module& module, const State<double>& state) {
    const alembert_solver_table& table = module.table();
    const Expected expected(p, state);
    const Vocabulary words(p);
    std::vector<double> par = prepared(module, state.parameters), y = state.q, rate = state.qdot;
    y.insert(y.end(), state.qdot.begin(), state.qdot.end());
    rate.resize(state.q.size());
    rate.insert(rate.end(), state.qddot.begin(), state.qddot.end());
    int count = 0;
    const auto look = [&](const FunctionTask& task, const auto& call) {
        if (task.results.empty()) return;
        Arrays out;
        for (const FunctionArgument& argument : task.arguments)
            out[argument.name].resize(room(task, argument.name));
        call(out);
        count += differences(task, out, expected);
    };
    const double t = state.t;
    const FunctionTask rhs = right_hand_side(p, words);
    look(rhs, [&](Arrays& out) {
        out["rate"].resize(y.size());
        table.rhs(t, y.data(), par.data(), out["rate"].data());
        for (const RateCopy& copy : rhs.copies) CHECK(out["rate"][copy.to] == y[copy.from]);
    });
    look(mass_forcing(p), [&](Arrays& out) {
        table.mass_forcing(t, y.data(), par.data(), out["mass"].data(), out["forcing"].data());
    });
    look(energy(p), [&](Arrays& out) {
        table.energy(t, y.data(), rate.data(), par.data(), out["energy"].data(), out["jacobi"].data());
    });
    look(outputs_at(p),
         [&](Arrays& out) { table.outputs_at(t, y.data(), rate.data(), par.data(), out["out"].data()); });
    look(events_at(p),
         [&](Arrays& out) { table.events_at(t, y.data(), rate.data(), par.data(), out["out"].data()); });
    look(constraints_at(p), [&](Arrays& out) {
        table.constraints_at(t, y.data(), par.data(), out["position"].data(), out["velocity"].data(),
                             out["rows"].data());
    });
    look(multipliers_at(p),
         [&](Arrays& out) { table.multipliers_at(t, y.data(), par.data(), out["lambda"].data()); });
    if (module.projection() != nullptr) {
        look(project(p), [&](Arrays& out) {
            module.projection()->project(t, y.data(), par.data(), out["out"].data(), out["position"].data(),
                                         out["pivots"].data());
        });
        look(gamma_at(p),
             [&](Arrays& out) { module.projection()->gamma_at(t, y.data(), par.data(), out["out"].data()); });
    }
    if (module.derivatives() != nullptr)
        look(jacobian(p).task,
             [&](Arrays& out) { module.derivatives()->jacobian(t, y.data(), par.data(), out["values"].data()); });
    return count;
}

/// The same with 16 registers, which every processor has, and with all that this one has.
int differences(const Program& p, const State<double>& state) {
    int count = 0;
    for (const int registers : std::set{16, machine::registers_of_processor()}) {
        CAPTURE(registers);
        const auto solver = memory_solver(p, false, registers);
        REQUIRE(solver.has_value() == machine::can_run());
        if (solver) count += differences(p, solver->module, state);
    }
    return count;
}

}  // namespace

TEST_CASE(
    "machine: sines and cosines of four angles at once are within 2.5 ulp of long doubles, and libm's beyond "
    "1e8") {
    std::mt19937_64 random(5);
    double worst = 0;
    for (int round = 0; round < 20000; ++round) {
        double values[12];
        const double scale = std::pow(10.0, static_cast<double>(random() % 9));
        std::uniform_real_distribution<double> uniform(-scale, scale);
        for (int k = 0; k < 4; ++k) values[k] = uniform(random);
        if (round % 100 == 0) values[round / 100 % 4] = round % 200 == 0 ? 1e15 : std::nan("");
        if (round % 101 == 0) values[1] = -0.0;
        sines_for_code(values, 4);
        for (int k = 0; k < 4; ++k) {
            const double x = values[k];
            if (std::isnan(x)) {
                CHECK((std::isnan(values[4 + k]) && std::isnan(values[8 + k])));
                continue;
            }
            const auto ulps = [&](double found, long double exact) {
                const double next = std::nextafter(std::abs(static_cast<double>(exact)), 2.0);
                return std::abs(
                    static_cast<double>((found - exact) / (next - std::abs(static_cast<double>(exact)))));
            };
            const auto wide = static_cast<long double>(x);
            worst = std::max({worst, ulps(values[4 + k], std::sin(wide)), ulps(values[8 + k], std::cos(wide))});
        }
    }
    CHECK(worst < 2.5);
}

TEST_CASE("machine: random programs with hundreds of values in use have the interpreter's values") {
    for (unsigned seed = 0; seed < 300; ++seed) {
        const int inputs = 1 + static_cast<int>(seed % 40);
        const Program p = random_program(
            {.seed = seed, .count = 20 + static_cast<int>(seed) * 3, .calls = seed % 2 == 1, .inputs = inputs});
        CAPTURE(seed);
        CHECK(differences(p, some_state(p, seed)) == 0);
    }
}

TEST_CASE("machine: a sum of hundreds of products of each other's factors, more than there are registers") {
    Program p;
    const int n = 200;
    std::vector<int> x;
    for (int i = 0; i < n; ++i) {
        p.coordinates.push_back({.name = fmt::format("q{}", i), .unit = ""});
        x.push_back(p.product(
            1, {{p.sum(2, {{1, p.product(1, {{p.variable({Variable::Kind::coordinate, i}), 2}})}}), -1}}));
    }
    for (int i = 0; i < n; ++i) {
        std::vector<Program::Term> terms;
        for (int j = 0; j < n; j += 7)
            terms.push_back(
                {(i + j) % 3 - 1 == 0 ? 2 : (i + j) % 3 - 1, p.product(1, {{x[i], 1}, {x[(i + j) % n], 1}})});
        p.roots.push_back({Group::acceleration, "", p.sum(0, terms)});
    }
    CHECK(differences(p, some_state(p, 3)) == 0);
}

TEST_CASE("machine: a sum of squares and even powers multiplies nothing by one") {
    Program p;
    std::vector<Program::Term> terms;
    for (int i = 0; i < 3; ++i) {
        p.coordinates.push_back({.name = fmt::format("q{}", i), .unit = ""});
        terms.push_back(
            {i == 1 ? -1 : 1, p.product(1, {{p.variable({Variable::Kind::coordinate, i}), i == 2 ? 4 : 2}})});
    }
    const int sum = p.sum(0, terms);
    for (int i = 0; i < 3; ++i) p.roots.push_back({Group::acceleration, "", sum});
    const Vocabulary words(p);
    const std::vector<int> roots{sum};
    const machine::Lines lines = machine::lines_of(p, words, Readiness(p, roots), right_hand_side(p, words));
    const auto count = [&](machine::Line::Kind kind) {
        return std::count_if(lines.list.begin(), lines.list.end(),
                             [&](const machine::Line& line) { return line.kind == kind; });
    };
    CHECK(count(machine::Line::Kind::multiply) == 2);  // of the first term, and the square in the fourth power
    CHECK(count(machine::Line::Kind::fused) == 2);
    CHECK(differences(p, some_state(p, 5)) == 0);
}

TEST_CASE("machine: a value that is no number stays so, and what an array has is copied") {
    Program p;
    p.coordinates = {{.name = "x", .unit = ""}};
    const int x = p.variable({Variable::Kind::coordinate, 0}), root = p.call(Op::sqrt, {x});
    const int one = p.number(1);
    p.roots = {{Group::acceleration, "", p.number(0)}};
    for (const int node : {p.call(Op::min, {one, root}), p.call(Op::max, {root, one}), p.call(Op::sign, {root}), x,
                           p.sum(0, {{-1, x}}), p.pi(), p.number(Rational(1) / 3)})
        p.roots.push_back({Group::output, "", node});
    for (const double at : {4.0, 0.0, -1.0})
        CHECK(differences(p, {.parameters = {}, .t = 0, .q = {at}, .qdot = {0}, .qddot = {0}}) == 0);
}

TEST_CASE("machine: all functions of all scenes, at random states") {
    for (const char* folder : {"scenes/textbook", "scenes/gallery", "scenes/benchmark"})
        for (const std::string& file : every_third(scenes_in(folder), 1)) {
            CAPTURE(file);
            const Prepared made = prepared(read_scene(file));
            const Mechanism& m = made.mechanism;
            std::mt19937_64 random(11);
            for (const char* name : {"lagrange", "routh", "kane", "recursive"}) {
                std::optional<Program> program;
                try {
                    program = choose(m, formalism(name).derive(m)).program;
                } catch (const ModelError&) {  // the formalism does not apply
                    continue;
                }
                CAPTURE(name);
                if (program->singular) continue;
                if (const auto d = differentiated(*program, {.power = true, .budget = 20000}))
                    program = d->program;
                const Start start = start_of(m);
                State<double> state = random_state(start, random);
                state.qdot.resize(program->speeds.empty() ? state.q.size() : program->speeds.size(), 0.7);
                state.qddot.assign(state.qdot.size(), 0.3);
                CHECK(differences(*program, state) == 0);
            }
        }
}

TEST_CASE("machine: small random scenes") {
    for (unsigned seed = 0; seed < 150; ++seed) {
        const std::string scene = random_scene(seed);
        CAPTURE(scene);
        const Mechanism m = build(parse_scene(scene, "random.toml"));
        std::optional<Program> program;
        try {
            program =
                choose(m, formalism(m.constraints.empty() && m.speeds.empty() ? "lagrange" : "routh").derive(m))
                    .program;
        } catch (const ModelError&) {
            continue;
        }
        if (program->singular) continue;
        std::mt19937_64 random(seed);
        State<double> state = random_state(start_of(m), random);
        state.qdot.resize(program->speeds.empty() ? state.q.size() : program->speeds.size(), 0.7);
        state.qddot.assign(state.qdot.size(), 0.3);
        CHECK(differences(*program, state) == 0);
    }
}

}  // namespace machine_code
