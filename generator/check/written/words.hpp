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

/// "if …", "when the hand is at rest", or "at", "for" just before the formula: what the last sentence says holds
/// under a condition.
bool states_condition(std::string_view words);

/// "steady motion", "conical pendulum": the motions of which the last sentence speaks are special ones.
bool speaks_of_special_motion(std::string_view words);

/// "starts from rest": constants of the motion are zero.
bool speaks_of_start_from_rest(std::string_view words);

bool speaks_of_angular_momentum(std::string_view words);

/// "where", "with", "and": a definition follows what is defined by it.
bool explains(std::string_view words);

/// Whether a sentence ends in the words.
bool ends_sentence(std::string_view words);

/// Whether they only join two formulas of one sentence: "or", "so".
bool joins_formulas(std::string_view words);

/// A word in a formula that can be the name of something (KE, const), and no word such as "and".
bool is_word_for_letter(std::string_view word);

/// A word of English prose that is no name in a formula: "the", "energy".
bool is_prose(std::string_view word);

}  // namespace alembert
