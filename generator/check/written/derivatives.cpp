// SPDX-License-Identifier: GPL-2.0-or-later
// d/dt, ∂/∂q, δ and differentials, as fractions and written in a line.

#include <algorithm>
#include <cstdlib>

#include "base/language/say.hpp"
#include "check/written/windows.hpp"

namespace alembert {

namespace {

constexpr int most_orders = 9;

bool is_style(const WrittenToken& token) {
    static constexpr std::string_view names[] = {"dot",    "ddot",   "dddot",    "vec",     "hat",
                                                 "bar",    "tilde",  "mathbf",   "mathcal", "underline",
                                                 "ddddot", "mathbb", "mathfrak", "mathscr"};
    return token.kind == WrittenToken::Kind::command &&
           std::find(std::begin(names), std::end(names), token.text) != std::end(names);
}

bool is_plain_letter(const WrittenToken& token, std::string_view base) {
    return token.kind == WrittenToken::Kind::letter && token.letter.base == base && token.letter.index.empty() &&
           token.letter.accent.empty() && token.dots == 0;
}

}  // namespace

/// d or ∂ with its order, as the beginning of a numerator or a denominator.
std::optional<MathParser::Differential> MathParser::differential(std::size_t i) const {
    if (kind(i) == Kind::begin_group && partner_[i] == i + 2 && is_plain_letter(token(i + 1), "d")) {  // {\rm d}
        if (kind(i + 3) == Kind::index || kind(i + 3) == Kind::power) return {};
        return Differential{false, 1, i + 3};
    }
    const bool is_partial = kind(i) == Kind::partial;
    if (!is_partial && !(i < end_ && is_plain_letter(token(i), "d"))) return {};
    if (kind(i + 1) == Kind::index || kind(i + 1) == Kind::primes) return {};
    if (kind(i + 1) == Kind::number && token(i + 1).tight && token(i + 1).text.size() == 1 &&
        kind(i + 2) == Kind::letter)
        return Differential{is_partial, token(i + 1).text[0] - '0', i + 2};  // d2theta/dt2
    if (kind(i + 1) != Kind::power) return Differential{is_partial, 1, i + 1};
    std::size_t k = i + 2;
    const bool is_group = kind(k) == Kind::begin_group;
    if (is_group) ++k;
    if (kind(k) != Kind::number || token(k).text.size() != 1 || (is_group && kind(k + 1) != Kind::end_group))
        return {};
    return Differential{is_partial, token(k).text[0] - '0', k + (is_group ? 2 : 1)};
}

/// The end of a letter with accents, index, primes and (t), without a power; no_partner if there is none.
std::size_t MathParser::end_of_letter(std::size_t i) const {
    const std::size_t none = no_partner;
    if (is_command(i, "frac")) {  // \frac{d}{dt}\theta as a variable
        if (kind(i + 1) != Kind::begin_group || partner_[i + 1] == none) return none;
        i = partner_[i + 1] + 1;
        if (kind(i) != Kind::begin_group || partner_[i] == none) return none;
        i = partner_[i] + 1;
    }
    bool has_accent = false;
    while (i < end_ && is_style(token(i))) ++i, has_accent = true;
    if (kind(i) == Kind::begin_group) {
        if (partner_[i] == none || partner_[i] >= end_) return none;
        const bool is_letter = has_accent || end_of_letter_inside(i);
        if (!is_letter) return none;
        i = partner_[i] + 1;
    } else if (kind(i) == Kind::letter ||
               (kind(i) == Kind::text && token(i).text.find(' ') == std::string::npos)) {
        ++i;
    } else {
        return none;
    }
    while (i < end_) {
        if (kind(i) == Kind::index) {
            ++i;
            while (i < end_ && is_style(token(i))) ++i;
            if (kind(i) == Kind::begin_group) {
                if (partner_[i] == none || partner_[i] >= end_) return none;
                i = partner_[i];
            }
            if (i >= end_) return none;
            ++i;
        } else if (kind(i) == Kind::primes) {
            ++i;
        } else if (kind(i) == Kind::power && kind(i + 1) == Kind::begin_group && partner_[i + 1] != none &&
                   (kind(i + 2) == Kind::text || kind(i + 2) == Kind::times || kind(i + 2) == Kind::primes)) {
            i = partner_[i + 1] + 1;
        } else if (kind(i) == Kind::power && kind(i + 1) == Kind::times) {
            i += 2;
        } else if (kind(i) == Kind::open && partner_[i] == i + 2 && is_plain_letter(token(i + 1), "t")) {
            i += 3;
        } else if (kind(i) == Kind::begin_group && kind(i + 1) == Kind::open && partner_[i + 1] == i + 3 &&
                   partner_[i] == i + 4) {
            i += 5;
        } else {
            break;
        }
    }
    return i;
}

bool MathParser::end_of_letter_inside(std::size_t i) const {
    return kind(i + 1) == Kind::letter && (partner_[i] == i + 2 || kind(i + 2) == Kind::index);
}

/// The letter after d or ∂ in a denominator, which may stand in parentheses: theta1', (theta1'). Its range, and
/// where what follows begins.
std::optional<std::pair<MathParser::Range, std::size_t>> MathParser::differential_letter(std::size_t i) const {
    if (kind(i) == Kind::open && partner_[i] != no_partner && partner_[i] < end_ &&
        end_of_letter(i + 1) == partner_[i])
        return std::pair(Range{i + 1, partner_[i]}, partner_[i] + 1);
    const std::size_t end = end_of_letter(i);
    if (end == no_partner) return {};
    return std::pair(Range{i, end}, end);
}

/// The variables of a denominator that is nothing but dt, ∂q ∂q̇, dx² …: each as often as its order says.
std::optional<std::vector<MathParser::Range>> MathParser::variables(std::size_t begin, std::size_t end,
                                                                    bool is_partial) const {
    std::vector<Range> found;
    for (std::size_t i = begin; i < end;) {
        if (i > begin && kind(i) == Kind::times) ++i;
        const auto what = differential(i);
        if (!what || what->is_partial != is_partial || what->order != 1) return {};
        const auto letter = differential_letter(what->after);
        if (!letter || letter->second > end) return {};
        auto [range, after] = *letter;
        int order = 1;
        if (kind(after) == Kind::power && after < end) {
            std::size_t k = after + 1;
            const bool is_group = kind(k) == Kind::begin_group;
            if (is_group) ++k;
            if (kind(k) != Kind::number || token(k).text.size() != 1) return {};
            order = token(k).text[0] - '0';
            after = k + (is_group ? 2 : 1);
        }
        for (int k = 0; k < order; ++k) found.push_back(range);
        i = after;
    }
    if (found.empty() || found.size() > static_cast<std::size_t>(most_orders)) return {};
    return found;
}

MathPtr MathParser::rate(const MathPtr& of, int order, std::size_t begin) const {
    if (order == 0) return of;
    if (of->kind == Math::Kind::letter ||
        (of->kind == Math::Kind::applied && of->args.size() == 1 && is_time(*of->args[0])))
        return node({.kind = Math::Kind::letter, .letter = of->letter, .dots = of->dots + order}, begin);
    if (of->kind == Math::Kind::rate)
        return node({.kind = Math::Kind::rate, .dots = of->dots + order, .args = of->args}, begin);
    return node({.kind = Math::Kind::rate, .dots = order, .args = {of}}, begin);
}

MathPtr MathParser::partial(const MathPtr& of, std::vector<MathPtr> variables, std::string_view sign,
                            std::size_t begin) const {
    std::vector<MathPtr> args{of};
    for (MathPtr& one : variables) {
        if (one->kind == Math::Kind::applied && one->args.size() == 1 && is_time(*one->args[0]))
            one = node({.kind = Math::Kind::letter, .letter = one->letter, .dots = one->dots}, begin);
        if (one->kind != Math::Kind::letter)
            throw NotUnderstood{
                one->offset, one->length,
                say("a derivative is taken with respect to something that is no letter; expected a "
                    "coordinate, a speed or the time")};
        args.push_back(std::move(one));
    }
    return node({.kind = Math::Kind::partial, .text = std::string(sign), .args = std::move(args)}, begin);
}

MathPtr MathParser::derivative(const Differential& what, const MathPtr& operand, const std::vector<Range>& of,
                               std::size_t begin) {
    if (static_cast<std::size_t>(what.order) != of.size())
        fail(begin, say("a derivative of order {} is divided by {} differentials; expected as many", what.order,
                        of.size()));
    std::vector<MathPtr> list;
    bool is_rate = !what.is_partial;
    for (const Range& range : of) {
        list.push_back(within(range.begin, range.end));
        is_rate &= is_time(*list.back());
    }
    if (is_rate) return rate(operand, what.order, begin);
    return partial(operand, std::move(list), what.is_partial ? "" : "d", begin);
}

/// What follows d/dt: parentheses alone, or the product.
MathPtr MathParser::operand_of_derivative(std::size_t begin) {
    if (at_ >= end_ || !(begins_factor() || is(Kind::times)))
        fail(begin, say("nothing follows the sign of a derivative; expected what is differentiated"));
    if (is(Kind::times)) ++at_;  // d/dt · L
    if (is(Kind::open) || is(Kind::begin_group) || is(Kind::no_open)) return factor(false);
    return term();
}

/// \frac, of which many are derivatives.
MathPtr MathParser::fraction() {
    const std::size_t begin = at_++;
    const auto part = [&]() -> Range {
        if (at_ >= end_) unexpected(say("the two parts of a fraction"));
        if (is(Kind::begin_group)) {
            const Range range{at_ + 1, closing(at_)};
            at_ = range.end + 1;
            return range;
        }
        const std::size_t from = at_;
        exponent();
        return {from, at_};
    };
    const Range above = part(), below = part();
    const std::size_t after = at_;
    const auto what = differential(above.begin);
    if (what && what->after <= above.end)
        if (const auto of = variables(below.begin, below.end, what->is_partial)) {
            MathPtr operand;
            if (what->after < above.end) {
                operand = within(what->after, above.end);
                at_ = after;
            } else {
                operand = operand_of_derivative(begin);
            }
            return derivative(*what, operand, *of, begin);
        }
    MathPtr numerator = within(above.begin, above.end), denominator = within(below.begin, below.end);
    return node({.kind = Math::Kind::quotient, .args = {numerator, denominator}}, begin);
}

/// d\theta/dt, ∂L/∂q, d/dt (…). Null if it is nothing of this kind; then the reader stays.
MathPtr MathParser::slanted_derivative() {
    const std::size_t begin = at_;
    const auto what = differential(begin);
    if (!what) return nullptr;
    Range operand{what->after, what->after};
    if (kind(what->after) == Kind::open && partner_[what->after] != no_partner && partner_[what->after] < end_)
        operand.end = partner_[what->after] + 1;
    else if (kind(what->after) != Kind::divide)
        operand.end = end_of_letter(what->after);
    if (operand.end == no_partner || kind(operand.end) != Kind::divide) return nullptr;
    Range below{operand.end + 1, operand.end + 1};
    std::size_t after = no_partner;
    if (kind(below.begin) == Kind::open && partner_[below.begin] != no_partner && partner_[below.begin] < end_) {
        below = {below.begin + 1, partner_[below.begin]};
        after = below.end + 1;
    } else {
        std::size_t i = below.begin;
        while (true) {
            const auto one = differential(i);
            if (!one || one->is_partial != what->is_partial) break;
            const auto letter = differential_letter(one->after);
            if (!letter) break;
            std::size_t k = letter->second;
            if (kind(k) == Kind::power && kind(k + 1) == Kind::number)
                k += 2;
            else if (kind(k) == Kind::power && kind(k + 1) == Kind::begin_group && kind(k + 2) == Kind::number)
                k += 4;
            i = k;
            if (!what->is_partial) break;  // d/dt dx: the second belongs to what follows
        }
        after = below.end = std::min(i, end_);
    }
    const auto of = variables(below.begin, below.end, what->is_partial);
    if (!of) return nullptr;
    at_ = after;
    MathPtr of_what;
    if (operand.begin == operand.end) {
        of_what = operand_of_derivative(begin);
    } else {
        of_what = within(operand.begin, operand.end);
        at_ = after;
    }
    return derivative(*what, of_what, *of, begin);
}

/// \partial_q L
MathPtr MathParser::subscripted_partial() {
    const std::size_t begin = at_++;
    if (!is(Kind::index)) fail(begin, say("∂ was found alone; expected a derivative such as ∂L/∂q"));
    ++at_;
    const Range range = script_range();
    std::size_t after = range.begin == at_ ? range.end : range.end + 1;
    std::size_t end = range.end;
    if (is(Kind::command)) {
        after = end = end_of_letter(at_);
        if (end == no_partner) unexpected(say("a letter"));
    }
    MathPtr variable = within(range.begin, end);
    at_ = after;
    MathPtr operand = operand_of_derivative(begin);
    return partial(operand, {variable}, "", begin);
}

/// δW and, where differentials are meant, dW. Null if it is none.
MathPtr MathParser::variation() {
    const std::size_t begin = at_;
    const WrittenToken& sign = token(begin);
    const bool is_delta = is_plain_letter(sign, "delta"), is_capital = is_plain_letter(sign, "Delta");
    const bool is_d = is_plain_letter(sign, "d") && (has_differentials_ || sign.upright);
    if (!is_delta && !is_d && !is_capital) return nullptr;
    const bool takes_letter =
        kind(begin + 1) == Kind::letter || (kind(begin + 1) == Kind::command && is_style(token(begin + 1)));
    const std::size_t end = takes_letter ? end_of_letter(begin + 1) : no_partner;
    if (end == no_partner && !(is_delta && has_variations_ && kind(begin + 1) == Kind::open)) return nullptr;
    const bool is_dotted = kind(begin + 1) == Kind::command || token(begin + 1).dots > 0;
    if (is_delta && is_dotted && !has_variations_) return nullptr;  // 2δẋ: a constant of damping
    ++at_;
    MathPtr of;
    if (end == no_partner) {
        of = bracket();
    } else {
        of = within(begin + 1, end);
        at_ = end;
    }
    if (!is_capital) return node({.kind = Math::Kind::variation, .text = is_d ? "d" : "", .args = {of}}, begin);
    if (of->kind != Math::Kind::letter) fail(begin, say("Δ was found before something that is no letter"));
    Letter letter = of->letter;
    letter.accent = letter.accent.empty() ? "Delta" : "Delta " + letter.accent;
    return node({.kind = Math::Kind::letter, .letter = letter, .dots = of->dots}, begin);
}

}  // namespace alembert
