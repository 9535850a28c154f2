// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// Text of a scene inside comments of emitted code, which it can neither close nor continue.
///
///     comment_text("kg */ int x;");                         // "kg * / int x;"
///     commented({"state", "", "rate"}, CodeLanguage::cpp);  // "// state\n//\n// rate"

#include <string>
#include <vector>

#include "codegen/emit/statement.hpp"

namespace alembert {

/// The text on one line: letters and signs of all languages stay; control characters, characters that change the
/// direction of writing, and backslashes are left out; the signs that begin and end comments are parted.
std::string comment_text(const std::string& text);

/// The lines between `/*` and its end in C; elsewhere each with `//`, or what the language has in its place.
std::string commented(const std::vector<std::string>& lines, CodeLanguage language);

}  // namespace alembert
