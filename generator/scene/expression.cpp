// SPDX-License-Identifier: GPL-2.0-or-later
// The grammar, by recursive descent:
//
//     sum      = product (("+" | "-") product)*
//     product  = signed (("*" | "/") signed)*
//     signed   = ("-" | "+") signed | power
//     power    = primary ("^" exponent)?            exponent = ("-" | "+") exponent | power
//     primary  = number | name primes? | function "(" sum ("," sum)* ")" | "(" sum ")" primes?
//
// Sums and products are flat, so that only nesting costs depth.

#include "scene/expression.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <optional>
#include <utility>

#include "scene/functions.hpp"
#include "scene/scene.hpp"
#include "scene/text.hpp"
#include "scene/tokens.hpp"

namespace alembert {
namespace {

using Kind = Tree::Kind;

constexpr std::size_t most_bytes = 64 * 1024;
constexpr int most_levels = 200;
constexpr double most_exponent = 64;

/// A subexpression, with what is known of it without any algebra.
struct Operand {
    TreePtr tree;
    std::optional<double> value;  ///< where it is made of numbers alone
    double exponent = 1;          ///< product of the whole exponents directly above its base
};

class Parser {
public:
    Parser(const std::string& text, bool rates_before) : text_(text), rates_before_(rates_before) {}

    TreePtr parse() {
        tokens_ = tokenize(text_);
        if (at_end()) stop(0, "the expression is empty");
        const Operand whole = sum();
        if (!at_end()) unexpected();
        return whole.tree;
    }

private:
    const std::string& text_;
    const bool rates_before_;
    std::vector<Token> tokens_;
    std::size_t at_ = 0;
    int depth_ = 0;

    struct Level {
        Parser& parser;
        Level(Parser& p, int offset) : parser(p) {
            if (++parser.depth_ > most_levels)
                stop(offset, fmt::format("nested more than {} levels deep", most_levels));
        }
        ~Level() { --parser.depth_; }
        Level(const Level&) = delete;
        Level& operator=(const Level&) = delete;
    };

    [[noreturn]] static void stop(int offset, std::string message) { throw Mistake{offset, std::move(message)}; }

    const Token& now() const { return tokens_[at_]; }
    const Token& ahead(std::size_t k) const { return tokens_[std::min(at_ + k, tokens_.size() - 1)]; }
    bool at_end() const { return now().kind == Token::Kind::end; }
    static bool is(const Token& token, char symbol) { return token.symbol == symbol; }
    bool at(char symbol) const { return is(now(), symbol); }
    std::string word(const Token& token) const { return text_.substr(token.offset, token.length); }

    /// The end in bytes of the last token read.
    int end() const { return at_ == 0 ? 0 : tokens_[at_ - 1].offset + tokens_[at_ - 1].length; }

    TreePtr make(Kind kind, int offset, std::string text, std::vector<TreePtr> args = {}, int primes = 0) const {
        return std::make_shared<const Tree>(
            Tree{kind, std::move(text), primes, std::move(args), offset, end() - offset});
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
            const int sign = tokens_[at_++].offset;
            const Operand term = product();
            terms.push_back(minus ? make(Kind::negate, sign, "", {term.tree}) : term.tree);
            if (value) value = term.value ? std::optional(*value + (minus ? -*term.value : *term.value)) : std::nullopt;
        }
        return {make(Kind::sum, begin, "", std::move(terms)), value};
    }

    Operand product() {
        const int begin = now().offset;
        Operand first = signed_power();
        refuse_neighbour(begin);
        if (!at('*') && !at('/')) return first;
        std::vector<TreePtr> factors{first.tree};
        std::optional<double> value = first.value;
        while (at('*') || at('/')) {
            const bool over = at('/');
            const int sign = tokens_[at_++].offset;
            const int factor_begin = now().offset;
            const Operand factor = signed_power();
            refuse_neighbour(factor_begin);
            factors.push_back(over ? make(Kind::reciprocal, sign, "", {factor.tree}) : factor.tree);
            if (over && factor.value == 0.0) stop(sign, "a division by zero");
            if (value) value = factor.value ? std::optional(over ? *value / *factor.value : *value * *factor.value)
                                            : std::nullopt;
        }
        return {make(Kind::product, begin, "", std::move(factors)), checked(value, begin)};
    }

    Operand signed_power() {
        if (!at('-') && !at('+')) return power();
        const int begin = now().offset;
        const Level level(*this, begin);
        const bool minus = at('-');
        ++at_;
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
        ++at_;
        const int exponent_begin = now().offset;
        const Operand exponent = this->exponent();
        const double whole = whole_exponent(base, exponent, exponent_begin);
        std::optional<double> value;
        if (base.value && exponent.value) {
            if (*base.value == 0 && *exponent.value < 0) stop(begin, "a division by zero");
            value = std::pow(*base.value, *exponent.value);
            if (std::isnan(*value)) value.reset();
            if (value && *value == 0 && *base.value != 0) stop(begin, "a number beyond the range of double precision");
        }
        return {make(Kind::power, begin, "", {base.tree, exponent.tree}), checked(value, begin), whole};
    }

    Operand exponent() {
        if (!at('-') && !at('+')) return power();
        const int begin = now().offset;
        const Level level(*this, begin);
        const bool minus = at('-');
        ++at_;
        return negated(minus, begin, exponent());
    }

    /// The whole exponents over the base, multiplied where one power stands directly on another.
    static double whole_exponent(const Operand& base, const Operand& exponent, int offset) {
        if (!exponent.value || *exponent.value != std::floor(*exponent.value)) return base.exponent;
        const double whole = *exponent.value;
        if (std::abs(whole) > most_exponent)
            stop(offset, fmt::format("the exponent {:.17g} is beyond the limit of {}", whole, most_exponent));
        const double all = base.exponent * whole;
        if (std::abs(all) > most_exponent)
            stop(offset, fmt::format("the exponents multiply to {:.17g}, beyond the limit of {}", all, most_exponent));
        return all;
    }

    static std::optional<double> checked(std::optional<double> value, int offset) {
        if (value && std::isinf(*value)) stop(offset, "a number beyond the range of double precision");
        return value;
    }

    // --- numbers, names, calls, parentheses

    Operand primary() {
        const Token& token = now();
        switch (token.kind) {
            case Token::Kind::number: return number();
            case Token::Kind::name: return is(ahead(1), '(') || find_function(word(token)) ? call() : name();
            default: break;
        }
        if (at('(')) return parenthesis();
        missing_operand();
    }

    Operand number() {
        const int begin = now().offset;
        const std::string literal = word(now());
        ++at_;
        if (now().kind == Token::Kind::primes) stop(now().offset, "a number has no derivative");
        double value = 0;
        std::from_chars(literal.data(), literal.data() + literal.size(), value);
        return {make(Kind::number, begin, literal), value};
    }

    int primes() {
        if (now().kind != Token::Kind::primes) return 0;
        if (now().length > 2) stop(now().offset, "at most two primes: mechanics knows rates and accelerations only");
        return tokens_[at_++].length;
    }

    Operand name() {
        const int begin = now().offset;
        std::string text = word(now());
        ++at_;
        const int count = primes();
        const TreePtr plain = make(Kind::name, begin, std::move(text), {}, count);
        if (count == 0 || !at('(')) return {plain, {}};
        if (!is(ahead(1), '-') || !is(ahead(2), ')')) return {plain, {}};
        if (!rates_before_)
            stop(begin, fmt::format("{}(-), a rate before the impact, stands only in a claim with at = \"impact\"",
                                    text_.substr(begin, end() - begin)));
        at_ += 3;
        return {make(Kind::call, begin, "(-)", {plain}), {}};
    }

    Operand parenthesis() {
        const int begin = now().offset;
        const Level level(*this, begin);
        ++at_;
        if (at(')')) stop(begin, "there is nothing in these parentheses");
        Operand inside = sum();
        close(begin);
        const int count = primes();
        if (count == 0) return inside;
        return {make(Kind::derivative, begin, "", {inside.tree}, count), {}};
    }

    void close(int opening) {
        if (at_end()) stop(opening, "this parenthesis is never closed");
        if (at(',')) stop(now().offset, "a comma stands only between the arguments of a function; "
                                        "the decimal sign is a point");
        if (!at(')')) unexpected();
        ++at_;
    }

    Operand call() {
        const int begin = now().offset;
        const std::string name = word(now());
        const Function* const function = find_function(name);
        ++at_;
        if (!function) unknown_function(begin, name);
        if (now().kind == Token::Kind::primes)
            stop(now().offset, fmt::format("a function has no prime; differentiate what it gives: ({})'", function->usage));
        if (at('^')) power_of_function(begin, name);
        if (!at('(')) stop(begin, fmt::format("'{0}' needs its argument in parentheses: {1}", name, function->usage));
        const int opening = now().offset;
        const Level level(*this, opening);
        ++at_;
        std::vector<TreePtr> args;
        if (!at(')')) {
            args.push_back(sum().tree);
            for (; at(','); args.push_back(sum().tree)) ++at_;
        }
        if (at_end()) stop(opening, "this parenthesis is never closed");
        if (!at(')')) unexpected();
        ++at_;
        if (now().kind == Token::Kind::primes)
            stop(now().offset, "a function's value is differentiated in parentheses of its own: (" +
                                   escaped(text_.substr(begin, end() - begin), 30) + ")'");
        check_arguments(*function, args, begin);
        return {make(Kind::call, begin, name, std::move(args)), {}};
    }

    static void check_arguments(const Function& function, const std::vector<TreePtr>& args, int begin) {
        const int count = static_cast<int>(args.size());
        if (count < function.least || count > function.most)
            stop(begin, fmt::format("'{}' takes {}{} argument{}, not {}: {}", function.name,
                                    function.most > 2 ? "at least " : "",
                                    function.least == function.most || function.most > 2
                                        ? fmt::format("{}", function.least)
                                        : fmt::format("{} or {}", function.least, function.most),
                                    function.least == 1 && function.most == 1 ? "" : "s", count, function.usage));
        if (function.takes != Function::Takes::points && function.takes != Function::Takes::frames) return;
        for (const TreePtr& arg : args)
            if (arg->kind != Kind::name || arg->primes > 0)
                stop(arg->offset, fmt::format("'{}' takes the name of a {}: {}", function.name,
                                              function.takes == Function::Takes::points ? "point" : "frame or body",
                                              function.usage));
    }

    // --- what goes wrong, and what to write instead

    [[noreturn]] void unknown_function(int begin, const std::string& name) const {
        const std::string meant = nearest(name, function_names());
        std::string message = "unknown function " + in_quotes(name);
        if (!meant.empty()) message += "; did you mean '" + meant + "'?";
        message += fmt::format("; if a product was meant write {}*{}", escaped(name), argument_text());
        stop(begin, std::move(message));
    }

    /// The parenthesis that begins here, as written; `(…)` where it is long or never closed.
    std::string argument_text() const {
        int open = 0;
        for (std::size_t k = at_; k < tokens_.size(); ++k) {
            open += is(tokens_[k], '(') - is(tokens_[k], ')');
            const int length = tokens_[k].offset + tokens_[k].length - now().offset;
            if (length > 24) break;
            if (open == 0) return escaped(text_.substr(now().offset, length));
        }
        return "(…)";
    }

    [[noreturn]] void power_of_function(int begin, const std::string& name) {
        ++at_;
        if (at('-')) ++at_;
        const bool minus = tokens_[at_ - 1].symbol == '-';
        const std::string exponent = at_end() ? "2" : (minus ? "-" : "") + word(now());
        if (!at_end()) ++at_;
        const std::string argument = at('(') ? argument_text() : "(…)";
        stop(begin, fmt::format("a power of a function is written after its argument: {}{}^{}", name, argument,
                                escaped(exponent, 20)));
    }

    /// `2x`, `2(x)`, `x y`, `)(`: a factor right after a factor.
    void refuse_neighbour(int begin) const {
        const Token& next = now();
        const bool follows = next.kind == Token::Kind::number || next.kind == Token::Kind::name || is(next, '(');
        if (!follows) {
            if (next.kind == Token::Kind::primes)
                stop(next.offset, "a prime stands right after a name or a parenthesis: x' or (…)'");
            return;
        }
        std::string left = text_.substr(begin, end() - begin);
        if (left.size() > 24) left = word(tokens_[at_ - 1]);
        const std::string right = is(next, '(') ? argument_text() : word(next);
        stop(next.offset, fmt::format("an operator is missing here; if a product was meant write {}*{}",
                                      escaped(left), escaped(right)));
    }

    [[noreturn]] void missing_operand() const {
        if (at_end() && at_ > 0)
            stop(tokens_[at_ - 1].offset, fmt::format("nothing follows {}", in_quotes(word(tokens_[at_ - 1]))));
        if (at(')') || at('=') || at(',')) {
            if (at_ > 0 && !is(tokens_[at_ - 1], ')'))
                stop(now().offset, fmt::format("an operand is missing between {} and {}",
                                               in_quotes(word(tokens_[at_ - 1])), in_quotes(word(now()))));
            unexpected();
        }
        if (now().kind == Token::Kind::primes)
            stop(now().offset, "a prime stands right after a name or a parenthesis: x' or (…)'");
        stop(now().offset, fmt::format("an operand is missing before {}", in_quotes(word(now()))));
    }

    [[noreturn]] void unexpected() const {
        if (at(')')) stop(now().offset, "this parenthesis closes nothing: none is open here");
        if (at('=')) stop(now().offset, "'=' is not part of an expression; only a claim is an equation");
        if (at(','))
            stop(now().offset, "a comma stands only between the arguments of a function; the decimal sign is a point");
        stop(now().offset, fmt::format("{} is not expected here", in_quotes(word(now()))));
    }
};

TreePtr parse(const Expression& expression, bool rates_before, std::vector<Diagnostic>& diagnostics) {
    if (expression.text.size() > most_bytes) {
        diagnostics.push_back({expression.place(), fmt::format("an expression of {} bytes; the limit is {} (64 KiB)",
                                                               expression.text.size(), most_bytes)});
        return nullptr;
    }
    try {
        return Parser(expression.text, rates_before).parse();
    } catch (const Mistake& mistake) {
        diagnostics.push_back({expression.place(mistake.offset), mistake.message});
        return nullptr;
    }
}

Expression slice(const std::string& text, const std::vector<Place>& places, std::size_t begin, std::size_t end) {
    Expression part{text.substr(begin, end - begin), {}, nullptr};
    if (places.size() > end) part.places.assign(places.begin() + static_cast<std::ptrdiff_t>(begin),
                                                places.begin() + static_cast<std::ptrdiff_t>(end) + 1);
    return part;
}

}  // namespace

Expression parse_expression(std::string text, std::vector<Place> places, std::vector<Diagnostic>& diagnostics) {
    Expression result{std::move(text), std::move(places), nullptr};
    result.tree = parse(result, false, diagnostics);
    return result;
}

Equality parse_equality(const std::string& text, const std::vector<Place>& places,
                        std::vector<Diagnostic>& diagnostics, bool rates_before) {
    const Expression whole{text, places, nullptr};
    const std::size_t sign = text.find('=');
    const auto refuse = [&](std::size_t offset, const char* message) {
        diagnostics.push_back({whole.place(static_cast<int>(offset)), message});
        return Equality{};
    };
    if (sign == std::string::npos) return refuse(0, "an equation needs an = sign");
    if (text.compare(sign, 2, "==") == 0) return refuse(sign, "'==' is not part of the language; an equation has one =");
    const std::size_t second = text.find('=', sign + 1);
    if (second != std::string::npos) return refuse(second, "an equation has one = sign, and this is the second");
    if (text.find_first_not_of(" \t\r\n") == sign) return refuse(sign, "nothing stands to the left of =");
    if (text.find_first_not_of(" \t\r\n", sign + 1) == std::string::npos)
        return refuse(sign, "nothing stands to the right of =");
    Equality result{slice(text, places, 0, sign), slice(text, places, sign + 1, text.size())};
    result.lhs.tree = parse(result.lhs, rates_before, diagnostics);
    result.rhs.tree = parse(result.rhs, rates_before, diagnostics);
    return result;
}

}  // namespace alembert
