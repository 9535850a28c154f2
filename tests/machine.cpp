// SPDX-License-Identifier: MIT
// Machine code in memory against the interpreter of the same program, which knows nothing of registers, of signs
// that are carried along, or of fused operations.
#include <doctest/doctest.h>

#include <fmt/format.h>

#include <cmath>
#include <cstdlib>
#include <limits>
#include <map>
#include <random>

#include "alembert/code_functions.hpp"
#include "alembert/error.hpp"
#include "emit/solver_functions.hpp"
#include "formalism/formalisms.hpp"
#include "lower/choose.hpp"
#include "machine/memory_solver.hpp"
#include "program/differentiate.hpp"
#include "program/rounding.hpp"
#include "random_scene.hpp"
#include "run/simulate.hpp"
#include "scenes.hpp"
#include "state/prepared.hpp"

namespace machine_code {

using namespace alembert;

namespace {

using Arrays = std::map<std::string, std::vector<double>>;

/// The values of all nodes and what rounding may do to them.
struct Expected {
    explicit Expected(const Program& program, const State<double>& state)
        : value(interpret<double>(program, state)), error(rounding_errors(program, state)) {}
    std::vector<double> value, error;
};

/// The number of results that differ by more than rounding explains. The sums of a program may be added in any
/// order: each partial sum is at most the sum of all sizes, which are in `error` once, so that the number of terms
/// bounds the ratio.
int differences(const FunctionTask& task, const Arrays& arrays, const Expected& expected) {
    constexpr double terms = 16;
    int count = 0;
    for (const FunctionResult& result : task.results)
        for (const std::size_t place : result.places) {
            const auto node = static_cast<std::size_t>(result.node);
            const double found = arrays.at(result.array).at(place), value = expected.value[node];
            const bool agree = std::isfinite(value) ? std::abs(found - value) <= terms * expected.error[node]
                                                    : !std::isfinite(found);
            if (agree) continue;
            MESSAGE(task.name << " " << result.array << "[" << place << "] = " << found << ", expected " << value
                              << " +- " << expected.error[node]);
            ++count;
        }
    return count;
}

std::size_t room(const FunctionTask& task, const std::string& array) {
    std::size_t size = 1;
    for (const FunctionResult& result : task.results)
        for (const std::size_t place : result.places)
            if (result.array == array) size = std::max(size, place + 1);
    return size;
}

/// All functions of the solver in memory at a state. `rate` holds the accelerations that energies and outputs
/// take.
int differences(const Program& p, const State<double>& state) {
    const auto solver = memory_solver(p);
    REQUIRE(solver);
    const Module& module = solver->module;
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

/// `count` steps, each of values made before; some of them are results.
Program random_program(unsigned seed, int count, bool calls, int inputs) {
    std::mt19937_64 random(seed);
    const auto pick = [&](int n) { return static_cast<int>(random() % static_cast<unsigned>(n)); };
    Program p;
    std::vector<int> pool;
    for (int i = 0; i < inputs; ++i) {
        p.coordinates.push_back({.name = fmt::format("q{}", i), .unit = ""});
        pool.push_back(p.variable({Variable::Kind::coordinate, i}));
        pool.push_back(p.variable({Variable::Kind::rate, i}));
    }
    for (int i = 0; i < 3; ++i) {
        p.parameters.push_back({.name = fmt::format("c{}", i), .unit = "", .value = 0.7 + 0.3 * i});
        pool.push_back(p.variable({Variable::Kind::parameter, i}));
    }
    pool.push_back(p.variable({Variable::Kind::time}));
    const auto any = [&] { return pool[random() % pool.size()]; };
    const auto bounded = [&](int node) {  // |x / (1 + x²)| ≤ 1/2: values do not grow from step to step
        return p.product(1, {{node, 1}, {p.sum(1, {{1, p.product(1, {{node, 2}})}}), -1}});
    };
    const Rational weights[] = {1, -1, Rational(2) / 3, -3};
    for (int k = 0; k < count; ++k) {
        const Rational weight = weights[pick(4)];
        const int a = any(), b = any(), c = any(), d = any(), e = any(), f = any();
        int node = a;
        switch (pick(calls ? 11 : 6)) {
            case 0:
            case 1:
                node = p.sum(k % 2, {{weight, a}, {weights[pick(4)], b}, {-1, c}});
                break;
            case 2:
                node = p.sum(0, {{1, p.product(1, {{a, 1}, {b, 1}})},
                                 {-1, p.product(1, {{c, 1}, {d, 1}, {e, 1}})},
                                 {weight, f}});
                break;
            case 3:
                node = p.sum(0, {{-1, a}, {-1, p.product(1, {{b, 2}, {c, 1}})}});
                break;
            case 4:
                node = p.product(weight, {{a, 1 + pick(4)}, {b, 1}});
                break;
            case 5:
                node = p.sum(
                    0, {{weight, p.product(1, {{a, 1}, {a, 1}})}, {1, a}, {-1, p.product(1, {{a, 1}, {b, 1}})}});
                break;
            case 6:
            case 7:
                node =
                    p.sum(0, {{1, p.call(Op::sin, {a})}, {-1, p.product(1, {{p.call(Op::cos, {a}), 1}, {b, 1}})}});
                break;
            case 8: {
                const Op ops[] = {Op::atan, Op::tanh, Op::abs, Op::sqrt};
                const Op op = ops[pick(4)];
                node = p.call(op, {op == Op::sqrt ? p.sum(1, {{1, p.product(1, {{a, 2}})}}) : a});
                break;
            }
            case 9: {
                const Op ops[] = {Op::min, Op::max};
                node = p.call(ops[pick(2)], {a, b});
                break;
            }
            default:
                node = p.call(Op::pow, {p.sum(2, {{1, p.product(1, {{a, 2}})}}), p.call(Op::tanh, {b})});
        }
        pool.push_back(bounded(node));
    }
    const int results = 40;
    for (int i = 0; i < inputs; ++i)
        p.roots.push_back({Group::acceleration, "", pool[pool.size() - 1 - static_cast<std::size_t>(i)]});
    for (int k = 0; k < results; ++k) p.roots.push_back({Group::output, fmt::format("o{}", k), any()});
    return p.canonical();
}

State<double> some_state(const Program& p, unsigned seed) {
    std::mt19937_64 random(seed);
    std::uniform_real_distribution<double> uniform(-2, 2);
    State<double> state{.parameters = {}, .t = uniform(random), .q = {}, .qdot = {}, .qddot = {}};
    for (const Quantity& parameter : p.parameters) state.parameters.push_back(parameter.value);
    for (std::size_t i = 0; i < p.coordinates.size(); ++i) {
        state.q.push_back(uniform(random));
        state.qdot.push_back(uniform(random));
        state.qddot.push_back(uniform(random));
    }
    return state;
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
        const Program p = random_program(seed, 20 + static_cast<int>(seed) * 3, seed % 2 == 1, inputs);
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
        for (const std::string& file : test::every_third(test::scenes_in(folder), 1)) {
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
                State<double> state = test::random_state(start, random);
                state.qdot.resize(program->speeds.empty() ? state.q.size() : program->speeds.size(), 0.7);
                state.qddot.assign(state.qdot.size(), 0.3);
                CHECK(differences(*program, state) == 0);
            }
        }
}

TEST_CASE("machine: small random scenes") {
    for (unsigned seed = 0; seed < 150; ++seed) {
        const std::string scene = test::random_scene(seed);
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
        State<double> state = test::random_state(start_of(m), random);
        state.qdot.resize(program->speeds.empty() ? state.q.size() : program->speeds.size(), 0.7);
        state.qddot.assign(state.qdot.size(), 0.3);
        CHECK(differences(*program, state) == 0);
    }
}

namespace {

/// A compiler that does not exist, as long as this object lives.
struct NoCompiler {
    NoCompiler() { setenv("CXX", "/nowhere/compiler", 1); }
    ~NoCompiler() { unsetenv("CXX"); }
};

double distance(const Run& a, const Run& b) {
    double most = 0;
    const auto look = [&](const std::vector<double>& x, const std::vector<double>& y) {
        REQUIRE(x.size() == y.size());
        for (std::size_t i = 0; i < x.size(); ++i)
            most = std::max(most, std::abs(x[i] - y[i]) / std::max(1.0, std::abs(x[i])));
    };
    look(a.final_coordinates, b.final_coordinates);
    look(a.final_rates, b.final_rates);
    return most;
}

}  // namespace

// Two codes round differently, so that their motions differ by no more than their errors.
TEST_CASE("machine: motions by code in memory and by the compiler differ by less than their estimated errors") {
    struct Case {
        const char *scene, *method;
        double duration;
    };
    for (const Case& c : {Case{"textbook/double_pendulum", "", 3}, Case{"textbook/double_pendulum", "radau", 2},
                          Case{"benchmark/andrews", "", 0.01}, Case{"benchmark/flyball_governor", "", 1},
                          Case{"benchmark/bouncing_ball", "", 1.5}, Case{"benchmark/chaplygin_sleigh", "", 3},
                          Case{"benchmark/cartesian_pendulum", "rattle8", 1},
                          Case{"benchmark/pleiades", "taylor", 0.1}, Case{"textbook/four_bar", "taylor", 1},
                          Case{"benchmark/heavy_top_fast", "dopri5", 1}, Case{"benchmark/pleiades", "bdf", 0.1}}) {
        CAPTURE(c.scene);
        CAPTURE(c.method);
        const Scene scene = read_scene(test::source_path(fmt::format("scenes/{}.toml", c.scene)));
        const auto run = [&](const char* code) {
            RunOptions wishes{.method = c.method, .code = code, .duration = c.duration};
            if (std::string_view(c.method) == "rattle8") wishes.step = 1e-3;
            return simulate(scene, wishes);
        };
        const Run memory = run("memory"), compiled = run("compiled");
        CHECK(memory.solver.code == CodeKind::memory);
        CHECK(compiled.solver.code == CodeKind::compiled);
        REQUIRE(memory.estimate);
        REQUIRE(memory.estimate->value);
        CHECK(distance(memory, compiled) <= *memory.estimate->value + *compiled.estimate->value);
    }
}

TEST_CASE("machine: a run needs no compiler, unless it is told to take one") {
    const Scene scene = read_scene(test::source_path("scenes/textbook/double_pendulum.toml"));
    const NoCompiler none;
    CHECK(simulate(scene, {.duration = 1}).solver.code == CodeKind::memory);
    CHECK_THROWS_AS(simulate(scene, {.code = "compiled", .duration = 1}), CompileError);
    CHECK_THROWS_AS(simulate(scene, {.duration = 1, .fast_math = true}), CompileError);
    CHECK_THROWS_AS(simulate(scene, {.code = "memory", .duration = 1, .fast_math = true}), ModelError);
    CHECK_THROWS_AS(simulate(scene, {.code = "fast", .duration = 1}), ModelError);
    setenv("ALEMBERT_CODE", "compiled", 1);
    CHECK_THROWS_AS(simulate(scene, {.duration = 1}), CompileError);
    CHECK(simulate(scene, {.code = "auto", .duration = 1}).solver.code == CodeKind::memory);
    unsetenv("ALEMBERT_CODE");
}

TEST_CASE(
    "machine: a long run goes over to compiled code, the same in every run; without a compiler it does not") {
    const Scene scene = read_scene(test::source_path("scenes/textbook/double_pendulum.toml"));
    const RunOptions wishes{
        .method = "rk4", .duration = 150, .step = 1e-4, .budget = 100'000'000, .estimate = false};
    const auto run = [&](const char* code) {
        RunOptions own = wishes;
        own.code = code;
        return simulate(scene, own);
    };
    const Run first = run("auto"), second = run("auto"), memory = run("memory");
    CHECK(first.solver.code == CodeKind::both);
    CHECK(second.solver.from_cache);
    CHECK(first.final_coordinates == second.final_coordinates);
    CHECK(memory.solver.code == CodeKind::memory);
    const NoCompiler none;
    const Run alone = run("auto");
    CHECK(alone.solver.code == CodeKind::memory);
    CHECK(alone.final_coordinates == memory.final_coordinates);
}

}  // namespace machine_code
