// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// Sentences of the words between formulas, and phrases in them.
///
///     has_phrase(last_sentence(words), "at rest|equilibri*|平衡*")
///     ends_with_word(words, {"near", "close to"})

#include <initializer_list>
#include <string>
#include <string_view>

namespace alembert {

std::string in_lower_case(std::string_view text);

/// Whether one of `phrases`, separated by |, stands in the text as whole words (a phrase that ends with * may go
/// on). The text is in lower case.
bool has_phrase(const std::string& text, std::string_view phrases);

/// Where the sentence that begins at `begin` ends: behind its full stop, or at the end of the words. "i.e." and
/// "d.h." have none.
std::size_t end_of_first_sentence(std::string_view words, std::size_t begin);

/// What stands behind the last full stop, in lower case.
std::string last_sentence(std::string_view words);

/// The same without spaces, commas, colons and opening parentheses at its end.
std::string trimmed_sentence(std::string_view words);

/// Whether the trimmed sentence ends with one of these words or phrases.
bool ends_with_word(std::string_view words, std::initializer_list<std::string_view> list);

/// Whether they are more than signs between formulas.
bool holds_letters(std::string_view words);

/// Whether a sentence ends in the words.
bool ends_sentence(std::string_view words);

/// Whether a whole sentence stands in them, and not only the end of the last one.
bool holds_sentence(std::string_view words);

/// Whether they only join two formulas of one sentence: "or", "so".
bool joins_formulas(std::string_view words);

/// Whether they end a sentence and only go on with its case: ". Then", "。则".
bool goes_on_with_case(std::string_view words);

/// Whether they begin with a capital letter, and so a sentence of their own.
bool begins_sentence(std::string_view words);

}  // namespace alembert
