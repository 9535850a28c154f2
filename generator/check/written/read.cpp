// SPDX-License-Identifier: GPL-2.0-or-later
#include "check/written/read.hpp"

#include <algorithm>
#include <utility>

#include "base/language/say.hpp"
#include "check/written/document.hpp"
#include "check/written/parser.hpp"
#include "scene/scene.hpp"
#include "scene/text.hpp"

namespace alembert {

namespace {

constexpr std::size_t largest_derivation = 1024 * 1024;
constexpr std::size_t characters_apart = 1024;  // bytes between the marks of Written::characters

bool begins_character(char byte) {
    return (static_cast<unsigned char>(byte) & 0xC0) != 0x80;
}

/// Notes where lines begin and how many characters stand before marks, so that places are found at once.
void note_places(Written& written) {
    written.lines = {0};
    std::size_t count = 0;
    for (std::size_t i = 0; i < written.text.size(); ++i) {
        if (i % characters_apart == 0) written.characters.push_back(count);
        count += begins_character(written.text[i]);
        if (written.text[i] == '\n') written.lines.push_back(i + 1);
    }
    if (written.text.size() % characters_apart == 0) written.characters.push_back(count);
}

[[noreturn]] void fail_at(const Written& written, std::size_t offset, std::string message) {
    Scene where;
    where.file = written.file;
    where.text = written.text;
    fail(where, {{{written.line(offset), written.column(offset)}, std::move(message)}});
}

bool is_tex(const std::string& text, const std::string& file) {
    return file.ends_with(".tex") || file.ends_with(".latex") ||
           text.find("\\documentclass") != std::string::npos ||
           text.find("\\begin{document}") != std::string::npos;
}

/// Where the text is no UTF-8, as a message.
void check_encoding(const Written& written) {
    for (std::size_t i = 0; i < written.text.size();) {
        const std::size_t begin = i;
        if (decode(written.text, i) == invalid_character)
            fail_at(written, begin,
                    say("the byte 0x{:02X} is not UTF-8 here; save the file as UTF-8",
                        static_cast<unsigned char>(written.text[begin])));
    }
}

}  // namespace

int Written::line(std::size_t offset) const {
    const auto after = std::upper_bound(lines.begin(), lines.end(), std::min(offset, text.size()));
    return std::max(1, static_cast<int>(after - lines.begin()));
}

int Written::column(std::size_t offset) const {
    const auto characters_before = [&](std::size_t end) {
        const std::size_t mark = end / characters_apart;
        std::size_t count = mark < characters.size() ? characters[mark] : 0;
        for (std::size_t i = mark * characters_apart; i < end; ++i) count += begins_character(text[i]);
        return count;
    };
    const std::size_t begin = lines.empty() ? 0 : lines[static_cast<std::size_t>(line(offset)) - 1];
    return 1 + static_cast<int>(characters_before(std::min(offset, text.size())) - characters_before(begin));
}

bool is_derivation(const std::string& text, const std::string& file) {
    return file.ends_with(".tex") || file.ends_with(".latex") || file.ends_with(".md") ||
           file.ends_with(".markdown") || has_enclosed_latex(text);
}

Written read_derivation(std::string text, std::string file) {
    if (text.size() > largest_derivation) {
        Scene where;
        where.file = file;
        fail(where,
             {{{}, say("the derivation has {} bytes; the limit is {} (1 MiB)", text.size(), largest_derivation)}});
    }
    Written written{.file = std::move(file), .text = std::move(text), .statements = {}};
    note_places(written);
    check_encoding(written);
    try {
        DocumentReader reader(written.text, is_tex(written.text, written.file) ? Markup::tex : Markup::markdown);
        written.statements = reader.statements();
    } catch (const BeyondLimit& limit) {
        fail_at(written, limit.offset, limit.message);
    }
    if (written.statements.empty())
        fail_at(written, 0,
                say("no mathematics was found; expected formulas in $…$, \\[…\\] or align, or lines such as T = "
                    "1/2*m*v^2"));
    return written;
}

}  // namespace alembert
