// SPDX-License-Identifier: GPL-2.0-or-later
#include "analysis/audit/description_poses.hpp"

#include "alembert/base/dense.hpp"
#include "alembert/base/tolerances.hpp"
#include "model/formalism/lagrange.hpp"
#include "program/lower/lower.hpp"

namespace alembert {

namespace {

constexpr int others = 4;  // states away from the given one that show the usual size of each row

/// The mechanism with each row of M as a nonholonomic constraint.
Mechanism with_rows_of_mass(const Mechanism& mechanism) {
    Mechanism m = with_own_intermediates(mechanism);
    const Equations e = lagrange_operator(m);
    m.z = e.z;
    m.constraints.clear();
    for (int i = 0; i < m.size(); ++i) {
        Mechanism::Constraint row;
        row.name = m.q[static_cast<std::size_t>(i)].get_name();
        row.holonomic = false;
        for (int j = 0; j < m.size(); ++j)
            row.row.push_back(e.M(static_cast<unsigned>(i), static_cast<unsigned>(j)));
        m.constraints.push_back(std::move(row));
    }
    return m;
}

/// Whether M has its full rank at one of the states at least.
bool is_regular_somewhere(const Mechanism& rows, const std::vector<State<double>>& states) {
    const Program program = lower_constraints(rows);
    const std::vector<int> nodes = program.nodes_of(Group::row);
    for (const State<double>& state : states) {
        const std::vector<double> value = interpret(program, state);
        Eigen::MatrixXd M(rows.size(), rows.size());
        for (Eigen::Index i = 0, k = 0; i < M.rows(); ++i)
            for (Eigen::Index j = 0; j < M.cols(); ++j, ++k)
                M(i, j) = value[static_cast<std::size_t>(nodes[static_cast<std::size_t>(k)])];
        if (!M.allFinite()) continue;
        const Eigen::VectorXd sigma = singular_values(M).values;
        if (sigma[sigma.size() - 1] > tolerance::dependent_row * sigma[0]) return true;
    }
    return false;
}

}  // namespace

std::vector<SingularPose> description_poses(const Mechanism& m, const State<double>& state) {
    if (!m.constraints.empty() || !m.redundant.empty() || m.size() == 0 || m.size() > most_described ||
        m.given_lagrangian || !m.symbols->functions().empty())
        return {};
    const Mechanism rows = with_rows_of_mass(m);
    std::vector<State<double>> states;
    for (int k = 1; k <= others; ++k) {
        states.push_back(state);
        for (std::size_t i = 0; i < state.q.size(); ++i)
            states.back().q[i] += 0.3 * k + 0.17 * static_cast<double>(i) * k;
    }
    if (!is_regular_somewhere(rows, states)) return {};
    return singular_poses(rows, state, states);
}

}  // namespace alembert
