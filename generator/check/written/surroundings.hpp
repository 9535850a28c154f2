// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// What stands in the text around a statement: conditions that come behind the formula, limits before it.

#include <string>

#include "check/written/read.hpp"

namespace alembert {

/// What goes on behind a formula until its sentence, its line or the next formula ends: "is conserved".
std::string words_behind(const Written& written, const WrittenStatement& statement);

/// Whether the formula behind it is its condition: "… at $y = -l$".
bool is_conditioned_behind(const Written& written, const WrittenStatement& statement);

/// The text from `begin` to `end` with the brackets at its ends whose other halves are within: trees of (a + b) c
/// begin behind the bracket.
std::string in_whole_brackets(const std::string& text, std::size_t begin, std::size_t end);

/// How far before a formula a limit may stand, in bytes: just before it, or anywhere in a usual sentence.
inline constexpr std::size_t beside_formula = 60, within_sentence = 160;

/// Whether its sentence has taken a limit within so many bytes before it: "for $M\to\infty$ we get …".
bool is_limit(const Written& written, const WrittenStatement& statement, std::size_t most);

}  // namespace alembert
