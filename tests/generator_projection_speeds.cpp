// SPDX-License-Identifier: MIT
// The emitted step to the constraints where the state is (q, u), against what defines it, from the other functions
// of the same file: q' = S u + h0 by the right-hand side, A and B = A S by constraints_at, M by mass_forcing.
//   δq = S M⁻¹Bᵀ (B M⁻¹Bᵀ)⁻¹ f, or Aᵀ (A Aᵀ)⁻¹ f where u has eliminated all;   δu = M⁻¹Bᵀ (B M⁻¹Bᵀ)⁻¹ (A q' + b at
//   q − δq)
#include <doctest/doctest.h>

#include <Eigen/Dense>
#include <fstream>
#include <iterator>
#include <random>

#include "alembert/base/dense.hpp"
#include "alembert/native/compilation.hpp"
#include "alembert/ode/integrate.hpp"
#include "alembert/ode/projection.hpp"
#include "analysis/state/assemble.hpp"
#include "analysis/state/prepared.hpp"
#include "codegen/emit/emit.hpp"
#include "model/formalism/kane.hpp"
#include "program/lower/choose.hpp"
#include "program/lower/lower.hpp"
#include "scenes.hpp"
#include "solved.hpp"

namespace generator_projection_speeds {

using namespace alembert;
using Eigen::MatrixXd;
using Eigen::VectorXd;

namespace {

struct Loaded {
    Mechanism mechanism;
    Program program;
    Module module;
    Start start;
    std::vector<double> par, state;  ///< at the start, which obeys the constraints
};

/// With `without`, the file's own projection is hidden.
Loaded loaded(const Scene& scene, bool without = false) {
    const Mechanism m = prepared(scene).mechanism;
    const Equations equations = kane(m);
    Program program = choose(m, equations).program;
    std::string text = emit(program).text;
    if (without) text.replace(text.find("* alembert_projection()"), 23, "* hidden_projection()");
    const Module module = load(compile(text, program.name, {}).object);
    Start start = start_of(m);
    assemble(start, m, lower_constraints(m), {});
    const State<double> state = state_of(start, m, equations);
    std::vector<double> both = state.q;
    both.insert(both.end(), state.qdot.begin(), state.qdot.end());
    return {m, std::move(program), module, start, prepared(module, start.parameters), std::move(both)};
}

Loaded loaded(const char* file, bool without = false) {
    return loaded(read_scene(test::source_path(file)), without);
}

struct Seen {
    VectorXd position, velocity;
    MatrixXd A, B, S, M;
};

Seen seen(const Loaded& here, double t, const VectorXd& state) {
    using Rows = Eigen::Map<const Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>>;
    const alembert_solver_table& table = here.module.table();
    const int n = table.coordinates, s = table.speeds, m = table.constraints;
    std::vector<double> rows(static_cast<std::size_t>(m * (n + s)));
    VectorXd forcing(s), at_rest = state, rate(n + s), rate_at_rest(n + s);
    Seen result{VectorXd(m), VectorXd(m), {}, {}, MatrixXd(n, s), MatrixXd(s, s)};
    table.constraints_at(t, state.data(), here.par.data(), result.position.data(), result.velocity.data(),
                         rows.data());
    table.mass_forcing(t, state.data(), here.par.data(), result.M.data(), forcing.data());
    result.A = Rows(rows.data(), m, n);
    result.B = Rows(rows.data() + m * n, m, s);
    at_rest.tail(s).setZero();
    table.rhs(t, at_rest.data(), here.par.data(), rate_at_rest.data());
    for (int k = 0; k < s; ++k) {
        VectorXd moving = at_rest;
        moving[n + k] = 1;
        table.rhs(t, moving.data(), here.par.data(), rate.data());
        result.S.col(k) = (rate - rate_at_rest).head(n);
    }
    return result;
}

constexpr const char* in_speeds[] = {
    "scenes/textbook/free_body_quaternion.toml", "scenes/textbook/heavy_top_quaternion.toml",
    "scenes/textbook/heavy_top_joint.toml",      "scenes/textbook/rolling_coin.toml",
    "scenes/benchmark/free_body.toml",           "tests/odd/speeds_with_multipliers.toml",
    "tests/odd/speeds_all_eliminated.toml",      "tests/odd/speeds_of_a_quaternion.toml"};

Scene four_bars_in_speeds() {
    std::ifstream file(test::source_path("scenes/benchmark/four_bars_2.toml"));
    const std::string text{std::istreambuf_iterator<char>(file), {}};
    return parse_scene(text +
                           "\n[speeds]\na = \"q0' + q1'\"\nb = \"q1' - p0'\"\nc = \"2*q2'\"\nd = \"p0' + "
                           "0.5*p1'\"\ne = \"p1'\"\n",
                       "four_bars_in_speeds.toml");
}

}  // namespace

TEST_CASE("projection: in speeds the emitted step is the least change, at any state") {
    int along = 0, across = 0, idle = 0;
    const unsigned seed = 61;
    std::mt19937_64 random(seed);
    for (const char* file : in_speeds) {
        CAPTURE(file);
        CAPTURE(seed);
        const Loaded here = loaded(file);
        const alembert_solver_table& table = here.module.table();
        const int n = table.coordinates, s = table.speeds, m = table.constraints;
        REQUIRE(here.module.projection() != nullptr);
        if (here.module.projection()->project == nullptr) {
            ++idle;
            Projection projection(here.module, here.start.parameters);
            CHECK_FALSE(projection.after_steps());
            CHECK(seen(here, 0, Eigen::Map<const VectorXd>(here.state.data(), n + s)).B.isZero(0));
            continue;
        }
        for (int trial = 0; trial < 5; ++trial) {
            const State<double> random_state = test::random_state(here.start, random);
            const double t = random_state.t;
            VectorXd state(n + s), moved(n + s), position(m), pivots(m);
            std::copy(random_state.q.begin(), random_state.q.end(), state.begin());
            std::copy_n(random_state.qdot.begin(), s, state.begin() + n);
            here.module.projection()->project(t, state.data(), here.par.data(), moved.data(), position.data(),
                                              pivots.data());
            const Seen before = seen(here, t, state);
            VectorXd arrived = state;
            arrived.head(n) = moved.head(n);
            const Seen after = seen(here, t, arrived);
            CHECK((position - before.position).norm() <= 1e-12 * (1 + position.norm()));
            VectorXd dq, du = VectorXd::Zero(s);
            if (before.B.isZero(0)) {
                ++across;
                std::vector<int> holonomic;
                for (int k = 0; k < m; ++k)
                    if (here.mechanism.constraints[static_cast<std::size_t>(k)].position) holonomic.push_back(k);
                const MatrixXd A = before.A(holonomic, Eigen::all);
                dq = A.transpose() * VectorXd(test::solved(A * A.transpose(), position(holonomic)).value());
                CHECK((A * before.S).norm() <= 1e-12 * A.norm() * before.S.norm());
            } else {
                ++along;
                const MatrixXd across_B = test::solved(before.M, before.B.transpose()).value();
                const MatrixXd S = before.B * across_B;  // with zero rows of eliminated ones
                dq = before.S * (across_B * least_norm(S, position).x);
                du = across_B * least_norm(S, after.velocity).x;
                CHECK((before.A * dq - position).norm() <= 1e-10 * (1 + before.A.norm() * dq.norm()));
            }
            CHECK((state.head(n) - dq - moved.head(n)).norm() <= 1e-10 * (1 + dq.norm() + state.norm()));
            CHECK((state.tail(s) - du - moved.tail(s)).norm() <= 1e-10 * (1 + du.norm() + state.norm()));
        }
    }
    CHECK(along >= 10);
    CHECK(across >= 20);
    CHECK(idle == 1);
}

TEST_CASE("projection: in speeds a file without its own step is projected to the same state by decompositions") {
    std::mt19937_64 random(62);
    std::uniform_real_distribution<double> off(-1e-6, 1e-6);
    for (const char* file : in_speeds) {
        CAPTURE(file);
        const Loaded here = loaded(file), blind = loaded(file, true);
        REQUIRE(blind.module.projection() == nullptr);
        Projection emitted(here.module, here.start.parameters), decomposed(blind.module, here.start.parameters);
        std::vector<double> state = here.state;
        for (double& x : state) x += off(random);
        std::vector<double> a = state, b = state;
        emitted(here.start.t, a.data());
        decomposed(here.start.t, b.data());
        CHECK_FALSE(emitted.is_near_singular());
        double size = 0;
        for (const double x : a) size = std::max(size, std::abs(x));
        for (std::size_t i = 0; i < a.size(); ++i)
            CHECK(std::abs(a[i] - b[i]) < 1e-10 * (1 + size));  // the matrices of the two are 1e-6 apart
        CHECK(emitted.residual(here.start.t, a.data()) < 1e-14 * (1 + size * size));
        CHECK(emitted.residual(here.start.t, b.data()) < 1e-14 * (1 + size * size));
        // A state that obeys the constraints is not changed.
        std::vector<double> again = a;
        emitted(here.start.t, again.data());
        CHECK(again == a);
    }
}

TEST_CASE("projection: in speeds constraints hold to rounding along long runs, and energy to the tolerance") {
    for (const char* file : {"scenes/textbook/heavy_top_quaternion.toml", "scenes/benchmark/free_body.toml",
                             "tests/odd/speeds_of_a_quaternion.toml"}) {
        CAPTURE(file);
        const Loaded here = loaded(file);
        Projection projection(here.module, here.start.parameters);
        const bool conserved = here.mechanism.inputs.empty() &&
                               // The radius of its ring changes.
                               std::string(file).find("odd") == std::string::npos;
        double worst = 0, first = 0, drift = 0;
        const auto on_step = [&](double t, std::span<const double> y, std::span<const double> rate) {
            worst = std::max(worst, projection.residual(t, y.data()));
            double energy[4], jacobi = 0;
            here.module.table().energy(t, y.data(), rate.data(), here.par.data(), energy, &jacobi);
            if (t == here.start.t) first = energy[2];
            drift = std::max(drift, std::abs(energy[2] - first));
        };
        for (const Method method : {Method::dop853, Method::dopri5, Method::abm}) {
            worst = drift = 0;
            Options options{
                .method = method, .start = here.start.t, .duration = 40, .tolerance = 1e-9, .on_step = on_step};
            if (method == Method::abm) options.step = 1e-3;
            projection.begin(options.start, here.state.data());
            const System system{
                .rhs = projection.guarded(make_rhs(here.module, here.start.parameters), here.start.parameters),
                .project = projection.after_steps()};
            const Trajectory motion = integrate(system, here.state, options);
            REQUIRE_FALSE(motion.failure);
            CHECK(worst < 1e-13);
            if (conserved) CHECK(drift < 1e-6);
        }
    }
}

TEST_CASE("projection: in speeds four-bars pass their flat poses on their branch") {
    const Loaded here = loaded(four_bars_in_speeds());
    REQUIRE(here.module.table().speed_names != nullptr);
    Projection projection(here.module, here.start.parameters);
    int near_singular = 0;
    const Options options{.method = Method::dop853,
                          .duration = 10,
                          .tolerance = 1e-10,
                          .on_step = [&](double, std::span<const double>, std::span<const double>) {
                              near_singular += projection.is_near_singular() ? 1 : 0;
                          }};
    const System system{
        .rhs = projection.guarded(make_rhs(here.module, here.start.parameters), here.start.parameters),
        .project = projection.after_steps()};
    const Trajectory motion = integrate(system, here.state, options);
    REQUIRE_FALSE(motion.failure);
    CHECK(near_singular > 0);
    const auto end = motion.final_state();
    // Of the equation of a pendulum, as in commands_hard.cpp.
    CHECK(std::abs(end[0] + 31.7505971869842) < 31 * 2e-7);
    CHECK(std::abs(end[3]) < 2e-7);
    CHECK(std::abs(end[7] / 2 + 1.50664218083798) < 2e-7);
}

}  // namespace generator_projection_speeds
