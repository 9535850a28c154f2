// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// Functions by points in the languages of dialect.hpp that have templates of their own: straight lines in which a
/// value is chosen by a condition, so that JAX can trace those of Python.
///
///     chosen_tables(program, dialect_of(CodeLanguage::julia));   // "const table0_f_at = Float64[0, 1, 3]…"

#include <string>

#include "codegen/emit/dialect.hpp"
#include "program/program.hpp"

namespace alembert {

/// Empty if no root of the program needs one. Throws ModelError for a function that the scene leaves open.
std::string chosen_tables(const Program& program, const Dialect& dialect);

}  // namespace alembert
