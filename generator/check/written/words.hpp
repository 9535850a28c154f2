// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// What the words between formulas say.

#include <string>
#include <string_view>

namespace alembert {

/// "if", "for", "when": what follows is a condition.
bool begins_condition(std::string_view words);

/// "therefore", "hence", "so".
bool speaks_of_consequence(std::string_view words);

/// "small angles", "linearize", "first order".
bool speaks_of_first_order(std::string_view words);

/// A word in a formula that can be the name of something (KE, const), and no word such as "and".
bool is_word_for_letter(std::string_view word);

/// A word of English prose that is no name in a formula: "the", "energy".
bool is_prose(std::string_view word);

}  // namespace alembert
