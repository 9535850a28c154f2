// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// Knots of tables whose times are known before a run: those of f(t), or of f(2 t − 1).
///
///     has_known_knots(program, table, call, 0)    // then steps end there (lower/quick_times.hpp)
///
/// A value must be continuous there: where it jumps, a step would have both values at its ends. Of long tables
/// (TabulatedFunction::tells_knots) these are no switches of a run besides.

#include <string>
#include <vector>

#include "program/program.hpp"

namespace alembert {

/// The number that a double is.
Rational exact(double x);

/// Whether the table has such knots along this argument.
bool has_known_knots(const Program& program, const TabulatedFunction& table, const Program::TableCall& call,
                     std::size_t argument);

/// The names of the tables over the state in which knots are so close, compared with others, that the control of a
/// step may not see a pulse between them.
std::vector<std::string> tables_with_close_knots(const Program& program);

/// Below this distance knots are close: by much less apart than others.
double close_knots(const TableAxis& axis);

}  // namespace alembert
