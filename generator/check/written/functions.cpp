// SPDX-License-Identifier: GPL-2.0-or-later
// Functions, roots, sums, and the calls of programs of computer algebra.

#include <algorithm>

#include "base/language/say.hpp"
#include "check/written/windows.hpp"

namespace alembert {

namespace {

/// Numbers and letters that count or turn and are no angle themselves: \sin 2\theta, \cos n\theta, \sin\omega t.
bool stands_before_angle(const Math& math) {
    using Kind = Math::Kind;
    if (math.kind == Kind::number) return true;
    if (math.kind == Kind::quotient)
        return math.args[0]->kind == Kind::number && math.args[1]->kind == Kind::number;
    if (math.kind != Kind::letter || math.dots > 0) return false;
    static constexpr std::string_view names[] = {"omega", "Omega", "nu", "n", "k", "pi"};
    return std::find(std::begin(names), std::end(names), math.letter.base) != std::end(names);
}

std::string inverse_of(const std::string& name) {
    return name == "sin" || name == "cos" || name == "tan" ? "a" + name : "";
}

}  // namespace

/// \sin^2\theta, \cos(…), \ln|x|
MathPtr MathParser::function() {
    const std::size_t begin = at_++;
    std::string name = tokens_[begin].text;
    if (name == "sqrt") return at_ = begin, root();
    MathPtr power;
    if (is(Kind::index)) fail(at_, say("a function with an index was found; expected its argument"));
    if (is(Kind::power)) {
        ++at_;
        power = exponent();
        const bool is_inverse =
            power->kind == Math::Kind::negate && power->args[0]->text == "1" && !inverse_of(name).empty();
        if (is_inverse) {
            name = inverse_of(name);
            power = nullptr;
        }
    }
    std::vector<MathPtr> arguments;
    const bool has_group = is(Kind::begin_group) && kind(at_ + 1) == Kind::open &&
                           partner_[at_ + 1] != no_partner && partner_[at_ + 1] + 1 == partner_[at_];
    if (is(Kind::open) || has_group) {
        const std::size_t open = at_ + (has_group ? 1 : 0), close = closing(open);
        if (close == open + 1) unexpected(say("the argument of {}", name));
        arguments = listed(open + 1, close);
        at_ = close + (has_group ? 2 : 1);
        if (arguments.size() > (name == "atan2" || name == "atan" ? 2U : 1U))
            fail(open, say("{} has {} arguments here; expected one", name, arguments.size()));
        if (name == "atan" && arguments.size() == 2) name = "atan2";
    } else {
        arguments = {bare_argument()};
    }
    MathPtr result = node({.kind = Math::Kind::call, .text = name, .args = std::move(arguments)}, begin);
    if (power) result = node({.kind = Math::Kind::power, .args = {result, power}}, begin);
    return result;
}

MathPtr MathParser::bare_argument() {
    const bool was_bare = is_bare_;
    is_bare_ = true;
    const std::size_t begin = at_;
    bool is_negative = false;
    if (is(Kind::minus)) is_negative = true, ++at_;
    if (at_ >= end_ || !begins_factor()) unexpected(say("the argument of a function"));
    std::vector<MathPtr> factors{factor(false)};
    while (at_ < end_) {
        const bool is_letter = is(Kind::letter) && now().dots == 0;
        const bool is_accented =
            is(Kind::command) && now().text != "dot" && now().text != "ddot" && begins_factor();
        const bool is_time_after = is_letter && now().letter == Letter{.base = "t"} &&
                                   factors.back()->kind == Math::Kind::letter && factors.back()->dots == 0;
        const bool goes_on = stands_before_angle(*factors.back()) &&
                             (is_letter || is_accented ||
                              (is(Kind::open) && factors.back()->kind != Math::Kind::letter && now().text == "("));
        if (!goes_on && !is_time_after) break;
        factors.push_back(factor(false));
        if (is_time_after) break;
    }
    is_bare_ = was_bare;
    MathPtr result = product(std::move(factors), {});
    if (is_negative) result = node({.kind = Math::Kind::negate, .args = {result}}, begin);
    return result;
}

MathPtr MathParser::command() {
    const std::string& name = tokens_[at_].text;
    static constexpr std::string_view accents[] = {"dot",    "ddot",     "dddot",   "ddddot",   "vec",
                                                   "hat",    "bar",      "tilde",   "mathbf",   "mathcal",
                                                   "mathbb", "mathfrak", "mathscr", "underline"};
    if (name == "frac") return fraction();
    if (name == "sqrt") return root();
    if (std::find(std::begin(accents), std::end(accents), name) != std::end(accents)) return accented();
    if (name == "underbrace" || name == "overbrace") return labelled_brace();
    if (name == "sum" || name == "int" || name == "prod" || name == "oint" || name == "iint")
        return big_operator();
    if (name == "abs" || name == "norm") return absolute_command();
    if (name == "dv" || name == "pdv" || name == "dd") return derivative_command();
    static constexpr std::string_view calls[] = {"diff",      "Diff",     "Rational", "Pow",
                                                 "Subscript", "simplify", "expand"};
    if (std::find(std::begin(calls), std::end(calls), name) != std::end(calls)) return algebra_call();
    unexpected(say("a term"));
}

/// \sqrt[3]{x}, √x, sqrt(x)
MathPtr MathParser::root() {
    const std::size_t begin = at_++;
    MathPtr degree;
    const bool is_latex = tokens_[begin].kind == Kind::command;
    if (is_latex && is(Kind::open) && now().text == "[") {
        const std::size_t close = closing(at_);
        degree = within(at_ + 1, close);
        at_ = close + 1;
    }
    if (at_ >= end_) unexpected(say("what stands under the root"));
    MathPtr inside;
    if (is(Kind::begin_group)) {
        inside = exponent();
    } else if (is(Kind::open)) {
        inside = bracket();
    } else if (is(Kind::letter)) {
        inside = primary();
    } else {
        inside = exponent();
    }
    if (!degree || degree->text == "2")
        return node({.kind = Math::Kind::call, .text = "sqrt", .args = {inside}}, begin);
    const MathPtr one = node({.kind = Math::Kind::number, .text = "1"}, begin);
    const MathPtr exponent = node({.kind = Math::Kind::quotient, .args = {one, degree}}, begin);
    return node({.kind = Math::Kind::power, .args = {inside, exponent}}, begin);
}

/// \abs{x}, \norm{v}
MathPtr MathParser::absolute_command() {
    const std::size_t begin = at_++;
    if (at_ >= end_) unexpected(say("the argument of {}", tokens_[begin].text));
    MathPtr inside = is(Kind::open) ? bracket() : exponent();
    return node({.kind = Math::Kind::call, .text = "abs", .args = {inside}}, begin);
}

/// \underbrace{x}_{words}: the words are no part of it.
MathPtr MathParser::labelled_brace() {
    const std::size_t begin = at_++;
    if (!is(Kind::begin_group)) unexpected(say("what stands over the brace"));
    const std::size_t close = closing(at_);
    MathPtr inside = within(at_ + 1, close);
    at_ = close + 1;
    while (is(Kind::index) || is(Kind::power)) {
        ++at_;
        const Range range = script_range();
        at_ = range.begin == at_ ? range.end : range.end + 1;
    }
    (void)begin;
    return inside;
}

/// \sum_{i=1}^{n} …, \int: with the limits as text.
MathPtr MathParser::big_operator() {
    const std::size_t begin = at_++;
    const std::string name = tokens_[begin].text;
    Letter limits;
    while (is(Kind::index) || is(Kind::power)) {
        const bool is_below = is(Kind::index);
        ++at_;
        const Range range = script_range();
        (is_below ? limits.index : limits.raised) = flat_text(range.begin, range.end);
        at_ = range.begin == at_ ? range.end : range.end + 1;
    }
    if (at_ >= end_ || !begins_factor()) unexpected(say("what is summed"));
    MathPtr body = term();
    return node({.kind = Math::Kind::call,
                 .text = name == "sum"    ? "sum"
                         : name == "prod" ? "prod"
                                          : "integral",
                 .letter = limits,
                 .args = {body}},
                begin);
}

/// \dv{x}{t}, \pdv{L}{q}, \dd{x} of LaTeX's package physics
MathPtr MathParser::derivative_command() {
    const std::size_t begin = at_++;
    const std::string name = tokens_[begin].text;
    int order = 1;
    if (is(Kind::open) && now().text == "[") {
        const std::size_t close = closing(at_);
        if (close == at_ + 2 && kind(at_ + 1) == Kind::number && token(at_ + 1).text.size() == 1)
            order = token(at_ + 1).text[0] - '0';
        at_ = close + 1;
    }
    std::vector<MathPtr> parts;
    while (is(Kind::begin_group) && parts.size() < (name == "dd" ? 1U : 3U)) {
        const std::size_t close = closing(at_);
        if (close > at_ + 1) parts.push_back(within(at_ + 1, close));
        at_ = close + 1;
    }
    if (parts.empty() && name == "dd" && is(Kind::letter)) parts.push_back(primary());
    if (parts.empty()) unexpected(say("the arguments of the command {}", "\\" + name));
    if (name == "dd") return node({.kind = Math::Kind::variation, .text = "d", .args = {parts[0]}}, begin);
    if (parts.size() == 1) parts.insert(parts.begin(), operand_of_derivative(begin));
    std::vector<MathPtr> variables(parts.begin() + 1, parts.end());
    if (variables.size() == 1) variables.assign(static_cast<std::size_t>(order), variables[0]);
    if (name == "dv" && is_time(*variables[0])) return rate(parts[0], order, begin);
    return partial(parts[0], std::move(variables), name == "dv" ? "d" : "", begin);
}

/// Derivative(theta(t), (t, 2)), diff(x, t, t), D[L, th'[t]], Rational(1, 2)
MathPtr MathParser::algebra_call() {
    const std::size_t begin = at_++;
    const std::string name = tokens_[begin].text;
    if (!is(Kind::open)) unexpected(say("the arguments of {}", name));
    const std::size_t close = closing(at_);
    const std::vector<Range> ranges = argument_ranges(at_ + 1, close);
    at_ = close + 1;
    if (name == "diff" || name == "Diff") return algebra_derivative(ranges, begin);
    const std::size_t count = name == "simplify" || name == "expand" ? 1 : 2;
    if (ranges.size() != count)
        fail(begin, say("{} has {} arguments here; expected {}", name, ranges.size(), count));
    MathPtr first = within(ranges[0].begin, ranges[0].end);
    if (count == 1) return first;
    MathPtr second = within(ranges[1].begin, ranges[1].end);
    if (name == "Subscript") {
        if (first->kind != Math::Kind::letter) fail(begin, say("{} has an index and is no letter", name));
        Letter letter = first->letter;
        letter.index = flat_text(ranges[1].begin, ranges[1].end);
        return this->letter(letter, first->dots, begin);
    }
    return node({.kind = name == "Pow" ? Math::Kind::power : Math::Kind::quotient, .args = {first, second}},
                begin);
}

MathPtr MathParser::algebra_derivative(const std::vector<Range>& arguments, std::size_t begin) {
    if (arguments.size() < 2)
        fail(begin, say("a derivative with one argument was found; expected what it is taken with respect to"));
    const MathPtr of = within(arguments[0].begin, arguments[0].end);
    std::vector<MathPtr> variables;
    const auto repeat = [&](std::size_t i) {
        if (kind(i) != Kind::number || token(i).text.size() != 1 || variables.empty())
            fail(i, say("{} was found; expected the order of the derivative", described(token(i))));
        for (int more = token(i).text[0] - '1'; more > 0; --more) variables.push_back(variables.back());
    };
    for (std::size_t k = 1; k < arguments.size(); ++k) {
        Range range = arguments[k];
        if (range.end == range.begin + 1 && kind(range.begin) == Kind::number) {  // diff(x, t, 2)
            repeat(range.begin);
            continue;
        }
        std::size_t order = no_partner;
        if (kind(range.begin) == Kind::open && partner_[range.begin] + 1 == range.end) {  // (t, 2), {t, 2}
            const std::vector<Range> inside = argument_ranges(range.begin + 1, range.end - 1);
            if (inside.size() == 2) {
                range = inside[0];
                order = inside[1].begin;
            }
        } else if (range.end == range.begin + 3 && kind(range.begin + 1) == Kind::stray &&
                   token(range.begin + 1).text == "$") {  // t$2
            order = range.begin + 2;
            range.end = range.begin + 1;
        }
        variables.push_back(within(range.begin, range.end));
        if (order != no_partner) repeat(order);
    }
    const bool is_rate =
        std::all_of(variables.begin(), variables.end(), [](const MathPtr& one) { return is_time(*one); });
    if (is_rate) return rate(of, static_cast<int>(variables.size()), begin);
    return partial(of, std::move(variables), "", begin);
}

}  // namespace alembert
