// SPDX-License-Identifier: GPL-2.0-or-later
// A constraint a·q' + b = 0 follows from A q' + c = 0 if (a, b) = σᵀ(A, c) with some σ, wherever the positions
// hold. A relation of analytic functions that holds at places chosen at random holds everywhere (but for chance).
#include "analysis/state/left_out.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

#include "alembert/base/dense.hpp"
#include "alembert/base/random.hpp"
#include "alembert/base/tolerances.hpp"
#include "analysis/state/assemble.hpp"
#include "analysis/state/nearly_redundant.hpp"
#include "base/language/say.hpp"
#include "program/lower/lower.hpp"
#include "program/rounding.hpp"

namespace alembert {

namespace {

constexpr int states_around = 3;
// Of a coordinate and of the duration: small, because another branch of the positions is another mechanism.
constexpr double reach = 1e-2;
constexpr double farthest = 10;  // in units of the change that was asked for; farther away lies another branch
constexpr double looser_near = 10;
constexpr double looser = 1e3;  // what is kept may be off by a tolerance each, and what follows from it by more

/// A state near this one, for numbers of any size: each coordinate changes by a part of itself, and one that is
/// zero by as much as the smallest other.
std::vector<double> changes(const std::vector<double>& q, std::mt19937_64& random) {
    const UniformReal<> part(-reach, reach);
    double least = HUGE_VAL;
    for (const double x : q)
        if (x != 0) least = std::min(least, std::abs(x));
    if (!std::isfinite(least)) least = 1;
    std::vector<double> result;
    for (const double x : q) result.push_back(part(random) * (x != 0 ? std::abs(x) : least));
    return result;
}

double size_of(const std::vector<double>& list) {
    double result = 0;
    for (const double x : list) result = std::max(result, std::abs(x));
    return result;
}

}  // namespace

LeftOut::LeftOut(const Mechanism& m) {
    if (m.redundant.empty()) return;
    Mechanism whole = m;
    whole.redundant.clear();
    for (const Mechanism::Constraint& c : m.redundant) (c.tie ? whole.constraints : whole.redundant).push_back(c);
    if (whole.constraints.size() > m.constraints.size()) {
        Program program = lower_constraints(whole);
        whole_.emplace(Whole{.mechanism = std::move(whole), .program = std::move(program)});
    }
    Mechanism kept = m;
    kept.redundant.clear();
    kept.speeds.clear();
    kept.q_is_guess.assign(m.q.size(), true);
    kept.qdot_is_guess.assign(m.q.size(), true);
    Mechanism all = kept;
    all.constraints.insert(all.constraints.end(), m.redundant.begin(), m.redundant.end());
    Program program = lower_constraints(all), kept_program = lower_constraints(kept);
    std::set<int> parameters;
    for (int id = 0; id < static_cast<int>(program.size()); ++id)
        if (program[id].op == Op::variable && program[id].variable.kind == Variable::Kind::parameter)
            parameters.insert(program[id].variable.index);
    both_.emplace(Both{.kept = std::move(kept),
                       .kept_program = std::move(kept_program),
                       .program = std::move(program),
                       .count_kept = static_cast<int>(m.constraints.size()),
                       .count = static_cast<int>(m.constraints.size() + m.redundant.size()),
                       .constraints = all.constraints,
                       .parameters = std::move(parameters)});
}

void LeftOut::check(const Start& start) const {
    if (!both_) return;
    Start here = start;
    if (!move_onto_kept(here)) return;
    check_position(here.state());
    if (!has_other_parameters(here)) return;
    check_row(here.state());
    std::mt19937_64 random(3);
    for (int k = 0; k < states_around; ++k) {
        Start other = here;
        other.t += reach * (k + 1) * start.duration;
        const std::vector<double> asked = changes(here.q, random);
        for (std::size_t i = 0; i < asked.size(); ++i) other.q[i] += asked[i];
        if (!move_onto_kept(other)) continue;
        std::vector<double> moved;
        for (std::size_t i = 0; i < asked.size(); ++i) moved.push_back(other.q[i] - here.q[i]);
        if (size_of(moved) > farthest * size_of(asked)) continue;
        check_position(other.state());
        check_row(other.state());
    }
}

bool LeftOut::move_onto_kept(Start& start) const {
    start.speeds.clear();
    try {
        assemble(start, both_->kept, both_->kept_program, {}, false);
        return true;
    } catch (const std::runtime_error&) {
        return false;
    }
}

bool LeftOut::has_other_parameters(const Start& start) const {
    return std::any_of(both_->parameters.begin(), both_->parameters.end(), [&](int k) {
        const auto at = static_cast<std::size_t>(k);
        return start.parameters[at] != both_->program.parameters[at].value;
    });
}

void LeftOut::check_position(const State<double>& state) const {
    const Program& p = both_->program;
    const std::vector<double> value = interpret(p, state), size = sizes_of_terms(p, state);
    const std::vector<int> nodes = p.nodes_of(Group::position), rows = p.nodes_of(Group::row);
    const auto n = static_cast<Eigen::Index>(state.q.size());
    const auto row = [&](int k) {
        Eigen::VectorXd result(n);
        for (Eigen::Index i = 0; i < n; ++i)
            result[i] = value[static_cast<std::size_t>(rows[static_cast<std::size_t>(k * n + i)])];
        return result;
    };
    const auto length = [&](int k) { return row(k).norm(); };
    const auto terms = [&](int k) { return size[static_cast<std::size_t>(nodes[static_cast<std::size_t>(k)])]; };
    for (int k = both_->count_kept; k < both_->count; ++k) {
        const double residual = std::abs(value[static_cast<std::size_t>(nodes[static_cast<std::size_t>(k)])]);
        const bool nearly = both_->constraints[static_cast<std::size_t>(k)].nearly.has_value();
        // The terms may all be zero, and their rounding is that of the coordinates.
        if (residual >
            (nearly ? looser_near * tolerance::nearly_dependent_row *
                          scale_of_row(both_->constraints, k, length, terms)
                    : looser * tolerance::initial_values * (terms(k) + row(k).lpNorm<1>() * size_of(state.q))))
            refuse(k, residual);
    }
}

void LeftOut::check_row(const State<double>& state) const {
    const Program& p = both_->program;
    const std::vector<double> value = interpret(p, state), sizes = sizes_of_terms(p, state);
    const std::vector<int> rows = p.nodes_of(Group::row), rates = p.nodes_of(Group::velocity),
                           positions = p.nodes_of(Group::position);
    const auto n = static_cast<Eigen::Index>(state.q.size());
    Eigen::MatrixXd A(both_->count, n);
    Eigen::VectorXd offset(both_->count), size(both_->count);
    for (Eigen::Index k = 0; k < both_->count; ++k) {
        const int node = rates[static_cast<std::size_t>(k)];
        double carried = 0;
        for (Eigen::Index i = 0; i < n; ++i) {
            A(k, i) = value[static_cast<std::size_t>(rows[static_cast<std::size_t>(k * n + i)])];
            carried += A(k, i) * state.qdot[static_cast<std::size_t>(i)];
        }
        offset[k] = value[static_cast<std::size_t>(node)] - carried;
        size[k] = sizes[static_cast<std::size_t>(node)];
    }
    if (!A.allFinite() || !offset.allFinite()) return;  // a pole, of which others tell
    const Eigen::MatrixXd kept = A.topRows(both_->count_kept);
    for (Eigen::Index k = both_->count_kept; k < both_->count; ++k) {
        const Eigen::RowVectorXd row = A.row(k);
        const Eigen::VectorXd share = least_norm(kept.transpose(), row.transpose()).x;
        const double apart = (row.transpose() - kept.transpose() * share).norm();
        if (both_->constraints[static_cast<std::size_t>(k)].nearly) {
            const auto length = [&](int other) { return A.row(other).norm(); };
            const auto terms = [&](int other) {
                return sizes[static_cast<std::size_t>(positions[static_cast<std::size_t>(other)])];
            };
            if (apart > looser_near * tolerance::nearly_dependent_row *
                            scale_of_row(both_->constraints, static_cast<int>(k), length, terms))
                refuse(static_cast<int>(k), apart);
            continue;
        }
        if (apart > looser * tolerance::dependent_row * row.norm() + tolerance::vanished_row * A.norm())
            refuse(static_cast<int>(k), apart);
        const double early = std::abs(offset[k] - share.dot(offset.head(both_->count_kept)));
        const double terms = size[k] + share.cwiseAbs().dot(size.head(both_->count_kept));
        if (early > looser * tolerance::initial_values * terms) refuse(static_cast<int>(k), early);
    }
}

std::vector<bool> tied_parameters(const Mechanism& mechanism, const Start& start) {
    std::vector<bool> tied(start.parameters.size(), false);
    if (mechanism.redundant.empty()) return tied;
    const LeftOut left_out(mechanism);
    for (std::size_t k = 0; k < tied.size(); ++k)
        for (const double part : {0.01, -0.01}) {
            Start other = start;
            other.parameters[k] += part * (start.parameters[k] != 0 ? start.parameters[k] : 1);
            try {
                left_out.check(other);
            } catch (const ModelError&) {
                tied[k] = true;
            }
        }
    return tied;
}

void LeftOut::refuse(int constraint, double residual) const {
    throw ModelError(
        say("constraint '{}' follows from the others at the values of the scene, but is off by {:.6g} at these: "
            "what was added or left out for the scene does not hold there",
            both_->constraints[static_cast<std::size_t>(constraint)].name, residual));
}

}  // namespace alembert
