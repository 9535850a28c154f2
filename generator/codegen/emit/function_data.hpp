// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// Emitted functions, and the quantities of a scene, as data for the templates.
///
///     functions << data_of(function, dialect);   // name, arguments, unpack, sections
///     name_quantities(file, program, words, options);

#include <kainjow/mustache.hpp>
#include <map>
#include <string>

#include "codegen/emit/dialect.hpp"
#include "codegen/emit/function.hpp"

namespace alembert {

kainjow::mustache::data data_of(const EmittedFunction& function, const Dialect& dialect);

/// Adds what a function takes, gives and declares, for languages that write it apart; `sizes` are those of the
/// arrays that it takes.
void add_declarations(kainjow::mustache::data& result, const EmittedFunction& function,
                      const std::map<std::string, std::size_t>& sizes);

/// Adds the states and the parameters by their names, and which of them comes where.
void name_quantities(kainjow::mustache::data& file, const Program& program, const Vocabulary& words,
                     const EmitOptions& options);

}  // namespace alembert
