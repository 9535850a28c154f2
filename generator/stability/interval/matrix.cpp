// SPDX-License-Identifier: GPL-2.0-or-later
#include "stability/interval/matrix.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <numeric>

#include "program/echelon.hpp"

namespace alembert {

RealBallMatrix RealBallMatrix::identity(int n) {
    RealBallMatrix result(n, n);
    for (int i = 0; i < n; ++i) result(i, i) = 1;
    return result;
}

RealBallMatrix RealBallMatrix::part(const std::vector<int>& of_rows, const std::vector<int>& of_columns) const {
    RealBallMatrix result(static_cast<int>(of_rows.size()), static_cast<int>(of_columns.size()));
    for (int i = 0; i < result.rows; ++i)
        for (int j = 0; j < result.columns; ++j) result(i, j) = (*this)(of_rows[i], of_columns[j]);
    return result;
}

RealBallMatrix operator*(const RealBallMatrix& a, const RealBallMatrix& b) {
    RealBallMatrix result(a.rows, b.columns);
    for (int i = 0; i < a.rows; ++i)
        for (int k = 0; k < a.columns; ++k)
            if (!a(i, k).is_zero())
                for (int j = 0; j < b.columns; ++j) result(i, j) += a(i, k) * b(k, j);
    return result;
}

RealBallMatrix operator+(const RealBallMatrix& a, const RealBallMatrix& b) {
    RealBallMatrix result = a;
    for (std::size_t k = 0; k < a.entries.size(); ++k) result.entries[k] += b.entries[k];
    return result;
}

RealBallMatrix operator*(const RealBall& a, const RealBallMatrix& b) {
    RealBallMatrix result = b;
    for (RealBall& x : result.entries) x = a * x;
    return result;
}

RealBallMatrix transposed(const RealBallMatrix& a) {
    RealBallMatrix result(a.columns, a.rows);
    for (int i = 0; i < a.rows; ++i)
        for (int j = 0; j < a.columns; ++j) result(j, i) = a(i, j);
    return result;
}

namespace {

double weight(const RealBall& x) {  // the preference for a pivot
    return x.may_be_zero() ? 0 : std::abs(x.number());
}

struct RealBallField : FieldOperations<RealBall> {
    double zero = 0;  ///< what may be zero and is smaller counts as zero

    std::optional<std::size_t> pivot(RowsOf<RealBall>& rows, std::size_t first, std::size_t column) const {
        const std::size_t best = largest_in(rows, first, column, weight);
        if (weight(rows[best][column]) != 0) return best;
        for (std::size_t r = first; r < rows.size(); ++r) {
            RealBall& entry = rows[r][column];
            if (!entry.is_zero() && !(std::abs(entry.number()) + entry.radius() < zero)) return std::nullopt;
            entry = 0;
        }
        return rows.size();
    }
};

/// Reduced row echelon form of A, with B appended. Returns the columns of the pivots, or nothing if an entry that
/// should be zero is only near zero.
std::optional<std::vector<int>> eliminate(RealBallMatrix& A, RealBallMatrix* B, double zero = 0) {
    const std::array<RealBallMatrix*, 2> parts{&A, B};
    RowsOf<RealBall> rows(static_cast<std::size_t>(A.rows));
    for (int i = 0; i < A.rows; ++i)
        for (const RealBallMatrix* const m : parts)
            for (int k = 0; m && k < m->columns; ++k) rows[static_cast<std::size_t>(i)].push_back((*m)(i, k));
    const RealBallField field{{}, zero};
    const auto pivots = echelon(rows, static_cast<std::size_t>(A.columns), field);
    if (!pivots) return {};
    for (int i = 0; i < A.rows; ++i) {
        auto entry = rows[static_cast<std::size_t>(i)].begin();
        for (RealBallMatrix* const m : parts)
            for (int k = 0; m && k < m->columns; ++k) (*m)(i, k) = std::move(*entry++);
    }
    return std::vector<int>(pivots->begin(), pivots->end());
}

}  // namespace

std::optional<RealBallMatrix> solution(RealBallMatrix A, RealBallMatrix B) {
    const auto pivots = eliminate(A, &B);
    if (!pivots || static_cast<int>(pivots->size()) < A.rows) return {};
    return B;
}

std::optional<RealBallMatrix> null_space(RealBallMatrix A, double zero) {
    const auto pivots = eliminate(A, nullptr, zero);
    if (!pivots) return {};
    RealBallMatrix result(A.columns, A.columns - static_cast<int>(pivots->size()));
    for (int j = 0, free = 0; j < A.columns; ++j) {
        if (std::find(pivots->begin(), pivots->end(), j) != pivots->end()) continue;
        result(j, free) = 1;
        for (std::size_t k = 0; k < pivots->size(); ++k) result((*pivots)[k], free) = -A(static_cast<int>(k), j);
        ++free;
    }
    return result;
}

std::optional<int> rank(const RealBallMatrix& A) {
    RealBallMatrix copy = A;
    const auto pivots = eliminate(copy, nullptr);
    if (!pivots) return {};
    return static_cast<int>(pivots->size());
}

RealBallVector characteristic(const RealBallMatrix& A) {
    const int n = A.rows;
    RealBallVector c{RealBall(1)};
    RealBallMatrix M(n, n);
    for (int k = 1; k <= n; ++k) {
        for (int i = 0; i < n; ++i) M(i, i) += c.back();
        M = A * M;
        RealBall trace = 0;
        for (int i = 0; i < n; ++i) trace += M(i, i);
        c.push_back(-trace * RealBall(Rational(1) / k));
    }
    return c;
}

std::optional<SignCount> inertia(RealBallMatrix A) {
    SignCount result;
    std::vector<bool> done(static_cast<std::size_t>(A.rows), false);
    const auto remove = [&](int p) {
        for (int i = 0; i < A.rows; ++i) {
            if (done[i] || i == p || A(i, p).is_zero()) continue;
            const RealBall factor = A(i, p) / A(p, p);
            for (int j = 0; j < A.rows; ++j)
                if (!done[j] && j != p) A(i, j) -= factor * A(p, j);
        }
        (A(p, p).sign() == 1 ? result.positive : result.negative) += 1;
        done[p] = true;
    };
    for (int left = A.rows; left > 0; --left) {
        int best = -1;
        for (int i = 0; i < A.rows; ++i)
            if (!done[i] && weight(A(i, i)) > 0 && (best < 0 || weight(A(i, i)) > weight(A(best, best)))) best = i;
        if (best >= 0) {
            remove(best);
            continue;
        }
        // Without a pivot on the diagonal, a pair of elements off it gives one eigenvalue of each sign.
        std::pair<int, int> pair{-1, -1};
        bool all_zero = true;
        for (int i = 0; i < A.rows; ++i)
            for (int j = 0; j < A.rows; ++j) {
                if (done[i] || done[j]) continue;
                all_zero = all_zero && A(i, j).is_zero();
                if (i != j && weight(A(i, j)) > 0) pair = {i, j};
            }
        if (all_zero) {
            result.zero += left;
            return result;
        }
        if (pair.first < 0) return {};
        const auto [i, j] = pair;  // x → x_i + x_j
        for (int k = 0; k < A.rows; ++k) A(i, k) += A(j, k);
        for (int k = 0; k < A.rows; ++k) A(k, i) += A(k, j);
        if (weight(A(i, i)) == 0) return {};
        remove(i);
    }
    return result;
}

std::vector<std::vector<int>> diagonal_blocks(const RealBallMatrix& A) {
    const int n = A.rows;
    std::vector<std::vector<bool>> reach(static_cast<std::size_t>(n),
                                         std::vector<bool>(static_cast<std::size_t>(n)));
    for (int i = 0; i < n; ++i)
        for (int j = 0; j < n; ++j) reach[i][j] = i == j || !A(i, j).is_zero();
    for (int k = 0; k < n; ++k)
        for (int i = 0; i < n; ++i)
            for (int j = 0; j < n; ++j)
                if (reach[i][k] && reach[k][j]) reach[i][j] = true;
    std::vector<std::vector<int>> result;
    std::vector<bool> done(static_cast<std::size_t>(n), false);
    for (int i = 0; i < n; ++i) {
        if (done[i]) continue;
        result.emplace_back();
        for (int j = i; j < n; ++j)
            if (!done[j] && reach[i][j] && reach[j][i]) {
                result.back().push_back(j);
                done[j] = true;
            }
    }
    return result;
}

}  // namespace alembert
