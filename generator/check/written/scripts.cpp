// SPDX-License-Identifier: GPL-2.0-or-later
// Letters with what stands below, above and over them.

#include <algorithm>

#include "base/language/say.hpp"
#include "check/written/commands.hpp"
#include "check/written/windows.hpp"

namespace alembert {

namespace {

int dots_of_accent(std::string_view name) {
    return name == "dot" ? 1 : name == "ddot" ? 2 : name == "dddot" ? 3 : name == "ddddot" ? 4 : 0;
}

bool is_capital(const WrittenToken& token) {
    return token.kind == WrittenToken::Kind::letter && token.letter.base.size() == 1 &&
           token.letter.base[0] >= 'A' && token.letter.base[0] <= 'Z' && token.dots == 0;
}

}  // namespace

bool is_time(const Math& math) {
    return math.kind == Math::Kind::letter && math.letter == Letter{.base = "t"} && math.dots == 0;
}

/// What _ or ^ has as its argument: the inside of a group, or one token. The reader stays before it.
MathParser::Range MathParser::script_range() {
    if (at_ >= end_) unexpected(say("an index or an exponent"));
    if (is(Kind::begin_group)) return {at_ + 1, closing(at_)};
    return {at_, at_ + 1};
}

MathPtr MathParser::exponent() {
    const std::size_t begin = at_;
    if (is(Kind::begin_group)) {
        const std::size_t end = closing(at_);
        MathPtr inside = within(at_ + 1, end);
        at_ = end + 1;
        return inside;
    }
    if (is(Kind::minus) || is(Kind::plus)) return factor(true);
    if (is(Kind::number)) {
        ++at_;
        return node({.kind = Math::Kind::number, .text = tokens_[begin].text}, begin);
    }
    if (is(Kind::letter)) {
        ++at_;
        const WrittenToken& what = tokens_[begin];
        return node({.kind = Math::Kind::letter, .letter = what.letter, .dots = what.dots}, begin);
    }
    return primary();
}

/// Text of an index: "1,2", "theta_1".
std::string MathParser::flat_text(std::size_t begin, std::size_t end) {
    std::string text, after;
    for (std::size_t i = begin; i < end; ++i) {
        const WrittenToken& what = token(i);
        switch (what.kind) {
            case Kind::number:
            case Kind::text:
            case Kind::function:
                text += what.text;
                break;
            case Kind::letter: {
                static constexpr std::string_view dotted[] = {"", "_dot", "_ddot", "_dddot", "_ddddot"};
                if (!text.empty() && what.letter.base.size() > 1 && text.back() != ',' && text.back() != '_')
                    text += ' ';
                if (what.upright && !what.text.empty()) {
                    text += what.text;
                    break;
                }
                text += what.letter.base + after + std::string(dotted[std::min(what.dots, 4)]);
                if (!what.letter.index.empty()) text += "_" + what.letter.index;
                after.clear();
                break;
            }
            case Kind::comma:
                text += ',';
                break;
            case Kind::index:
                text += '_';
                break;
            case Kind::plus:
                text += '+';
                break;
            case Kind::minus:
                text += '-';
                break;
            case Kind::times:
                text += '*';
                break;
            case Kind::divide:
                text += '/';
                break;
            case Kind::relation:
                text += '=';
                break;
            case Kind::primes:
                text += std::string(static_cast<std::size_t>(what.dots), '\'');
                break;
            case Kind::open:
            case Kind::close:
                text += what.kind == Kind::open ? '(' : ')';
                break;
            case Kind::begin_group:
            case Kind::end_group:
            case Kind::power:
            case Kind::space:
            case Kind::bar:
                break;
            case Kind::command:
                if (const int dots = dots_of_accent(what.text); dots > 0)
                    after = std::string("_") + std::string(static_cast<std::size_t>(dots - 1), 'd') + "dot";
                else if (what.text == "max" || what.text == "min")
                    text += what.text;
                else if (what.text != "vec" && what.text != "mathbf" && what.text != "hat" && what.text != "bar" &&
                         what.text != "tilde" && what.text != "mathcal")
                    fail(i, say("{} was found in an index; expected letters, numbers or words", described(what)));
                break;
            default:
                fail(i, say("{} was found in an index; expected letters, numbers or words", described(what)));
        }
    }
    return text;
}

void MathParser::add_index(Letter& letter, int& dots) {
    ++at_;
    const Range range = script_range();
    std::size_t end = range.end;
    if (is(Kind::command)) {  // F_\mathbf{x}
        end = end_of_letter(at_);
        if (end == no_partner) unexpected(say("an index"));
    } else if (range.begin != at_) {
        ++end;
    }
    const std::string text = flat_text(range.begin, std::min(end, range.begin == at_ ? end : range.end));
    at_ = end;
    if (text.empty()) return;
    if (dots == 0 && (text == "dot" || text == "ddot")) {
        dots = text == "dot" ? 1 : 2;
        return;
    }
    letter.index += (letter.index.empty() ? "" : ",") + text;
}

/// What stands above a letter and is no power, as text.
std::optional<std::string> MathParser::raised_text(const Letter& letter, std::size_t begin, std::size_t end) {
    if (begin >= end) return std::string();
    const std::size_t count = end - begin;
    const WrittenToken& first = token(begin);
    const bool is_number = letter.base == "e" && letter.index.empty();
    if (first.kind == Kind::text) return flat_text(begin, end);
    if (count == 1 && first.kind == Kind::number && first.text == "0" && !is_number) return "0";  // y^0 at rest
    if (count == 1 && first.kind == Kind::times) return std::string("*");
    if (count == 1 && (first.kind == Kind::plus || first.kind == Kind::minus))
        return std::string(first.kind == Kind::plus ? "+" : "-");
    if (count == 1 && first.kind == Kind::letter &&
        (first.letter.base == "top" || first.letter.base == "dagger" || first.letter.base == "ddagger" ||
         first.letter.base == "bot"))
        return first.letter.base == "top" ? "T" : first.letter.base;
    if (is_number) return {};
    bool are_marks = true;  // ^{*\top}
    for (std::size_t i = begin; i < end; ++i)
        are_marks &= token(i).kind == Kind::times ||
                     (token(i).kind == Kind::letter && token(i).letter.base == "top") ||
                     (token(i).kind == Kind::letter && token(i).letter.base == "T");
    if (are_marks) {
        std::string marks;
        for (std::size_t i = begin; i < end; ++i) marks += token(i).kind == Kind::times ? "*" : "T";
        return marks;
    }
    if (first.kind == Kind::open && count == 3 && token(end - 1).kind == Kind::close &&
        (token(begin + 1).kind == Kind::number || token(begin + 1).kind == Kind::letter))
        return flat_text(begin, end);
    if (count == 1 && first.kind == Kind::letter && (first.upright || first.letter.base.size() > 1) &&
        !first.letter.base.empty() && command_named(first.letter.base) == nullptr)
        return flat_text(begin, end);
    for (std::size_t i = begin; i < end; ++i)
        if (!is_capital(token(i)) && token(i).kind != Kind::divide && token(i).kind != Kind::comma) return {};
    return flat_text(begin, end);
}

/// Reads ^ if what follows it is no power.
bool MathParser::add_raised(Letter& letter, int& dots) {
    const std::size_t sign = at_++;
    const Range range = script_range();
    const std::size_t after = range.begin == at_ ? range.end : range.end + 1;
    bool are_primes = range.begin < range.end;
    int primes = 0;
    for (std::size_t i = range.begin; i < range.end; ++i) {
        are_primes &= token(i).kind == Kind::primes;
        primes += token(i).dots;
    }
    if (are_primes) {
        dots += primes;
        at_ = after;
        return true;
    }
    const std::optional<std::string> text = raised_text(letter, range.begin, range.end);
    if (!text) {
        at_ = sign;
        return false;
    }
    letter.raised += (letter.raised.empty() || text->empty() ? "" : ",") + *text;
    at_ = after;
    return true;
}

/// Whether what is in parentheses after a letter may be its arguments. In the argument of a function without
/// parentheses only (t) is: \cos\theta(x + y) is a product.
bool MathParser::has_arguments(const Letter&) const {
    std::size_t open = at_;
    if (is(Kind::begin_group) && kind(at_ + 1) == Kind::open && partner_[at_] != no_partner &&
        partner_[at_ + 1] + 1 == partner_[at_])
        ++open;  // \theta{\left(t\right)}
    if (kind(open) != Kind::open || partner_[open] == no_partner || partner_[open] >= end_) return false;
    const std::string& sign = tokens_[open].text;
    const bool is_value =
        sign == "[" && partner_[open] == open + 2 &&  // x_1[0], x[t]
        (kind(open + 1) == Kind::number || (kind(open + 1) == Kind::letter && token(open + 1).letter.base == "t"));
    if (sign != "(" && !is_value && !(sign == "[" && tokens_[open].upright)) return false;  // th'[t]
    if (partner_[open] == open + 1) return false;
    if (!is_bare_) return true;
    return partner_[open] == open + 2 && kind(open + 1) == Kind::letter && token(open + 1).letter.base == "t";
}

/// A letter that has been read, and what follows it: index, what is raised, primes, arguments, power.
MathPtr MathParser::letter(Letter letter, int dots, std::size_t begin) {
    while (at_ < end_) {
        if (is(Kind::index)) {
            add_index(letter, dots);
        } else if (is(Kind::primes)) {
            dots += tokens_[at_++].dots;
        } else if (is(Kind::power)) {
            if (!add_raised(letter, dots)) break;
        } else if (is(Kind::times) && (kind(at_ + 1) == Kind::index || kind(at_ + 1) == Kind::end) &&
                   now().text.empty()) {
            ++at_;  // F*_v
            letter.raised += "*";
        } else {
            break;
        }
    }
    MathPtr power;
    if (is(Kind::power)) {
        ++at_;
        power = exponent();
        while (is(Kind::index)) add_index(letter, dots);  // x^2_1
    }
    MathPtr result = node({.kind = Math::Kind::letter, .letter = letter, .dots = dots}, begin);
    if (!power && has_arguments(letter)) {
        const bool is_group = is(Kind::begin_group);
        const std::size_t open = at_ + (is_group ? 1 : 0), close = partner_[open];
        std::vector<MathPtr> arguments = listed(open + 1, close);
        at_ = close + (is_group ? 2 : 1);
        if (letter.base == "D" && dots == 0 && letter.index.empty() && arguments.size() == 1 && is(Kind::open) &&
            partner_[at_] == at_ + 2 && arguments[0]->kind == Math::Kind::letter) {  // D(theta)(t) of Maple
            at_ += 3;
            return rate(arguments[0], 1, begin);
        }
        if (dots > 0 && arguments.size() == 1 && is_time(*arguments[0]))
            result = node({.kind = Math::Kind::letter, .letter = letter, .dots = dots}, begin);
        else
            result =
                node({.kind = Math::Kind::applied, .letter = letter, .dots = dots, .args = std::move(arguments)},
                     begin);
    }
    if (power) result = node({.kind = Math::Kind::power, .args = {result, power}}, begin);
    return result;
}

/// \dot{…}, \vec{…}
MathPtr MathParser::accented() {
    const std::size_t begin = at_++;
    const std::string name = tokens_[begin].text;
    const int more = dots_of_accent(name);
    if (at_ >= end_) unexpected(say("a letter under the accent {}", "\\" + name));
    MathPtr inside;
    if (is(Kind::begin_group)) {
        const std::size_t end = closing(at_);
        inside = within(at_ + 1, end);
        at_ = end + 1;
    } else if (is(Kind::letter)) {
        const WrittenToken& what = tokens_[at_++];
        inside = node({.kind = Math::Kind::letter, .letter = what.letter, .dots = what.dots}, at_ - 1);
    } else {
        inside = primary();
    }
    if (inside->kind == Math::Kind::letter || (inside->kind == Math::Kind::applied && more > 0)) {
        Letter base = inside->letter;
        if (more == 0 && !(name == "mathbf" && !base.accent.empty())) {
            base.accent = base.accent.empty() || base.accent == "mathbf" ? name : name + " " + base.accent;
            if (name == "mathbb" || name == "mathfrak" || name == "underline") base.accent = name;
        }
        if (inside->kind == Math::Kind::applied)
            return node({.kind = Math::Kind::letter, .letter = base, .dots = inside->dots + more}, begin);
        return letter(base, inside->dots + more, begin);
    }
    if (more > 0) return rate(inside, more, begin);
    if (inside->kind == Math::Kind::product) {  // \vec{AB}
        Letter joined{.accent = name};
        for (const MathPtr& one : inside->args) {
            if (one->kind != Math::Kind::letter || one->dots > 0 || !one->letter.index.empty())
                fail(begin, say("{} stands over more than a letter; expected one letter under it", "\\" + name));
            joined.base += one->letter.base;
        }
        return letter(joined, 0, begin);
    }
    if (name == "mathbf" || name == "underline") return inside;
    if (name == "bar" && inside->kind == Math::Kind::number) return inside;
    fail(begin, say("{} stands over more than a letter; expected one letter under it", "\\" + name));
}

/// theta.diff(t) of SymPy
MathPtr MathParser::method(std::size_t begin) {
    const std::size_t open = ++at_;
    const std::size_t close = closing(open);
    std::vector<Range> arguments{{begin, open - 1}};
    for (const Range& range : argument_ranges(open + 1, close)) arguments.push_back(range);
    at_ = close + 1;
    return algebra_derivative(arguments, begin);
}

}  // namespace alembert
