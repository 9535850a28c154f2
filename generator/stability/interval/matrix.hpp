// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// Small matrices of numbers with bounds (certain.hpp); every result is given only if it is certain.
///
///     const std::optional<CertainMatrix> x = solution(A, b);        // nothing where no pivot is surely not zero
///     characteristic(A)                                             // det(s − A), highest power first
///     definiteness(K)                                               // by pivots of L D Lᵀ

#include <optional>
#include <vector>

#include "stability/interval/certain.hpp"

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

/// Columns that span the null space; nothing if the rank is not certain. A number that may be zero and is smaller
/// than `zero` counts as zero.
std::optional<CertainMatrix> null_space(CertainMatrix A, double zero = 0);

/// The rank, or nothing if it is not certain.
std::optional<int> rank(const CertainMatrix& A);

/// Coefficients of det(s·1 − A), highest power first (Faddeev & Leverrier).
CertainVector characteristic(const CertainMatrix& A);

/// The numbers of positive, negative and zero eigenvalues of a symmetric matrix. Nothing if signs are not known.
struct SignCount {
    int positive = 0, negative = 0, zero = 0;
};
std::optional<SignCount> inertia(CertainMatrix A);

/// The strongly connected groups of rows; the eigenvalues are those of the diagonal blocks.
std::vector<std::vector<int>> diagonal_blocks(const CertainMatrix& A);

}  // namespace alembert
