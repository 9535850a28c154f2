// SPDX-License-Identifier: GPL-2.0-or-later
#include "analysis/redundancy.hpp"

#include <Eigen/Dense>
#include <random>

#include "analysis/assemble.hpp"
#include "lower/lower.hpp"

namespace alembert {

namespace {

constexpr int states = 8;
constexpr double negligible = 1e-9;

/// Which rows are combinations of those before them (Gram-Schmidt, twice, in the order of declaration).
std::vector<bool> dependent_rows(const Eigen::MatrixXd& A) {
    std::vector<bool> result;
    std::vector<Eigen::RowVectorXd> basis;
    for (Eigen::Index k = 0; k < A.rows(); ++k) {
        Eigen::RowVectorXd row = A.row(k);
        const double size = row.norm();
        for (int round = 0; round < 2; ++round)
            for (const Eigen::RowVectorXd& b : basis) row -= row.dot(b) * b;
        result.push_back(!(row.norm() > negligible * size));
        if (!result.back()) basis.push_back(row.normalized());
    }
    return result;
}

}  // namespace

std::vector<int> redundant_constraints(const Mechanism& mechanism) {
    if (mechanism.constraints.size() < 2 && static_cast<int>(mechanism.constraints.size()) < mechanism.size()) return {};
    const Program program = lower_constraints(mechanism);
    const std::vector<int> rows = program.nodes_of("row");
    const auto m = static_cast<Eigen::Index>(mechanism.constraints.size()), n = static_cast<Eigen::Index>(mechanism.size());
    std::vector<bool> redundant(mechanism.constraints.size(), true);
    const auto look = [&](const Start& start) {
        const std::vector<double> value = interpret(program, start.state());
        Eigen::MatrixXd A(m, n);
        for (Eigen::Index k = 0; k < m; ++k)
            for (Eigen::Index i = 0; i < n; ++i) A(k, i) = value[rows[k * n + i]];
        if (!A.allFinite()) return;
        const std::vector<bool> now = dependent_rows(A);
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

Mechanism without_constraints(Mechanism mechanism, const std::vector<int>& positions) {
    for (auto k = positions.rbegin(); k != positions.rend(); ++k)
        mechanism.constraints.erase(mechanism.constraints.begin() + *k);
    return mechanism;
}

}  // namespace alembert
