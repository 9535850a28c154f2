// SPDX-License-Identifier: GPL-2.0-or-later
#include "scene/text.hpp"

#include <fmt/format.h>

namespace alembert {

char32_t decode(std::string_view text, std::size_t& i) {
    const auto byte = [&](std::size_t k) { return static_cast<unsigned char>(text[k]); };
    const unsigned char lead = byte(i);
    if (lead < 0x80) return static_cast<char32_t>(byte(i++));
    const std::size_t length = lead >= 0xF0 ? 4 : lead >= 0xE0 ? 3 : 2;
    constexpr char32_t least[] = {0, 0, 0x80, 0x800, 0x10000};
    if (lead < 0xC2 || lead > 0xF4 || i + length > text.size()) return ++i, invalid_character;
    char32_t c = lead & (0xFFu >> (length + 1));
    for (std::size_t k = 1; k < length; ++k) {
        if ((byte(i + k) & 0xC0) != 0x80) return ++i, invalid_character;
        c = (c << 6) | (byte(i + k) & 0x3Fu);
    }
    if (c < least[length] || c > 0x10FFFF || (c >= 0xD800 && c <= 0xDFFF)) return ++i, invalid_character;
    i += length;
    return c;
}

std::string encode(char32_t c) {
    const auto tail = [&](int shift) { return static_cast<char>(0x80 | ((c >> shift) & 0x3F)); };
    if (c < 0x80) return {static_cast<char>(c)};
    if (c < 0x800) return {static_cast<char>(0xC0 | (c >> 6)), tail(0)};
    if (c < 0x10000) return {static_cast<char>(0xE0 | (c >> 12)), tail(6), tail(0)};
    return {static_cast<char>(0xF0 | (c >> 18)), tail(12), tail(6), tail(0)};
}

bool is_name(std::string_view text) {
    if (text.empty() || is_digit(static_cast<unsigned char>(text[0]))) return false;
    for (std::size_t i = 0; i < text.size();) {
        const char32_t c = decode(text, i);
        if (!is_letter(c) && !is_digit(c)) return false;
    }
    return true;
}

std::string_view word_at(std::string_view text, std::size_t begin) {
    std::size_t end = begin;
    while (end < text.size() && (text[end] | 0x20) >= 'a' && (text[end] | 0x20) <= 'z') ++end;
    return text.substr(std::min(begin, text.size()), end - begin);
}

bool is_disturbing(char32_t c) {
    return c < 0x20 || (c >= 0x7F && c < 0xA0) || c == 0xAD || c == 0x61C || c == 0x180E ||
           (c >= 0x200B && c <= 0x200F) || (c >= 0x2028 && c <= 0x202E) || (c >= 0x2060 && c <= 0x206F) ||
           c == 0xFEFF || (c >= 0xFFF9 && c <= 0xFFFB) || (c >= 0xE0000 && c <= 0xE0FFF) || c == invalid_character;
}

std::string escaped(std::string_view text, std::size_t most) {
    std::string result;
    std::size_t count = 0;
    for (std::size_t i = 0; i < text.size(); ++count) {
        if (count == most) return result + "…";
        const std::size_t begin = i;
        const char32_t c = decode(text, i);
        if (c == U'\n')
            result += "\\n";
        else if (c == U'\t')
            result += "\\t";
        else if (c == invalid_character)
            result += fmt::format("\\x{:02X}", static_cast<unsigned char>(text[begin]));
        else if (is_disturbing(c))
            result += fmt::format("\\u{:04X}", static_cast<unsigned>(c));
        else
            result += text.substr(begin, i - begin);
    }
    return result;
}

std::string in_quotes(std::string_view text) {
    return fmt::format("'{}'", escaped(text));
}

std::string labelled(std::string_view label, std::string_view text) {
    return fmt::format("{} '{}'", label, escaped(text));
}

int width(char32_t c) {
    const auto in = [c](char32_t first, char32_t last) { return c >= first && c <= last; };
    if (in(0x300, 0x36F) || in(0x20D0, 0x20FF) || in(0xFE00, 0xFE0F)) return 0;
    if (in(0x1100, 0x115F) || in(0x2E80, 0xA4CF) || in(0xAC00, 0xD7A3) || in(0xF900, 0xFAFF) ||
        in(0xFE30, 0xFE6F) || in(0xFF00, 0xFF60) || in(0xFFE0, 0xFFE6) || in(0x1F300, 0x1FAFF) ||
        in(0x20000, 0x3FFFD))
        return 2;
    return 1;
}

}  // namespace alembert
