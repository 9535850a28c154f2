// SPDX-License-Identifier: GPL-2.0-or-later
#include "algebra/notation/latex.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <sstream>

#include <cln/integer.h>
#include <cln/integer_io.h>

#include "algebra/notation/lettering.hpp"
#include "algebra/notation/text.hpp"
#include "algebra/notation/unspecified.hpp"

namespace alembert {

namespace {

using Kind = Phrase::Kind;

std::string write(const Phrase& phrase);

bool is_fraction(const Phrase& phrase) {
    return phrase.kind == Kind::number && digits(phrase).empty();
}

/// Whether the phrase needs parentheses that grow with it.
bool is_tall(const Phrase& phrase) {
    if (phrase.kind == Kind::quotient || is_fraction(phrase)) return true;
    if (phrase.kind == Kind::call && phrase.name == "sqrt") return true;
    if (const auto call = unspecified_phrase(phrase); call && call->order > 0 && call->by_symbols) return true;
    if (phrase.kind == Kind::power) return is_tall(phrase.args[0]);
    return std::any_of(phrase.args.begin(), phrase.args.end(), is_tall);
}

std::string in_parentheses(const std::string& content, bool tall) {
    return tall ? fmt::format("\\left({}\\right)", content) : fmt::format("({})", content);
}

std::string parenthesized(const Phrase& phrase) {
    return in_parentheses(write(phrase), is_tall(phrase));
}

bool is_signed_or_sum(const Phrase& phrase) {
    return phrase.kind == Kind::sum || phrase.kind == Kind::negative;
}

std::string enclosed(const Phrase& phrase, bool parentheses) {
    return parentheses ? parenthesized(phrase) : write(phrase);
}

std::string fraction(const std::string& above, const std::string& below) {
    return fmt::format("\\frac{{{}}}{{{}}}", above, below);
}

std::string number_latex(const Phrase& phrase) {
    if (std::string plain = digits(phrase); !plain.empty()) return plain;
    std::ostringstream above, below;
    above << cln::numerator(phrase.value);
    below << cln::denominator(phrase.value);
    return fraction(above.str(), below.str());
}

std::string symbol_latex(const SymbolInfo& info) {
    const Lettering letters = lettering(info.name);
    std::string result = latex_letters(letters.stem);
    if (info.order > 0 && info.order <= 4) result = fmt::format("\\{:d>{}}ot{{{}}}", "", info.order, result);
    if (!letters.index.empty() || info.before)
        result += fmt::format("_{{{}{}}}", latex_letters(letters.index), info.before ? "-" : "");
    if (info.order > 4) result += fmt::format("^{{({})}}", info.order);
    if (info.kind == SymbolInfo::Kind::input) result += "(t)";
    return result;
}

bool is_spelled_out(const Phrase& factor) {
    const Phrase& base = factor.kind == Kind::power ? factor.args[0] : factor;
    return base.kind == Kind::symbol && is_word(lettering(base.info.name).stem);
}

bool begins_with_digit(const Phrase& factor) {
    return factor.kind == Kind::number || (factor.kind == Kind::power && factor.args[0].kind == Kind::number);
}

std::string write_product(const std::vector<Phrase>& factors) {
    std::string result;
    for (std::size_t i = 0; i < factors.size(); ++i) {
        const bool apart = i > 0 && (is_spelled_out(factors[i]) || is_spelled_out(factors[i - 1]));
        if (i > 0) result += begins_with_digit(factors[i]) ? " \\cdot " : apart ? " \\, " : " ";
        result += enclosed(factors[i], is_signed_or_sum(factors[i]));
    }
    return result;
}

std::string write_quotient(const Phrase& phrase) {
    const Fronted fronted = take_front(phrase);
    if (!fronted.front.is_number(1) && !fronted.rest.is_number(1) && fronted.rest.kind != Kind::sum) {
        return fmt::format("{} {}", number_latex(fronted.front), write(fronted.rest));
    }
    return fraction(write(phrase.args[0]), write(phrase.args[1]));
}

std::string function_latex(const std::string& name) {
    static const std::map<std::string, std::string> names{{"asin", "\\arcsin"},
                                                          {"acos", "\\arccos"},
                                                          {"atan", "\\arctan"},
                                                          {"log", "\\ln"},
                                                          {"signum", "\\operatorname{sgn}"},
                                                          {"minimum", "\\min"},
                                                          {"maximum", "\\max"}};
    for (const char* own : {"sin", "cos", "tan", "sinh", "cosh", "tanh"})
        if (name == own) return fmt::format("\\{}", name);
    const auto found = names.find(name);
    if (found != names.end()) return found->second;
    std::string plain;
    for (const char c : name) plain += c == '_' ? std::string("\\_") : std::string(1, c);
    return fmt::format("\\operatorname{{{}}}", plain);
}

bool takes_exponent(const std::string& name) {
    return function_latex(name) == fmt::format("\\{}", name);
}

/// dV/dr, f'(x - c), ∂²f/∂x∂y; ∂₁f(x, 2x) where no letter says by which argument is differentiated.
std::string write_unspecified(const UnspecifiedPhrase& call) {
    std::string args;
    for (const Phrase* arg : call.arguments) args += fmt::format("{}{}", args.empty() ? "" : ", ", write(*arg));
    const bool tall =
        std::any_of(call.arguments.begin(), call.arguments.end(), [](const Phrase* a) { return is_tall(*a); });
    const std::string letter = symbol_latex(call.function->info), of = in_parentheses(args, tall);
    if (call.order == 0) return letter + of;
    const auto raised = [](int order) { return order == 1 ? "" : fmt::format("^{{{}}}", order); };
    const bool alone = call.arguments.size() == 1;
    if (call.by_symbols) {
        const std::string d = alone ? "\\mathrm{d}" : "\\partial";
        const std::string gap = alone ? "" : " ";
        std::string below;
        for (std::size_t k = 0; k < call.orders.size(); ++k)
            if (call.orders[k] > 0)
                below += fmt::format("{}{}{}{}{}", below.empty() ? "" : " \\, ", d, gap, write(*call.arguments[k]),
                                     raised(call.orders[k]));
        return fraction(d + raised(call.order) + gap + letter, below);
    }
    if (alone)
        return letter +
               (call.order <= 3 ? std::string(static_cast<std::size_t>(call.order), '\'')
                                : fmt::format("^{{({})}}", call.order)) +
               of;
    std::string result;
    for (std::size_t k = 0; k < call.orders.size(); ++k)
        if (call.orders[k] > 0) result += fmt::format("\\partial_{{{}}}{} ", k + 1, raised(call.orders[k]));
    return result + letter + of;
}

/// f^{e}(x); sin θ without parentheses.
std::string write_call(const Phrase& phrase, const std::string& exponent) {
    if (const auto call = unspecified_phrase(phrase)) return write_unspecified(*call);
    if (phrase.name == "sqrt") return fmt::format("\\sqrt{{{}}}", write(phrase.args[0]));
    if (phrase.name == "exp") return fmt::format("\\mathrm{{e}}^{{{}}}", write(phrase.args[0]));
    if (phrase.name == "abs") return fmt::format("\\left|{}\\right|", write(phrase.args[0]));
    const std::string name = phrase.name.empty() ? "" : function_latex(phrase.name) + exponent;
    const Phrase& arg = phrase.args[0];
    const bool bare =
        takes_exponent(phrase.name) && arg.kind == Kind::symbol && arg.info.kind != SymbolInfo::Kind::input;
    if (bare) return name + (exponent.empty() && write(arg)[0] != '\\' ? " " : "") + write(arg);
    std::string args;
    for (const Phrase& each : phrase.args) args += fmt::format("{}{}", args.empty() ? "" : ", ", write(each));
    const bool tall = std::any_of(phrase.args.begin(), phrase.args.end(), is_tall);
    return name + in_parentheses(args, tall);
}

std::string write_power(const Phrase& base, const Phrase& exponent) {
    const std::string raised = fmt::format("^{{{}}}", is_fraction(exponent) ? text(exponent) : write(exponent));
    const bool is_whole = exponent.kind == Kind::number && is_integer(exponent.value);
    if (base.kind == Kind::call && takes_exponent(base.name) && is_whole) return write_call(base, raised);
    const bool simple = base.kind == Kind::symbol || (base.kind == Kind::number && !digits(base).empty()) ||
                        (base.kind == Kind::call && base.name == "abs");
    return enclosed(base, !simple) + raised;
}

std::string write(const Phrase& phrase) {
    switch (phrase.kind) {
        case Kind::number:
            return number_latex(phrase);
        case Kind::symbol:
            return symbol_latex(phrase.info);
        case Kind::product:
            return write_product(phrase.args);
        case Kind::quotient:
            return write_quotient(phrase);
        case Kind::power:
            return write_power(phrase.args[0], phrase.args[1]);
        case Kind::call:
            return write_call(phrase, "");
        case Kind::negative:
            return fmt::format("-{}", enclosed(phrase.args[0], is_signed_or_sum(phrase.args[0])));
        case Kind::sum:
            break;
    }
    std::string result;
    for (const Phrase& term : phrase.args) {
        const bool is_negative = term.kind == Kind::negative;
        const Phrase& value = is_negative ? term.args[0] : term;
        const char* first = is_negative ? "-" : "";
        const char* next = is_negative ? " - " : " + ";
        result += result.empty() ? first : next;
        result += enclosed(value, is_signed_or_sum(value));
    }
    return result;
}

}  // namespace

std::string latex(const Phrase& phrase) {
    return write(phrase);
}

}  // namespace alembert
