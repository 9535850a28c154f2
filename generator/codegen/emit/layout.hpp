// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// The layout of an emitted file: the width of lines, lists, and the header.

#include <string>
#include <vector>

#include "program/named_function.hpp"

namespace alembert {

constexpr std::size_t line_width = 110;

/// Breaks long lines and indents the rest; lines are only broken before an operator or after a comma, and not
/// inside square brackets, where Julia would begin a new row.
std::string wrapped(const std::string& text);

/// "a, b, " over several lines.
std::string wrapped_list(const std::vector<std::string>& items);

/// "\"a\", \"b\", "
std::string quoted(const std::vector<std::string>& names);

/// "7 x 7, row by row; 120 operations": the shape of its values, and their cost.
std::string described(const NamedFunction& function);

/// "1 division", "2 divisions".
std::string counted(long count, const std::string& noun);

}  // namespace alembert
