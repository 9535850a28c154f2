// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// Knots of long tables whose times are known before a run: those of f(t), or of f(2 t − 1).
///
///     is_affine_in_time(program, id)       // 2 t − 1, k t + c with parameters
///     has_known_knots(program, call, 0)    // then steps end there (lower/quick_times.hpp), and no side is held
///
/// A value must be continuous there: where it jumps, a step would have both values at its ends.

#include "program/program.hpp"

namespace alembert {

/// The positions of the knots at which a derivative up to the second of this derivative jumps.
inline const std::vector<int>& kinks_of(const TabulatedFunction& table, std::size_t axis,
                                        const TabulatedFunction::Orders& orders) {
    return table.axes()[axis].kinks[orders[0] + orders[1] > 0 ? 1 : 0];
}

bool is_affine_in_time(const Program& program, int id);

/// Whether the knots of the table along this argument are such, if it has some at which a derivative jumps.
bool has_known_knots(const Program& program, const TabulatedFunction& table, const Program::TableCall& call,
                     std::size_t argument);

}  // namespace alembert
