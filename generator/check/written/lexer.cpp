// SPDX-License-Identifier: GPL-2.0-or-later
#include "check/written/lexer.hpp"

#include <algorithm>
#include <utility>

#include "base/language/say.hpp"
#include "scene/text.hpp"

namespace alembert {

namespace {

constexpr int most_replaced_within = 40;
constexpr std::size_t wide_gap = 3;  // blanks between two equations of one line of plain text

bool is_latin(char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z');
}

bool is_written_blank(char c) {
    return c == ' ' || c == '\t' || c == '\r' || c == '\n';
}

}  // namespace

WrittenLexer::WrittenLexer(std::string_view text, std::size_t offset, WrittenNotation notation,
                           TokenContext& context, std::vector<WrittenToken>& list)
    : text_(text), offset_(offset), notation_(notation), context_(context), list_(list) {}

void WrittenLexer::run() {
    while (at_ < text_.size()) {
        const std::size_t begin = at_;
        is_tight_ = !skip_space() && (at_ > 0 || is_fixed_);
        const bool is_gap = is_plain() && at_ >= begin + wide_gap && at_ < text_.size() && begin > 0 &&
                            text_.substr(begin, at_ - begin).find('\n') == std::string_view::npos;
        if (is_gap) add(Kind::space, begin);  // T = …      V = … in one line
        if (at_ < text_.size()) next();
    }
}

/// True if there was something.
bool WrittenLexer::skip_space() {
    const std::size_t begin = at_;
    while (at_ < text_.size()) {
        if (is_written_blank(text_[at_]) || (!is_plain() && text_[at_] == '~')) {
            ++at_;
        } else if (text_[at_] == '%' && !is_plain() && !is_fixed_) {
            at_ = std::min(text_.find('\n', at_), text_.size());
        } else {
            break;
        }
    }
    return at_ > begin;
}

WrittenToken& WrittenLexer::add(Kind kind, std::size_t begin, std::string_view text) {
    if (++context_.tokens > most_written_tokens)
        throw BeyondLimit{place(begin), say("the derivation has more than {} tokens", most_written_tokens)};
    WrittenToken token;
    token.kind = kind;
    token.text = text;
    token.offset = place(begin);
    token.length = is_fixed_ ? fixed_length_ : at_ - begin;
    token.tight = is_tight_;
    is_tight_ = true;
    if (kind != Kind::number) one_digit_ = 0;
    list_.push_back(std::move(token));
    return list_.back();
}

/// Reads `latex` in place of what stands from `begin` to here.
void WrittenLexer::replace(const std::string& latex, std::size_t begin, WrittenNotation notation) {
    if (replaced_ >= most_replaced_within)
        throw BeyondLimit{place(begin),
                          say("the formula is nested more than {} levels deep", most_replaced_within)};
    WrittenLexer inner(latex, place(begin), notation, context_, list_);
    inner.replaced_ = replaced_ + 1;
    inner.is_fixed_ = true;
    inner.fixed_length_ = is_fixed_ ? fixed_length_ : at_ - begin;
    inner.expansion_ = expansion_;
    const std::size_t first = list_.size();
    const bool was_tight = is_tight_;
    inner.run();
    if (first < list_.size()) list_[first].tight = was_tight;
    one_digit_ = inner.one_digit_;
    is_tight_ = true;
}

void WrittenLexer::next() {
    const char c = text_[at_];
    if (has_digit(at_) || (c == '.' && has_digit(at_ + 1))) return number();
    if (c == '\'' || c == '`') return primes();
    if (c == '\\') return command();
    if (is_latin(c)) return word();
    if (static_cast<unsigned char>(c) < 0x80) {
        const std::size_t begin = at_;
        if (sign()) return;
        ++at_;
        add(Kind::stray, begin, text_.substr(begin, 1));
        return;
    }
    character();
}

void WrittenLexer::number() {
    const std::size_t begin = at_;
    if (one_digit_ > 0 && has_digit(at_)) {
        ++at_;
        const std::size_t left = one_digit_ - 1;
        add(Kind::number, begin, text_.substr(begin, 1));
        one_digit_ = left;
        return;
    }
    while (has_digit(at_)) ++at_;
    if (byte(at_) == '.' && has_digit(at_ + 1))
        for (++at_; has_digit(at_);) ++at_;
    if (byte(at_) == 'e' || byte(at_) == 'E') {
        const std::size_t digits = at_ + (byte(at_ + 1) == '-' || byte(at_ + 1) == '+' ? 2 : 1);
        if (has_digit(digits))
            for (at_ = digits; has_digit(at_);) ++at_;
    }
    const std::string text(text_.substr(begin, at_ - begin));
    // 9{,}81 and "= 6,54 cm" as German has it; three digits after a comma may be thousands, but not after a zero
    const bool is_braced = text_.compare(at_, 3, "{,}") == 0;
    const bool is_value = byte(at_) == ',' && !list_.empty() && list_.back().kind == Kind::relation;
    const std::size_t fraction = at_ + (is_braced ? 3 : 1);
    if (text.find('.') == std::string::npos && (is_braced || is_value) && has_digit(fraction)) {
        std::size_t end = fraction;
        while (has_digit(end)) ++end;
        const bool is_list = is_value && (byte(end) == ',' || byte(end) == ')') && byte(end + 1) != ' ' &&
                             byte(end + 1) != '\n' && byte(end + 1) != '\0';
        if ((end - fraction != 3 || text == "0") && !is_list) {
            const std::string digits(text_.substr(fraction, end - fraction));
            at_ = end;
            add(Kind::number, begin, text + "." + digits);
            return;
        }
    }
    add(Kind::number, begin, text);
}

void WrittenLexer::primes() {
    const std::size_t begin = at_;
    const bool is_noun = text_.compare(at_, 6, "'diff(") == 0 || text_.compare(at_, 11, "'integrate(") == 0;
    const bool is_after_sign =
        list_.empty() || (list_.back().kind != Kind::letter && list_.back().kind != Kind::close &&
                          list_.back().kind != Kind::primes && list_.back().kind != Kind::end_group);
    if (is_noun && is_after_sign) {  // of Maxima
        ++at_;
        return;
    }
    while (byte(at_) == '\'' || byte(at_) == '`') ++at_;
    add(Kind::primes, begin).dots = static_cast<int>(std::min<std::size_t>(at_ - begin, 100));
}

bool WrittenLexer::doubled_sign(std::size_t begin) {
    struct Pair {
        std::string_view text;
        Kind kind;
        std::string_view meaning;
    };
    static constexpr Pair pairs[] = {
        {"<=>", Kind::arrow, "iff"}, {"...", Kind::dots, ""},     {"**", Kind::power, ""},
        {":=", Kind::relation, ":"}, {"=:", Kind::relation, ":"}, {"==", Kind::relation, "="},
        {"=>", Kind::arrow, "to"},   {"->", Kind::arrow, "to"},   {"<=", Kind::relation, "<"},
        {">=", Kind::relation, "<"}, {"!=", Kind::relation, "<"}, {"~=", Kind::relation, "~"},
        {".*", Kind::times, ""},     {"./", Kind::divide, "/"},   {"//", Kind::divide, "/"},
        {".^", Kind::power, ""},     {"||", Kind::bar, "||"},
    };
    for (const Pair& pair : pairs) {
        if (text_.compare(at_, pair.text.size(), pair.text) != 0) continue;
        if (!is_plain() && (pair.text == "=>" || pair.text == "<=" || pair.text == "->" || pair.text == "||"))
            continue;
        at_ += pair.text.size();
        add(pair.kind, begin, pair.meaning);
        return true;
    }
    return false;
}

/// {\rm sen}: \mathrm{sen}
bool WrittenLexer::old_upright(std::size_t begin) {
    constexpr std::string_view mark = "{\\rm";
    if (text_.compare(begin, mark.size(), mark) != 0 || is_latin(byte(begin + mark.size()))) return false;
    const std::size_t end = end_of_group(text_, begin);
    if (end == std::string_view::npos) return false;
    const std::size_t from = begin + mark.size();
    const std::string body(text_.substr(from, end - from - 1));
    at_ = end;
    replace("\\mathrm{" + body + "}", begin);
    return true;
}

/// A sign of ASCII.
bool WrittenLexer::sign() {
    const std::size_t begin = at_;
    if (doubled_sign(begin)) return true;
    const char c = text_[at_++];
    const auto is = [&](Kind kind, std::string_view text = {}) {
        add(kind, begin, text);
        return true;
    };
    switch (c) {
        case '+':
            return is(Kind::plus);
        case '-':
            return is(Kind::minus);
        case '*':
            return is(Kind::times);
        case '/':
            return is(Kind::divide, "/");
        case '^':
            is(Kind::power);
            one_digit_ = is_plain() ? 0 : 1;
            return true;
        case '_':
            is(Kind::index);
            one_digit_ = is_plain() ? 0 : 1;
            return true;
        case '(':
        case '[': {
            WrittenToken& bracket = add(Kind::open, begin, std::string_view(&c, 1));
            bracket.upright = is_plain() && bracket.tight && c == '[';  // th'[t] of Mathematica
        }
            return true;
        case ')':
        case ']':
            return is(Kind::close, std::string_view(&c, 1));
        case '{':
            if (!is_plain() && old_upright(begin)) return true;
            return is_plain() ? is(Kind::open, "{") : is(Kind::begin_group);
        case '}':
            return is_plain() ? is(Kind::close, "}") : is(Kind::end_group);
        case '|':
            return is(Kind::bar, "|");
        case '=':
            return is(Kind::relation, "=");
        case '<':
        case '>':
            return is(Kind::relation, "<");
        case '~':
            return is(Kind::relation, "~");
        case ',':
            return is(Kind::comma);
        case ';':
        case ':':
            return is(Kind::semicolon);
        case '.':
            if (text_.compare(at_, 5, "diff(") == 0) {  // theta.diff(t)
                at_ += 4;
                return is(Kind::command, ".diff");
            }
            return is(Kind::period);
        case '&':
            return is(Kind::ampersand);
        default:
            --at_;
            return false;
    }
}

/// What combining marks after `letter` make of it.
std::string WrittenLexer::marks(std::string letter) {
    for (std::size_t after = at_; at_ < text_.size(); at_ = after) {
        const std::string_view mark = combining_mark(decode(text_, after));
        if (mark.empty() || letter.size() > 200) break;
        letter = "\\" + std::string(mark) + "{" + letter + "}";
    }
    return letter;
}

/// A run of raised or lowered signs.
void WrittenLexer::scripts(char (*plain)(char32_t), std::string_view mark) {
    const std::size_t begin = at_;
    std::string run(mark);
    run += "{";
    for (std::size_t after = at_; at_ < text_.size(); at_ = after) {
        const char c = plain(decode(text_, after));
        if (c == '\0') break;
        run += c;
    }
    replace(run + "}", begin);
}

void WrittenLexer::character() {
    const std::size_t begin = at_;
    for (const std::string_view word : {"常数", "常量", "恒量", "常值"})
        if (text_.compare(at_, word.size(), word) == 0) {
            at_ += word.size();
            add(Kind::letter, begin).letter.base = "const";
            return;
        }
    const char32_t c = decode(text_, at_);
    if (raised_sign(c) != '\0' || lowered_sign(c) != '\0') {
        at_ = begin;
        return raised_sign(c) != '\0' ? scripts(raised_sign, "^") : scripts(lowered_sign, "_");
    }
    if (c == 0x200B || c == 0x2009 || c == 0x202F || c == 0x00A0 || c == 0x2062 || c == 0x2061 || c == 0xFEFF ||
        c == 0x2002 || c == 0x2003 || c == 0x200A || c == 0x3000 || c == 0x2005 || c == 0x2063) {
        is_tight_ = false;
        return;
    }
    const std::string latex = spelled(c);
    if (latex.empty()) {
        add(Kind::stray, begin, text_.substr(begin, at_ - begin));
        return;
    }
    std::string letter = marks(latex);
    if (is_plain() && is_letter(c) && has_digit(at_)) {  // θ1
        const std::size_t digits = at_;
        while (has_digit(at_)) ++at_;
        letter += "_{" + std::string(text_.substr(digits, std::min<std::size_t>(at_ - digits, 20))) + "}";
    }
    replace(letter, begin);
}

/// sin and cos without a backslash: a mistake in LaTeX that is often made.
bool WrittenLexer::bare_function() {
    for (const std::string_view name : {"sin", "cos", "tan", "sinh", "cosh", "exp"}) {
        if (text_.compare(at_, name.size(), name) != 0 || is_latin(byte(at_ + name.size()))) continue;
        const std::size_t begin = at_;
        at_ += name.size();
        add(Kind::function, begin, name);
        return true;
    }
    return false;
}

/// K.E. and P.E.
bool WrittenLexer::abbreviated_energy() {
    for (const std::string_view name : {"K.E", "P.E"}) {
        if (text_.compare(at_, name.size(), name) != 0 || is_latin(byte(at_ + name.size()))) continue;
        const std::size_t begin = at_;
        at_ += name.size();
        if (byte(at_) == '.') ++at_;
        add(Kind::letter, begin).letter.base = {name.front(), 'E'};
        return true;
    }
    return false;
}

/// Latin letters: each for itself in LaTeX, together in plain text.
void WrittenLexer::word() {
    const std::size_t begin = at_;
    if (abbreviated_energy()) return;
    if (!is_plain()) {
        if (bare_function()) return;
        ++at_;
        const std::string letter = marks(std::string(1, text_[begin]));
        if (letter.size() > 1) return replace(letter, begin);
        add(Kind::letter, begin).letter.base = letter;
        return;
    }
    while (is_latin(byte(at_)) || has_digit(at_) ||
           (byte(at_) == '_' && (is_latin(byte(at_ + 1)) || has_digit(at_ + 1))))
        ++at_;
    std::size_t after = at_;
    if (at_ < text_.size() && !combining_mark(decode(text_, after)).empty()) {  // the last letter has a mark
        if (at_ - begin > 1) {
            --at_;
        } else {
            replace(marks(std::string(1, text_[begin])), begin);
            return;
        }
    }
    if (spelled_variation(begin)) return;
    split_function(begin);
    const std::string text(text_.substr(begin, at_ - begin));
    if (!plain_word(begin, text)) {
        auto [letter, dots] = letter_of_word(text);
        WrittenToken& token = add(Kind::letter, begin);
        token.letter = std::move(letter);
        token.dots = dots;
    }
}

/// The δ of delta_y and deltaW; what it varies is read next.
bool WrittenLexer::spelled_variation(std::size_t begin) {
    constexpr std::string_view delta = "delta";
    const std::string_view word = text_.substr(begin, at_ - begin);
    if (!context_.has_virtual_work || !word.starts_with(delta) || word.size() == delta.size()) return false;
    const std::size_t rest = delta.size() + (word[delta.size()] == '_' ? 1 : 0);
    if (rest == word.size() || !is_latin(word[rest])) return false;
    at_ = begin + delta.size();
    add(Kind::letter, begin).letter.base = delta;
    at_ = begin + rest;
    return true;
}

/// The letters before a function that is written together with them: mgLsinθ. The function is read next.
void WrittenLexer::split_function(std::size_t begin) {
    if (at_ - begin < 4 || !function_named(text_.substr(begin, at_ - begin)).empty()) return;
    const char after = byte(at_);
    if (after != '(' && static_cast<unsigned char>(after) < 0x80) return;
    for (const std::string_view name : {"sin", "cos", "tan"})
        if (text_.substr(begin, at_ - begin).ends_with(name)) at_ -= name.size();
}

/// Words of programs of computer algebra, functions, and differentials such as dtheta.
bool WrittenLexer::plain_word(std::size_t begin, const std::string& word) {
    static constexpr std::string_view calls[] = {"Derivative", "diff",  "Diff",     "Rational",
                                                 "Pow",        "pow",   "Dt",       "Eq",
                                                 "Subscript",  "Power", "simplify", "expand"};
    static constexpr std::string_view modules[] = {"sp",   "sympy", "np", "numpy", "math",
                                                   "Math", "sm",    "me", "cmath"};
    std::size_t next = at_;
    while (byte(next) == ' ') ++next;
    const bool has_bracket = byte(next) == '(' || byte(next) == '[';
    if (byte(at_) == '.' && is_latin(byte(at_ + 1)) &&
        std::find(std::begin(modules), std::end(modules), word) != std::end(modules)) {
        ++at_;
        return true;
    }
    if (word == "D" && byte(at_) == '[') {
        add(Kind::command, begin, "diff");
        return true;
    }
    if (has_bracket && std::find(std::begin(calls), std::end(calls), word) != std::end(calls)) {
        add(Kind::command, begin,
            word == "Diff" || word == "Derivative" || word == "Dt" ? "diff"
            : word == "pow" || word == "Power"                     ? "Pow"
                                                                   : word);
        return true;
    }
    if (const std::string_view function = function_named(word); !function.empty()) {
        add(Kind::function, begin, function);
        return true;
    }
    if (word == "sqr" && has_bracket) return false;
    std::size_t sign = next;  // after primes: dL'/d(q')
    while (byte(sign) == '\'') ++sign;
    if (word.size() > 1 && word[0] == 'd' && (byte(sign) == '/' || (begin > 0 && text_[begin - 1] == '/'))) {
        const std::string rest = word.substr(1);
        const auto [letter, dots] = letter_of_word(rest);
        const bool is_variable = letter.base.size() == 1 || command_named(letter.base) != nullptr || rest == "t";
        if (is_variable && !letter.base.empty() && is_latin(letter.base[0])) {
            const std::size_t end = at_;
            at_ = begin + 1;
            add(Kind::letter, begin).letter.base = "d";
            at_ = end;
            WrittenToken& token = add(Kind::letter, begin + 1);
            token.letter = letter;
            token.dots = dots;
            return true;
        }
    }
    return false;
}

}  // namespace alembert
