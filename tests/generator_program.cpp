// SPDX-License-Identifier: MIT
#include <doctest/doctest.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <random>

#include "analysis/state/prepared.hpp"
#include "codegen/emit/emit.hpp"
#include "model/formalism/formalisms.hpp"
#include "program/constants.hpp"
#include "program/interpret.hpp"
#include "program/lower/choose.hpp"
#include "program/share.hpp"
#include "program/solve.hpp"
#include "scenes.hpp"
#include "solved.hpp"

namespace generator_program {

using namespace alembert;

namespace {

int coordinate(Program& p, int index) {
    return p.variable({Variable::Kind::coordinate, index});
}
int parameter(Program& p, int index) {
    return p.variable({Variable::Kind::parameter, index});
}

}  // namespace

// 2k − m g would be rounded to 1e-10 once for the whole run, 4e-12 of m g.
TEST_CASE("program: a small constant is not swallowed by that of a stiff spring") {
    Program p;
    p.parameters = {{.name = "k", .unit = "", .value = 8e5}, {.name = "w", .unit = "", .value = 29.43}};
    const int x = coordinate(p, 0), k = parameter(p, 0), w = parameter(p, 1);
    p.coordinates = {{.name = "x", .unit = ""}};
    const int force = p.sum(0, {{2, k}, {-1, w}, {-2, p.product(1, {{k, 1}, {x, 1}})}});
    p.roots.push_back({.group = Group::acceleration, .name = "x''", .node = force});
    const Program apart = without_swallowed_constants(p);
    const auto has_gathered_constants = [](const Program& program) {
        const Node& sum = program[program.roots[0].node];
        return std::any_of(sum.args.begin(), sum.args.end(), [&](int arg) {
            return program[arg].op == Op::sum && program[arg].is_constant() && program[arg].args.size() > 1;
        });
    };
    CHECK(has_gathered_constants(p));
    CHECK(!has_gathered_constants(apart));
    const auto value = [](const Program& program, long double at) {
        const State<long double> state{.parameters = {8e5L, 29.43L}, .t = 0, .q = {at}, .qdot = {0}, .qddot = {0}};
        return interpret<long double>(program, state)[static_cast<std::size_t>(program.roots[0].node)];
    };
    for (const long double at : {-3.7L, 0.6L, 0.99998L, 12.0L})
        CHECK(std::abs(static_cast<double>(value(p, at) - value(apart, at))) < 1e-11);
    CHECK(apart.count(std::vector{apart.roots[0].node}).total() <= p.count(std::vector{force}).total() + 1);
    // With a soft spring nothing changes.
    p.parameters[0].value = 8;
    CHECK(has_gathered_constants(without_swallowed_constants(p)));
}

TEST_CASE("program: equal values are one node, in whatever order they were made") {
    Program p;
    const int x = coordinate(p, 0), y = coordinate(p, 1), a = parameter(p, 0);
    CHECK(p.sum(0, {{1, x}, {1, y}}) == p.sum(0, {{1, y}, {1, x}}));
    CHECK(p.product(2, {{x, 1}, {a, 2}, {y, 1}}) == p.product(2, {{y, 1}, {x, 1}, {a, 1}, {a, 1}}));
    CHECK(p.sum(0, {{1, x}, {-1, x}}) == p.number(0));
    CHECK(p.product(1, {{x, 2}, {x, -2}}) == p.number(1));
    // y − x is −1·(x − y); both share one node.
    const int difference = p.sum(0, {{1, x}, {-1, y}}), turned = p.sum(0, {{-1, x}, {1, y}});
    CHECK(p[turned].args[0] == difference);
    CHECK(p.product(1, {{difference, 2}}) == p.product(1, {{turned, 2}}));
}

// Lists of a call stand on the stack up to 96 terms, and on the heap beyond (program/short_lists.hpp).
TEST_CASE("program: sums and products of any length have the values of their terms, in whatever order") {
    std::mt19937_64 random(11);
    for (const int length : {1, 2, 40, 95, 96, 97, 200, 3000}) {
        CAPTURE(length);
        Program p;
        State<double> state;
        std::vector<Program::Term> terms;
        std::vector<Program::Factor> factors;
        double sum = 0.5, product = 3;
        for (int k = 0; k < length; ++k) {
            const int x = coordinate(p, k);
            const int weight = k % 7 - 3;  // zero too: such a term goes
            terms.emplace_back(weight, x);
            terms.emplace_back(2, x);  // gathered with the one before
            factors.emplace_back(x, k % 2 == 0 ? 1 : -1);
            state.q.push_back(1 + 1.0 / (k + 1));
            sum += (weight + 2) * state.q.back();
            product *= k % 2 == 0 ? state.q.back() : 1 / state.q.back();
        }
        const int value = p.sum(Rational(1) / 2, terms), other = p.product(3, factors);
        std::shuffle(terms.begin(), terms.end(), random);
        std::shuffle(factors.begin(), factors.end(), random);
        CHECK(p.sum(Rational(1) / 2, terms) == value);
        CHECK(p.product(3, factors) == other);
        const std::vector<double> values = interpret<double>(p, state);
        CHECK(values[value] == doctest::Approx(sum).epsilon(1e-12));  // at most 6000 roundings of 1.1e-16
        CHECK(values[other] == doctest::Approx(product).epsilon(1e-12));
    }
}

TEST_CASE("program: cos is even, sin is odd, and √x·√x is x") {
    Program p;
    const int x = coordinate(p, 0), y = coordinate(p, 1);
    const int d = p.sum(0, {{1, x}, {-1, y}}), minus_d = p.sum(0, {{1, y}, {-1, x}});
    CHECK(p.call(Op::cos, {d}) == p.call(Op::cos, {minus_d}));
    CHECK(p.sum(0, {{1, p.call(Op::sin, {d})}, {1, p.call(Op::sin, {minus_d})}}) == p.number(0));
    const int root = p.power(x, Rational(1) / 2);
    CHECK(p.product(1, {{root, 1}, {root, 1}}) == x);
    CHECK(p.power(x, Rational(-3) / 2) == p.product(1, {{x, -1}, {root, -1}}));
    CHECK(p.call(Op::sqrt, {p.number(Rational(4) / 9)}) == p.number(Rational(2) / 3));
}

TEST_CASE("program: parts that depend on parameters only are collected and not counted") {
    Program p;
    const int x = coordinate(p, 0), a = parameter(p, 0), b = parameter(p, 1);
    const int value = p.product(3, {{a, 1}, {b, 2}, {x, 1}});
    const std::vector<int> roots{value};
    CHECK(p.count(roots).total() == 1);
    const int shifted = p.sum(2, {{1, a}, {3, b}, {1, x}});
    const std::vector<int> others{shifted};
    CHECK(p.count(others).total() == 1);
}

TEST_CASE(
    "program: a·(b·x) takes one multiplication with a·b known beforehand, and two where b·x is an acceleration "
    "too") {
    const State<double> state{.parameters = {0.7, 1.9}, .q = {1.3, -0.4}, .qdot = {}, .qddot = {}};
    for (const bool is_wanted : {false, true}) {
        Program p;
        const int x = coordinate(p, 0), y = coordinate(p, 1), a = parameter(p, 0), b = parameter(p, 1);
        const int force = p.product(-1, {{b, 2}, {x, 1}, {y, 1}});
        p.roots = {{Group::forcing, "f0", force},
                   {Group::acceleration, "a0", p.product(1, {{force, 1}, {a, -1}})}};
        if (is_wanted) p.roots.push_back({Group::acceleration, "a1", force});
        CHECK(p.count(p.right_hand_side()).total() == 3);  // b² x y, then by 1/a

        const Program result = shared(p);
        CHECK(result.count(result.right_hand_side()).total() == (is_wanted ? 3 : 2));
        const std::vector<double> values = interpret<double>(result, state);
        CHECK(values[result.nodes_of(Group::forcing)[0]] == doctest::Approx(1.9 * 1.9 * 1.3 * 0.4).epsilon(1e-15));
        CHECK(values[result.nodes_of(Group::acceleration)[0]] ==
              doctest::Approx(1.9 * 1.9 * 1.3 * 0.4 / 0.7).epsilon(1e-15));
    }
}

TEST_CASE("program: high powers are repeated squares, and the interpreter's value is that of pow") {
    Program p;
    const int x = coordinate(p, 0);
    const std::vector<int> roots{p.product(1, {{x, 13}})};
    CHECK(p.count(roots).total() <= 6);
    const std::vector<double> value =
        interpret<double>(p, {.parameters = {}, .q = {1.7}, .qdot = {}, .qddot = {}});
    CHECK(value[roots[0]] == doctest::Approx(std::pow(1.7, 13)).epsilon(1e-14));
}

TEST_CASE("solve: sparse, dense, indefinite and singular matrices against Eigen") {
    std::mt19937_64 random(7);
    std::uniform_real_distribution<double> uniform(-1, 1);
    struct Case {
        const char* name;
        int n;
        double density;
        bool zero_diagonal;
    };
    for (const Case& c :
         {Case{"dense", 5, 1, false}, Case{"sparse", 8, 0.3, false}, Case{"indefinite", 4, 1, true},
          Case{"one", 1, 1, false}, Case{"indefinite sparse", 6, 0.9, true}}) {
        CAPTURE(c.name);
        Eigen::MatrixXd M = Eigen::MatrixXd::Zero(c.n, c.n);
        Eigen::VectorXd f(c.n);
        Program p;
        std::vector<int> lower, forcing;
        std::vector<double> values;
        const auto variable = [&](double value) {
            values.push_back(value);
            return coordinate(p, static_cast<int>(values.size()) - 1);
        };
        for (int i = 0; i < c.n; ++i)
            for (int j = 0; j <= i; ++j) {
                const bool there = i == j ? !c.zero_diagonal : uniform(random) < 2 * c.density - 1;
                M(i, j) = M(j, i) = there ? uniform(random) + (i == j ? 4 : 0) : 0;
                lower.push_back(there ? variable(M(i, j)) : p.number(0));
            }
        for (int i = 0; i < c.n; ++i) forcing.push_back(variable(f[i] = uniform(random)));
        const auto x = solve_symmetric(p, lower, forcing);
        REQUIRE(x);
        const std::vector<double> value =
            interpret<double>(p, {.parameters = {}, .q = values, .qdot = {}, .qddot = {}});
        const Eigen::VectorXd expected = test::solved(M, f).value();
        for (int i = 0; i < c.n; ++i) CHECK(value[(*x)[i]] == doctest::Approx(expected[i]).epsilon(1e-11));
    }
    Program p;
    const int a = parameter(p, 0), zero = p.number(0);
    CHECK_FALSE(solve_symmetric(p, {a, zero, zero}, {a, a}));
}

TEST_CASE("constants: terms of parameters that cancel are removed, and a shared sum without any is kept") {
    Program p;
    const int A = p.variable({Variable::Kind::parameter, 0}), C = p.variable({Variable::Kind::parameter, 1});
    const int m = p.variable({Variable::Kind::parameter, 2}), q = p.variable({Variable::Kind::coordinate, 0});
    const int z = p.product(1, {{m, 2}}), rest = p.sum(0, {{1, A}, {-1, C}, {-1, z}});
    p.roots = {{Group::output, "a", p.product(1, {{p.sum(0, {{1, z}, {1, rest}}), 1}, {q, 1}})},
               {Group::output, "b", p.product(1, {{rest, 1}, {q, 2}})}};
    const Program simple = with_simple_constants(p);
    const Node& a = simple[simple.nodes_of(Group::output)[0]];
    CHECK(std::any_of(a.args.begin(), a.args.end(),
                      [&](int arg) { return simple[arg].op == Op::sum && simple[arg].args.size() == 2; }));
    const State<double> s{.parameters = {1.7, 0.4, 1.3}, .t = 0, .q = {0.8}, .qdot = {}, .qddot = {}};
    const std::vector<double> before = interpret(p, s), after = interpret(simple, s);
    for (std::size_t k = 0; k < 2; ++k)
        CHECK(after[simple.nodes_of(Group::output)[k]] ==
              doctest::Approx(before[p.nodes_of(Group::output)[k]]).epsilon(1e-14));
}

TEST_CASE("emit: M and f are visible by name, and functions with nothing to do are not written") {
    const Mechanism m = prepared(read_scene(test::source_path("scenes/textbook/heavy_top_joint.toml"))).mechanism;
    const std::string text = emit(choose(m, formalism("kane").derive(m)).program).text;
    for (const char* part : {"// M00 = A, M10 = 0, M11 = A, M20 = 0, M21 = 0, M22 = C",
                             "const Real f0 = ", "const Real f1 = ", "// f2 = 0"})
        CHECK_MESSAGE(text.find(part) != std::string::npos, part);
    for (const char* part : {"void events_at", "double tan(", "struct sines"})
        CHECK_MESSAGE(text.find(part) == std::string::npos, part);
}

TEST_CASE("energy: where the speeds are body rates, T is half the sum of moments of inertia times their squares") {
    const Mechanism m = prepared(read_scene(test::source_path("scenes/textbook/heavy_top_joint.toml"))).mechanism;
    const Program p = choose(m, formalism("kane").derive(m)).program;
    State<double> s = start_of(m).state();
    s.q = {0.7, -0.2, 0.4, 0.5};
    s.qdot = {0.3, -1.1, 2.4};
    std::vector<double> inertia(2);  // A and C
    for (std::size_t k = 0; k < p.parameters.size(); ++k)
        if (p.parameters[k].name == "A" || p.parameters[k].name == "C")
            inertia[p.parameters[k].name == "C" ? 1 : 0] = s.parameters[k];
    const double T = 0.5 * (inertia[0] * (0.3 * 0.3 + 1.1 * 1.1) + inertia[1] * 2.4 * 2.4);
    const std::vector<int> kinetic = p.nodes_of(Group::kinetic);
    CHECK(interpret(p, s)[kinetic[0]] == doctest::Approx(T).epsilon(1e-13));
    CHECK(p.count(kinetic).total() < 12);  // no quaternion in it
    CHECK(p.nodes_of(Group::jacobi) == p.nodes_of(Group::energy));
}

TEST_CASE("solve: row exchanges take a pivot that does not vanish at the witness") {
    Program p;
    const int b = p.variable({Variable::Kind::parameter, 0}), c = p.variable({Variable::Kind::parameter, 1}),
              zero = p.number(0), one = p.number(1), two = p.number(2);
    // [b 0 1; 0 c 0; 1 0 0] x = (1, 1, 2) has x = (2, 1/c, 1 - 2 b).
    const Witness witness(State<double>{.parameters = {0, 4}, .q = {}, .qdot = {}, .qddot = {}});
    const auto x = solve_symmetric(p, {b, zero, c, one, zero, zero}, {one, one, two}, 0, witness);
    REQUIRE(x);
    for (const double at : {0.0, 0.3}) {
        const auto value = interpret(p, State<double>{.parameters = {at, 4}, .q = {}, .qdot = {}, .qddot = {}});
        const double expected[] = {2, 0.25, 1 - 2 * at};
        for (std::size_t i = 0; i < 3; ++i)
            CHECK(std::abs(value[static_cast<std::size_t>((*x)[i])] - expected[i]) < 1e-15);
    }
}

}  // namespace generator_program
