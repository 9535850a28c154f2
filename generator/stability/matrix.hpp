// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// Matrices of numbers with bounds (certain.hpp): few rows, every answer with its certainty.
///
///     const std::optional<CertainMatrix> x = solution(A, b);        // nothing where no pivot is surely not zero
///     characteristic(A)                                             // det(s − A), highest power first
///     definiteness(K)                                               // by pivots of L D Lᵀ

#include <optional>
#include <vector>

#include "stability/certain.hpp"

namespace alembert {

using CertainVector = std::vector<Certain>;

struct CertainMatrix {
    CertainMatrix() = default;
    CertainMatrix(int rows, int columns)
        : rows(rows), columns(columns), entries(static_cast<std::size_t>(rows) * columns) {}
    static CertainMatrix identity(int n);
    Certain& operator()(int i, int j) { return entries[static_cast<std::size_t>(i) * columns + j]; }
    const Certain& operator()(int i, int j) const { return entries[static_cast<std::size_t>(i) * columns + j]; }
    CertainMatrix part(const std::vector<int>& of_rows, const std::vector<int>& of_columns) const;

    int rows = 0, columns = 0;
    std::vector<Certain> entries;
};

CertainMatrix operator*(const CertainMatrix& a, const CertainMatrix& b);
CertainMatrix operator+(const CertainMatrix& a, const CertainMatrix& b);
CertainMatrix operator*(const Certain& a, const CertainMatrix& b);
CertainMatrix transposed(const CertainMatrix& a);

/// X of A X = B, A square.
std::optional<CertainMatrix> solution(CertainMatrix A, CertainMatrix B);

/// Columns that span the null space; nothing where the rank is not certain. What cannot be told from zero and is
/// smaller than `zero` is taken for zero.
std::optional<CertainMatrix> null_space(CertainMatrix A, double zero = 0);

/// Rank, or nothing.
std::optional<int> rank(const CertainMatrix& A);

/// Coefficients of det(s·1 − A), highest power first (Faddeev & Leverrier).
CertainVector characteristic(const CertainMatrix& A);

/// Of a symmetric matrix: how many eigenvalues are positive, negative and zero. Nothing where signs are not known.
struct SignCount {
    int positive = 0, negative = 0, zero = 0;
};
std::optional<SignCount> inertia(CertainMatrix A);

/// Strongly connected groups of rows, so that eigenvalues are those of the diagonal blocks.
std::vector<std::vector<int>> diagonal_blocks(const CertainMatrix& A);

}  // namespace alembert
