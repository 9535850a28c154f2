// SPDX-License-Identifier: GPL-2.0-or-later
#include "analysis/state/redundancy.hpp"

#include <fmt/format.h>

#include <Eigen/Dense>
#include <algorithm>
#include <utility>

#include "alembert/base/dense.hpp"
#include "alembert/base/random.hpp"
#include "analysis/state/assemble.hpp"
#include "analysis/state/branch.hpp"
#include "analysis/state/contradiction.hpp"
#include "base/language/say.hpp"
#include "model/formalism/elements.hpp"
#include "model/sample_functions.hpp"
#include "program/lower/lower.hpp"

namespace alembert {

namespace {

constexpr int states = 8;

/// Marks the rows that are combinations of those before them in `order`.
std::vector<bool> dependent_rows(const Eigen::MatrixXd& A, const std::vector<int>& order, double least) {
    std::vector<bool> result(order.size());
    rests_of_rows(A, order, [&](int k, double rest) {
        const double size = A.row(k).norm();
        result[static_cast<std::size_t>(k)] = !(rest > least * size && size > tolerance::vanished_row * A.norm());
        return !result[static_cast<std::size_t>(k)];
    });
    return result;
}

/// The order in which rows are kept: first the holonomic ones, because they restrict positions, then rows that are
/// independent at the start.
std::vector<int> order_of_keeping(const Mechanism& mechanism, const Eigen::MatrixXd* at_start, double least) {
    std::vector<int> order;
    for (const bool holonomic : {true, false})
        for (int k = 0; k < static_cast<int>(mechanism.constraints.size()); ++k)
            if (mechanism.constraints[k].holonomic == holonomic) order.push_back(k);
    if (at_start == nullptr) return order;
    const std::vector<bool> dependent = dependent_rows(*at_start, order, least);
    std::stable_partition(order.begin(), order.end(),
                          [&](int k) { return mechanism.constraints[k].holonomic || !dependent[k]; });
    return order;
}

}  // namespace

std::vector<double> rests_of_rows(const Eigen::MatrixXd& A, const std::vector<int>& order,
                                  const std::function<bool(int k, double rest)>& keeps) {
    std::vector<double> result(static_cast<std::size_t>(A.rows()));
    std::vector<Eigen::RowVectorXd> basis;
    for (const int k : order) {
        Eigen::RowVectorXd row = A.row(k);
        for (int round = 0; round < 2; ++round)
            for (const Eigen::RowVectorXd& b : basis) row -= row.dot(b) * b;
        const double rest = row.norm();
        result[static_cast<std::size_t>(k)] = rest;
        if (keeps(k, rest)) basis.push_back(row / rest);
    }
    return result;
}

std::vector<int> redundant_constraints(const Mechanism& mechanism, double least) {
    if (constraints_are_open(mechanism)) return redundant_constraints(with_sample_functions(mechanism), least);
    if (mechanism.constraints.size() < 2 && static_cast<int>(mechanism.constraints.size()) < mechanism.size())
        return {};
    const Program program = lower_constraints(mechanism);
    const std::vector<int> rows = program.nodes_of(Group::row);
    const auto m = static_cast<Eigen::Index>(mechanism.constraints.size()),
               n = static_cast<Eigen::Index>(mechanism.size());
    std::vector<Eigen::MatrixXd> at;  // the rows at the start, then at states around it
    const auto take = [&](const Start& start) {
        const std::vector<double> value = interpret(program, start.state());
        Eigen::MatrixXd A(m, n);
        for (Eigen::Index r = 0; r < m; ++r)
            for (Eigen::Index i = 0; i < n; ++i) A(r, i) = value[rows[r * n + i]];
        if (A.allFinite()) at.push_back(std::move(A));
    };
    Start start = start_of(mechanism);
    try {
        assemble(start, mechanism, program, {});
    } catch (const std::runtime_error&) {
        return {};  // the command reports this, with the reason
    }
    take(start);
    const bool has_start = !at.empty();
    for (const Start& place : places_on_branch(mechanism, program, start, states, 1)) take(place);
    const std::vector<int> order = order_of_keeping(mechanism, has_start ? &at.front() : nullptr, least);
    std::vector<std::vector<bool>> dependent;
    for (const Eigen::MatrixXd& A : at) dependent.push_back(dependent_rows(A, order, least));
    // Rows may vanish at the start that do not vanish around it; then the start does not show which rows are
    // needed.
    const auto rank = [](const std::vector<bool>& of) { return std::count(of.begin(), of.end(), false); };
    if (has_start && dependent.size() > 1 &&
        std::all_of(dependent.begin() + 1, dependent.end(),
                    [&](const auto& other) { return rank(dependent.front()) <= rank(other); }))
        dependent.erase(dependent.begin());
    std::vector<int> result;
    for (int k = 0; k < static_cast<int>(m); ++k)
        if (std::all_of(dependent.begin(), dependent.end(), [&](const auto& of) { return of[k]; }))
            result.push_back(k);
    return result;
}

bool factors_change(const Mechanism& mechanism, int row, const std::vector<int>& redundant,
                    const std::vector<State<double>>& places) {
    const Program program = lower_constraints(mechanism);
    const std::vector<int> rows = program.nodes_of(Group::row);
    const Eigen::Index n = mechanism.size();
    std::optional<Eigen::VectorXd> first;
    for (const State<double>& state : places) {
        const std::vector<double> value = interpret(program, state);
        const auto at = [&](int r) {
            Eigen::VectorXd result(n);
            for (Eigen::Index i = 0; i < n; ++i) result[i] = value[rows[r * n + i]];
            return result;
        };
        std::vector<int> kept;
        for (int r = 0; r < static_cast<int>(mechanism.constraints.size()); ++r)
            if (std::find(redundant.begin(), redundant.end(), r) == redundant.end()) kept.push_back(r);
        Eigen::MatrixXd basis(n, static_cast<Eigen::Index>(kept.size()));
        for (std::size_t c = 0; c < kept.size(); ++c) basis.col(static_cast<Eigen::Index>(c)) = at(kept[c]);
        const Eigen::VectorXd share = least_norm(basis, at(row)).x;
        if (!share.allFinite()) continue;
        if (!first) first = share;
        if ((share - *first).norm() > 1e-7 * (1 + first->norm())) return true;
    }
    return false;
}

Mechanism along_axes(Mechanism m, int rolling) {
    Mechanism::Rolling& rolls = m.rollings[static_cast<std::size_t>(rolling)];
    rolls.is_along = true;
    GiNaC::exmap gone;  // the multipliers of rows that hold identically along the axes
    std::vector<Mechanism::Constraint> all;
    bool put = false;
    for (const Mechanism::Constraint& c : m.constraints) {
        if (c.rolling != rolling) {
            all.push_back(c);
            continue;
        }
        if (!std::exchange(put, true)) all.insert(all.end(), rolls.along.begin(), rolls.along.end());
        if (std::none_of(rolls.along.begin(), rolls.along.end(),
                         [&](const Mechanism::Constraint& a) { return a.multiplier.is_equal(c.multiplier); })) {
            gone[c.multiplier] = 0;
            m.identities.push_back(c.name);
        }
    }
    m.constraints = std::move(all);
    for (auto* parts : {&m.outputs, &m.events, &m.definitions})
        for (Mechanism::Definition& part : *parts)
            if (!gone.empty()) part.value = substitute(*m.z, {part.value}, gone)[0];
    return m;
}

Mechanism with_regular_rows(Mechanism mechanism) {
    for (std::size_t r = 0; r < mechanism.rollings.size(); ++r) {
        if (mechanism.rollings[r].along.empty() || mechanism.rollings[r].is_along) continue;
        const std::vector<int> redundant = redundant_constraints(mechanism);
        const auto own = std::find_if(redundant.begin(), redundant.end(), [&](int k) {
            return mechanism.constraints[k].rolling == static_cast<int>(r);
        });
        if (own == redundant.end()) continue;
        const Mechanism sampled = with_sample_functions(mechanism);
        const std::vector<State<double>> places =
            states_that_obey(without_constraints(sampled, redundant), start_of(sampled), states);
        if (std::any_of(own, redundant.end(), [&](int k) {
                return mechanism.constraints[k].rolling == static_cast<int>(r) &&
                       factors_change(sampled, k, redundant, places);
            }))
            mechanism = along_axes(std::move(mechanism), static_cast<int>(r));
    }
    return mechanism;
}

std::vector<int> follows_from(const Mechanism& mechanism, int k, const std::vector<int>& redundant,
                              const std::vector<State<double>>& states) {
    const Program program = lower_constraints(mechanism);
    const std::vector<int> rows = program.nodes_of(Group::row);
    const Eigen::Index n = mechanism.size();
    std::vector<int> kept;
    for (int r = 0; r < static_cast<int>(mechanism.constraints.size()); ++r)
        if (std::find(redundant.begin(), redundant.end(), r) == redundant.end()) kept.push_back(r);
    if (kept.empty()) return {};
    std::vector<bool> used(kept.size(), false);
    for (const State<double>& state : states) {
        const std::vector<double> value = interpret(program, state);
        const auto row = [&](int r) {
            Eigen::VectorXd result(n);
            for (Eigen::Index i = 0; i < n; ++i) result[i] = value[rows[r * n + i]];
            return result;
        };
        Eigen::MatrixXd basis(n, static_cast<Eigen::Index>(kept.size()));
        for (std::size_t c = 0; c < kept.size(); ++c) basis.col(static_cast<Eigen::Index>(c)) = row(kept[c]);
        const Eigen::VectorXd target = row(k), share = least_norm(basis, target).x;
        for (Eigen::Index c = 0; c < share.size(); ++c)
            if (std::abs(share[c]) * basis.col(c).norm() > 1e-7 * target.norm())
                used[static_cast<std::size_t>(c)] = true;
    }
    std::vector<int> result;
    for (std::size_t c = 0; c < kept.size(); ++c)
        if (used[c]) result.push_back(kept[c]);
    return result;
}

Mechanism without_constraints(Mechanism mechanism, const std::vector<int>& positions) {
    for (const int k : positions) mechanism.redundant.push_back(mechanism.constraints[k]);
    for (auto k = positions.rbegin(); k != positions.rend(); ++k)
        mechanism.constraints.erase(mechanism.constraints.begin() + *k);
    return mechanism;
}

void check_implied(const Mechanism& mechanism, const std::vector<int>& redundant) {
    if (redundant.empty() || constraints_are_open(mechanism)) return;
    Mechanism all = mechanism, others = without_constraints(mechanism, redundant);
    for (Mechanism* each : {&all, &others}) {
        each->q_is_guess.assign(mechanism.q.size(), true);
        each->qdot_is_guess.assign(mechanism.q.size(), true);
        each->speeds.clear();
    }
    const Program program = lower_constraints(all), constraints = lower_constraints(others);
    const std::vector<int> velocity = program.nodes_of(Group::velocity);
    std::mt19937_64 random(2);
    const UniformReal<> rate(-1, 1);
    // A position may follow from the others on one branch of their positions only, and that is where all hold. The
    // rates are those that the others allow.
    for (Start& start : places_on_branch(all, program, start_of(others), states, 2, false)) {
        try {
            for (double& u : start.qdot) u += rate(random);
            assemble(start, others, constraints, {});
        } catch (const std::runtime_error&) {
            continue;
        }
        const std::vector<double> value = interpret(program, start.state());
        for (const int r : redundant) {
            const double residual = std::abs(value[velocity[r]]);
            if (std::isfinite(residual) && residual > 1e-6 * (1 + size_of_terms(program, velocity[r], value)))
                throw ModelError(say(
                    "constraint '{0}' has a row that follows from the others', but prescribes rates that "
                    "contradict theirs: together they hold only where a relation between the coordinates does; "
                    "write that relation as a holonomic constraint in place of '{0}'",
                    mechanism.constraints[r].name));
        }
    }
}

}  // namespace alembert
