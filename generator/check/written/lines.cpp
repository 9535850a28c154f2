// SPDX-License-Identifier: GPL-2.0-or-later
// Lines of Markdown and of plain text: code, lists, and formulas without marks.

#include <algorithm>

#include "base/language/say.hpp"
#include "check/written/commands.hpp"
#include "check/written/document.hpp"
#include "check/written/equation_number.hpp"
#include "check/written/long_dashes.hpp"
#include "check/written/parser.hpp"
#include "check/written/statements.hpp"
#include "check/written/word_kinds.hpp"
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

/// A $ that is not within a word, as in diff(x, t$2) of Maple.
bool has_dollar(std::string_view text) {
    for (std::size_t k = text.find('$'); k != std::string_view::npos; k = text.find('$', k + 1))
        if (k == 0 || !is_name(text.substr(k - 1, 1))) return true;
    return false;
}

std::string_view trimmed(std::string_view text) {
    while (!text.empty() && std::string_view(" \t\r\n").find(text.front()) != std::string_view::npos)
        text.remove_prefix(1);
    while (!text.empty() && std::string_view(" \t\r\n").find(text.back()) != std::string_view::npos)
        text.remove_suffix(1);
    return text;
}

bool has_command(std::string_view text) {
    if (text.find("\\[") != std::string_view::npos && !has_display(text)) return false;
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
    if (digits > k && digits - k < 4 && digits + 1 < line.size() && (line[digits] == '.' || line[digits] == ')') &&
        line[digits + 1] == ' ')
        k = digits + 2;
    blanks();
    const std::size_t bold = line.substr(k, 2) == "**" ? line.find("**", k + 2) : std::string_view::npos;
    if (bold == std::string_view::npos) return k;
    if (has_relation_sign(line.substr(k, bold - k))) return k + 2;
    k = bold + 2;  // **Kinetic energy:** T = …
    while (k < line.size() && (line[k] == ' ' || line[k] == ':')) ++k;
    return k;
}

/// A line of a picture of characters, or a rule.
bool is_drawing(std::string_view line) {
    if (line.find("===") != std::string_view::npos || line.find("---") != std::string_view::npos ||
        line.find("___") != std::string_view::npos)
        return true;
    const std::string_view bare = trimmed(line);
    return bare.starts_with('|') ||
           bare.find_first_of("abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ\xCE\xCF\xE1\xF0") ==
               std::string_view::npos;
}

bool is_program(std::string_view language) {
    static constexpr std::string_view names[] = {
        "python", "py",         "c",   "cpp",   "c++",     "bash", "sh",   "json", "toml",
        "yaml",   "javascript", "js",  "julia", "html",    "css",  "rust", "java", "console",
        "shell",  "diff",       "xml", "ascii", "mermaid", "dot",  "csv"};
    return std::find(std::begin(names), std::end(names), language) != std::end(names);
}

/// Where a line ends before the dots that lead to the number of an equation, as in "…(8)" and ". . . (8)".
std::size_t before_leaders(std::string_view line) {
    std::size_t end = line.size(), dots = 0;
    for (;;) {
        const std::string_view left = line.substr(0, end);
        if (left.ends_with(' ') || left.ends_with('\t'))
            --end;
        else if (left.ends_with('.'))
            --end, ++dots;
        else if (left.ends_with("…") || left.ends_with("⋯"))
            end -= std::string_view("…").size(), dots += 3;
        else
            break;
    }
    return dots > 1 ? end : line.size();
}

/// 8, 2.13, 5a
bool is_short_number(std::string_view text) {
    constexpr std::size_t most = 5;
    return !text.empty() && text.size() <= most && text[0] >= '0' && text[0] <= '9' &&
           text.find_first_not_of("0123456789.abc'") == std::string_view::npos;
}

/// Where the formula of a line ends, before the number of an equation, (1.24), or a remark in parentheses or after
/// #.
std::size_t end_of_formula(std::string_view line) {
    std::size_t end = line.size();
    const auto without_blanks = [&] {
        while (end > 0 && (line[end - 1] == ' ' || line[end - 1] == '\r' || line[end - 1] == '\t')) --end;
    };
    const std::size_t remark = line.find(" # ");
    if (remark != std::string_view::npos) end = remark;
    without_blanks();
    if (end == 0 || line[end - 1] != ')') return end;
    std::size_t open = end;
    for (int depth = 0; open > 0;) {
        --open;
        depth += line[open] == ')' ? 1 : line[open] == '(' ? -1 : 0;
        if (depth == 0) break;
    }
    const std::string_view inside = line.substr(open + 1, end - open - 2);
    if (const std::size_t before = before_leaders(line.substr(0, open)); before < open && is_short_number(inside))
        return before;
    if (open < 2 || line[open - 1] != ' ' || inside.empty()) return end;
    const bool is_number = inside.find('.') != std::string_view::npos &&
                           inside.find_first_not_of("0123456789.") == std::string_view::npos;
    const bool is_far = line[open - 2] == ' ' && inside.find_first_of("=+^*/") == std::string_view::npos;
    const bool has_words = inside.find(' ') != std::string_view::npos &&
                           inside.find_first_of("=+^*/-0123456789") == std::string_view::npos &&
                           is_prose(inside.substr(0, inside.find(' ')));
    if (!is_number && !is_far && !has_words) return end;
    const std::size_t whole = end;
    end = open;
    without_blanks();
    if (end == 0 || std::string_view("=+-*/^(").find(line[end - 1]) != std::string_view::npos) return whole;
    return end;
}

/// A formula that goes on in the next line, without the numbers of equations behind its lines.
std::vector<WrittenToken> without_equation_numbers(const std::vector<WrittenToken>& tokens,
                                                   std::string_view text) {
    std::vector<WrittenToken> result;
    for (std::size_t i = 0; i < tokens.size(); ++i) {
        const std::size_t before = i == 0 ? tokens[i].offset : tokens[i - 1].offset + tokens[i - 1].length;
        const bool is_next_line =
            before < tokens[i].offset && text.substr(before, tokens[i].offset - before).find('\n') != text.npos;
        if (is_next_line) result.resize(before_equation_number(result, 0, result.size()));
        result.push_back(tokens[i]);
    }
    return result;
}

bool binds(const WrittenToken& token) {
    const LineKind kind = token.kind;
    return kind == LineKind::plus || kind == LineKind::times || kind == LineKind::divide ||
           kind == LineKind::power || kind == LineKind::relation || kind == LineKind::minus;
}

}  // namespace

bool has_display(std::string_view text) {
    for (std::size_t k = text.find("\\["); k != std::string_view::npos; k = text.find("\\[", k + 1))
        if (named_character_length(text.substr(k, 60)) == 0) return true;
    return false;
}

std::size_t named_character_length(std::string_view text) {
    if (!text.starts_with("\\[")) return 0;
    const std::size_t letters = word_at(text, 2).size();
    return letters > 1 && text.substr(2 + letters, 1) == "]" ? letters + 3 : 0;
}

/// What begins at the beginning of a line. False if the line is to be read character by character.
bool DocumentReader::line(Markup markup) {
    const std::size_t end = line_end(at_);
    const std::string_view text = slice(at_, end);
    if (markup == Markup::markdown) {
        const std::string_view bare = trimmed(text);
        if (bare.starts_with("```") || bare.starts_with("~~~")) return fence();
        if (bare == "[" && bare_display()) return true;
    }
    if (text.find(".. math::") != std::string_view::npos) return restructured_math(end);
    if (markup == Markup::tex && has_marks_) return false;
    if (has_dollar(text) || text.find("\\(") != std::string_view::npos || has_display(text) ||
        text.find("\\begin") != std::string_view::npos || text.find('`') != std::string_view::npos ||
        !has_relation_sign(text))
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
        if (has_marks_of_latex(slice(begin, end)) &&
            slice(begin, end).find_first_of("$[(b") != std::string_view::npos &&
            (slice(begin, end).find("\\begin") != std::string_view::npos ||
             slice(begin, end).find("\\[") != std::string_view::npos ||
             slice(begin, end).find('$') != std::string_view::npos ||
             slice(begin, end).find("\\(") != std::string_view::npos))
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

/// `.. math::` of reStructuredText: what stands after it on the line, and the indented lines below.
bool DocumentReader::restructured_math(std::size_t end) {
    const std::size_t begin = text_.find(".. math::", at_) + std::string_view(".. math::").size();
    std::size_t last = end;
    for (std::size_t from = end; from < end_;) {
        const std::size_t next = line_end(from + 1);
        const std::string_view line = slice(std::min(from + 1, end_), next);
        const bool is_blank = trimmed(line).empty();
        if (!is_blank && line[0] != ' ' && line[0] != '\t') break;
        if (!is_blank && !trimmed(line).starts_with(':')) last = next;
        from = next;
    }
    std::size_t from = begin;
    while (trimmed(slice(from, line_end(from))).empty() && from < last) from = std::min(line_end(from) + 1, last);
    if (trimmed(slice(from, line_end(from))).starts_with(':')) from = line_end(from);  // :label:
    at_ = last;
    formula(from, last, WrittenNotation::latex, true);
    return true;
}

/// `T = ½ m v²` within words.
bool DocumentReader::code() {
    std::size_t width = 1;
    while (at_ + width < end_ && text_[at_ + width] == '`') ++width;
    const std::string_view mark = slice(at_, at_ + width);
    const std::size_t close = text_.find(mark, at_ + width);
    if (close == std::string::npos || close >= line_end(at_)) {
        say_words(mark);
        at_ += width;
        return true;
    }
    const std::size_t begin = at_ + width;
    const bool is_formula = words_.ends_with(":math:");
    at_ = close + width;
    if (is_formula) {
        words_.resize(words_.size() - std::string_view(":math:").size());
        formula(begin, close, WrittenNotation::latex, false);
        return true;
    }
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
    const std::size_t end = std::min(line_end(at_), at_ + 600);
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

/// A line of LaTeX without marks, in which words of prose stand between formulas.
std::vector<WrittenToken> DocumentReader::latex_tokens(std::size_t begin, std::size_t end) {
    std::vector<WrittenToken> tokens;
    std::size_t from = begin;
    const auto take = [&](std::size_t to) {
        for (WrittenToken& token : tokens_of(slice(from, to), from, WrittenNotation::latex, context_))
            tokens.push_back(std::move(token));
    };
    int depth = 0;
    for (std::size_t k = begin; k < end;) {
        const std::string_view word = word_at(slice(k, end), 0);
        if (text_[k] == '\\') {
            k += 1 + std::max<std::size_t>(word_at(slice(k + 1, end), 0).size(), 1);
        } else if (word.size() > 1 && depth == 0 && is_prose(word)) {
            take(k);
            add_word(tokens, std::string(word), k);
            from = k += word.size();
        } else {
            depth += text_[k] == '{' ? 1 : text_[k] == '}' ? -1 : 0;
            k += std::max<std::size_t>(word.size(), 1);
        }
    }
    take(end);
    return tokens;
}

/// A word of prose becomes a part of the text before it, or a text of its own.
void DocumentReader::add_word(std::vector<WrittenToken>& tokens, const std::string& word, std::size_t offset) {
    if (!tokens.empty() && tokens.back().kind == LineKind::text) {
        std::string& text = tokens.back().text;
        const auto is_wide = [](char c) { return static_cast<unsigned char>(c) >= 0x80; };
        const bool is_adjacent = tokens.back().offset + tokens.back().length == offset;
        const bool are_wide = text.size() > 1 && is_wide(text[text.size() - 2]) && is_wide(word[0]);
        if (is_adjacent && are_wide) text.pop_back();  // 平衡时 is one word, and each of its signs a token
        text += word + " ";
        tokens.back().length = offset + word.size() - tokens.back().offset;
        return;
    }
    WrittenToken token;
    token.kind = LineKind::text;
    token.text = word + " ";
    token.offset = offset;
    token.length = word.size();
    tokens.push_back(std::move(token));
}

/// A line of plain text, in which words of prose become one token for all that stand together.
std::vector<WrittenToken> DocumentReader::plain_tokens(std::size_t begin, std::size_t end) {
    std::vector<WrittenToken> joined;
    const std::vector<WrittenToken> tokens = tokens_of(slice(begin, end), begin, WrittenNotation::plain, context_);
    const auto source = [&](std::size_t i) {
        return slice(tokens[i].offset, tokens[i].offset + tokens[i].length);
    };
    const auto is_letter = [&](std::size_t i) { return i < tokens.size() && tokens[i].kind == LineKind::letter; };
    const auto is_bound = [&](std::size_t i) {
        return (i > 0 && binds(tokens[i - 1])) ||
               (i + 1 < tokens.size() && (binds(tokens[i + 1]) || tokens[i + 1].kind == LineKind::primes ||
                                          (tokens[i + 1].kind == LineKind::open && tokens[i + 1].tight)));
    };
    const auto is_clear_prose = [&](std::size_t i) {
        return is_letter(i) && source(i).size() > 1 && is_prose(source(i)) && !is_bound(i);
    };
    const auto is_label = [&](std::size_t i) {  // "and from (2) 4/3 l φ'' + …", "with (17)  F = …"
        return (joined.empty() || joined.back().kind == LineKind::text) && i + 3 < tokens.size() &&
               tokens[i].kind == LineKind::open && tokens[i + 1].kind == LineKind::number &&
               tokens[i + 2].kind == LineKind::close && !binds(tokens[i + 3]) &&
               source(i + 1).find_first_not_of("0123456789.") == std::string_view::npos &&
               (tokens[i + 2].offset + tokens[i + 2].length < tokens[i + 3].offset ||
                source(i + 3).starts_with(' '));
    };
    const LongDashes dashes(tokens, source);
    for (std::size_t i = 0; i < tokens.size(); ++i) {
        if (dashes.is_minus(i)) {
            joined.push_back(tokens[i]);
            joined.back().kind = LineKind::minus;
            continue;
        }
        if (is_label(i)) {
            const std::size_t last = tokens[i + 2].offset + tokens[i + 2].length;
            add_word(joined, std::string(slice(tokens[i].offset, last)), tokens[i].offset);
            i += 2;
            continue;
        }
        bool is_word = is_clear_prose(i);
        const bool is_joined = !joined.empty() && joined.back().kind == LineKind::text;
        if (!is_word && is_letter(i) && !is_bound(i)) {
            // A word of another language, or "a", beside prose
            const std::string_view word = source(i);
            const bool has_vowel = word.find_first_of("aeiouy") != std::string_view::npos;
            const bool is_small = word.find_first_not_of("abcdefghijklmnopqrstuvwxyz") == std::string_view::npos;
            const bool is_beside = is_joined || is_clear_prose(i + 1);
            is_word = is_beside && is_small && has_vowel &&
                      (word.size() > 1 ? command_named(word) == nullptr
                                       : is_clear_prose(i + 1) && (is_joined || i == 0));
        }
        const LineKind kind = tokens[i].kind;
        const bool is_mark = (kind == LineKind::stray && tokens[i].text != "$" && tokens[i].text != "pm" &&
                              tokens[i].text != "mp") ||
                             (kind == LineKind::minus && is_joined && is_clear_prose(i + 1));
        if (is_word || is_mark)
            add_word(joined, std::string(source(i)), tokens[i].offset);
        else
            joined.push_back(tokens[i]);
    }
    return joined;
}

/// "T of particle M1 = …", "Q(x) of gravity on particle M1 = …", "F*(x') = …", as `derive --steps` prints them:
/// the words stand above the letter, and below it, what is in parentheses. Empty for a line that begins otherwise.
std::vector<WrittenToken> DocumentReader::labelled_tokens(std::size_t begin, std::size_t end) {
    constexpr std::string_view of = " of ", indexed = "QFEB";
    const std::string_view line = slice(begin, end), before = line.substr(0, line.find(" = "));
    const std::size_t word = std::min(before.find(of), before.size());
    if (before.size() == line.size() || before.substr(0, word).find(' ') != std::string_view::npos) return {};
    std::string_view label = before.substr(std::min(word + of.size(), before.size()));
    if (label.starts_with("the ")) label.remove_prefix(4);
    if (label.find_first_of("=+*/^") != std::string_view::npos) return {};
    std::vector<WrittenToken> tokens = plain_tokens(begin, begin + word);
    if (tokens.empty() || tokens[0].kind != LineKind::letter) return {};
    const auto open = std::find_if(tokens.begin(), tokens.end(),
                                   [](const WrittenToken& token) { return token.kind == LineKind::open; });
    const bool has_index = indexed.find(before[0]) != std::string_view::npos && tokens.end() - open >= 3 &&
                           tokens.back().kind == LineKind::close && open[1].kind == LineKind::letter &&
                           open[1].letter.base != "t";
    const bool is_labelled = word < before.size() && label != "system" && label != "whole system";
    if (!has_index && (tokens.size() > 1 || word == before.size())) return {};
    const WrittenToken first = tokens[0];
    const auto mark = [&](LineKind kind, std::string_view text = "") {
        WrittenToken token = first;
        token.kind = kind;
        token.text = text;
        return token;
    };
    if (has_index) {
        if (open[2].kind == LineKind::primes) {
            open[1].dots += open[2].dots;
            tokens.erase(open + 2);
        }
        open->kind = LineKind::begin_group;
        tokens.back().kind = LineKind::end_group;
        tokens.insert(open, mark(LineKind::index));
    }
    if (is_labelled)
        for (const WrittenToken& token : {mark(LineKind::power), mark(LineKind::begin_group),
                                          mark(LineKind::text, label), mark(LineKind::end_group)})
            tokens.push_back(token);
    for (WrittenToken& token : plain_tokens(begin + before.size(), end)) tokens.push_back(std::move(token));
    return tokens;
}

/// A line with a sign such as =, and the lines that go on with it. False if it holds no statement.
namespace {

/// (%o3) of Maxima, Out[3]= and In[3]:= of Mathematica before a formula.
std::size_t session_label_length(std::string_view line) {
    const std::size_t begin = std::min(line.find_first_not_of(' '), line.size());
    const std::string_view rest = line.substr(begin);
    const auto behind = [&](std::string_view open, std::string_view close) -> std::size_t {
        if (!rest.starts_with(open)) return 0;
        std::size_t at = open.size();
        while (at < rest.size() && std::isdigit(static_cast<unsigned char>(rest[at])) != 0) ++at;
        return at > open.size() && rest.substr(at).starts_with(close) ? begin + at + close.size() : 0;
    };
    for (const auto& [open, close] :
         {std::pair("(%o", ")"), std::pair("(%i", ")"), std::pair("Out[", "]="), std::pair("In[", "]:=")})
        if (const std::size_t length = behind(open, close); length > 0) return length;
    return 0;
}

/// "(d) " and "b) " before what stands in an item of an exam.
std::size_t item_length(std::string_view line) {
    const std::size_t begin = std::min(line.find_first_not_of(' '), line.size());
    std::string_view rest = line.substr(begin);
    const bool is_open = rest.starts_with('(');
    if (is_open) rest.remove_prefix(1);
    const bool is_item = rest.size() > 2 && std::isalpha(static_cast<unsigned char>(rest[0])) != 0 &&
                         rest[1] == ')' && rest[2] == ' ' &&
                         std::string_view("=+-*/^").find(trimmed(rest.substr(2))[0]) == std::string_view::npos;
    if (is_item) return begin + (is_open ? 1 : 0) + 3;
    std::size_t digits = 0;  // "(5)  T = …"
    while (digits < rest.size() && std::isdigit(static_cast<unsigned char>(rest[digits])) != 0) ++digits;
    const bool is_number =
        is_open && digits > 0 && rest.substr(digits).starts_with(") ") &&
        std::string_view("=+-*/^").find(trimmed(rest.substr(digits + 1))[0]) == std::string_view::npos;
    if (is_number) return begin + 1 + digits + 2;
    rest = line.substr(begin);  // "COR. 1.  If …"
    constexpr std::size_t longest_word = 8;
    std::size_t at = 0;
    while (at < rest.size() && std::isalpha(static_cast<unsigned char>(rest[at])) != 0) ++at;
    if (at < 2 || at > longest_word || std::isupper(static_cast<unsigned char>(rest[0])) == 0) return 0;
    if (at < rest.size() && rest[at] == '.') ++at;
    if (at >= rest.size() || rest[at] != ' ') return 0;
    const std::size_t number = ++at;
    while (at < rest.size() && std::isdigit(static_cast<unsigned char>(rest[at])) != 0) ++at;
    return at > number && rest.substr(at).starts_with(". ") ? begin + at + 2 : 0;
}

/// The length of a line without "(3 points)" or "（3分）" at its end.
std::size_t length_without_points(std::string_view line) {
    static constexpr std::string_view words[] = {"分",  "points", "point", "P",    "P.",     "Punkte", "Pkt.",
                                                 "pts", "pt",     "marks", "mark", "puntos", "punti",  "pontos",
                                                 "pkt", "баллов", "балла", "балл", "poäng",  "p",      "点"};
    static constexpr std::pair<std::string_view, std::string_view> brackets[] = {
        {"(", ")"}, {"（", "）"}, {"[", "]"}, {"（", ")"}, {"(", "）"}};
    const std::string_view text = line.substr(0, line.find_last_not_of(" \t\r") + 1);
    for (const auto& [open, close] : brackets) {
        const std::size_t begin = text.rfind(open);
        if (!text.ends_with(close) || begin == std::string_view::npos) continue;
        const std::size_t from = begin + open.size();
        const std::string_view inside = trimmed(text.substr(from, text.size() - close.size() - from));
        const std::size_t digits = std::min(inside.find_first_not_of("0123456789"), inside.size());
        const std::string_view word = trimmed(inside.substr(digits));
        if (digits > 0 && std::find(std::begin(words), std::end(words), word) != std::end(words))
            return std::min(text.find_last_not_of(" \t", begin - (begin > 0 ? 1 : 0)) + 1, begin);
    }
    return line.size();
}

}  // namespace

bool DocumentReader::plain_line(std::size_t begin, std::size_t end) {
    std::size_t from = begin + marker_length(slice(begin, end));
    from += session_label_length(slice(from, end));
    from += item_length(slice(from, end));
    if (is_drawing(slice(from, end))) return false;
    std::size_t after = end;
    while (after < end_) {  // lines that begin with = or +, or follow a sign
        const std::size_t next = line_end(after + 1);
        const std::string_view line = trimmed(slice(std::min(after + 1, end_), next));
        const std::string_view before = trimmed(slice(from, after));
        const bool ends_with_sign = !before.empty() &&
                                    std::string_view("=+-*/").find(before.back()) != std::string_view::npos &&
                                    !before.ends_with("**");
        if (line.empty() || !(line[0] == '=' || (line[0] == '+' && line.substr(0, 2) != "+ [") ||
                              line.starts_with("≈") || (ends_with_sign && before.back() != '-')))
            break;
        after = next;
    }
    const std::size_t last = from + length_without_points(slice(from, after));
    std::size_t stop = end_of_formula(slice(from, last)) + from;
    if (stop - from > 4 && text_.compare(stop - 2, 2, "**") == 0) stop -= 2;
    const bool is_latex = has_command(slice(from, stop));
    std::vector<WrittenToken> tokens = is_latex ? latex_tokens(from, stop) : labelled_tokens(from, stop);
    if (tokens.empty()) tokens = plain_tokens(from, stop);
    std::vector<WrittenStatement> found = statements_of(without_equation_numbers(tokens, text_), false);
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
    say_words(slice(begin, from));
    add(std::move(kept), is_alone);
    say_words(words);
    at_ = after;
    return true;
}

}  // namespace alembert
