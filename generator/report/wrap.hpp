// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// Long lines of formulas and words as several lines.
///
///     wrapped("  m*l^2*theta'' + m*g*l*sin(theta) = 0\n", 24)
///         "  m*l^2*theta''\n      + m*g*l*sin(theta) = 0\n"

#include <string>
#include <string_view>

namespace alembert {

/// Breaks lines of more than `width` columns at spaces, before operators and outside parentheses where that is
/// possible; what goes on stands four columns further right. Words that are longer stay whole, and so do rows of
/// tables.
std::string wrapped(std::string_view text, int width);

}  // namespace alembert
