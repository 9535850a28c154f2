// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// Linear algebra modulo the prime of prime.hpp.

#include <cstddef>
#include <utility>
#include <vector>

#include "program/prime.hpp"

namespace alembert {

/// Gauss-Jordan elimination modulo the prime: makes the reduced row echelon form, which is the same for all
/// systems of equations with the same solutions. Returns the rank among the first `columns` columns.
inline int reduce_rows(std::vector<std::vector<Prime>>& rows, std::size_t columns) {
    std::size_t rank = 0;
    for (std::size_t column = 0; column < columns && rank < rows.size(); ++column) {
        std::size_t pivot = rank;
        while (pivot < rows.size() && rows[pivot][column].is_zero()) ++pivot;
        if (pivot == rows.size()) continue;
        std::swap(rows[rank], rows[pivot]);
        const Prime scale = rows[rank][column].inverse();
        for (Prime& entry : rows[rank]) entry *= scale;
        for (std::size_t r = 0; r < rows.size(); ++r) {
            const Prime factor = rows[r][column];
            if (r == rank || factor.is_zero()) continue;
            for (std::size_t k = column; k < rows[r].size(); ++k) rows[r][k] -= factor * rows[rank][k];
        }
        ++rank;
    }
    return static_cast<int>(rank);
}

}  // namespace alembert
