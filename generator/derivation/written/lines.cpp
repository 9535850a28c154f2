// SPDX-License-Identifier: GPL-2.0-or-later
// Lines of Markdown and of plain text: code, lists, and formulas without marks.

#include <algorithm>

#include "base/language/say.hpp"
#include "derivation/written/document.hpp"
#include "derivation/written/parser.hpp"
#include "derivation/written/statements.hpp"
#include "derivation/written/words.hpp"
#include "scene/text.hpp"

namespace alembert {

namespace {

using LineKind = WrittenToken::Kind;

bool has_relation_sign(std::string_view text) {
    if (text.find('=') != std::string_view::npos) return true;
    for (const std::string_view sign : {"≈", "≡", "≔", "\\approx", "≃", "Eq("})
        if (text.find(sign) != std::string_view::npos) return true;
    return false;
}

std::string_view trimmed(std::string_view text) {
    while (!text.empty() && std::string_view(" \t\r\n").find(text.front()) != std::string_view::npos) text.remove_prefix(1);
    while (!text.empty() && std::string_view(" \t\r\n").find(text.back()) != std::string_view::npos) text.remove_suffix(1);
    return text;
}

bool has_command(std::string_view text) {
    for (std::size_t k = text.find('\\'); k != std::string_view::npos; k = text.find('\\', k + 1))
        if (k + 1 < text.size() && ((text[k + 1] | 0x20) >= 'a' && (text[k + 1] | 0x20) <= 'z')) return true;
    return false;
}

/// The length of what marks a line of Markdown: "- ", "1. ", "> ", "## ", "**".
std::size_t marker_length(std::string_view line) {
    std::size_t k = 0;
    const auto blanks = [&] {
        while (k < line.size() && (line[k] == ' ' || line[k] == '\t')) ++k;
    };
    blanks();
    while (k < line.size() && (line[k] == '#' || line[k] == '>')) ++k;
    blanks();
    if (k + 1 < line.size() && (line[k] == '-' || line[k] == '*' || line[k] == '+') && line[k + 1] == ' ') k += 2;
    std::size_t digits = k;
    while (digits < line.size() && line[digits] >= '0' && line[digits] <= '9') ++digits;
    if (digits > k && digits - k < 4 && digits + 1 < line.size() && (line[digits] == '.' || line[digits] == ')') && line[digits + 1] == ' ')
        k = digits + 2;
    blanks();
    if (line.substr(k, 2) == "**" && line.find("**", k + 2) != std::string_view::npos) k += 2;
    return k;
}

bool is_program(std::string_view language) {
    static constexpr std::string_view names[] = {"python", "py", "c", "cpp", "c++", "bash", "sh", "json", "toml", "yaml", "javascript", "js",
                                                 "julia", "html", "css", "rust", "java", "console", "shell", "diff", "xml"};
    return std::find(std::begin(names), std::end(names), language) != std::end(names);
}

bool binds(const WrittenToken& token) {
    const LineKind kind = token.kind;
    return kind == LineKind::plus || kind == LineKind::times || kind == LineKind::divide || kind == LineKind::power ||
           kind == LineKind::relation || kind == LineKind::minus;
}

}  // namespace

/// What begins at the beginning of a line. False if the line is to be read character by character.
bool DocumentReader::line(Markup markup) {
    const std::size_t end = line_end(at_);
    const std::string_view text = slice(at_, end);
    if (markup == Markup::markdown) {
        const std::string_view bare = trimmed(text);
        if (bare.starts_with("```") || bare.starts_with("~~~")) return fence();
        if (bare == "[" && bare_display()) return true;
    }
    if (markup == Markup::tex && has_marks_) return false;
    if (text.find('$') != std::string_view::npos || text.find("\\(") != std::string_view::npos ||
        text.find("\\[") != std::string_view::npos || text.find("\\begin") != std::string_view::npos ||
        text.find('`') != std::string_view::npos || !has_relation_sign(text))
        return false;
    return plain_line(at_, end);
}

/// ``` … ```
bool DocumentReader::fence() {
    const std::size_t first = line_end(at_);
    const std::string_view opening = trimmed(slice(at_, first));
    const std::string mark(opening.substr(0, 3));
    std::string_view language = opening.substr(std::min(opening.find_first_not_of(mark[0]), opening.size()));
    language = language.substr(0, language.find_first_of(" {"));
    std::size_t close = first;
    while (close < end_) {
        const std::size_t next = line_end(close + 1);
        if (trimmed(slice(std::min(close + 1, end_), next)).starts_with(mark)) break;
        close = next;
    }
    const std::size_t begin = std::min(first + 1, end_), end = std::max(begin, std::min(close + 1, end_));
    const std::size_t after = close >= end_ ? end_ : line_end(close + 1);
    if (language == "math" || language == "katex") {
        at_ = after;
        formula(begin, end, WrittenNotation::latex, true);
    } else if (language == "latex" || language == "tex") {
        if (has_marks_of_latex(slice(begin, end)) && slice(begin, end).find_first_of("$[(b") != std::string_view::npos &&
            (slice(begin, end).find("\\begin") != std::string_view::npos || slice(begin, end).find("\\[") != std::string_view::npos ||
             slice(begin, end).find('$') != std::string_view::npos || slice(begin, end).find("\\(") != std::string_view::npos))
            scan(begin, end, Markup::tex);
        else
            formula(begin, end, WrittenNotation::latex, true);
    } else if (!is_program(language)) {
        const std::size_t last = end_;
        end_ = end;
        for (std::size_t from = begin; from < end;) {
            const std::size_t to = line_end(from);
            at_ = from;
            if (!has_relation_sign(slice(from, to)) || !plain_line(from, to)) {
                say_words(slice(from, to));
                say_words(" ");
                at_ = to;
            }
            from = std::max(at_, to) + 1;
        }
        end_ = last;
    }
    at_ = after;
    is_line_start_ = false;
    return true;
}

/// `T = ½ m v²` within words.
bool DocumentReader::code() {
    const std::size_t close = text_.find('`', at_ + 1);
    if (close == std::string::npos || close >= line_end(at_) || close == at_ + 1) return false;
    const std::size_t begin = at_ + 1;
    at_ = close + 1;
    if (!has_relation_sign(slice(begin, close))) {
        say_words(slice(begin, close));
        return true;
    }
    std::vector<WrittenStatement> found;
    if (has_command(slice(begin, close)))
        found = statements_of(tokens_of(slice(begin, close), begin, WrittenNotation::latex, context_), false);
    else
        found = statements_of(tokens_of(slice(begin, close), begin, WrittenNotation::plain, context_), false);
    add(std::move(found), false);
    return true;
}

/// [ and ] on lines of their own, as the displays of chats become when their backslashes are lost.
bool DocumentReader::bare_display() {
    std::size_t begin = line_end(at_);
    std::size_t end = begin;
    for (int count = 0; count < 60 && end < end_; ++count) {
        const std::size_t next = line_end(end + 1);
        if (trimmed(slice(std::min(end + 1, end_), next)) == "]") {
            at_ = next;
            formula(begin, end, WrittenNotation::latex, true);
            return true;
        }
        end = next;
    }
    return false;
}

/// (\theta) within words, as inline formulas of chats become when their backslashes are lost.
bool DocumentReader::bare_parentheses() {
    const std::size_t end = std::min(line_end(at_), at_ + 2000);
    int depth = 0;
    for (std::size_t k = at_; k < end; ++k) {
        if (text_[k] == '(') ++depth;
        if (text_[k] == '$' || text_[k] == '`') return false;
        if (text_[k] != ')' || --depth > 0) continue;
        const std::size_t begin = at_ + 1;
        if (!has_command(slice(begin, k)) || slice(begin, k).find("\\(") != std::string_view::npos) return false;
        at_ = k + 1;
        formula(begin, k, WrittenNotation::latex, false);
        return true;
    }
    return false;
}

/// The tokens of a line, in which words of prose become one token for all that stand together.
std::vector<WrittenStatement> DocumentReader::plain_statements(std::size_t begin, std::size_t end) {
    const std::string_view line = slice(begin, end);
    const WrittenNotation notation = has_command(line) ? WrittenNotation::latex : WrittenNotation::plain;
    std::vector<WrittenToken> tokens = tokens_of(line, begin, notation, context_);
    std::vector<WrittenToken> joined;
    for (std::size_t i = 0; i < tokens.size(); ++i) {
        WrittenToken& token = tokens[i];
        bool is_word = false;
        if (notation == WrittenNotation::plain && token.kind == LineKind::letter) {
            const std::string_view word = slice(token.offset, token.offset + token.length);
            const bool binds_after = i + 1 < tokens.size() && (binds(tokens[i + 1]) || tokens[i + 1].kind == LineKind::primes ||
                                                               (tokens[i + 1].kind == LineKind::open && tokens[i + 1].tight));
            const bool binds_before = i > 0 && binds(tokens[i - 1]);
            const bool is_joined = !joined.empty() && joined.back().kind == LineKind::text;
            const bool stands_first = i == 0 || is_joined;
            is_word = is_prose(word) && !binds_after && !binds_before && (word.size() > 1 || (stands_first && i + 1 < tokens.size() && tokens[i + 1].kind == LineKind::letter && tokens[i + 1].length > 2));
        }
        const bool is_mark = token.kind == LineKind::stray && notation == WrittenNotation::plain && token.text != "$" && token.text != "pm" && token.text != "mp";
        if (!is_word && !is_mark) {
            joined.push_back(std::move(token));
            continue;
        }
        const std::string word(slice(token.offset, token.offset + token.length));
        if (!joined.empty() && joined.back().kind == LineKind::text) {
            joined.back().text += (is_mark ? "" : " ") + word;
            joined.back().length = token.offset + token.length - joined.back().offset;
        } else {
            token.kind = LineKind::text;
            token.text = word + (is_mark ? " " : "");
            if (!is_mark) token.text += " ";
            joined.push_back(std::move(token));
        }
    }
    return statements_of(std::move(joined), false);
}

/// A line with a sign such as =, and the lines that go on with it. False if it holds no statement.
bool DocumentReader::plain_line(std::size_t begin, std::size_t end) {
    const std::size_t from = begin + marker_length(slice(begin, end));
    std::size_t after = end;
    while (after < end_) {  // lines that begin with = or +, or follow a sign
        const std::size_t next = line_end(after + 1);
        const std::string_view line = trimmed(slice(std::min(after + 1, end_), next));
        const std::string_view before = trimmed(slice(from, after));
        const bool ends_with_sign = !before.empty() && std::string_view("=+-*/").find(before.back()) != std::string_view::npos && !before.ends_with("**");
        if (line.empty() || !(line[0] == '=' || (line[0] == '+' && line.substr(0, 2) != "+ [") || line.starts_with("≈") || (ends_with_sign && before.back() != '-'))) break;
        after = next;
    }
    std::size_t stop = after;
    while (stop > from && (text_[stop - 1] == ' ' || text_[stop - 1] == '\r')) --stop;
    if (stop - from > 4 && text_.compare(stop - 2, 2, "**") == 0) stop -= 2;
    std::vector<WrittenStatement> found = plain_statements(from, stop);
    bool has_statement = false, has_failure = false;
    for (const WrittenStatement& one : found) {
        has_statement |= one.sides.size() > 1;
        has_failure |= one.sides.empty();
    }
    if (!has_statement && !(has_failure && !has_marks_)) return false;
    if (has_failure && has_marks_) return false;
    const bool is_alone = !found.empty() && found.size() == 1 && found[0].offset == from;
    std::vector<WrittenStatement> kept;
    std::string words;
    for (WrittenStatement& one : found) {
        if (one.sides.size() == 1) {  // a letter among words
            words += one.words + " " + std::string(slice(one.offset, one.offset + one.length));
            continue;
        }
        if (!words.empty()) one.words = words + " " + one.words;
        words.clear();
        kept.push_back(std::move(one));
    }
    add(std::move(kept), is_alone);
    say_words(words);
    at_ = after;
    return true;
}

}  // namespace alembert
