// SPDX-License-Identifier: GPL-2.0-or-later
// G = A W Aᵀ with a positive W has the characteristic polynomial λ^(m−r) (λ^r + c₁ λ^(r−1) + … + c_r), and
//   E = (G^r + c₁ G^(r−1) + … + c_r)/c_r
// is 1 on its null space and 0 on the rest. c_k and the powers come from Leverrier's recursion (Decell, An
// application of the Cayley-Hamilton theorem to generalized matrix inversion, SIAM Review 7 (1965) 526):
//   B₁ = 1,   c_k = −tr(G B_k)/k,   B_{k+1} = G B_k + c_k,   E = B_{r+1}/c_r.
#include "program/tie.hpp"

#include <algorithm>

namespace alembert {

namespace {

using Matrix = std::vector<std::vector<int>>;

/// 1/M_ii, in whose metric rows have sizes that do not depend on the units of the coordinates; 1 if some
/// coordinate that the rows hold has no inertia of its own.
std::vector<int> weights(Program& p, const Matrix& rows, const std::vector<int>& inertia) {
    const auto is_held = [&](std::size_t i) {
        return std::any_of(rows.begin(), rows.end(), [&](const auto& row) { return !p.is_zero(row[i]); });
    };
    bool is_measured = true;
    for (std::size_t i = 0; i < inertia.size(); ++i) is_measured &= !is_held(i) || !p.is_zero(inertia[i]);
    std::vector<int> result(inertia.size(), p.number(1));
    for (std::size_t i = 0; i < inertia.size() && is_measured; ++i)
        if (is_held(i)) result[i] = p.product(1, {{inertia[i], -1}});
    return result;
}

/// The product of two symmetric matrices that commute.
Matrix product(Program& p, const Matrix& a, const Matrix& b) {
    Matrix result(a.size(), std::vector<int>(a.size()));
    for (std::size_t i = 0; i < a.size(); ++i)
        for (std::size_t j = 0; j <= i; ++j) {
            std::vector<Program::Term> terms;
            for (std::size_t k = 0; k < a.size(); ++k)
                terms.emplace_back(1, p.product(1, {{a[i][k], 1}, {b[k][j], 1}}));
            result[i][j] = result[j][i] = p.sum(0, terms);
        }
    return result;
}

int trace(Program& p, const Rational& factor, const Matrix& a) {
    std::vector<Program::Term> terms;
    for (std::size_t i = 0; i < a.size(); ++i) terms.emplace_back(factor, a[i][i]);
    return p.sum(0, terms);
}

}  // namespace

std::vector<int> tie_of_rows(Program& p, const std::vector<std::vector<int>>& rows,
                             const std::vector<int>& inertia, int rank) {
    const std::size_t m = rows.size();
    const std::vector<int> weight = weights(p, rows, inertia);
    Matrix G(m, std::vector<int>(m));
    for (std::size_t i = 0; i < m; ++i)
        for (std::size_t j = 0; j <= i; ++j) {
            std::vector<Program::Term> terms;
            for (std::size_t k = 0; k < weight.size(); ++k)
                terms.emplace_back(1, p.product(1, {{rows[i][k], 1}, {rows[j][k], 1}, {weight[k], 1}}));
            G[i][j] = G[j][i] = p.sum(0, terms);
        }
    Matrix power = G, B;
    int c = p.number(1);
    for (int k = 1; k <= rank; ++k) {
        if (k > 1) power = product(p, G, B);
        c = trace(p, Rational(-1) / k, power);
        B = power;
        for (std::size_t i = 0; i < m; ++i) B[i][i] = p.sum(0, {{1, power[i][i]}, {1, c}});
    }
    const int scale = p.product(1, {{trace(p, Rational(1) / rank, G), 1}, {c, -1}});
    std::vector<int> lower;
    for (std::size_t i = 0; i < m; ++i)
        for (std::size_t j = 0; j <= i; ++j) lower.push_back(p.product(1, {{B[i][j], 1}, {scale, 1}}));
    return lower;
}

}  // namespace alembert
