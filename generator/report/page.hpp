// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <string>
#include <utility>

namespace alembert {

/// Adds formatted text to a page: put(page, "t = {}\n", t);
template <typename... T>
void put(std::string& page, fmt::format_string<T...> format, T&&... values) {
    page += fmt::format(format, std::forward<T>(values)...);
}

/// Columns for names: as wide as the widest and a space, `least` at the least.
template <typename Names>
std::size_t column_for(const Names& names, std::size_t least) {
    for (const auto& name : names) least = std::max(least, fmt::formatted_size("{}", name) + 1);
    return least;
}

}  // namespace alembert
