// SPDX-License-Identifier: GPL-2.0-or-later
// What begins with a backslash: commands, groups of words, macros.

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "base/language/say.hpp"
#include "check/written/lexer.hpp"
#include "scene/text.hpp"

namespace alembert {

namespace {

constexpr int most_macros_within = 8;
constexpr std::size_t longest_upright = 400;  // bytes of \mathrm{…} that may be a word or a unit
constexpr std::size_t most_macro_bytes = 1024 * 1024;

bool is_command_letter(char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '@';
}

std::string_view without_outer_blanks(std::string_view text) {
    while (!text.empty() && std::string_view(" \t\r\n~").find(text.front()) != std::string_view::npos)
        text.remove_prefix(1);
    while (!text.empty() && std::string_view(" \t\r\n~").find(text.back()) != std::string_view::npos)
        text.remove_suffix(1);
    return text;
}

/// The words of \text{…}: blanks collapsed, commands without their backslash.
std::string plain_words(std::string_view text) {
    std::string words;
    for (std::size_t k = 0; k < text.size(); ++k) {
        const char c = text[k];
        if (c == '\\' && k + 1 < text.size() && !is_command_letter(text[k + 1])) {
            if (std::string_view(",;:! ").find(text[++k]) == std::string_view::npos)
                words += text[k];
            else
                words += ' ';
        } else if (c == '{' || c == '}' || c == '$' || c == '\\') {
            continue;
        } else if (c == ' ' || c == '\n' || c == '\t' || c == '\r' || c == '~') {
            if (!words.empty() && words.back() != ' ') words += ' ';
        } else {
            words += c;
        }
    }
    return std::string(without_outer_blanks(words));
}

bool is_word_of_letters(std::string_view text) {
    return !text.empty() && is_command_letter(text[0]) && text[0] != '@' &&
           std::all_of(text.begin(), text.end(), [](char c) {
               return (is_command_letter(c) && c != '@') || (c >= '0' && c <= '9') || c == '_';
           });
}

}  // namespace

std::size_t end_of_group(std::string_view text, std::size_t begin) {
    int depth = 0;
    for (std::size_t k = begin; k < text.size(); ++k) {
        if (text[k] == '\\')
            ++k;
        else if (text[k] == '{')
            ++depth;
        else if (text[k] == '}' && --depth == 0)
            return k + 1;
    }
    return std::string_view::npos;
}

std::string plain_unit(std::string_view unit) {
    struct Part {
        std::string_view name, sign;
    };
    static constexpr Part parts[] = {
        {"metre", "m"},  {"meter", "m"},    {"second", "s"},   {"kilogram", "kg"}, {"gram", "g"},
        {"newton", "N"}, {"radian", "rad"}, {"joule", "J"},    {"watt", "W"},      {"degree", "deg"},
        {"hertz", "Hz"}, {"pascal", "Pa"},  {"minute", "min"}, {"hour", "h"},      {"kelvin", "K"},
        {"ampere", "A"}, {"coulomb", "C"},  {"volt", "V"},     {"kilo", "k"},      {"centi", "c"},
        {"milli", "m"},  {"micro", "u"},    {"mega", "M"},     {"giga", "G"},      {"squared", "^2"},
        {"cubed", "^3"}, {"square", ""},    {"kg", "kg"},      {"m", "m"},         {"s", "s"},
        {"N", "N"},      {"rad", "rad"},    {"mm", "mm"},      {"cm", "cm"},       {"cdot", "*"},
        {"times", "*"},  {"rm", ""},        {"mathrm", ""},    {"text", ""},       {"circ", "deg"},
    };
    std::string plain;
    bool is_prefix = false;
    for (std::size_t k = 0; k < unit.size();) {
        if (unit[k] != '\\') {
            if (std::string_view("{}~").find(unit[k]) == std::string_view::npos)
                plain += unit[k] == '.' ? '*' : unit[k];
            ++k;
            continue;
        }
        std::size_t end = k + 1;
        while (end < unit.size() && is_command_letter(unit[end])) ++end;
        const std::string_view name = unit.substr(k + 1, end - k - 1);
        if (name.empty()) {  // a thin space
            if (!plain.empty()) plain += ' ';
            end = k + 2;
        }
        for (const Part& part : parts) {
            if (part.name != name) continue;
            const bool joins = is_prefix || part.sign.starts_with('^') || part.sign == "*" || plain.empty() ||
                               plain.back() == '/' || plain.back() == '*' || plain.back() == ' ';
            plain += (joins ? "" : " ") + std::string(part.sign);
            is_prefix = name.ends_with("kilo") || name.ends_with("illi") || name == "centi" || name == "micro" ||
                        name == "mega" || name == "giga";
        }
        if (name == "per") plain += '/', is_prefix = false;
        k = std::min(end, unit.size());
    }
    return std::string(without_outer_blanks(plain));
}

/// The argument that comes next: a group without its braces, or one character or command.
std::string_view WrittenLexer::argument() {
    skip_space();
    if (at_ >= text_.size()) return {};
    const std::size_t begin = at_;
    if (text_[at_] == '{') {
        const std::size_t end = end_of_group(text_, at_);
        at_ = end == std::string_view::npos ? text_.size() : end;
        return text_.substr(begin + 1, end == std::string_view::npos ? end : end - begin - 2);
    }
    if (text_[at_] == '\\') {
        for (++at_; at_ < text_.size() && is_command_letter(text_[at_]);) ++at_;
        if (at_ == begin + 1 && at_ < text_.size()) ++at_;
    } else {
        decode(text_, at_);
    }
    return text_.substr(begin, at_ - begin);
}

/// Passes over [ … ] if it comes next.
void WrittenLexer::bracket_argument() {
    if (byte(at_) != '[') return;
    const std::size_t end = text_.find(']', at_);
    if (end != std::string_view::npos && end - at_ < 200) at_ = end + 1;
}

/// The bracket after \left or \right.
void WrittenLexer::delimiter(std::string_view which, std::size_t begin) {
    skip_space();
    if (which == "middle") {
        if (byte(at_) == '\\') return command();
        add(Kind::bar, begin, "|");
        at_ = std::min(at_ + 1, text_.size());
        return;
    }
    const bool is_left = which == "left";
    const std::size_t from = at_;
    std::string_view sign = text_.substr(std::min(at_, text_.size()), 1);
    if (sign == "\\") {
        for (++at_; at_ < text_.size() && is_command_letter(text_[at_]);) ++at_;
        if (at_ == from + 1 && at_ < text_.size()) ++at_;
        sign = text_.substr(from + 1, at_ - from - 1);
    } else {
        at_ = std::min(at_ + sign.size(), text_.size());
    }
    if (sign == ".") {
        add(is_left ? Kind::no_open : Kind::no_close, begin);
        return;
    }
    static constexpr std::pair<std::string_view, std::string_view> brackets[] = {
        {"(", "("},      {")", "("},      {"[", "["},      {"]", "["},      {"{", "{"},      {"}", "{"},
        {"lbrace", "{"}, {"rbrace", "{"}, {"|", "|"},      {"vert", "|"},   {"lvert", "|"},  {"rvert", "|"},
        {"Vert", "|"},   {"lVert", "|"},  {"rVert", "|"},  {"langle", "<"}, {"rangle", "<"}, {"<", "<"},
        {">", "<"},      {"lbrack", "["}, {"rbrack", "["}, {"lfloor", "["}, {"rfloor", "["}};
    for (const auto& [name, bracket] : brackets)
        if (name == sign) {
            add(is_left ? Kind::open : Kind::close, begin, bracket);
            return;
        }
    at_ = from;
}

void WrittenLexer::command() {
    const std::size_t begin = at_++;
    const char c = byte(at_);
    if (is_plain() && c == '[') {  // \[Theta] of Mathematica
        const std::size_t end = std::min(text_.find(']', at_), text_.size());
        std::string name(text_.substr(at_ + 1, std::min<std::size_t>(end - at_ - 1, 40)));
        at_ = std::min(end + 1, text_.size());
        if (name.starts_with("Curly")) name = "var" + name.substr(5);
        if (name.starts_with("Capital"))
            name = name.substr(7);
        else if (!name.empty())
            name[name.starts_with("var") ? 3 : 0] |= 0x20;
        return replace("\\" + name + " ", begin);
    }
    if (!is_command_letter(c)) {
        if (at_ < text_.size()) decode(text_, at_);
        if (c == '\\') {
            if (byte(at_) == '*') ++at_;
            bracket_argument();
            add(Kind::row, begin);
        } else if (c == '{' || c == '}') {
            add(c == '{' ? Kind::open : Kind::close, begin, "{");
        } else if (c == '|') {
            add(Kind::bar, begin, "||");
        } else if (c == '_') {
            add(Kind::index, begin);
            one_digit_ = is_plain() ? 0 : 1;
        } else if (c == '&' || c == '%' || c == '#' || c == '$') {
            add(Kind::stray, begin, text_.substr(begin, 2));
        } else {
            is_tight_ = c == '!';
        }
        return;
    }
    while (is_command_letter(byte(at_))) ++at_;
    const std::string_view name = text_.substr(begin + 1, at_ - begin - 1);
    if (const auto macro = context_.macros.find(name); macro != context_.macros.end())
        return expand(macro->second, name, begin);
    if (name == "begin" || name == "end") return environment(name == "begin", begin);
    if (const std::string_view function = function_named(name); !function.empty() && name != "sqrt") {
        add(Kind::function, begin, function);
        return;
    }
    if (const WrittenCommand* const known = command_named(name)) return named(*known, begin);
    add(Kind::stray, begin, text_.substr(begin, at_ - begin));
}

void WrittenLexer::named(const WrittenCommand& command, std::size_t begin) {
    using Effect = WrittenCommand::Effect;
    switch (command.effect) {
        case Effect::nothing:
            if (byte(at_) == '*') ++at_;
            is_tight_ = true;
            return;
        case Effect::dropped:
            if (byte(at_) == '*') ++at_;
            bracket_argument();
            argument();
            return;
        case Effect::words: {
            const std::string words = plain_words(argument());
            if (words.size() == 1 && is_command_letter(words[0]) && words != "a") {  // \textbf{r}
                add(Kind::letter, begin).letter = {.base = words,
                                                   .accent = command.name == "textbf" ? "mathbf" : ""};
            } else if (!words.empty()) {
                add(Kind::text, begin, words);
            }
            return;
        }
        case Effect::upright:
            return upright(begin);
        case Effect::delimiter:
            return delimiter(command.name, begin);
        case Effect::definition:
            at_ = begin;
            if (take_in_macro(text_, at_, context_)) return;
            at_ = begin + 1 + command.name.size();
            [[fallthrough]];
        case Effect::refused:
            add(Kind::refused, begin, text_.substr(begin, at_ - begin));
            return;
        case Effect::token:
            break;
    }
    const std::string_view text = command.text;
    if (command.kind == Kind::letter) {
        add(Kind::letter, begin).letter.base = text;
    } else if (text == "qty" && !is_siunitx()) {
        is_tight_ = true;  // brackets of the package physics
    } else if (text == "SI" || text == "qty" || text == "num" || text == "unit") {
        quantity(begin, text);
    } else if (text == "textcolor" || text == "colorbox" || text == "mathcolor" || text == "cancelto" ||
               text == "underset" || text == "overset" || text == "stackrel") {
        const std::string over(argument());  // what is coloured, or stands over a sign, comes after it
        (void)over;
        is_tight_ = true;
    } else if (text == "boxed" || text == "mathop" || text == "mathrel" || text == "mathbin" ||
               text == "mathord") {
        is_tight_ = true;
    } else if (command.kind == Kind::relation || command.kind == Kind::arrow) {
        if (command.name.starts_with('x')) bracket_argument(), argument();  // \xrightarrow{…}
        add(command.kind, begin, text);
    } else {
        WrittenToken& token = add(command.kind, begin, text);
        if (command.kind == Kind::primes) token.dots = 1;
        if (command.kind == Kind::command)
            one_digit_ = text == "frac" || text == "binom" ? 2 : text == "sqrt" || text == "dot" ? 1 : 0;
    }
}

/// \mathrm{…}: a word is one letter, a function, a differential or a unit; anything else is a group.
void WrittenLexer::upright(std::size_t begin) {
    if (byte(at_) == '*') ++at_;
    const std::size_t before = at_;
    skip_space();
    if (byte(at_) == '{' && end_of_group(text_.substr(0, at_ + longest_upright), at_) == std::string_view::npos) {
        at_ = before;
        return;
    }
    const std::string_view inside = without_outer_blanks(argument());
    const std::string name = [&] {
        std::string plain;
        for (std::size_t k = 0; k < inside.size(); ++k)
            if (!(inside[k] == '\\' && k + 1 < inside.size() && inside[k + 1] == '_')) plain += inside[k];
        return plain;
    }();
    if (const std::string_view function = function_named(name); !function.empty()) {
        add(Kind::function, begin, function);
    } else if (name.size() == 2 && name[0] == 'd' &&
               std::string_view("tTxyzqrsuvVWELmAMSHQU").find(name[1]) != std::string_view::npos) {
        WrittenToken& d = add(Kind::letter, begin);
        d.letter.base = "d";
        d.upright = true;
        add(Kind::letter, begin).letter.base = name.substr(1);
    } else if (is_word_of_letters(name)) {
        WrittenToken& token = add(Kind::letter, begin);
        token.letter = name.size() > 1 ? letter_of_word(name).first : Letter{.base = name};
        token.text = name;
        token.upright = true;
    } else if (inside.find('\\') == std::string_view::npos || !plain_unit(inside).empty()) {
        const std::string unit =
            inside.find('\\') == std::string_view::npos ? std::string(inside) : plain_unit(inside);
        if (inside.find('\\') != std::string_view::npos && inside.find("\\,") == std::string_view::npos &&
            inside.find("\\cdot") == std::string_view::npos && inside.find("\\ ") == std::string_view::npos) {
            at_ = before;  // a style over mathematics
            return;
        }
        WrittenToken& token = add(Kind::text, begin, unit);
        token.upright = true;
    } else {
        at_ = before;
    }
}

/// Whether \qty has two groups: that of siunitx, not that of physics.
bool WrittenLexer::is_siunitx() const {
    std::size_t k = at_;
    while (k < text_.size() && (text_[k] == ' ' || text_[k] == '*')) ++k;
    if (byte(k) == '[') {
        k = text_.find(']', k);
        if (k == std::string_view::npos) return false;
        ++k;
    }
    if (byte(k) != '{') return false;
    const std::size_t end = end_of_group(text_.substr(0, k + 60), k);
    return end != std::string_view::npos && byte(end) == '{';
}

/// \SI{9.81}{\metre\per\second\squared}, \num{2.5}
void WrittenLexer::quantity(std::size_t begin, std::string_view name) {
    bracket_argument();
    if (name != "unit") {
        std::string number(argument());
        std::erase(number, ',');
        if (const std::size_t e = number.find_first_of("eE"); e != std::string::npos && name == "num")
            number = "{" + number.substr(0, e) + "\\cdot10^{" + number.substr(e + 1) + "}}";
        replace(number, begin);
    }
    if (name == "num") return;
    const std::string unit = plain_unit(argument());
    if (!unit.empty()) add(Kind::text, begin, unit).upright = true;
}

/// Environments that only set lines under each other are dropped: their rows are rows of the display.
void WrittenLexer::environment(bool begins, std::size_t begin) {
    std::string name(argument().substr(0, 60));
    const bool is_starred = name.ends_with('*');
    if (is_starred) name.pop_back();
    static constexpr std::string_view lines[] = {"aligned",  "split",  "gathered",    "alignedat",    "align",
                                                 "equation", "gather", "multline",    "eqnarray",     "alignat",
                                                 "flalign",  "math",   "displaymath", "subequations", "dgroup",
                                                 "dmath",    "empheq", "multlined"};
    if (begins && (name.starts_with("align") || name == "gathered" || name == "split")) bracket_argument();
    if (begins && (name == "alignedat" || name == "alignat" || name == "empheq")) argument();
    if (std::find(std::begin(lines), std::end(lines), name) != std::end(lines)) {
        if (name == "subequations" || name == "equation") return;
        add(Kind::row, begin, begins ? "begin" : "end");
        return;
    }
    add(begins ? Kind::begin_environment : Kind::end_environment, begin, name);
    if (begins && (name == "array" || name == "tabular")) {
        bracket_argument();
        argument();
    }
}

void WrittenLexer::expand(const WrittenMacro& macro, std::string_view name, std::size_t begin) {
    if (expansion_ >= most_macros_within) {
        add(Kind::refused, begin, text_.substr(begin, at_ - begin));
        return;
    }
    std::vector<std::string> arguments;
    for (int k = 0; k < macro.arguments; ++k) arguments.emplace_back(argument());
    std::string text;
    for (std::size_t k = 0; k < macro.body.size(); ++k) {
        const char c = macro.body[k];
        const bool is_argument =
            c == '#' && k + 1 < macro.body.size() && macro.body[k + 1] >= '1' && macro.body[k + 1] <= '9';
        if (is_argument) {
            const auto which = static_cast<std::size_t>(macro.body[++k] - '1');
            if (which < arguments.size()) text += arguments[which];
        } else {
            text += c;
        }
        if (context_.expanded + text.size() > most_macro_bytes)
            throw BeyondLimit{place(begin), say("the macros of the derivation become more than {} bytes; "
                                                "\\{} is one of them",
                                                most_macro_bytes, name)};
    }
    context_.expanded += text.size();
    ++expansion_;
    replace(text, begin);
    --expansion_;
}

bool take_in_macro(std::string_view text, std::size_t& at, TokenContext& context) {
    std::size_t k = at + 1;
    while (k < text.size() && is_command_letter(text[k])) ++k;
    const bool is_operator = text.substr(at + 1, k - at - 1) == "DeclareMathOperator";
    const auto skip = [&] {
        while (k < text.size() && (text[k] == ' ' || text[k] == '*' || text[k] == '\n')) ++k;
    };
    skip();
    const bool has_braces = k < text.size() && text[k] == '{';
    if (has_braces) ++k;
    skip();
    if (k >= text.size() || text[k] != '\\') return false;
    const std::size_t begin = ++k;
    while (k < text.size() && is_command_letter(text[k])) ++k;
    const std::string name(text.substr(begin, k - begin));
    skip();
    if (name.empty() || (has_braces && (k >= text.size() || text[k++] != '}'))) return false;
    skip();
    WrittenMacro macro;
    if (k + 2 < text.size() && text[k] == '[' && text[k + 2] == ']') {
        if (text[k + 1] < '0' || text[k + 1] > '9') return false;
        macro.arguments = text[k + 1] - '0';
        k += 3;
    }
    skip();
    if (k >= text.size() || text[k] != '{') return false;  // [default] as well
    const std::size_t end = end_of_group(text, k);
    if (end == std::string_view::npos || end - k > 1000 || context.macros.size() >= 1000) return false;
    macro.body = std::string(text.substr(k + 1, end - k - 2));
    if (is_operator) macro.body = "\\operatorname{" + macro.body + "}";
    if (const WrittenCommand* const known = command_named(name);
        known != nullptr && known->effect == WrittenCommand::Effect::refused)
        return false;
    context.macros[name] = std::move(macro);
    at = end;
    return true;
}

std::vector<WrittenToken> tokens_of(std::string_view text, std::size_t offset, WrittenNotation notation,
                                    TokenContext& context) {
    std::vector<WrittenToken> list;
    WrittenLexer(text, offset, notation, context, list).run();
    return list;
}

}  // namespace alembert
