// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// Lists as people type them: words with commas between.
///
///     at_commas("min,0.5,")                   gives  {"min", "0.5", ""}
///     names_of("theta1,theta2")               gives  {"theta1", "theta2"}

#include <string>
#include <string_view>
#include <vector>

#include "alembert/base/error.hpp"
#include "base/language/say.hpp"

namespace alembert {

/// What stands between commas, as it is; one empty text if there is nothing.
inline std::vector<std::string> at_commas(std::string_view list) {
    std::vector<std::string> words;
    for (;;) {
        const std::size_t end = list.find(',');
        words.emplace_back(list.substr(0, end));
        if (end == std::string_view::npos) return words;
        list.remove_prefix(end + 1);
    }
}

/// B1,B2 …: names between commas; none if the list is empty. Throws ModelError if a name is missing.
inline std::vector<std::string> names_of(const std::string& list) {
    if (list.empty()) return {};
    std::vector<std::string> names = at_commas(list);
    for (const std::string& name : names)
        if (name.empty())
            throw ModelError(
                say("'{}' has a comma beside which there is no name; expected names with one comma between two",
                    list));
    return names;
}

}  // namespace alembert
