// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// Output features for terminals only: colours, and lines of the right width.

#include <optional>
#include <string>
#include <string_view>

#include "present/report/ink.hpp"

namespace alembert {

/// An Ink with marks if the descriptor is a terminal with colours, otherwise without. NO_COLOR set to anything
/// forbids colours (no-color.org), and so does a TERM that is "dumb".
Ink ink_for(int descriptor);

/// The number of columns; nothing if the descriptor is no terminal.
std::optional<int> columns_of(int descriptor);

/// An error or a warning with its place, the word "error" and the caret marked.
std::string marked_message(const std::string& message, const Ink& ink, const std::string& tone);

/// The escape sequence for the letter of a mark; empty for any other.
std::string_view colour_of(char letter);

}  // namespace alembert
