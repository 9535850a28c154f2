// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// The reduced row echelon form over any field: modulo a prime, of fractions, of numbers with bounds, of
/// expressions.
///
///     std::vector<std::vector<Prime>> rows = …;                    // the right sides are further columns
///     echelon(rows, columns, PrimeField())->size()                 // the rank (program/reduce_rows.hpp)
///
/// A field says which row has the pivot and how rows are combined:
///
///     struct SomeField {
///         using Number = …;
///         static constexpr bool makes_ones = true;                 // pivots become 1; otherwise they stay
///         std::optional<std::size_t> pivot(Rows& rows, std::size_t first, std::size_t column) const;
///         bool is_zero(const Number& factor) const;                // whether there is nothing to subtract
///         void divide(std::vector<Number>& row, std::size_t from, const Number& by) const;
///         Number quotient(const Number& a, const Number& b) const; // only where pivots stay
///         void subtract(Number& from, const Number& factor, const Number& of) const;
///     };
///
/// `pivot` looks at the rows from `first` on and gives rows.size() where the column has only zeros there, which it
/// may tidy; nothing where that cannot be told.
///
/// Eliminations that are others: by few new entries, of expressions and graphs (algebra/symbolic/exact_solve.hpp,
/// model/formalism/kinematics.cpp, program/solve.hpp); of symmetric matrices, whose signs count (`inertia` in
/// stability/matrix.hpp, analysis/state/sum_of_squares.cpp); of floating-point matrices, whose results depend on
/// the order of operations (stability/linear/dense_long.hpp, tangent.cpp, analysis/agree/agree.cpp); of rows that
/// come one at a time, where the first that contradicts is wanted (check/counterexample.cpp, check/solution.cpp,
/// analysis/exact/real_state.cpp); of expressions that are zero where their values at points are
/// (analysis/exact/null_fields.hpp).

#include <algorithm>
#include <cstddef>
#include <optional>
#include <utility>
#include <vector>

namespace alembert {

template <typename Number>
using RowsOf = std::vector<std::vector<Number>>;

/// The columns of the pivots among the first `columns`, one for each row that has one. Nothing where the field
/// cannot tell.
template <typename Field>
std::optional<std::vector<std::size_t>> echelon(RowsOf<typename Field::Number>& rows, std::size_t columns,
                                                const Field& field) {
    using Number = typename Field::Number;
    std::vector<std::size_t> pivots;
    for (std::size_t column = 0; column < columns && pivots.size() < rows.size(); ++column) {
        const std::size_t rank = pivots.size();
        const std::optional<std::size_t> chosen = field.pivot(rows, rank, column);
        if (!chosen) return std::nullopt;
        if (*chosen == rows.size()) continue;
        std::swap(rows[rank], rows[*chosen]);
        std::vector<Number>& row = rows[rank];
        const Number lead = row[column];
        if constexpr (Field::makes_ones) {
            field.divide(row, column + 1, lead);
            row[column] = Number(1);
        }
        for (std::size_t r = 0; r < rows.size(); ++r) {
            if (r == rank || field.is_zero(rows[r][column])) continue;
            Number factor = rows[r][column];
            if constexpr (!Field::makes_ones) factor = field.quotient(factor, lead);
            for (std::size_t k = column + 1; k < rows[r].size(); ++k) field.subtract(rows[r][k], factor, row[k]);
            rows[r][column] = Number(0);
        }
        pivots.push_back(column);
    }
    return pivots;
}

/// The arithmetic of numbers that have operators and `is_zero`, with pivots that become 1.
template <typename N>
struct FieldOperations {
    using Number = N;
    static constexpr bool makes_ones = true;
    bool is_zero(const Number& x) const { return x.is_zero(); }
    void divide(std::vector<Number>& row, std::size_t from, const Number& by) const {
        for (std::size_t k = from; k < row.size(); ++k) row[k] = row[k] / by;
    }
    void subtract(Number& from, const Number& factor, const Number& of) const { from -= factor * of; }
};

/// The pivot is the largest entry of the column, by a size that is zero for what cannot be one.
template <typename Number, typename Size>
std::size_t largest_in(const RowsOf<Number>& rows, std::size_t first, std::size_t column, const Size& size) {
    std::size_t best = first;
    for (std::size_t r = first + 1; r < rows.size(); ++r)
        if (size(rows[r][column]) > size(rows[best][column])) best = r;
    return best;
}

}  // namespace alembert
