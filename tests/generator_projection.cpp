// SPDX-License-Identifier: MIT
// The emitted step to the constraints against what defines it, from the other functions of the same file: A δq = f
// with M δq in the span of the rows of A (the least change in the metric of M), and the same for rates at the new
// position.
#include <doctest/doctest.h>

#include <Eigen/Dense>
#include <random>

#include "alembert/base/dense.hpp"
#include "alembert/native/compilation.hpp"
#include "alembert/ode/projection.hpp"
#include "analysis/state/assemble.hpp"
#include "analysis/state/prepared.hpp"
#include "codegen/emit/emit.hpp"
#include "model/formalism/routh.hpp"
#include "program/lower/choose.hpp"
#include "program/lower/lower.hpp"
#include "scenes.hpp"

namespace generator_projection {

using namespace alembert;
using Eigen::MatrixXd;
using Eigen::VectorXd;

namespace {

struct Seen {
    VectorXd position, velocity;
    MatrixXd A, M;
};

Seen seen(const Module& module, const std::vector<double>& par, const std::vector<double>& state) {
    const alembert_solver_table& table = module.table();
    const int n = table.coordinates, m = table.constraints;
    Seen s{VectorXd(m), VectorXd(m), MatrixXd(m, n), MatrixXd(n, n)};
    std::vector<double> rows(static_cast<std::size_t>(m * n)), forcing(static_cast<std::size_t>(n));
    table.constraints_at(0, state.data(), par.data(), s.position.data(), s.velocity.data(), rows.data());
    table.mass_forcing(0, state.data(), par.data(), s.M.data(), forcing.data());
    s.A = Eigen::Map<const Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>>(rows.data(), m,
                                                                                                   n);
    return s;
}

/// The part of M x that is no combination of the rows of A, relative to |M x|.
double off_span(const Seen& s, const VectorXd& x) {
    const VectorXd force = s.M * x, multipliers = least_norm(s.A.transpose(), force).x;
    return (force - s.A.transpose() * multipliers).norm() / force.norm();
}

}  // namespace

TEST_CASE("projection: the emitted step is Newton's, by the least change in the metric of M") {
    int scenes = 0;
    std::mt19937_64 random(6);
    std::uniform_real_distribution<double> off(-1e-3, 1e-3);
    for (const char* file : {"scenes/textbook/four_bar.toml", "scenes/textbook/slider_crank.toml",
                             "scenes/textbook/crane.toml", "scenes/textbook/coin.toml",
                             "scenes/benchmark/andrews.toml", "scenes/textbook/cartesian_pendulum.toml"}) {
        CAPTURE(file);
        const Mechanism m = prepared(read_scene(test::source_path(file))).mechanism;
        const Program program = choose(m, routh(m)).program;
        const Module module = load(compile(emit(program).text, program.name, {}).object);
        if (module.projection() == nullptr) continue;
        ++scenes;
        Start start = start_of(m);
        assemble(start, m, lower_constraints(m), {});
        const std::vector<double> par = prepared(module, start.parameters);
        const auto n = static_cast<std::size_t>(m.size());
        std::vector<double> state = start.q, moved(2 * n), position(m.constraints.size()), pivots(position.size());
        for (double& q : state) q += off(random);
        for (std::size_t i = 0; i < n; ++i) state.push_back(start.qdot[i] + off(random));
        module.projection()->project(0, state.data(), par.data(), moved.data(), position.data(), pivots.data());
        const Seen before = seen(module, par, state);
        VectorXd dq(n), du(n);
        std::vector<double> between = state;
        for (std::size_t i = 0; i < n; ++i) {
            dq[static_cast<Eigen::Index>(i)] = state[i] - moved[i];
            du[static_cast<Eigen::Index>(i)] = state[n + i] - moved[n + i];
            between[i] = moved[i];
        }
        const Seen after = seen(module, par, between);
        CHECK((before.A * dq - before.position).norm() <= 1e-12 * before.A.norm());
        CHECK((before.A * du - after.velocity).norm() <= 1e-12 * before.A.norm());
        if (before.position.norm() > 0)
            CHECK(off_span(before, dq) < 1e-8);  // dq has lost half of its digits as a difference
        CHECK(off_span(before, du) < 1e-8);
        for (std::size_t k = 0; k < position.size(); ++k)
            CHECK(position[k] == doctest::Approx(before.position[static_cast<Eigen::Index>(k)]));
        // After repeated steps the state obeys the constraints.
        Projection project(module, start.parameters);
        project(0, state.data());
        CHECK(project.residual(0, state.data()) < 1e-13 * std::max(1.0, before.A.norm()));
        CHECK_FALSE(project.is_near_singular());
    }
    CHECK(scenes >= 5);
}

TEST_CASE("projection: a failed run is forgotten before the next") {
    const Mechanism m =
        prepared(read_scene(test::source_path("scenes/textbook/cartesian_pendulum.toml"))).mechanism;
    const Program program = choose(m, routh(m)).program;
    const Module module = load(compile(emit(program).text, program.name, {}).object);
    REQUIRE(module.projection() != nullptr);
    const Start start = start_of(m);
    Projection projection(module, start.parameters);
    std::vector<double> home = start.q, lost;
    for (const double rate : start.qdot) home.push_back(rate);
    lost = home;
    for (double& x : lost) x = 1e6 * (x + 1);
    for (double& x : home) x += 1e-3;
    std::vector<double> at = lost;
    projection(0, at.data());
    at = home;
    projection(0, at.data());
    CHECK(projection.is_near_singular());  // its row is small beside that of the lost one
    projection.begin(0, home.data());
    at = home;
    projection(0, at.data());
    CHECK_FALSE(projection.is_near_singular());
    CHECK(projection.residual(0, at.data()) < 1e-12);
}

TEST_CASE(
    "projection: gamma is the rate of A q' that keeps it, and the careful accelerations are the emitted ones") {
    const Mechanism m = prepared(read_scene(test::source_path("scenes/textbook/four_bar.toml"))).mechanism;
    const Program program = choose(m, routh(m)).program;
    const Module module = load(compile(emit(program).text, program.name, {}).object);
    REQUIRE(module.projection() != nullptr);
    Start start = start_of(m);
    assemble(start, m, lower_constraints(m), {});
    const std::vector<double> par = prepared(module, start.parameters);
    const auto n = static_cast<std::size_t>(m.size());
    std::vector<double> state = start.q, rate(2 * n), gamma(m.constraints.size());
    for (std::size_t i = 0; i < n; ++i) state.push_back(start.qdot[i] + 0.3);
    Projection(module, start.parameters)(0, state.data());
    const Rhs rhs = make_rhs(module, start.parameters);
    rhs(0, state.data(), rate.data());
    module.projection()->gamma_at(0, state.data(), par.data(), gamma.data());
    const Seen here = seen(module, par, state);
    for (std::size_t k = 0; k < gamma.size(); ++k) {
        double sum = 0;
        for (std::size_t i = 0; i < n; ++i)
            sum += here.A(static_cast<Eigen::Index>(k), static_cast<Eigen::Index>(i)) * rate[n + i];
        CHECK(sum == doctest::Approx(gamma[k]).epsilon(1e-10));
    }
}

}  // namespace generator_projection
