// SPDX-License-Identifier: MIT
// The matrix C(q, q') of velocity terms, against Christoffel's symbols of Schiehlen's mass matrix, whose
// derivatives are those of dual numbers.
#include <algorithm>
#include <cmath>

#include "alembert/base/error.hpp"
#include "analysis/state/prepared.hpp"
#include "dual.hpp"
#include "model/formalism/elements.hpp"
#include "model/formalism/schiehlen.hpp"
#include "program/lower/lower.hpp"
#include "robot_functions.hpp"
#include "simulate/evaluate.hpp"

namespace generator_coriolis {

using namespace alembert;
using test::Dual;

namespace {

/// ∂M_ij/∂q_k at i·n² + j·n + k, of Schiehlen's M; and −f of M q'' = f.
struct Expected {
    std::vector<double> slope, minus_f;
};

Expected by_schiehlen(const Mechanism& m, const State<double>& s) {
    const Equations e = schiehlen(m);
    std::vector<GiNaC::ex> list;
    for (int i = 0; i < m.size(); ++i)
        for (int j = 0; j < m.size(); ++j) list.push_back(e.M(i, j));
    for (int i = 0; i < m.size(); ++i) list.push_back(-e.forcing(i));
    Program program;
    std::vector<std::pair<GiNaC::symbol, int>> open;
    for (const Mechanism::Unilateral& contact : m.unilateral)
        open.emplace_back(contact.gap.multiplier, program.number(0));
    const std::vector<int> nodes = lower_expressions(program, in_terms_of(e, m), list, open);
    const std::size_t n = s.q.size();
    Expected result{.slope = std::vector<double>(n * n * n), .minus_f = {}};
    for (std::size_t k = 0; k < n; ++k) {
        State<Dual> dual{.parameters = {s.parameters.begin(), s.parameters.end()},
                         .t = s.t,
                         .q = {s.q.begin(), s.q.end()},
                         .qdot = {s.qdot.begin(), s.qdot.end()},
                         .qddot = std::vector<Dual>(n)};
        dual.q[k].d = 1;
        const std::vector<Dual> value = interpret(program, dual);
        for (std::size_t ij = 0; ij < n * n; ++ij)
            result.slope[ij * n + k] = value[static_cast<std::size_t>(nodes[ij])].d;
        if (k == 0)
            for (std::size_t i = 0; i < n; ++i)
                result.minus_f.push_back(value[static_cast<std::size_t>(nodes[n * n + i])].v);
    }
    return result;
}

/// C by its definition.
std::vector<double> christoffel(const std::vector<double>& slope, const std::vector<double>& v) {
    const std::size_t n = v.size();
    const auto at = [&](std::size_t i, std::size_t j, std::size_t k) { return slope[(i * n + j) * n + k]; };
    std::vector<double> C(n * n);
    for (std::size_t i = 0; i < n; ++i)
        for (std::size_t j = 0; j < n; ++j)
            for (std::size_t k = 0; k < n; ++k)
                C[i * n + j] += (at(i, j, k) + at(i, k, j) - at(j, k, i)) * v[k] / 2;
    return C;
}

}  // namespace

TEST_CASE("functions: C is that of Christoffel's symbols, and M' - 2C is skew, in every scene") {
    std::vector<std::string> files = test::every_third(test::scenes_in("scenes/textbook"), 1);
    for (const char* name : {"benchmark/trees/arm7", "benchmark/trees/pend8", "gallery/six_joint_arm",
                             "gallery/universal_double_pendulum", "gallery/furuta_joints", "gallery/rssr"})
        files.push_back(test::source_path(std::string("scenes/") + name + ".toml"));
    files.push_back(test::source_path("tests/odd/armature.toml"));
    const unsigned seed = 20261126;
    CAPTURE(seed);
    std::mt19937_64 random(seed);
    int checked = 0;
    for (const std::string& file : files) {
        CAPTURE(file);
        const Mechanism m = prepared(read_scene(file)).mechanism;
        const bool has_quaternions = std::any_of(m.constraints.begin(), m.constraints.end(),
                                                 [](const Mechanism::Constraint& c) { return c.norm; });
        if (obstacle_to_schiehlen(m) || m.given_lagrangian || has_quaternions) continue;
        const RobotFunctions functions(m, false);
        const FunctionProgram coriolis = functions.dynamics("coriolis");
        for (int again = 0; again < 3; ++again) {
            const State<double> s = test::random_motion(m, random);
            const std::size_t n = s.q.size();
            const Expected expected = by_schiehlen(m, s);
            const std::vector<double> C = test::values(coriolis, s);
            test::check_near(C, christoffel(expected.slope, s.qdot));
            std::vector<double> sum;
            for (std::size_t i = 0; i < n; ++i)
                for (std::size_t j = 0; j < n; ++j) {
                    double change = 0;
                    for (std::size_t k = 0; k < n; ++k) change += expected.slope[(i * n + j) * n + k] * s.qdot[k];
                    sum.push_back(change - C[i * n + j] - C[j * n + i]);
                }
            double size = 1;
            for (const double x : C) size = std::max(size, std::abs(x));
            for (const double x : sum) CHECK(std::abs(x) < 1e-10 * size);
        }
        ++checked;
    }
    CHECK(checked > 20);
}

TEST_CASE("functions: C q' are the velocity terms of the equations") {
    std::mt19937_64 random(7);
    for (const char* name : {"benchmark/trees/arm7", "benchmark/trees/arm7g", "benchmark/trees/pend4",
                             "textbook/elastic_pendulum", "textbook/spherical_pendulum"}) {
        CAPTURE(name);
        const Mechanism m =
            prepared(read_scene(test::source_path(std::string("scenes/") + name + ".toml"))).mechanism;
        State<double> s = test::random_motion(m, random);
        const std::size_t n = s.q.size();
        const std::vector<double> C = test::values(RobotFunctions(m, false).dynamics("coriolis"), s),
                                  moving = by_schiehlen(m, s).minus_f, v = s.qdot;
        s.qdot.assign(n, 0);
        const std::vector<double> still = by_schiehlen(m, s).minus_f;
        std::vector<double> terms, expected;
        for (std::size_t i = 0; i < n; ++i) {
            terms.push_back(0);
            for (std::size_t j = 0; j < n; ++j) terms.back() += C[i * n + j] * v[j];
            expected.push_back(moving[i] - still[i]);
        }
        test::check_near(terms, expected);
    }
}

// A pendulum on a cart: M = [m + M, m l cos θ; m l cos θ, m l²], C = [0, −m l θ' sin θ; 0, 0].
TEST_CASE("functions: `eval` gives M and C, of a pendulum on a cart those of the book") {
    const Scene scene = parse_scene(R"toml(
[coordinates]
x = { initial = 0.2, rate = 0.5 }
theta = { initial = 0.7, rate = -1.1 }
[[particle]]
name = "cart"
mass = 3
position = ["x", 0]
[[particle]]
name = "bob"
mass = 2
position = ["x + 1.5*sin(theta)", "-1.5*cos(theta)"]
)toml",
                                    "cart.toml");
    const Evaluation e = evaluate(scene, {.matrices = true});
    const double coupling = 2 * 1.5 * std::cos(0.7);
    test::check_near(e.mass.at(0), {5, coupling}, 1e-14);
    test::check_near(e.mass.at(1), {coupling, 2 * 1.5 * 1.5}, 1e-14);
    test::check_near(e.coriolis.at(0), {0, 1.1 * 2 * 1.5 * std::sin(0.7)}, 1e-14);
    test::check_near(e.coriolis.at(1), {0, 0}, 1e-14);
    CHECK(evaluate(scene, {}).coriolis.empty());
}

TEST_CASE("functions: there is no C of quaternions") {
    const Mechanism m =
        prepared(read_scene(test::source_path("scenes/textbook/free_body_quaternion.toml"))).mechanism;
    CHECK_THROWS_WITH_AS(RobotFunctions(m, false).dynamics("coriolis"), doctest::Contains("leave 'coriolis' out"),
                         ModelError);
}

}  // namespace generator_coriolis
