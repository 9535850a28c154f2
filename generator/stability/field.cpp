// SPDX-License-Identifier: GPL-2.0-or-later
#include "stability/field.hpp"

#include <algorithm>
#include <cmath>

#include "base/language/say.hpp"
#include "program/echelon.hpp"

namespace alembert {

namespace {

/// The pivots are the largest values at the point. A division by one that may be zero throws.
struct ExpansionField {
    using Number = Expansion;
    static constexpr bool makes_ones = false;
    static std::size_t pivot(const RowsOf<Expansion>& rows, std::size_t first, std::size_t column) {
        return largest_in(rows, first, column, [](const Expansion& e) {
            return e.value().may_be_zero() ? 0 : std::abs(e.value().number());
        });
    }
    static bool is_zero(const Expansion&) { return false; }
    static Expansion quotient(const Expansion& a, const Expansion& b) { return a / b; }
    static void subtract(Expansion& from, const Expansion& factor, const Expansion& of) {
        from = from - factor * of;
    }
};

/// Solves the system of equations whose rows end with the right sides.
std::vector<Expansion> solved_rows(std::vector<std::vector<Expansion>> rows) {
    const std::size_t n = rows.size();
    echelon(rows, n, ExpansionField());
    std::vector<Expansion> result;
    for (std::size_t k = 0; k < n; ++k) result.push_back(rows[k][n] / rows[k][k]);
    return result;
}

/// Newton's method with the derivatives at the point: each round makes the terms of one more degree right.
void follow_constraints(const Local& local, State<Expansion>& state, int degree) {
    const Residuals& r = local.residuals;
    const auto matrix = [&](const std::vector<int>& nodes, std::size_t offset, const std::vector<int>& columns) {
        const Monomials linear(r.n + r.s, 1);
        std::vector<int> all;
        for (int k = 0; k < r.n + r.s; ++k) all.push_back(k);
        const auto value = interpret(r.program, local.state_at(local.point, &linear, all));
        RealBallMatrix result(static_cast<int>(nodes.size()), static_cast<int>(columns.size()));
        for (int i = 0; i < result.rows; ++i)
            for (int j = 0; j < result.columns; ++j)
                result(i, j) = value[nodes[i]].coefficient(1 + static_cast<int>(offset) + columns[j]);
        return result;
    };
    const auto solve_for = [&](const std::vector<int>& nodes, const std::vector<int>& unknowns, std::size_t offset,
                               std::vector<Expansion>& values) {
        if (unknowns.empty()) return;
        const RealBallMatrix J = matrix(nodes, offset, unknowns);
        const auto inverse = solution(J, RealBallMatrix::identity(J.rows));
        if (!inverse) throw NotAnalytic(say("the constraints are not surely regular"));
        for (int round = 0; round < degree; ++round) {
            const std::vector<Expansion> value = interpret(r.program, state);
            for (int i = 0; i < J.rows; ++i)
                for (int k = 0; k < J.rows; ++k)
                    values[unknowns[i]] +=
                        Expansion(-(*inverse)(i, k)) * without_constant(value[nodes[k]]);  // zero at the point
        }
    };
    solve_for(r.position, local.split.q_dependent, 0, state.q);
    solve_for(r.velocity, local.split.u_dependent, static_cast<std::size_t>(r.n), state.qdot);
}

}  // namespace

State<Expansion> state_of_series(const Local& local, const std::vector<Expansion>& x, int degree) {
    const std::size_t ne = local.essential.size();
    State<Expansion> state =
        local.state_at(local.point, nullptr, std::vector<int>(local.point.q.size() + local.point.u.size(), -1));
    for (std::size_t k = 0; k < ne; ++k) state.q[local.split.q[local.essential[k]]] = x[k];
    for (std::size_t j = 0; j < local.split.u.size(); ++j) state.qdot[local.split.u[j]] = x[ne + j];
    follow_constraints(local, state, degree);
    return state;
}

std::vector<Expansion> field(const Local& local, const std::vector<Expansion>& x, int degree) {
    const Residuals& r = local.residuals;
    const std::vector<Expansion> value = interpret(r.program, state_of_series(local, x, degree));
    const auto s = static_cast<std::size_t>(r.s), m = static_cast<std::size_t>(r.kept), size = s + m;
    // M u' − Aᵀλ = f, A u' = γ
    std::vector<std::vector<Expansion>> rows(size, std::vector<Expansion>(size + 1, Expansion(0)));
    for (std::size_t i = 0, next = 0; i < s; ++i) {
        for (std::size_t j = 0; j <= i; ++j) rows[i][j] = rows[j][i] = value[r.mass[next++]];
        rows[i][size] = value[r.forcing[i]];
        for (std::size_t k = 0; k < m; ++k) {
            rows[s + k][i] = value[r.row[k * s + i]];
            rows[i][s + k] = Expansion(-1) * rows[s + k][i];
        }
    }
    for (std::size_t k = 0; k < m; ++k) rows[s + k][size] = value[r.gamma[k]];
    const std::vector<Expansion> rates = solved_rows(std::move(rows));
    std::vector<Expansion> result;
    for (const int k : local.essential) result.push_back(value[r.rate[local.split.q[k]]]);
    for (const int j : local.split.u) result.push_back(rates[static_cast<std::size_t>(j)]);
    return result;
}

RealBall state_value(const Local& local, std::size_t k) {
    const std::size_t ne = local.essential.size();
    return k < ne ? local.point.q[local.split.q[local.essential[k]]] : local.point.u[local.split.u[k - ne]];
}

}  // namespace alembert
