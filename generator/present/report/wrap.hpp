// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// Breaks long lines of formulas and words.
///
///     wrapped("  m*l^2*theta'' + m*g*l*sin(theta) = 0\n", 24)
///         "  m*l^2*theta''\n      + m*g*l*sin(theta) = 0\n"

#include <string>
#include <string_view>

namespace alembert {

/// Breaks lines of more than `width` columns at spaces, if possible before operators and outside parentheses.
/// Continuations are indented by four columns. Longer words are not broken, and neither are rows of tables.
std::string wrapped(std::string_view text, int width);

}  // namespace alembert
