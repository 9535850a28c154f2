// SPDX-License-Identifier: GPL-2.0-or-later
#include "derivation/written/read.hpp"

#include <algorithm>
#include <utility>

#include "base/language/say.hpp"
#include "derivation/written/document.hpp"
#include "derivation/written/parser.hpp"
#include "scene/scene.hpp"
#include "scene/source.hpp"
#include "scene/text.hpp"

namespace alembert {

namespace {

constexpr std::size_t largest_derivation = 1024 * 1024;

[[noreturn]] void fail_at(const std::string& text, const std::string& file, std::size_t offset, std::string message) {
    Scene where;
    where.file = file;
    where.text = text;
    fail(where, {{SourceText(text).place(offset), std::move(message)}});
}

bool is_tex(const std::string& text, const std::string& file) {
    return file.ends_with(".tex") || file.ends_with(".latex") || text.find("\\documentclass") != std::string::npos ||
           text.find("\\begin{document}") != std::string::npos;
}

/// Where the text is no UTF-8, as a message.
void check_encoding(const std::string& text, const std::string& file) {
    for (std::size_t i = 0; i < text.size();) {
        const std::size_t begin = i;
        if (decode(text, i) == invalid_character)
            fail_at(text, file, begin,
                    say("the byte 0x{:02X} is not UTF-8 here; save the file as UTF-8", static_cast<unsigned char>(text[begin])));
    }
}

}  // namespace

int Written::line(std::size_t offset) const {
    return 1 + static_cast<int>(std::count(text.begin(), text.begin() + static_cast<std::ptrdiff_t>(std::min(offset, text.size())), '\n'));
}

int Written::column(std::size_t offset) const {
    const std::size_t end = std::min(offset, text.size());
    const std::size_t line_break = end == 0 ? std::string::npos : text.rfind('\n', end - 1);
    int column = 1;
    for (std::size_t i = line_break == std::string::npos ? 0 : line_break + 1; i < end; ++column) decode(text, i);
    return column;
}

bool is_derivation(const std::string& text, const std::string& file) {
    return file.ends_with(".tex") || file.ends_with(".latex") || file.ends_with(".md") || file.ends_with(".markdown") ||
           has_marks_of_latex(text);
}

Written read_derivation(std::string text, std::string file) {
    if (text.size() > largest_derivation) {
        Scene where;
        where.file = file;
        fail(where, {{{}, say("the derivation has {} bytes; the limit is {} (1 MiB)", text.size(), largest_derivation)}});
    }
    check_encoding(text, file);
    Written written{.file = std::move(file), .text = std::move(text), .statements = {}};
    try {
        DocumentReader reader(written.text, is_tex(written.text, written.file) ? Markup::tex : Markup::markdown);
        written.statements = reader.statements();
    } catch (const BeyondLimit& limit) {
        fail_at(written.text, written.file, limit.offset, limit.message);
    }
    if (written.statements.empty())
        fail_at(written.text, written.file, 0,
                say("no mathematics was found; expected formulas in $…$, \\[…\\] or align, or lines such as T = 1/2*m*v^2"));
    return written;
}

}  // namespace alembert
