// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// What a terminal gets beyond what files and pipes get: colours, and lines that fit.

#include <optional>
#include <string>
#include <string_view>

#include "report/ink.hpp"

namespace alembert {

/// Marks where the descriptor is a terminal with colours, none elsewhere. NO_COLOR set to anything forbids them
/// (no-color.org), and so does a TERM that is "dumb".
Ink ink_for(int descriptor);

/// Columns; nothing where the descriptor is no terminal.
std::optional<int> columns_of(int descriptor);

/// A message of an error or a warning with its place, "error" and the caret marked.
std::string marked_message(const std::string& message, const Ink& ink, const std::string& tone);

/// The escape sequence for the letter of a mark; empty for any other.
std::string_view colour_of(char letter);

}  // namespace alembert
