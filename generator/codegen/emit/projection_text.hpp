// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// C for programs that integrate the emitted equations: the projection on the constraints that `simulate` uses,
/// also near singular poses, and the balance of energy. The main program beside a file and the functional mock-up
/// unit have the same text.
///
///     projection_text(program, CodeLanguage::c);

#include <string>

#include "codegen/emit/statement.hpp"
#include "program/program.hpp"

namespace alembert {

/// The text expects the constants n, speeds and constraints, the emitted functions, and <float.h>, <math.h>,
/// <string.h>. The template is templates/projection.c.mustache.
std::string projection_text(const Program& program, CodeLanguage language);

/// In such text the number of rows that constraints_at gives: `constraints`, or more where some follow from these.
std::string all_constraints(const Program& program);

}  // namespace alembert
