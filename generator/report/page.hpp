// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <fmt/format.h>

#include <string>
#include <utility>

namespace alembert {

/// Adds formatted text to a page: put(page, "t = {}\n", t);
template <typename... T>
void put(std::string& page, fmt::format_string<T...> format, T&&... values) {
    page += fmt::format(format, std::forward<T>(values)...);
}

}  // namespace alembert
