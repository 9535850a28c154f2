// SPDX-License-Identifier: GPL-2.0-or-later
// Sums, products, powers: the precedences.

#include "check/written/parser.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "base/language/say.hpp"
#include "check/written/windows.hpp"
#include "scene/text.hpp"

namespace alembert {

std::string described(const WrittenToken& token) {
    using Kind = WrittenToken::Kind;
    switch (token.kind) {
        case Kind::number:
            return say("the number {}", escaped(token.text, 20));
        case Kind::letter:
            return say("the letter {}", in_quotes(token.letter.base));
        case Kind::function:
            return say("the function {}", token.text);
        case Kind::text:
            return say("the words {}", in_quotes(token.text));
        case Kind::end:
            return say("the end of the formula");
        case Kind::relation:
        case Kind::arrow:
            return say("a sign such as =");
        case Kind::plus:
            return say("the sign {}", "+");
        case Kind::minus:
            return say("the sign {}", "-");
        case Kind::times:
            return say("a sign of multiplication");
        case Kind::divide:
            return say("the sign {}", "/");
        case Kind::power:
            return say("the sign {}", "^");
        case Kind::index:
            return say("the sign {}", "_");
        case Kind::primes:
            return say("a prime");
        case Kind::comma:
            return say("a comma");
        case Kind::semicolon:
            return say("a semicolon");
        case Kind::period:
            return say("a full stop");
        case Kind::dots:
            return say("an ellipsis");
        case Kind::open:
        case Kind::begin_group:
        case Kind::no_open:
            return say("an opening bracket");
        case Kind::close:
        case Kind::end_group:
        case Kind::no_close:
            return say("a closing bracket");
        case Kind::bar:
            return say("a vertical bar");
        case Kind::command:
            return say("the command {}", in_quotes("\\" + token.text));
        case Kind::ampersand:
        case Kind::row:
            return say("the end of a cell");
        default:
            return in_quotes(token.text);
    }
}

MathParser::MathParser(const std::vector<WrittenToken>& tokens, const std::vector<std::size_t>& partner,
                       bool has_differentials)
    : tokens_(tokens), partner_(partner), has_differentials_(has_differentials) {
    for (std::size_t i = 0; i + 1 < tokens.size(); ++i)
        has_variations_ |= tokens[i].kind == Kind::letter && tokens[i].letter.base == "delta" &&
                           tokens[i + 1].kind == Kind::letter && tokens[i + 1].dots == 0;
}

MathPtr MathParser::read(std::size_t begin, std::size_t end) {
    at_ = begin;
    end_ = end;
    return within(begin, end);
}

const WrittenToken& MathParser::token(std::size_t i) const {
    static const WrittenToken nothing;
    return i < tokens_.size() ? tokens_[i] : nothing;
}

void MathParser::fail(std::size_t i, std::string message) const {
    const std::size_t k = std::min(i, tokens_.empty() ? 0 : tokens_.size() - 1);
    if (tokens_.empty()) throw NotUnderstood{0, 0, std::move(message)};
    const WrittenToken& where = tokens_[k];
    const bool is_past = i > k;
    throw NotUnderstood{where.offset + (is_past ? where.length : 0), is_past ? 0 : where.length,
                        std::move(message)};
}

void MathParser::unexpected(const std::string& expected) const {
    if (at_ < end_ && now().kind == Kind::stray) {
        if (now().text == "pm" || now().text == "mp")
            fail(at_, say("a sign with two meanings, ±, was found; expected one equation for each sign"));
        fail(at_, say("{} is not known in a formula; expected {}", in_quotes(now().text), expected));
    }
    if (at_ < end_ && now().kind == Kind::refused)
        fail(at_,
             say("{} is refused: nothing is executed, and no other file is read; expected formulas written out",
                 in_quotes(now().text)));
    fail(at_, say("{} was found; expected {}", at_ < end_ ? described(now()) : described({}), expected));
}

std::size_t MathParser::closing(std::size_t i) const {
    const std::size_t partner = partner_[i];
    if (partner == no_partner || partner >= end_)
        fail(i, say("a bracket is opened here and not closed; expected its other half"));
    return partner;
}

/// The tokens of a window as one expression; afterwards the reader stands where it stood.
MathPtr MathParser::within(std::size_t begin, std::size_t end) {
    const Window window(*this, begin, end);
    if (at_ == end_) unexpected(say("an expression"));
    MathPtr result = expression();
    if (at_ < end_) unexpected(say("a sign between two terms, or the end of the formula"));
    return result;
}

/// Trees are walked by recursion: chains such as a/b/c/… may not make them deeper than brackets can.
void MathParser::count_levels(Math& math) const {
    for (const MathPtr& one : math.args) math.levels = std::max(math.levels, one->levels + 1);
    if (math.levels > 3 * most_written_nesting)
        throw BeyondLimit{math.offset,
                          say("the formula is nested more than {} levels deep", most_written_nesting)};
}

MathPtr MathParser::node(Math math, std::size_t begin) const {
    const WrittenToken& first = token(begin);
    const WrittenToken& last = token(at_ > begin ? at_ - 1 : begin);
    math.offset = first.offset;
    math.length = std::max(last.offset + last.length, first.offset + first.length) - first.offset;
    count_levels(math);
    return std::make_shared<const Math>(std::move(math));
}

MathPtr MathParser::placed(Math math, const Math& first, const Math& last) const {
    math.offset = first.offset;
    math.length = std::max(last.offset + last.length, first.offset + first.length) - first.offset;
    count_levels(math);
    return std::make_shared<const Math>(std::move(math));
}

MathPtr MathParser::expression() {
    const Depth depth(*this);
    std::vector<MathPtr> terms;
    const std::size_t begin = at_;
    do {
        bool is_negative = false;
        const std::size_t sign = at_;
        while (is(Kind::plus) || is(Kind::minus)) is_negative ^= tokens_[at_++].kind == Kind::minus;
        MathPtr one = term();
        if (is_negative) one = node({.kind = Math::Kind::negate, .args = {one}}, sign);
        terms.push_back(std::move(one));
    } while (is(Kind::plus) || is(Kind::minus));
    if (terms.size() == 1) return terms[0];
    return node({.kind = Math::Kind::sum, .args = std::move(terms)}, begin);
}

MathPtr MathParser::product(std::vector<MathPtr> factors, std::string_view sign) const {
    if (factors.size() == 1) return factors[0];
    const MathPtr first = factors.front(), last = factors.back();
    return placed({.kind = Math::Kind::product, .text = std::string(sign), .args = std::move(factors)}, *first,
                  *last);
}

MathPtr MathParser::term() {
    std::vector<MathPtr> factors{factor(true)};
    std::string sign;  // of the product: cdot if it has one
    while (at_ < end_) {
        if (is(Kind::times)) {
            const std::string which = tokens_[at_++].text;
            MathPtr next = factor(true);
            if (which == "times") {
                const MathPtr before = product(std::move(factors), sign);
                factors = {product({before, next}, which)};
                sign.clear();
            } else {
                if (which == "cdot") sign = which;
                factors.push_back(std::move(next));
            }
        } else if (is(Kind::divide)) {
            ++at_;
            const MathPtr numerator = product(std::move(factors), sign);
            MathPtr below = divisor(numerator);
            factors = {placed({.kind = Math::Kind::quotient, .args = {numerator, below}}, *numerator, *below)};
            sign.clear();
        } else if (begins_factor()) {
            if (is(Kind::number) && kind(at_ - 1) == Kind::number)  // 2 3, x_10, \frac123
                fail(at_,
                     say("two numbers stand beside each other; expected a sign between them, or braces around an "
                         "index or exponent of several digits"));
            factors.push_back(factor(false));
        } else {
            break;
        }
    }
    return product(std::move(factors), sign);
}

/// What stands after /: one factor, or a number with the letters that are written together with it, 2m of p^2/2m.
MathPtr MathParser::divisor(const MathPtr& numerator) {
    const std::size_t begin = at_;
    std::vector<MathPtr> factors{factor(true)};
    const bool is_joined = factors[0]->kind == Math::Kind::number && numerator->kind != Math::Kind::number &&
                           kind(begin) == Kind::number && at_ == begin + 1;
    while (is_joined && is(Kind::letter) && now().tight && now().dots == 0) factors.push_back(factor(false));
    return product(std::move(factors), {});
}

bool MathParser::begins_factor() const {
    switch (kind(at_)) {
        case Kind::number:
        case Kind::letter:
        case Kind::function:
        case Kind::open:
        case Kind::begin_group:
        case Kind::partial:
        case Kind::begin_environment:
        case Kind::text:
        case Kind::no_open:
            return true;
        case Kind::command:
            return now().text != "over" && now().text != "atop" && now().text != ".diff";
        case Kind::bar:
            return bars_ == 0;
        default:
            return false;
    }
}

MathPtr MathParser::factor(bool may_be_negative) {
    const std::size_t begin = at_;
    bool is_negative = false;
    while (may_be_negative && (is(Kind::plus) || is(Kind::minus)))
        is_negative ^= tokens_[at_++].kind == Kind::minus;
    const std::size_t from = at_;
    MathPtr result = after_it(primary(), from);
    if (is_negative) result = node({.kind = Math::Kind::negate, .args = {result}}, begin);
    return result;
}

MathPtr MathParser::primary() {
    const Depth depth(*this);
    const std::size_t begin = at_;
    switch (kind(at_)) {
        case Kind::number:
            return number();
        case Kind::letter: {
            if (MathPtr found = slanted_derivative()) return found;
            if (MathPtr found = variation()) return found;
            ++at_;
            const WrittenToken& what = tokens_[begin];
            return letter(what.letter, what.dots, begin);
        }
        case Kind::partial:
            if (MathPtr found = slanted_derivative()) return found;
            return subscripted_partial();
        case Kind::function:
            return function();
        case Kind::command:
            return command();
        case Kind::open:
        case Kind::no_open:
            return bracket();
        case Kind::begin_group:
            return group();
        case Kind::bar:
            return absolute();
        case Kind::begin_environment:
            return environment();
        case Kind::text: {
            if (tokens_[at_].text.find(' ') != std::string::npos) unexpected(say("a term"));
            ++at_;
            return letter(letter_of_word(tokens_[begin].text).first, 0, begin);
        }
        default:
            unexpected(say("a term"));
    }
}

/// Powers and primes of what is no letter.
/// Whether (t) follows a rate.
bool MathParser::is_at_time(const Math& rate) const {
    const bool is_rate = rate.kind == Math::Kind::rate || (rate.kind == Math::Kind::letter && rate.dots > 0);
    return is_rate && kind(at_) == Kind::open && kind(at_ + 1) == Kind::letter &&
           token(at_ + 1).letter.base == "t" && token(at_ + 1).letter.index.empty() &&
           kind(at_ + 2) == Kind::close;
}

MathPtr MathParser::after_it(MathPtr result, std::size_t begin) {
    while (at_ < end_) {
        if (is(Kind::power)) {
            const Range range = (++at_, script_range());
            const bool is_transposed =
                range.end == range.begin + 1 && kind(range.begin) == Kind::letter &&
                (token(range.begin).letter.base == "T" || token(range.begin).letter.base == "top");
            if (is_transposed && (result->kind == Math::Kind::vector || result->kind == Math::Kind::matrix)) {
                at_ = std::max(range.end, at_);
                if (is(Kind::end_group)) ++at_;  // ^{T}
                if (result->kind == Math::Kind::matrix && result->args.size() == 1) result = result->args[0];
                continue;
            }
            MathPtr raised = exponent();
            result = node({.kind = Math::Kind::power, .args = {result, raised}}, begin);
        } else if (is(Kind::primes)) {
            const int dots = tokens_[at_++].dots;
            result = rate(result, dots, begin);
        } else if (is_at_time(*result)) {
            at_ += 3;  // dσ/dt (t)
        } else if (is_command(at_, ".diff")) {
            result = method(begin);
        } else if (is(Kind::index)) {
            unexpected(say("a letter before an index"));
        } else if (is(Kind::bar) && bars_ == 0 && kind(at_ + 1) == Kind::index) {
            fail(at_, say("a value at a place, |_…, was found; expected the value written out"));
        } else {
            break;
        }
    }
    return result;
}

MathPtr MathParser::number() {
    const std::size_t begin = at_++;
    MathPtr value = node({.kind = Math::Kind::number, .text = tokens_[begin].text}, begin);
    return quantity(value, begin);
}

/// |x|, of bars that look alike on both sides.
MathPtr MathParser::absolute() {
    const std::size_t begin = at_++;
    const std::string sign = tokens_[begin].text;
    ++bars_;
    MathPtr inside = expression();
    --bars_;
    if (!is(Kind::bar)) unexpected(say("the other bar of an absolute value"));
    ++at_;
    return node({.kind = Math::Kind::call, .text = "abs", .args = {inside}}, begin);
}

}  // namespace alembert
