// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <string>
#include <utility>

#include "base/language/say.hpp"

namespace alembert {

/// Adds formatted text to a page: put(page, "t = {}\n", t);
template <typename... T>
void put(std::string& page, fmt::format_string<T...> format, T&&... values) {
    page += fmt::format(format, std::forward<T>(values)...);
}

/// The same in the language of the reader.
template <typename... T>
void say_on(std::string& page, fmt::format_string<T...> english, T&&... values) {
    page += translated_with(english, fmt::make_format_args(values...));
}

/// "1 step", "3 steps", or with the translation of the word.
inline std::string shown_count(long count, const char* noun) {
    return say("{} {}{}", count, translated(noun), count == 1 ? "" : "s");
}

/// Columns for names: as wide as the widest and a space, `least` at the least.
template <typename Names>
std::size_t column_for(const Names& names, std::size_t least) {
    for (const auto& name : names) least = std::max(least, fmt::formatted_size("{}", name) + 1);
    return least;
}

}  // namespace alembert
