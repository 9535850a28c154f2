// SPDX-License-Identifier: GPL-2.0-or-later
// The grammar, by recursive descent:
//
//     sum      = product (("+" | "-") product)*
//     product  = signed (("*" | "/") signed)*
//     signed   = ("-" | "+") signed | power
//     power    = primary ("^" exponent)?            exponent = ("-" | "+") exponent | power
//     primary  = number unit? | name primes? | function "(" sum ("," sum)* ")" | "(" sum ")" primes?
//
//     unit     = word power? (("*" | "/" | "-")? word power?)*     of words that are units (scene/unit_text.hpp)
//
// Sums and products are flat, so that only nesting adds depth.

#include "scene/expression.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <optional>
#include <utility>

#include "base/language/say.hpp"
#include "scene/functions.hpp"
#include "scene/hints.hpp"
#include "scene/known_names.hpp"
#include "scene/text.hpp"
#include "scene/tokens.hpp"
#include "scene/typed.hpp"
#include "scene/unit_text.hpp"

namespace alembert {
namespace {

using Kind = Tree::Kind;

constexpr std::size_t longest_expression = 64 * 1024;
constexpr int most_levels = 200;
constexpr double most_exponent = 64;

/// A subexpression, with what is known about it without algebra.
struct Operand {
    TreePtr tree;
    std::optional<double> value;  ///< its value, if it consists of numbers only
    double exponent = 1;          ///< the product of the whole exponents directly above its base
};

class Parser {
public:
    Parser(const std::string& text, bool rates_before, const KnownNames* names)
        : words_{text, tokenize(text)}, rates_before_(rates_before), names_(names) {}

    TreePtr parse() {
        if (words_.at_end()) stop(0, say("the expression is empty"));
        const Operand whole = sum();
        if (!words_.at_end()) refuse_word(words_);
        return whole.tree;
    }

    /// What is doubtful in the units of its quantities.
    const std::vector<Mistake>& warnings() const { return warnings_; }

private:
    Words words_;
    std::vector<Mistake> warnings_;
    const bool rates_before_;
    const KnownNames* const names_;  ///< of the scene, and the units of its own; null for none
    int depth_ = 0;

    struct Level {
        Parser& parser;
        Level(Parser& p, int offset) : parser(p) {
            if (++parser.depth_ > most_levels) stop(offset, say("nested more than {} levels deep", most_levels));
        }
        ~Level() { --parser.depth_; }
        Level(const Level&) = delete;
        Level& operator=(const Level&) = delete;
    };

    const Token& now() const { return words_.now(); }
    bool at(char symbol) const { return words_.at_symbol(symbol); }
    int next() { return words_.tokens[words_.at++].offset; }

    TreePtr make(Kind kind, int offset, std::string text, std::vector<TreePtr> args = {}, int primes = 0) const {
        return std::make_shared<const Tree>(
            Tree{kind, std::move(text), primes, std::move(args), offset, words_.end() - offset});
    }

    // --- sums and products

    Operand sum() {
        const int begin = now().offset;
        Operand first = product();
        if (!at('+') && !at('-')) return first;
        std::vector<TreePtr> terms{first.tree};
        std::optional<double> value = first.value;
        while (at('+') || at('-')) {
            const bool minus = at('-');
            const int sign = next();
            const Operand term = product();
            terms.push_back(minus ? make(Kind::negate, sign, "", {term.tree}) : term.tree);
            if (value)
                value = term.value ? std::optional(*value + (minus ? -*term.value : *term.value)) : std::nullopt;
        }
        return {make(Kind::sum, begin, "", std::move(terms)), value};
    }

    Operand product() {
        const int begin = now().offset;
        Operand first = signed_power();
        refuse_second(first, begin);
        if (!at('*') && !at('/')) return first;
        std::vector<TreePtr> factors{first.tree};
        std::optional<double> value = first.value;
        while (at('*') || at('/')) {
            const bool over = at('/');
            const int sign = next();
            const int factor_begin = now().offset;
            const Operand factor = signed_power();
            refuse_second(factor, factor_begin);
            factors.push_back(over ? make(Kind::reciprocal, sign, "", {factor.tree}) : factor.tree);
            if (over && factor.value == 0.0) stop(sign, say("a division by zero"));
            if (value)
                value = factor.value ? std::optional(over ? *value / *factor.value : *value * *factor.value)
                                     : std::nullopt;
        }
        return {make(Kind::product, begin, "", std::move(factors)), checked(value, begin)};
    }

    /// A factor right after another one: after a number, most likely a unit that is not known.
    void refuse_second(const Operand& first, int begin) const {
        const Token& second = now();
        const std::string word = words_.word(second);
        const bool is_quantity = !first.tree->unit.empty();
        if (is_quantity && second.kind == Token::Kind::number) refuse_second_number(words_, begin);
        const bool is_word = second.kind == Token::Kind::name && !Words::is(words_.ahead(1), '(');
        if ((is_quantity || first.tree->kind == Kind::number) && is_word &&
            (names_ == nullptr || !names_->has(word)))
            refuse_unknown_unit(words_, begin);
        refuse_neighbour(words_, begin);
    }

    Operand signed_power() {
        if (!at('-') && !at('+')) return power();
        const Level level(*this, now().offset);
        const bool minus = at('-');
        const int begin = next();
        return negated(minus, begin, signed_power());
    }

    Operand negated(bool minus, int begin, Operand operand) const {
        if (!minus) return operand;
        if (operand.value) operand.value = -*operand.value;
        return {make(Kind::negate, begin, "", {operand.tree}), operand.value};
    }

    // --- powers

    Operand power() {
        const int begin = now().offset;
        const Operand base = primary();
        if (!at('^')) return base;
        const Level level(*this, now().offset);
        next();
        const int exponent_begin = now().offset;
        const Operand exponent = this->exponent();
        const double whole = whole_exponent(base, exponent, exponent_begin);
        std::optional<double> value;
        if (base.value && exponent.value) {
            if (*base.value == 0 && *exponent.value < 0) stop(begin, say("a division by zero"));
            value = std::pow(*base.value, *exponent.value);
            if (std::isnan(*value)) value.reset();
            if (value && *value == 0 && *base.value != 0)
                stop(begin, say("a number beyond the range of double precision"));
        }
        return {make(Kind::power, begin, "", {base.tree, exponent.tree}), checked(value, begin), whole};
    }

    Operand exponent() {
        if (!at('-') && !at('+')) return power();
        const Level level(*this, now().offset);
        const bool minus = at('-');
        const int begin = next();
        return negated(minus, begin, exponent());
    }

    /// The whole exponent of the base; exponents are multiplied if one power stands directly on another.
    static double whole_exponent(const Operand& base, const Operand& exponent, int offset) {
        if (!exponent.value || *exponent.value != std::floor(*exponent.value)) return base.exponent;
        const double whole = *exponent.value;
        if (std::abs(whole) > most_exponent)
            stop(offset, say("the exponent {:.17g} is beyond the limit of {}", whole, most_exponent));
        const double all = base.exponent * whole;
        if (std::abs(all) > most_exponent)
            stop(offset, say("the exponents multiply to {:.17g}, beyond the limit of {}", all, most_exponent));
        return all;
    }

    static std::optional<double> checked(std::optional<double> value, int offset) {
        if (value && std::isinf(*value)) stop(offset, say("a number beyond the range of double precision"));
        return value;
    }

    // --- numbers, names, calls, parentheses

    Operand primary() {
        if (now().kind == Token::Kind::number) return number();
        if (now().kind == Token::Kind::name) return is_call() ? call() : name();
        if (at('(')) return parenthesis();
        refuse_missing_operand(words_);
    }

    /// A name that may also be that of a quantity is a function if a parenthesis follows, even after primes, which
    /// are then refused; x'(-) is no call.
    bool is_call() const {
        const std::string word = words_.word(now());
        if (is_reserved_function(word) || Words::is(words_.ahead(1), '(')) return true;
        return find_function(word) != nullptr && words_.ahead(1).kind == Token::Kind::primes &&
               Words::is(words_.ahead(2), '(') && !Words::is(words_.ahead(3), '-');
    }

    Operand number() {
        const std::string literal = words_.word(now());
        const int begin = next();
        if (now().kind == Token::Kind::primes) stop(now().offset, say("a number has no derivative"));
        const double value = value_of_digits(literal);
        const TreePtr number = make(Kind::number, begin, literal);
        return is_unit(0) ? quantity(number, begin) : Operand{number, value};
    }

    // --- units

    /// Whether the word `ahead` tokens from here is a unit; min(x, y) is none.
    bool is_unit(std::size_t ahead) const {
        const Token &word = words_.ahead(ahead), &next = words_.ahead(ahead + 1);
        if (word.kind != Token::Kind::name || Words::is(next, '(') || next.kind == Token::Kind::primes)
            return false;
        const std::string text = words_.word(word);
        if (names_ != nullptr && names_->units().contains(text)) return true;
        if (names_ != nullptr && names_->has(text) && !is_unit_symbol(text)) return false;
        if (names_ != nullptr && own_unit(names_->units(), text) != nullptr) return true;  // in the plural
        return is_known_unit(text) || is_no_multiple(text);
    }

    /// The number times what its unit is in the SI.
    Operand quantity(const TreePtr& number, int begin) {
        const int unit_begin = now().offset;
        const std::string text = unit();
        const UnitReading unit = names_ == nullptr ? read_unit(text) : read_unit(text, names_->units());
        if (!unit.meaning) stop(unit_begin, say("'{}' is no unit: {}", text, unit.mistake));
        for (const UnitDoubt& doubt : unit.doubts)
            if (!doubt.mass.empty()) warnings_.push_back({unit_begin, advice_on_mass(doubt)});
        std::vector<TreePtr> factors{number};
        if (!unit.meaning->exact.empty()) factors.push_back(Parser(unit.meaning->exact, false, nullptr).parse());
        Tree whole{Kind::product, "", 0, std::move(factors), begin, words_.end() - begin};
        whole.unit = unit.has_own ? unit.meaning->si : text;
        return {std::make_shared<const Tree>(std::move(whole)), {}};
    }

    std::string unit() {
        std::string text;
        while (true) {
            const bool is_joined = !text.empty() && (at('*') || at('/') || is_hyphen());
            if (!is_unit(is_joined ? 1 : 0)) return text;
            if (is_joined && at('-')) check_hyphen();
            if (is_joined)
                text += words_.word(words_.tokens[words_.at++]);
            else if (!text.empty())
                text += ' ';
            const std::string word = words_.word(now());
            if (is_no_multiple(word))
                stop(now().offset,
                     say("'{}' has a zero of its own or is a logarithm, and a quantity is a multiple of its "
                         "unit; write it in K, or as a ratio",
                         word));
            text += word;
            next();
            if (at('^')) text += unit_power();
        }
    }

    /// A minus sign without blanks between two words, the second of which is a unit: N-m.
    bool is_hyphen() const {
        const Token& next = words_.ahead(1);
        return at('-') && words_.last().kind == Token::Kind::name && now().offset == words_.end() &&
               next.offset == now().offset + 1;
    }

    /// Returns where the hyphen joins two units: the scene has no name that could be subtracted, or engineers
    /// write the two as one.
    void check_hyphen() const {
        const std::string first = words_.word(words_.last()), second = words_.word(words_.ahead(1));
        if (names_ == nullptr || !names_->has(second) || is_product_of_units(first, second)) return;
        stop(now().offset,
             say("'{0}-{1}' may be a unit or a difference; write {0}*{1} for the unit, and {0} - {1} "
                 "with blanks for the difference",
                 first, second));
    }

    /// ^2 or ^-1 after a unit.
    std::string unit_power() {
        const std::size_t number = Words::is(words_.ahead(1), '-') ? 2 : 1;
        const std::string power = words_.word(words_.ahead(number));
        if (words_.ahead(number).kind != Token::Kind::number || power.find_first_of(".eE") != std::string::npos)
            stop(now().offset, say("the power of a unit is a whole number"));
        words_.at += number + 1;
        return (number == 2 ? "^-" : "^") + power;
    }

    int primes() {
        if (now().kind != Token::Kind::primes) return 0;
        if (now().length > 3)
            stop(now().offset,
                 say("at most three primes: third derivatives are the highest, and stand in claims alone"));
        return words_.tokens[words_.at++].length;
    }

    Operand name() {
        std::string text = words_.word(now());
        const int begin = next();
        const int count = primes();
        const TreePtr plain = make(Kind::name, begin, std::move(text), {}, count);
        if (count == 0 || !at('(') || !Words::is(words_.ahead(1), '-') || !Words::is(words_.ahead(2), ')'))
            return {plain, {}};
        if (!rates_before_)
            stop(begin, say("{}(-), a rate before the impact, stands only in a claim with at = \"impact\"",
                            words_.text.substr(begin, words_.end() - begin)));
        words_.at += 3;
        return {make(Kind::call, begin, "(-)", {plain}), {}};
    }

    Operand parenthesis() {
        const Level level(*this, now().offset);
        const int begin = next();
        if (at(')')) stop(begin, say("there is nothing in these parentheses"));
        Operand inside = sum();
        close(begin);
        const int count = primes();
        if (count == 0) return inside;
        return {make(Kind::derivative, begin, "", {inside.tree}, count), {}};
    }

    void close(int opening) {
        if (words_.at_end()) stop(opening, say("this parenthesis is never closed"));
        if (!at(')')) refuse_word(words_);
        next();
    }

    Operand call() {
        const Token name = now();
        const Function* const function = find_function(words_.word(name));
        next();
        if (now().kind == Token::Kind::primes)
            stop(now().offset,
                 say("a function has no prime; differentiate what it gives: ({})'", function->usage));
        if (at('^')) refuse_power_of_function(words_, name);
        if (!at('('))
            stop(name.offset, say("'{}' needs its argument in parentheses: {}", function->name, function->usage));
        const Level level(*this, now().offset);
        const int opening = next();
        std::vector<TreePtr> args;
        if (!at(')')) {
            args.push_back(sum().tree);
            for (; at(','); args.push_back(sum().tree)) next();
        }
        close(opening);
        if (now().kind == Token::Kind::primes)
            stop(now().offset, say("a function's value is differentiated in parentheses of its own: ({})'",
                                   escaped(words_.text.substr(name.offset, words_.end() - name.offset), 30)));
        if (function) check_arguments(*function, args, name.offset);
        return {make(Kind::call, name.offset, words_.word(name), std::move(args)), {}};
    }
};

TreePtr parse(const Expression& expression, bool rates_before, std::vector<Diagnostic>& diagnostics,
              const KnownNames* names) {
    if (expression.text.size() > longest_expression) {
        diagnostics.push_back({expression.place(), say("an expression of {} bytes; the limit is {} (64 KiB)",
                                                       expression.text.size(), longest_expression)});
        return nullptr;
    }
    try {
        Parser parser(expression.text, rates_before, names);
        TreePtr tree = parser.parse();
        for (const Mistake& doubt : parser.warnings())
            diagnostics.push_back(
                {expression.place(doubt.offset), doubt.message, Severity::warning, "unknown_unit"});
        return tree;
    } catch (const Mistake& mistake) {
        diagnostics.push_back({expression.place(mistake.offset), mistake.message});
        return nullptr;
    }
}

Expression slice(const std::string& text, const std::vector<Place>& places, std::size_t begin, std::size_t end) {
    Expression part{text.substr(begin, end - begin), {}, nullptr};
    if (places.size() > end)
        part.places.assign(places.begin() + static_cast<std::ptrdiff_t>(begin),
                           places.begin() + static_cast<std::ptrdiff_t>(end) + 1);
    return part;
}

}  // namespace

double value_of_digits(const std::string& digits) {
    double value = 0;
    std::from_chars(digits.data(), digits.data() + digits.size(), value);
    return value;
}

Expression parse_expression(std::string text, std::vector<Place> places, std::vector<Diagnostic>& diagnostics,
                            const KnownNames* names) {
    write_plainly(text, places);
    Expression result{std::move(text), std::move(places), nullptr};
    result.tree = parse(result, false, diagnostics, names);
    return result;
}

Equality parse_equality(const std::string& typed, const std::vector<Place>& their_places,
                        std::vector<Diagnostic>& diagnostics, bool rates_before, const KnownNames* names) {
    std::string text = typed;
    std::vector<Place> places = their_places;
    write_plainly(text, places);
    const Expression whole{text, places, nullptr};
    const std::size_t sign = text.find('=');
    const auto refuse = [&](std::size_t offset, const std::string& message) {
        diagnostics.push_back({whole.place(static_cast<int>(offset)), message});
        return Equality{};
    };
    if (sign == std::string::npos) return refuse(0, say("an equation needs an = sign"));
    if (text.compare(sign, 2, "==") == 0)
        return refuse(sign, say("'==' is not part of the language; an equation has one ="));
    const std::size_t second = text.find('=', sign + 1);
    if (second != std::string::npos)
        return refuse(second, say("an equation has one = sign, and this is the second"));
    if (text.find_first_not_of(" \t\r\n") == sign) return refuse(sign, say("nothing stands to the left of ="));
    if (text.find_first_not_of(" \t\r\n", sign + 1) == std::string::npos)
        return refuse(sign, say("nothing stands to the right of ="));
    Equality result{slice(text, places, 0, sign), slice(text, places, sign + 1, text.size())};
    result.lhs.tree = parse(result.lhs, rates_before, diagnostics, names);
    result.rhs.tree = parse(result.rhs, rates_before, diagnostics, names);
    return result;
}

Inequality parse_inequality(const std::string& typed, const std::vector<Place>& their_places,
                            std::vector<Diagnostic>& diagnostics, const KnownNames* names) {
    std::string text = typed;
    std::vector<Place> places = their_places;
    write_plainly(text, places);
    const Expression whole{text, places, nullptr};
    const std::size_t sign = text.find_first_of("<>");
    const auto refuse = [&](std::size_t offset, const std::string& message) {
        diagnostics.push_back({whole.place(static_cast<int>(offset)), message});
        return Inequality{};
    };
    if (sign == std::string::npos || text.find_first_of("<>=", sign + 1) != std::string::npos)
        return refuse(0, say("an assumption has one sign > or <, as in \"lambda > 0\""));
    const auto is_blank = [&](std::size_t from, std::size_t to) {
        return text.substr(from, to - from).find_first_not_of(" \t\r\n") == std::string::npos;
    };
    if (is_blank(0, sign)) return refuse(sign, say("nothing stands to the left of {}", text[sign]));
    if (is_blank(sign + 1, text.size())) return refuse(sign, say("nothing stands to the right of {}", text[sign]));
    Expression left = slice(text, places, 0, sign), right = slice(text, places, sign + 1, text.size());
    left.tree = parse(left, false, diagnostics, names);
    right.tree = parse(right, false, diagnostics, names);
    return text[sign] == '>' ? Inequality{std::move(left), std::move(right)}
                             : Inequality{std::move(right), std::move(left), true};
}

namespace {

std::string without_superfluous_blanks(const std::string& text) {
    std::string result;
    for (const char c : text) {
        const bool blank = c == ' ' || c == '\t' || c == '\n' || c == '\r';
        if (blank && (result.empty() || result.back() == ' ')) continue;
        result += blank ? ' ' : c;
    }
    while (!result.empty() && result.back() == ' ') result.pop_back();
    return result;
}

}  // namespace

std::string text_of(const Equality& equation) {
    return without_superfluous_blanks(equation.lhs.text + " = " + equation.rhs.text);
}

std::string text_of(const Inequality& inequality) {
    const auto& [greater, less, begins_with_less] = inequality;
    return without_superfluous_blanks(begins_with_less ? less.text + " < " + greater.text
                                                       : greater.text + " > " + less.text);
}

}  // namespace alembert
