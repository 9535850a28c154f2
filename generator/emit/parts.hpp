// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// A long function's statements in parts, each of which a compiler takes in its stride.
///
///     const FunctionParts parts = in_parts(statements, 1000);
///     parts.list[1].lines;       // const Real& z7 = carried[3]; …; carried[9] = z12;
///     parts.carried;             // length of `carried`
///
/// The time that g++ takes grows with the square of a function's length from some thousand statements on (a minute for 18 000,
/// most of it for registers). What a part makes and a later one needs goes through the array `carried`, once.
///
/// A statement is a line: `const Real a = …;`, also with several names, `const auto [a, b] = …;`, `const auto a = …;`, whose members
/// the next line takes, or an assignment to what is no name of the function's own.

#include <set>
#include <string>
#include <vector>

namespace alembert {

struct FunctionPart {
    std::vector<std::string> lines;
    std::set<std::string> names;  ///< all that the lines mention
};

struct FunctionParts {
    std::vector<FunctionPart> list;
    int carried = 0;
};

FunctionParts in_parts(const std::vector<std::string>& statements, std::size_t length);

}  // namespace alembert
