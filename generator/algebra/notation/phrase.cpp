// SPDX-License-Identifier: GPL-2.0-or-later
#include "algebra/notation/phrase.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <sstream>
#include <utility>

#include <cln/integer.h>
#include <cln/integer_io.h>

#include "algebra/symbolic/functions.hpp"

namespace alembert {

namespace {

using Form = Phrase::Kind;

Phrase node(Form kind, std::vector<Phrase> args) {
    Phrase result;
    result.kind = kind;
    result.args = std::move(args);
    return result;
}

}  // namespace

namespace phrases {

Phrase number(const Rational& value, bool decimal) {
    Phrase result;
    result.value = cln::abs(value);
    result.decimal = decimal && is_finite_decimal(value);
    return value < 0 ? negative(std::move(result)) : result;
}

Phrase symbol(const GiNaC::ex& symbol, const SymbolInfo& info) {
    Phrase result;
    result.kind = Form::symbol;
    result.symbol = symbol;
    result.info = info;
    return result;
}

Phrase pi() {
    return symbol(GiNaC::Pi, {.name = "pi"});
}

Phrase sum(std::vector<Phrase> terms) {
    if (terms.empty()) return number(0);
    std::vector<Phrase> flat;
    for (Phrase& term : terms) {
        if (term.kind == Form::sum)
            std::move(term.args.begin(), term.args.end(), std::back_inserter(flat));
        else
            flat.push_back(std::move(term));
    }
    return flat.size() == 1 ? std::move(flat[0]) : node(Form::sum, std::move(flat));
}

Phrase product(std::vector<Phrase> factors) {
    if (factors.empty()) return number(1);
    return factors.size() == 1 ? std::move(factors[0]) : node(Form::product, std::move(factors));
}

Phrase quotient(Phrase numerator, Phrase denominator) {
    if (denominator.is_number(1)) return numerator;
    return node(Form::quotient, {std::move(numerator), std::move(denominator)});
}

Phrase power(Phrase base, const Rational& exponent) {
    if (exponent == 1) return base;
    if (2 * exponent == 1) return call("sqrt", {std::move(base)});
    return power(std::move(base), number(exponent));
}

Phrase power(Phrase base, Phrase exponent) {
    return node(Form::power, {std::move(base), std::move(exponent)});
}

Phrase tuple(std::vector<Phrase> elements) {
    return node(Form::call, std::move(elements));
}

Phrase call(std::string name, std::vector<Phrase> args) {
    Phrase result = node(Form::call, std::move(args));
    result.name = std::move(name);
    return result;
}

Phrase negative(Phrase arg) {
    if (arg.kind == Form::negative) {
        Phrase inner = std::move(arg.args[0]);
        return inner;
    }
    return node(Form::negative, {std::move(arg)});
}

}  // namespace phrases

int cost(const Phrase& phrase) {
    int result = 0;
    for (const Phrase& arg : phrase.args) result += cost(arg);
    switch (phrase.kind) {
        case Form::number:
            return is_integer(phrase.value) || phrase.decimal ? 1 : 2;
        case Form::symbol:
            return 2;
        case Form::sum:
            return result + static_cast<int>(phrase.args.size()) - 1;
        case Form::product:
            for (const Phrase& arg : phrase.args) result += arg.kind == Form::sum;
            return result;
        case Form::quotient:
            return result + 1;
        case Form::power:
            return result + (phrase.args[0].kind == Form::sum);
        case Form::call: {
            // a double angle such as sin 2θ costs more to read
            const Phrase& arg = phrase.args[0];
            const Phrase& first = arg.kind == Form::sum ? arg.args[0] : arg;
            const bool multiple = (phrase.name == "sin" || phrase.name == "cos") && first.kind == Form::product &&
                                  first.args[0].kind == Form::number;
            return result + (multiple ? 4 : 1);
        }
        case Form::negative:
            return result + 1;
    }
    return result;
}

GiNaC::ex expression(const Phrase& phrase) {
    GiNaC::exvector args;
    for (const Phrase& arg : phrase.args) args.push_back(expression(arg));
    switch (phrase.kind) {
        case Form::number:
            return expression(phrase.value);
        case Form::symbol:
            return phrase.symbol;
        case Form::sum:
            return GiNaC::add(args);
        case Form::product:
            return GiNaC::mul(args);
        case Form::quotient:
            return args[0] / args[1];
        case Form::power:
            return GiNaC::pow(args[0], args[1]);
        case Form::negative:
            return -args[0];
        case Form::call:
            break;
    }
    if (phrase.name == "sqrt") return GiNaC::sqrt(args[0]);
    if (phrase.name == "abs") return absolute(args.at(0));
    const auto count = static_cast<unsigned>(args.size());
    return GiNaC::function(GiNaC::function::find_function(phrase.name, count), args);
}

bool is_finite_decimal(const Rational& value) {
    cln::cl_I rest = cln::denominator(value);
    for (const int prime : {2, 5})
        while (cln::zerop(cln::mod(rest, prime))) rest = cln::exquo(rest, prime);
    return rest == 1;
}

bool is_decimal(const Rational& value) {
    if (is_integer(value) || !is_finite_decimal(value)) return false;
    const cln::cl_I denominator = cln::denominator(value);
    const bool customary = denominator <= 8 || denominator == 16 || denominator == 32 || denominator == 64;
    return !customary || cln::abs(cln::numerator(value)) > 32;
}

bool reads_as_decimal(const Rational& value) {
    if (is_integer(value) || !is_finite_decimal(value)) return false;
    return is_decimal(value) || cln::zerop(cln::mod(cln::denominator(value), 5));
}

std::string digits(const Phrase& number) {
    const Rational& value = number.value;
    std::ostringstream stream;
    if (is_integer(value)) {
        stream << cln::numerator(value);
        return stream.str();
    }
    if (!number.decimal) return {};
    cln::cl_I scale = 1;
    std::size_t places = 0;
    while (!is_integer(value * scale)) {
        scale = scale * 10;
        ++places;
    }
    stream << cln::numerator(value * scale);
    const std::string all = fmt::format("{:0>{}}", stream.str(), places + 1);
    return fmt::format("{}.{}", all.substr(0, all.size() - places), all.substr(all.size() - places));
}

Fronted take_front(const Phrase& phrase) {
    if (phrase.kind == Form::number) return {phrase, phrases::number(1)};
    if (phrase.kind == Form::product && phrase.args[0].kind == Form::number) {
        std::vector<Phrase> rest(phrase.args.begin() + 1, phrase.args.end());
        return {phrase.args[0], phrases::product(std::move(rest))};
    }
    if (phrase.kind == Form::quotient) {
        Fronted top = take_front(phrase.args[0]);
        const Fronted bottom = take_front(phrase.args[1]);
        // 2x/(3y) stays one fraction
        if (!bottom.rest.is_number(1)) return {phrases::number(1), phrase};
        return {phrases::number(top.front.value / bottom.front.value), std::move(top.rest)};
    }
    return {phrases::number(1), phrase};
}

}  // namespace alembert
