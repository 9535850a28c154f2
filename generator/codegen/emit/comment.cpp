// SPDX-License-Identifier: GPL-2.0-or-later
#include "codegen/emit/comment.hpp"

#include <cstdint>

#include "codegen/emit/dialect.hpp"

namespace alembert {

namespace {

/// Control characters, and those that are not seen but change how the text around them is shown.
bool is_hidden(std::uint32_t code) {
    return code < 0x20 || (code >= 0x7f && code < 0xa0) || code == 0xad || (code >= 0x200b && code <= 0x200f) ||
           (code >= 0x2028 && code <= 0x202e) || (code >= 0x2060 && code <= 0x206f) ||
           (code >= 0xd800 && code <= 0xf8ff) || code == 0x61c || code == 0xfeff || code >= 0xfff0;
}

/// Whether the two characters begin or end a comment, begin a trigraph, or begin the end of a script in HTML.
bool are_parted(char before, char now) {
    return (before == '*' && now == '/') || (before == '/' && (now == '*' || now == '/')) ||
           (before == '?' && now == '?') || (before == '<' && (now == '/' || now == '!'));
}

}  // namespace

std::string comment_text(const std::string& text) {
    std::string result;
    for (std::size_t i = 0; i < text.size();) {
        const auto byte = static_cast<unsigned char>(text[i]);
        const std::size_t length = byte < 0x80 ? 1 : byte >= 0xf0 ? 4 : byte >= 0xe0 ? 3 : byte >= 0xc0 ? 2 : 0;
        if (length == 0 || i + length > text.size()) {  // no beginning of a character
            ++i;
            continue;
        }
        std::uint32_t code = length == 1 ? byte : byte & (0xffU >> (length + 1));
        bool is_whole = true;
        for (std::size_t k = 1; k < length; ++k) {
            const auto next = static_cast<unsigned char>(text[i + k]);
            is_whole = is_whole && (next & 0xc0U) == 0x80;
            code = code << 6 | (next & 0x3fU);
        }
        if (text[i] == '\n' || text[i] == '\t') {
            result += ' ';
        } else if (is_whole && !is_hidden(code) && text[i] != '\\') {
            if (!result.empty() && are_parted(result.back(), text[i])) result += ' ';
            result += text.substr(i, length);
        }
        i += is_whole ? length : 1;
    }
    return result;
}

std::string commented(const std::vector<std::string>& lines, CodeLanguage language) {
    std::string result;
    for (const std::string& line : lines) {
        if (!result.empty()) result += '\n';
        if (language != CodeLanguage::c)
            result += std::string(dialect_of(language).comment) + (line.empty() ? "" : " ") + line;
        else if (!line.empty())
            result += "   " + line;
    }
    return result;
}

}  // namespace alembert
