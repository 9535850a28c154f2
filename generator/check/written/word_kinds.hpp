// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// What a single word is: prose, or a name in a formula.

#include <string_view>

namespace alembert {

/// A word in a formula that can be the name of something (KE, const), and no word such as "and".
bool is_word_for_letter(std::string_view word);

/// const, Konst., 常量: what keeps its value.
bool is_word_for_constant(std::string_view word);

/// A word of English prose that is no name in a formula: "the", "energy".
bool is_prose(std::string_view word);

}  // namespace alembert
