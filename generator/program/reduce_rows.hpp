// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// Linear algebra modulo the prime of prime.hpp.

#include "program/echelon.hpp"
#include "program/prime.hpp"

namespace alembert {

struct PrimeField : FieldOperations<Prime> {
    static std::size_t pivot(const RowsOf<Prime>& rows, std::size_t first, std::size_t column) {
        while (first < rows.size() && rows[first][column].is_zero()) ++first;
        return first;
    }
    static void divide(std::vector<Prime>& row, std::size_t from, Prime by) {
        const Prime scale = by.inverse();
        for (std::size_t k = from; k < row.size(); ++k) row[k] *= scale;
    }
};

/// Makes the reduced row echelon form, which is the same for all systems of equations with the same solutions.
/// Returns the rank among the first `columns` columns.
inline int reduce_rows(std::vector<std::vector<Prime>>& rows, std::size_t columns) {
    return static_cast<int>(echelon(rows, columns, PrimeField())->size());
}

}  // namespace alembert
