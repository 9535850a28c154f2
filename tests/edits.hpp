// SPDX-License-Identifier: MIT
#pragma once

/// Changes of a scene's text.
///
///     edited(contents(source_path("scenes/textbook/crane.toml")), {{"duration = 10", "duration = 2"}})

#include <doctest/doctest.h>

#include <string>
#include <utility>
#include <vector>

namespace alembert::test {

/// The text in which each of these strings is replaced where it stands first. It must stand there: an edit that
/// changes nothing would leave a test without its case.
inline std::string edited(std::string text, const std::vector<std::pair<std::string, std::string>>& edits) {
    for (const auto& [from, to] : edits) {
        const std::size_t at = text.find(from);
        REQUIRE_MESSAGE(at != std::string::npos, from);
        text.replace(at, from.size(), to);
    }
    return text;
}

/// The text without the tables that begin with `header`.
inline std::string without(std::string text, const std::string& header) {
    for (std::size_t at; (at = text.find(header)) != std::string::npos;) {
        const std::size_t end = text.find("\n[", at + 1);
        text.erase(at, end == std::string::npos ? end : end + 1 - at);
    }
    return text;
}

}  // namespace alembert::test
