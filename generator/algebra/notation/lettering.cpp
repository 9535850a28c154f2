// SPDX-License-Identifier: GPL-2.0-or-later
#include "algebra/notation/lettering.hpp"

#include <fmt/format.h>

#include <string_view>
#include <vector>

#include "base/language/greek.hpp"

namespace alembert {

namespace {

bool is_digit(char c) {
    return c >= '0' && c <= '9';
}
bool is_continuation(char c) {
    return (static_cast<unsigned char>(c) & 0xC0) == 0x80;
}

std::vector<std::string_view> letters_of(std::string_view text) {
    std::vector<std::string_view> result;
    for (std::size_t start = 0; start < text.size();) {
        std::size_t end = start + 1;
        while (end < text.size() && is_continuation(text[end])) ++end;
        result.push_back(text.substr(start, end - start));
        start = end;
    }
    return result;
}

std::string to_greek(const std::string& word) {
    const GreekLetter* entry = greek_named(word);
    return entry ? std::string(entry->letter) : word;
}

unsigned code_point(std::string_view letter) {
    const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(letter[i]); };
    const unsigned lead = byte(0);
    unsigned value = lead < 0x80 ? lead : lead < 0xE0 ? lead & 0x1F : lead < 0xF0 ? lead & 0x0F : lead & 0x07;
    for (std::size_t i = 1; i < letter.size(); ++i) value = value << 6 | (byte(i) & 0x3F);
    return value;
}

/// A letter inside \mathrm{…}; a letter that pdflatex cannot set is written as its number.
std::string latex_plain(std::string_view letter) {
    if (letter == "_") return "\\_";
    if (letter.size() == 1) return std::string(letter);
    const unsigned code = code_point(letter);
    if (code >= 0xC0 && code <= 0x17F && code != 0xD7 && code != 0xF7) return fmt::format("\\text{{{}}}", letter);
    return fmt::format("U{:X}", code);
}

}  // namespace

Lettering lettering(const std::string& name) {
    const std::size_t bar = name.find('_', 1);
    std::string stem = name.substr(0, bar);
    std::string index = bar == std::string::npos ? "" : name.substr(bar + 1);
    std::size_t digits = stem.size();
    while (digits > 1 && is_digit(stem[digits - 1])) --digits;
    if (digits < stem.size() && stem[0] != '_') {
        const std::string number = stem.substr(digits);
        stem.resize(digits);
        index = index.empty() ? number : fmt::format("{},{}", number, index);
    }
    if (stem == "_") return {name, ""};
    return {to_greek(stem), to_greek(index)};
}

bool is_word(const std::string& letters) {
    return letters_of(letters).size() > 1;
}

std::string latex_letters(const std::string& letters) {
    if (const std::size_t comma = letters.find(','); comma != std::string::npos)
        return fmt::format("{},{}", latex_letters(letters.substr(0, comma)),
                           latex_letters(letters.substr(comma + 1)));
    if (letters.find_first_not_of("0123456789") == std::string::npos) return letters;
    const std::vector<std::string_view> each = letters_of(letters);
    if (each.size() == 1 && each[0].size() == 1 && each[0] != "_") return letters;
    std::string result;
    std::string upright;
    const auto flush = [&] {
        if (!upright.empty()) result += fmt::format("\\mathrm{{{}}}", upright);
        upright.clear();
    };
    for (const std::string_view letter : each) {
        if (const GreekLetter* entry = letter.size() > 1 ? greek_of(letter) : nullptr) {
            flush();
            result += std::string(entry->latex);
        } else {
            upright += latex_plain(letter);
        }
    }
    flush();
    return result;
}

std::string xml_escaped(const std::string& text) {
    std::string result;
    for (const char c : text) {
        switch (c) {
            case '&':
                result += "&amp;";
                break;
            case '<':
                result += "&lt;";
                break;
            case '>':
                result += "&gt;";
                break;
            case '"':
                result += "&quot;";
                break;
            default:
                result += c;
        }
    }
    return result;
}

}  // namespace alembert
