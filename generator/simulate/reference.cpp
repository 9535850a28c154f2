// SPDX-License-Identifier: GPL-2.0-or-later
#include "simulate/reference.hpp"

#include <fmt/format.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <ctime>
#include <span>

#include "alembert/base/dense.hpp"
#include "alembert/ode/integrate.hpp"
#include "base/language/say.hpp"
#include "program/event_code.hpp"
#include "program/lower/lower.hpp"
#include "program/lower/quick_times.hpp"
#include "program/tape.hpp"

namespace alembert {

namespace {

Quad quad_of_decimal(double x) {
    return quad_of(cln::rationalize(cln::cl_F(cln::cl_DF(x))));  // the simplest fraction that rounds to it
}

/// Moves `x[free]` until the nodes vanish. The residual is computed in Quad and its derivatives in double, so that
/// each round gains 15 digits.
class Settling {
public:
    Settling(const Mechanism& m, const Program& p, const QuadStart& start) : m_(m), p_(p), start_(start) {}

    struct Rows {
        std::vector<int> residual, derivative;  ///< nodes of the residuals, and n derivatives of each
        std::vector<Quad> target;
    };

    void operator()(const Rows& rows, std::vector<Quad>& q, std::vector<Quad>& u, std::vector<Quad>& x,
                    std::vector<int> free) const {
        const auto m = static_cast<Eigen::Index>(rows.residual.size());
        if (m == 0) return;
        if (free.empty())
            for (int i = 0; i < m_.size(); ++i) free.push_back(i);
        std::vector<int> wanted = rows.residual;
        wanted.insert(wanted.end(), rows.derivative.begin(), rows.derivative.end());
        Tape<Quad> tape(p_, wanted, start_.parameters);
        std::vector<Quad> out(wanted.size());
        for (int round = 0; round < 4; ++round) {
            tape(start_.t, q.data(), u.data(), out.data());
            Eigen::MatrixXd J(m, static_cast<Eigen::Index>(free.size()));
            Eigen::VectorXd f(m);
            Quad largest = 0;
            for (std::size_t k = 0; k < rows.residual.size(); ++k)
                largest = std::max(largest, abs(out[k] - rows.target[k]));
            if (!(largest > Quad(1e-33)) || !is_finite(largest)) return;
            for (Eigen::Index k = 0; k < m; ++k) {
                const auto row = static_cast<std::size_t>(k);
                f[k] = static_cast<double>((out[row] - rows.target[row]) / largest);
                for (std::size_t j = 0; j < free.size(); ++j)
                    J(k, static_cast<Eigen::Index>(j)) = static_cast<double>(
                        out[rows.residual.size() + row * m_.q.size() + static_cast<std::size_t>(free[j])]);
            }
            const Eigen::VectorXd step = least_norm(J, f).x;
            if (!step.allFinite()) return;
            for (std::size_t j = 0; j < free.size(); ++j)
                x[static_cast<std::size_t>(free[j])] -=
                    largest * static_cast<Quad>(step[static_cast<Eigen::Index>(j)]);
        }
    }

private:
    const Mechanism& m_;
    const Program& p_;
    const QuadStart& start_;
};

/// The nodes of a group with their derivatives from `rows`; of positions, only those of holonomic constraints.
Settling::Rows rows_of(const Program& p, const Mechanism& m, Group group, Group rows) {
    Settling::Rows result;
    const std::vector<int> residual = p.nodes_of(group), derivative = p.nodes_of(rows);
    const auto n = m.q.size();
    for (std::size_t k = 0; k < residual.size(); ++k) {
        if (group == Group::position && !m.constraints[k].position) continue;
        result.residual.push_back(residual[k]);
        for (std::size_t j = 0; j < n; ++j) result.derivative.push_back(derivative[k * n + j]);
    }
    result.target.resize(result.residual.size());
    return result;
}

std::vector<int> places(const std::vector<bool>& flags) {
    std::vector<int> result;
    for (std::size_t i = 0; i < flags.size(); ++i)
        if (flags[i]) result.push_back(static_cast<int>(i));
    return result;
}

}  // namespace

QuadStart quad_start(const Mechanism& m, const Equations& equations, const Start& doubles,
                     std::optional<double> duration) {
    QuadStart start;
    for (const Mechanism::Parameter& p : m.parameters)
        if (p.independent) start.parameters.push_back(quad_of(cln::the<cln::cl_RA>(p.number().to_cl_N())));

    Program program;
    const StartNodes nodes = lower_start(program, m);
    const auto values = [&](const std::vector<int>& of) {
        std::vector<Quad> result(of.size());
        Tape<Quad>(program, of, start.parameters)(0, nullptr, nullptr, result.data());
        return result;
    };
    std::vector<Quad> q = values(nodes.q), u = values(nodes.qdot), speeds = values(nodes.speeds),
                      states = values(nodes.states), times = values({nodes.t, nodes.duration});
    start.t = times[0];
    start.duration = duration ? quad_of_decimal(*duration) : times[1];

    const bool speeds_given = !doubles.speeds.empty();
    const Program constraints = lower_constraints(m);
    const std::vector<int> q_free = places(m.q_is_guess), u_free = places(m.qdot_is_guess);
    for (const int i : q_free)
        q[static_cast<std::size_t>(i)] = static_cast<Quad>(doubles.q[static_cast<std::size_t>(i)]);
    const Settling settle(m, constraints, start);
    settle(rows_of(constraints, m, Group::position, Group::row), q, u, q, q_free);
    if (speeds_given || !u_free.empty() || !m.constraints.empty()) {
        for (std::size_t i = 0; i < u.size(); ++i)
            if (speeds_given || (i < m.qdot_is_guess.size() && m.qdot_is_guess[i]))
                u[i] = static_cast<Quad>(doubles.qdot[i]);
        Settling::Rows rows = rows_of(constraints, m, Group::velocity, Group::row);
        if (speeds_given) {
            const Settling::Rows forms = rows_of(constraints, m, Group::speed, Group::form_row);
            rows.residual.insert(rows.residual.end(), forms.residual.begin(), forms.residual.end());
            rows.derivative.insert(rows.derivative.end(), forms.derivative.begin(), forms.derivative.end());
            rows.target.insert(rows.target.end(), speeds.begin(), speeds.end());
        }
        settle(rows, q, u, u, speeds_given ? std::vector<int>() : u_free);
    }

    start.state = q;
    if (equations.speeds_are_rates()) {
        start.state.insert(start.state.end(), u.begin(), u.end());
    } else if (speeds_given) {
        start.state.insert(start.state.end(), speeds.begin(), speeds.end());
    } else {
        Program forms;
        std::vector<int> nodes;
        for (const GiNaC::ex& form : equations.form) nodes.push_back(lower_expression(forms, m, form));
        std::vector<Quad> values(nodes.size());
        Tape<Quad>(forms, nodes, start.parameters)(start.t, q.data(), u.data(), values.data());
        start.state.insert(start.state.end(), values.begin(), values.end());
    }
    start.state.insert(start.state.end(), states.begin(), states.end());
    return start;
}

namespace {

/// The steps of a run in doubles that passes over no pulse and no narrow place; empty where there can be none.
std::vector<double> mesh_of(const Program& program, const std::vector<double>& parameters, const RoughRhs& rhs,
                            const QuadStart& start) {
    const auto t = static_cast<double>(start.t), duration = static_cast<double>(start.duration);
    System system{.quick_times = quick_times(program, parameters, t, t + duration),
                  .quick_places = {quick_places_code(program, Kinks::watched), parameters}};
    if (!(duration > 0) || (system.quick_times.empty() && !system.quick_places.code)) return {};
    std::vector<double> initial, mesh;
    for (const Quad& y : start.state) initial.push_back(static_cast<double>(y));
    system.rhs = make_rhs(static_cast<int>(initial.size()), rhs);
    integrate(
        system, initial,
        {.start = t,
         .duration = duration,
         .sample = duration,
         .when_stiff = Method::radau,
         .on_step = [&](double end, std::span<const double>, std::span<const double>) { mesh.push_back(end); }});
    return mesh;
}

}  // namespace

std::optional<Reference> reference(const Program& program, const QuadStart& start,
                                   const ReferenceOptions& options) {
    const std::size_t n = program.coordinates.size();
    const bool own_speeds = !program.speeds.empty();
    std::vector<int> wanted = program.nodes_of(Group::rate);
    const std::vector<int> accelerations = program.nodes_of(Group::acceleration);
    wanted.insert(wanted.end(), accelerations.begin(), accelerations.end());
    Tape<Quad> tape(program, wanted, start.parameters);
    double share = 0;  // the share of the work before this method
    const QuadRhs rhs = [&](Quad t, const Quad* state, Quad* rate) {
        if (options.progress && start.duration > 0)
            options.progress(share + 0.5 * static_cast<double>((t - start.t) / start.duration));
        if (!own_speeds) std::copy_n(state + n, n, rate);
        tape(t, state, state + n, own_speeds ? rate : rate + n);
    };

    std::vector<double> parameters;
    for (const Quad& value : start.parameters) parameters.push_back(static_cast<double>(value));
    Tape<double> rough_tape(program, wanted, parameters);
    const RoughRhs rough = [&](double t, const double* state, double* rate) {
        if (!own_speeds) std::copy_n(state + n, n, rate);
        rough_tape(t, state, state + n, own_speeds ? rate : rate + n);
    };

    std::vector<Quad> rate(start.state.size());
    const std::clock_t clock = std::clock();
    int calls = 0;
    do {
        rhs(start.t, start.state.data(), rate.data());
        ++calls;
    } while (std::clock() - clock < CLOCKS_PER_SEC / 1000);
    const double each = static_cast<double>(std::clock() - clock) / CLOCKS_PER_SEC / calls;
    const long budget = static_cast<long>(options.seconds / each) + 1;

    const Quad end = start.t + start.duration;
    const std::vector<double> mesh = mesh_of(program, parameters, rough, start);
    for (const double tolerance : {1e-28, 1e-20}) {
        share = 0;
        const QuadMotion first =
            extrapolate(rhs, start.state, start.t, end, {.tolerance = tolerance, .budget = budget, .mesh = mesh});
        if (!first.finished) continue;
        share = 0.5;
        const QuadMotion second =
            collocate(rhs, rough, start.state, first.mesh, {.tolerance = tolerance, .budget = 4 * budget});
        if (!second.finished) continue;
        const double apart = agreement(first.state, second.state);
        Reference result{
            .coordinates = {first.state.begin(), first.state.begin() + static_cast<std::ptrdiff_t>(n)},
            .rates = {},
            .speeds = {},
            .digits = std::clamp(static_cast<int>(std::floor(-std::log10(std::max(apart, 1e-33)))), 0, 33),
            .by = say("extrapolated midpoint rules (tolerance {:g}) and Gauss collocation of order 28, binary128",
                      tolerance),
            .evaluations = first.evaluations + second.evaluations};
        rhs(end, first.state.data(), rate.data());
        result.rates.assign(rate.begin(), rate.begin() + static_cast<std::ptrdiff_t>(n));
        if (own_speeds)
            result.speeds.assign(first.state.begin() + static_cast<std::ptrdiff_t>(n), first.state.end());
        return result;
    }
    return std::nullopt;
}

}  // namespace alembert
