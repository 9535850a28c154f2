// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// What people read, in the language that they have chosen. The sources have the English text; a catalogue of
/// gettext (po/zh.po) has its translation.
///
///     throw ModelError(say("the mass of {} is {}", body, mass));
///     constexpr const char* title = to_say("Routh's equations");  // in a table, translated where it is shown
///     page += translated(title);
///
/// The compiler holds the English text against its values. A test holds each translation against its English text
/// (tests/language.sh). JSON, CSV and emitted code are English in every language.

#include <fmt/core.h>

#include <string>
#include <string_view>
#include <vector>

#include "base/language/say.hpp"

namespace alembert {

class MessageCatalogue;

/// The catalogue from which texts are taken from now on; without one they are English. To be called before other
/// threads begin. The catalogue must live as long as texts are asked for.
void use_catalogue(const MessageCatalogue* catalogue);

/// What people write is recognized in the language of this catalogue too, whatever they read. It must live as
/// long.
void know_catalogue(const MessageCatalogue* catalogue);

/// `english` with its values, as in fmt::format, in English and in the language of the catalogue that is known.
std::vector<std::string> in_each_language(fmt::string_view english, fmt::format_args values);

/// The translation of a text without values, or the text itself where there is none.
std::string translated(std::string_view english);

/// Of a list between ", ", each part by itself: "lagrange, textbook form" of an emitted file, which is English.
std::string translated_parts(std::string_view english);

/// The translation of `english` with its values, or the English text where there is none that takes them.
std::string translated_with(fmt::string_view english, fmt::format_args values);

/// `english` with its values, as in fmt::format, in the language of the reader.
template <typename... T>
std::string say(fmt::format_string<T...> english, T&&... values) {
    return translated_with(english, fmt::make_format_args(values...));
}

/// Marks a text for the catalogue that `translated` is given later.
consteval const char* to_say(const char* english) {
    return english;
}

}  // namespace alembert
