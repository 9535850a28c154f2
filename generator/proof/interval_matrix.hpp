// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// Small matrices of intervals, row by row.
///
///     const std::vector<Interval> inverse = inverse_of(matrix, n);        // contains A⁻¹ of each A in the matrix

#include <vector>

#include "alembert/base/interval.hpp"

namespace alembert {

/// The middle of an interval; NaN if it has none.
double middle_of(const Interval& x);

/// Entries without bounds where a matrix of the set may be singular. The matrix is multiplied by an approximate
/// inverse C of its middle; with C A = I − E and the row sums of |E| below q < 1, A⁻¹ = (I − E)⁻¹ C differs from C
/// by at most q/(1 − q) times the largest |C| of its column (Neumaier, Interval Methods for Systems of Equations
/// (1990), §4.1).
std::vector<Interval> inverse_of(const std::vector<Interval>& matrix, std::size_t n);

}  // namespace alembert
