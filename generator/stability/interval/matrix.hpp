// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// Small matrices of numbers with bounds (real_ball.hpp); every result is given only if it is certain.
///
///     const std::optional<RealBallMatrix> x = solution(A, b);       // nothing where no pivot is surely not zero
///     characteristic(A)                                             // det(s − A), highest power first
///     definiteness(K)                                               // by pivots of L D Lᵀ

#include <optional>
#include <vector>

#include "stability/interval/real_ball.hpp"

namespace alembert {

using RealBallVector = std::vector<RealBall>;

struct RealBallMatrix {
    RealBallMatrix() = default;
    RealBallMatrix(int rows, int columns)
        : rows(rows), columns(columns), entries(static_cast<std::size_t>(rows) * columns) {}
    static RealBallMatrix identity(int n);
    RealBall& operator()(int i, int j) { return entries[static_cast<std::size_t>(i) * columns + j]; }
    const RealBall& operator()(int i, int j) const { return entries[static_cast<std::size_t>(i) * columns + j]; }
    RealBallMatrix part(const std::vector<int>& of_rows, const std::vector<int>& of_columns) const;

    int rows = 0, columns = 0;
    std::vector<RealBall> entries;
};

RealBallMatrix operator*(const RealBallMatrix& a, const RealBallMatrix& b);
RealBallMatrix operator+(const RealBallMatrix& a, const RealBallMatrix& b);
RealBallMatrix operator*(const RealBall& a, const RealBallMatrix& b);
RealBallMatrix transposed(const RealBallMatrix& a);

/// X of A X = B, A square.
std::optional<RealBallMatrix> solution(RealBallMatrix A, RealBallMatrix B);

/// Columns that span the null space; nothing if the rank is not certain. A number that may be zero and is smaller
/// than `zero` counts as zero.
std::optional<RealBallMatrix> null_space(RealBallMatrix A, double zero = 0);

/// The rank, or nothing if it is not certain.
std::optional<int> rank(const RealBallMatrix& A);

/// Coefficients of det(s·1 − A), highest power first (Faddeev & Leverrier).
RealBallVector characteristic(const RealBallMatrix& A);

/// The numbers of positive, negative and zero eigenvalues of a symmetric matrix. Nothing if signs are not known.
struct SignCount {
    int positive = 0, negative = 0, zero = 0;
};
std::optional<SignCount> inertia(RealBallMatrix A);

/// The strongly connected groups of rows; the eigenvalues are those of the diagonal blocks.
std::vector<std::vector<int>> diagonal_blocks(const RealBallMatrix& A);

}  // namespace alembert
