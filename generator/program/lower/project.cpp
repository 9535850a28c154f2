// SPDX-License-Identifier: GPL-2.0-or-later
//   K (δπ, ·) = (0, f),   δq = S δπ,   K (δu, ·) = (0, A_q h + b at q − δq),   A = A_q S
// (Hairer & Wanner, Solving ODEs II, §VII.2; there S = 1); if all constraints are eliminated, A_q Aₑᵀ ν = f, δq =
// Aₑᵀ ν.
#include "program/lower/project.hpp"

#include <algorithm>

#include "program/lower/lower.hpp"
#include "program/solve.hpp"

namespace alembert {

using GiNaC::ex;

namespace {

/// a·b + rest
int dot(Program& program, const std::vector<int>& a, const std::vector<int>& b, int rest) {
    std::vector<Program::Term> terms{{1, rest}};
    for (std::size_t i = 0; i < a.size(); ++i) terms.emplace_back(1, program.product(1, {{a[i], 1}, {b[i], 1}}));
    return program.sum(0, terms);
}

/// Σ columns_k x_k
std::vector<int> combined(Program& program, const std::vector<std::vector<int>>& columns,
                          const std::vector<int>& x) {
    std::vector<int> result;
    for (std::size_t i = 0; i < columns.front().size(); ++i) {
        std::vector<Program::Term> terms;
        for (std::size_t k = 0; k < columns.size(); ++k)
            terms.emplace_back(1, program.product(1, {{columns[k][i], 1}, {x[k], 1}}));
        result.push_back(program.sum(0, terms));
    }
    return result;
}

/// Moves coordinates along `rows` so that `residual` becomes 0, by the least change in the Euclidean metric.
struct LeastChange {
    std::vector<int> change, pivots;  ///< pivots of rows·rowsᵀ
};
std::optional<LeastChange> least_change(Program& program, const std::vector<std::vector<int>>& rows,
                                        const std::vector<int>& residual) {
    std::vector<int> square;
    for (std::size_t k = 0; k < rows.size(); ++k)
        for (std::size_t j = 0; j <= k; ++j) square.push_back(dot(program, rows[k], rows[j], program.number(0)));
    const auto nu = solve_symmetric(program, square, residual);
    if (!nu) return std::nullopt;
    LeastChange result{.change = combined(program, rows, *nu), .pivots = {}};
    // The pivots of the elimination have the opposite sign.
    for (const int pivot : later_pivots(program, square, static_cast<int>(rows.size()), 0))
        result.pivots.push_back(program.sum(0, {{-1, pivot}}));
    return result;
}

std::vector<int> lowered(const std::function<int(const ex&)>& lowering, const std::vector<ex>& list) {
    std::vector<int> nodes;
    for (const ex& e : list) nodes.push_back(lowering(e));
    return nodes;
}

/// The pivots of the constraints that are kept, into which those of the constraints that are tied to them are
/// multiplied.
void put_pivots(Program& program, std::vector<int>& pivots, const Mechanism& m, const Equations& equations,
                const MotionMatrix& matrix) {
    const std::vector<const Mechanism::Constraint*>& tied = matrix.tied;
    const std::vector<int> kept = equations.kept(m);
    const int s = equations.size(), all = s + static_cast<int>(kept.size() + tied.size());
    const std::vector<int> divided = later_pivots(program, matrix.K, all, s, matrix.witness);
    for (std::size_t k = 0; k < kept.size(); ++k)
        pivots[kept[k]] = divided.empty() ? program.number(1) : divided[k];
    for (std::size_t k = 0; k < tied.size() && !divided.empty(); ++k) {
        const int c = *std::find_if(kept.begin(), kept.end(),
                                    [&](int one) { return m.constraints[one].tie == tied[k]->tie; });
        pivots[c] = program.product(1, {{pivots[c], 1}, {divided[kept.size() + k], 1}});
    }
}

}  // namespace

void add_projection(Program& program, const Mechanism& m, const Equations& equations, const MotionMatrix& matrix,
                    bool fold) {
    const bool own_speeds = !equations.speeds_are_rates();
    const std::size_t n = m.q.size(), s = equations.u.size();
    const std::vector<int> position = program.nodes_of(Group::position), kept = equations.kept(m);
    std::vector<int> across;  // constraints that the speeds have eliminated and that coordinates may violate
    for (const Equations::Eliminated& e : equations.eliminated)
        if (!program.is_zero(position[e.constraint])) across.push_back(e.constraint);
    if (kept.empty() && across.empty()) return;

    std::vector<std::pair<GiNaC::symbol, int>> given;
    std::vector<int> u, change(s, program.number(0));
    for (std::size_t k = 0; k < s; ++k) u.push_back(program.variable({Variable::Kind::rate, static_cast<int>(k)}));
    for (std::size_t k = 0; k < s && own_speeds; ++k) given.emplace_back(equations.u[k], u[k]);
    const auto here = lowering_into(program, m, given, fold);
    std::vector<int> pivots(position.size(), program.number(0)), residual, off;
    const auto solve = [&](const std::vector<int>& right) {
        std::vector<int> sides(s, program.number(0));
        sides.insert(sides.end(), right.begin(), right.end());
        return *solve_symmetric(program, matrix.K, sides, static_cast<int>(s), matrix.witness);
    };
    const auto row_of = [&](std::size_t k) { return own_speeds ? m.constraints[kept[k]].row : equations.A[k]; };
    const bool only_norms = !own_speeds && across.empty() &&
                            std::all_of(kept.begin(), kept.end(), [&](int c) { return m.constraints[c].norm; });
    const std::vector<int>& by_rows = kept.empty() ? across : kept;
    if (kept.empty() || only_norms) {
        std::vector<std::vector<int>> rows;
        for (const int c : by_rows) {
            rows.push_back(lowered(here, m.constraints[c].row));
            residual.push_back(position[c]);
        }
        const auto least = least_change(program, rows, residual);
        if (!least) return;
        off = least->change;
        for (std::size_t k = 0; k < least->pivots.size(); ++k) pivots[by_rows[k]] = least->pivots[k];
    } else {
        for (const int c : kept) residual.push_back(position[c]);
        for (const Mechanism::Constraint* c : matrix.tied) residual.push_back(here(c->position.value_or(0)));
        off = solve(residual);
        off.resize(s);
        std::vector<std::vector<int>> columns;
        for (std::size_t k = 0; k < s && own_speeds; ++k)
            columns.push_back(lowered(here, m.z->push_forward(equations.h, {{equations.u[k], 1}})));
        if (own_speeds) off = combined(program, columns, off);
        put_pivots(program, pivots, m, equations, matrix);
    }

    for (std::size_t i = 0; i < n; ++i) {
        const int q = program.variable({Variable::Kind::coordinate, static_cast<int>(i)});
        given.emplace_back(m.q[i], program.sum(0, {{1, q}, {-1, off[i]}}));
        program.roots.push_back({Group::projected, m.q[i].get_name(), given.back().second});
    }
    if (!kept.empty()) {
        const auto there = lowering_into(program, m, given, fold);
        const std::vector<int> rates = own_speeds ? lowered(there, equations.h) : u;
        residual.clear();
        for (std::size_t k = 0; k < kept.size(); ++k)
            residual.push_back(
                dot(program, lowered(there, row_of(k)), rates, there(m.constraints[kept[k]].offset)));
        if (only_norms) {
            std::vector<std::vector<int>> rows;
            for (std::size_t k = 0; k < kept.size(); ++k) rows.push_back(lowered(there, row_of(k)));
            if (const auto least = least_change(program, rows, residual)) change = least->change;
        } else {
            for (const Mechanism::Constraint* c : matrix.tied)
                residual.push_back(dot(program, lowered(there, c->row), rates, there(c->offset)));
            change = solve(residual);
        }
    }
    for (std::size_t k = 0; k < s; ++k) {
        const std::string name = own_speeds ? equations.u[k].get_name() : m.q[k].get_name() + "'";
        program.roots.push_back({Group::projected, name, program.sum(0, {{1, u[k]}, {-1, change[k]}})});
    }
    for (const int pivot : pivots) program.roots.push_back({Group::pivot, "", pivot});
}

}  // namespace alembert
