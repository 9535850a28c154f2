// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// Divides the statements of a long function into parts that compile quickly.
///
///     const FunctionParts parts = in_parts(statements, 1000);
///     parts.list[1].lines;       // const Real& z7 = carried[3]; …; const Real z12 = …; carried[9] = z12; …
///     parts.carried;             // length of `carried`
///
/// The time that g++ takes grows with the square of a function's length from some thousand statements on (a minute
/// for 18 000, most of it for registers). Values of one part that later parts need are passed through the array
/// `carried`, each once. They are stored as soon as they are known, so that the compiler need not keep them, and a
/// place in it is used again after the last part that reads it.

#include <set>
#include <string>
#include <vector>

#include "codegen/emit/statement.hpp"

namespace alembert {

struct FunctionPart {
    std::vector<std::string> lines;
    std::set<std::string> names;  ///< all names that the statements use or declare
};

struct FunctionParts {
    std::vector<FunctionPart> list;
    int carried = 0;
};

/// Makes parts of `length` statements; the last may have fewer.
FunctionParts in_parts(const std::vector<CodeStatement>& statements, std::size_t length, CodeLanguage language);

}  // namespace alembert
