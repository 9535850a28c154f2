// SPDX-License-Identifier: GPL-2.0-or-later
#include "state/redundancy.hpp"

#include <fmt/format.h>

#include <Eigen/Dense>
#include <algorithm>
#include <random>

#include "alembert/dense.hpp"
#include "alembert/tolerances.hpp"
#include "lower/lower.hpp"
#include "state/assemble.hpp"

namespace alembert {

namespace {

constexpr int states = 8;
/// Which rows are combinations of those before them in `order` (Gram-Schmidt, twice).
std::vector<bool> dependent_rows(const Eigen::MatrixXd& A, const std::vector<int>& order) {
    std::vector<bool> result(order.size());
    std::vector<Eigen::RowVectorXd> basis;
    for (const int k : order) {
        Eigen::RowVectorXd row = A.row(k);
        const double size = row.norm();
        for (int round = 0; round < 2; ++round)
            for (const Eigen::RowVectorXd& b : basis) row -= row.dot(b) * b;
        result[k] = !(row.norm() > tolerance::dependent_row * size);
        if (!result[k]) basis.push_back(row.normalized());
    }
    return result;
}

}  // namespace

std::vector<int> redundant_constraints(const Mechanism& mechanism) {
    if (mechanism.constraints.size() < 2 && static_cast<int>(mechanism.constraints.size()) < mechanism.size())
        return {};
    const Program program = lower_constraints(mechanism);
    const std::vector<int> rows = program.nodes_of(Group::row);
    const auto m = static_cast<Eigen::Index>(mechanism.constraints.size()),
               n = static_cast<Eigen::Index>(mechanism.size());
    // A velocity constraint that follows from a position is the one to drop: it does not say where.
    std::vector<int> order;
    for (const bool holonomic : {true, false})
        for (std::size_t k = 0; k < mechanism.constraints.size(); ++k)
            if (mechanism.constraints[k].holonomic == holonomic) order.push_back(static_cast<int>(k));
    std::vector<bool> redundant(mechanism.constraints.size(), true);
    const auto look = [&](const Start& start) {
        const std::vector<double> value = interpret(program, start.state());
        Eigen::MatrixXd A(m, n);
        for (Eigen::Index k = 0; k < m; ++k)
            for (Eigen::Index i = 0; i < n; ++i) A(k, i) = value[rows[k * n + i]];
        if (!A.allFinite()) return;
        const std::vector<bool> now = dependent_rows(A, order);
        for (std::size_t k = 0; k < redundant.size(); ++k) redundant[k] = redundant[k] && now[k];
    };
    Mechanism loose = mechanism;
    loose.q_is_guess.assign(mechanism.q.size(), true);
    loose.qdot_is_guess.assign(mechanism.q.size(), true);
    std::mt19937_64 random(1);
    std::uniform_real_distribution<double> away(-0.3, 0.3);
    for (int k = 0; k <= states; ++k) {
        Start start = start_of(mechanism);
        if (k > 0)
            for (double& q : start.q) q += away(random) * (1 + std::abs(q));
        try {
            assemble(start, k > 0 ? loose : mechanism, program, {});
        } catch (const std::runtime_error&) {
            if (k == 0) return {};  // which the command tells, with the reason
            continue;
        }
        look(start);
    }
    std::vector<int> result;
    for (std::size_t k = 0; k < redundant.size(); ++k)
        if (redundant[k]) result.push_back(static_cast<int>(k));
    return result;
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
    if (redundant.empty()) return;
    Mechanism others = without_constraints(mechanism, redundant);
    others.q_is_guess.assign(mechanism.q.size(), true);
    others.qdot_is_guess.assign(mechanism.q.size(), true);
    others.speeds.clear();
    const Program program = lower_constraints(mechanism), constraints = lower_constraints(others);
    const std::vector<int> velocity = program.nodes_of(Group::velocity);
    std::mt19937_64 random(2);
    std::uniform_real_distribution<double> away(-0.3, 0.3), rate(-1, 1);
    for (int k = 0; k < states; ++k) {
        Start start = start_of(others);
        for (double& q : start.q) q += away(random) * (1 + std::abs(q));
        for (double& u : start.qdot) u += rate(random);
        try {
            assemble(start, others, constraints, {});
        } catch (const std::runtime_error&) {
            continue;
        }
        const std::vector<double> value = interpret(program, start.state());
        for (const int r : redundant) {
            const double misfit = std::abs(value[velocity[r]]);
            if (std::isfinite(misfit) && misfit > 1e-6 * (1 + size_of_terms(program, velocity[r], value)))
                throw ModelError(fmt::format(
                    "constraint '{0}' has a row that follows from the others', and asks for other rates than "
                    "they do: together they hold only where a relation between the coordinates does; "
                    "write that relation as a holonomic constraint in place of '{0}'",
                    mechanism.constraints[r].name));
        }
    }
}

}  // namespace alembert
