// SPDX-License-Identifier: GPL-2.0-or-later
#include "check/written/read.hpp"

#include <algorithm>
#include <cctype>
#include <string_view>
#include <utility>

#include "base/language/say.hpp"
#include "check/written/document.hpp"
#include "check/written/notebook.hpp"
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

/// How many words of two letters or more follow each other with blanks between them, at the most.
std::size_t longest_sentence(const std::string& line) {
    std::size_t longest = 0, words = 0, letters = 0;
    const auto end_word = [&](bool goes_on) {
        words = letters >= 2 ? words + 1 : letters == 0 && goes_on ? words : 0;
        longest = std::max(longest, words);
        if (!goes_on) words = 0;
        letters = 0;
    };
    for (const char c : line)
        if (std::isalpha(static_cast<unsigned char>(c)) != 0)
            ++letters;
        else
            end_word(c == ' ');
    end_word(false);
    return longest;
}

/// Whether the line is written as people write formulas: "Kinetic energy: T = ½ m l² θ̇²".
bool is_written_by_hand(const std::string& line) {
    static constexpr const char* signs[] = {"²", "³", "½", "⅓", "¼", "⅔", "·", "\u0307", "\u0308"};
    const std::size_t colon = line.find(':'), equals = line.find('=');
    const bool is_labelled = colon < equals && longest_sentence(line.substr(0, colon)) > 0;
    const bool is_chain = equals != line.rfind('=') && line.find("==") == std::string::npos;
    const auto ends_factor = [](char c) {
        return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == ')' || c == '\'';
    };
    const auto begins_factor = [](char c) { return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '('; };
    bool has_product = false;  // without a sign: 1/2 m l^2
    for (std::size_t i = 1; i + 1 < line.size(); ++i)
        has_product = has_product || (line[i] == ' ' && ends_factor(line[i - 1]) && begins_factor(line[i + 1]));
    const bool is_printed = line.find("Eq(") != std::string::npos || line.find("Derivative(") != std::string::npos;
    return is_labelled || is_chain || is_printed || (has_product && equals != std::string::npos) ||
           longest_sentence(line) >= 3 || std::any_of(std::begin(signs), std::end(signs), [&](const char* sign) {
               return line.find(sign) != std::string::npos;
           });
}

/// A page of words is no file of claims: it has sentences, labels or signs that these do not have, and more than
/// one of them where a line begins with a word of such a file.
bool has_prose(const std::string& text) {
    int by_hand = 0;
    bool has_mode = false;
    for (std::size_t begin = 0; begin < text.size();) {
        const std::size_t end = std::min(text.find('\n', begin), text.size());
        std::string line = text.substr(begin, end - begin);
        begin = end + 1;
        line.resize(std::min(line.find('#'), line.size()));  // a comment
        const std::size_t first = line.find_first_not_of(" \t\r");
        if (first == std::string::npos) continue;
        static constexpr std::string_view modes[] = {"unknowns", "constants", "rest",   "impact",   "motion",
                                                     "solution", "near",      "closed", "sticking", "where"};
        const std::string word = line.substr(first, line.find_first_of(" \t\r", first) - first);
        if (std::find(std::begin(modes), std::end(modes), word) != std::end(modes)) {
            has_mode = true;
            continue;
        }
        const bool is_equation = line.find('=') != std::string::npos || line.find("＝") != std::string::npos;
        const bool is_by_hand = is_written_by_hand(line) || (!is_equation && longest_sentence(line) >= 2) ||
                                (!is_equation && static_cast<unsigned char>(line[first]) >= 0x80);
        by_hand += is_by_hand ? 1 : 0;
    }
    return by_hand > (has_mode ? 1 : 0);
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
           file.ends_with(".markdown") || file.ends_with(".rst") || file.ends_with(".ipynb") ||
           has_enclosed_latex(text) || (file.ends_with(".txt") && has_prose(text));
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
    const std::string cells = written.file.ends_with(".ipynb") ? cells_of_notebook(written.text) : "";
    if (written.file.ends_with(".ipynb") && cells.empty())
        fail_at(written, 0, say("the file is no notebook of Jupyter: it has no list 'cells'"));
    try {
        DocumentReader reader(cells.empty() ? written.text : cells,
                              is_tex(written.text, written.file) ? Markup::tex : Markup::markdown);
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
