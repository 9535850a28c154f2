// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// Characters and words: UTF-8, the form of names, and how text from a file is shown in a message.
///
///     in_quotes("a\nb")  gives  'a\nb' with the line end escaped: nothing in a scene reaches the terminal raw.

#include <string>
#include <string_view>

namespace alembert {

/// The result of `decode` for a byte that begins no UTF-8 sequence.
inline constexpr char32_t invalid_character = 0xFFFFFFFF;

/// The code point at `text[i]`; moves `i` past it. Overlong forms, surrogates and stray bytes are invalid: then
/// `i` moves by one byte.
char32_t decode(std::string_view text, std::size_t& i);

std::string encode(char32_t c);

/// ASCII letter, `_`, or a letter of another script.
bool is_letter(char32_t c);

inline bool is_digit(char32_t c) {
    return c >= U'0' && c <= U'9';
}

/// A letter or `_`, then letters, digits, `_`.
bool is_name(std::string_view text);

/// The letters of ASCII that stand at `begin`.
std::string_view word_at(std::string_view text, std::size_t begin);

/// Characters that would disturb a terminal: control characters, marks of writing direction, invisible characters.
bool is_disturbing(char32_t c);

/// `text` with disturbing characters and invalid bytes escaped, and cut to `most` characters.
std::string escaped(std::string_view text, std::size_t most = 60);

/// The same in single quotes.
std::string in_quotes(std::string_view text);

/// `label 'text'`.
std::string labelled(std::string_view label, std::string_view text);

/// The columns of a character on a terminal: 0, 1 or 2.
int width(char32_t c);

}  // namespace alembert
