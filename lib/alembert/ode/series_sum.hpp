// SPDX-License-Identifier: MIT
#pragma once

/// The polynomial of a power series at a time, in all components at once.
///
///     sum_series(rows, order, size, h, change, slopes);
///     change[i];       // Σ_{1≤k≤order} c_k[i] h^k
///     slopes[i];       // Σ k c_k[i] h^k, the slope times h
///
/// `rows` holds c_0, c_1 …, `size` numbers each, and room for eight more numbers behind the last row, whose values
/// do not matter.

namespace alembert {

inline constexpr int room_behind_rows = 8;

/// `slopes` may be null.
void sum_series(const double* rows, int order, int size, double h, double* change, double* slopes);

}  // namespace alembert
