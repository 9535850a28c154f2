// SPDX-License-Identifier: GPL-2.0-or-later
#include "algebra/notation/mathml.hpp"

#include <fmt/format.h>

#include <array>
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

const std::string times = "<mo>&#x2062;</mo>";  // invisible
const std::string thin_space = "<mspace width=\"0.1667em\"></mspace>";
const std::string applied = "<mo>&#x2061;</mo>";  // function application, invisible

std::string write(const Phrase& phrase);

std::string element(const std::string& name, const std::string& content) {
    return fmt::format("<{0}>{1}</{0}>", name, content);
}
std::string row(const std::string& content) {
    return element("mrow", content);
}
std::string operation(const std::string& sign) {
    return element("mo", sign);
}
const std::string minus = operation("&#x2212;");

std::string identifier(const std::string& letters) {
    return element("mi", xml_escaped(letters));
}

bool is_signed_or_sum(const Phrase& phrase) {
    return phrase.kind == Kind::sum || phrase.kind == Kind::negative;
}

std::string parenthesized(const std::string& content) {
    return in_brackets(content, "(", ")");
}

std::string enclosed(const Phrase& phrase, bool parentheses) {
    return parentheses ? parenthesized(write(phrase)) : write(phrase);
}

std::string number_mathml(const Phrase& phrase) {
    if (const std::string plain = digits(phrase); !plain.empty()) return element("mn", plain);
    std::ostringstream above, below;
    above << cln::numerator(phrase.value);
    below << cln::denominator(phrase.value);
    return element("mfrac", element("mn", above.str()) + element("mn", below.str()));
}

/// The letter with its dots, and its index (empty if none).
std::pair<std::string, std::string> symbol_parts(const SymbolInfo& info) {
    const Lettering letters = lettering(info.name);
    std::string stem = identifier(letters.stem);
    constexpr std::array<const char*, 5> dots{"", "˙", "¨", "⃛", "⃜"};
    if (info.order > 0 && info.order < 5)
        stem = fmt::format("<mover accent=\"true\">{}{}</mover>", stem,
                           operation(dots[static_cast<std::size_t>(info.order)]));
    else if (info.order > 0)
        stem = element("msup",
                       stem + row(operation("(") + element("mn", std::to_string(info.order)) + operation(")")));
    const bool is_number = letters.index.find_first_not_of("0123456789") == std::string::npos;
    std::string index;
    if (!letters.index.empty()) index = is_number ? element("mn", letters.index) : identifier(letters.index);
    if (info.before) index = row(index + operation("-"));
    return {stem, index};
}

std::string symbol_mathml(const SymbolInfo& info) {
    const auto [stem, index] = symbol_parts(info);
    const std::string letter = index.empty() ? stem : element("msub", stem + index);
    if (info.kind != SymbolInfo::Kind::input) return letter;
    return row(letter + applied + parenthesized(element("mi", "t")));
}

/// Whether it begins with the upright name of a function, before which TeX sets a thin space: sin θ, sin² θ.
bool has_function_first(const Phrase& phrase) {
    const Phrase& first = phrase.kind == Kind::power ? phrase.args[0] : phrase;
    return first.kind == Kind::call && !first.name.empty() && first.name != "sqrt" && first.name != "exp" &&
           first.name != "abs" && !unspecified_phrase(first);
}

std::string write_product(const Phrase& phrase) {
    std::string result;
    for (const Phrase& factor : phrase.args) {
        if (!result.empty())
            result += factor.kind == Kind::number  ? operation("&#x22C5;")
                      : has_function_first(factor) ? times + thin_space
                                                   : times;
        result += enclosed(factor, is_signed_or_sum(factor));
    }
    return row(result);
}

std::string write_quotient(const Phrase& phrase) {
    const Fronted fronted = take_front(phrase);
    if (!fronted.front.is_number(1) && !fronted.rest.is_number(1) && fronted.rest.kind != Kind::sum)
        return row(number_mathml(fronted.front) + times + write(fronted.rest));
    return element("mfrac", write(phrase.args[0]) + write(phrase.args[1]));
}

std::string function_name_mathml(const std::string& name) {
    static const std::map<std::string, std::string> names{
        {"asin", "arcsin"}, {"acos", "arccos"}, {"atan", "arctan"}, {"log", "ln"},
        {"signum", "sgn"},  {"minimum", "min"}, {"maximum", "max"}};
    const auto found = names.find(name);
    return identifier(found == names.end() ? name : found->second);
}

bool takes_exponent(const std::string& name) {
    for (const char* own : {"sin", "cos", "tan", "sinh", "cosh", "tanh"})
        if (name == own) return true;
    return false;
}

/// As in LaTeX: dV/dr, f′(x − c), ∂²f/∂x∂y.
std::string write_unspecified(const UnspecifiedPhrase& call) {
    std::string args;
    for (const Phrase* arg : call.arguments) args += (args.empty() ? "" : "<mo>,</mo>") + write(*arg);
    const std::string letter = symbol_mathml(call.function->info), of = applied + parenthesized(args);
    if (call.order == 0) return row(letter + of);
    const auto raised = [](const std::string& base, int order) {
        return order == 1 ? base : element("msup", base + element("mn", std::to_string(order)));
    };
    const bool alone = call.arguments.size() == 1;
    if (call.by_symbols) {
        const std::string d = alone ? "<mi mathvariant=\"normal\">d</mi>" : operation("&#x2202;");
        std::string below;
        for (std::size_t k = 0; k < call.orders.size(); ++k)
            if (call.orders[k] > 0) below += d + raised(write(*call.arguments[k]), call.orders[k]);
        return element("mfrac", row(raised(d, call.order) + letter) + row(below));
    }
    if (alone) {
        std::string primes;
        for (int k = 0; k < call.order; ++k) primes += "&#x2032;";
        return row(element("msup", letter + operation(primes)) + of);
    }
    std::string result;
    for (std::size_t k = 0; k < call.orders.size(); ++k)
        if (call.orders[k] > 0)
            result += raised(element("msub", operation("&#x2202;") + element("mn", std::to_string(k + 1))),
                             call.orders[k]);
    return row(result + letter + of);
}

std::string write_call(const Phrase& phrase, const std::string& name) {
    if (const auto call = unspecified_phrase(phrase)) return write_unspecified(*call);
    if (phrase.name == "sqrt") return element("msqrt", write(phrase.args[0]));
    if (phrase.name == "exp") return element("msup", "<mi mathvariant=\"normal\">e</mi>" + write(phrase.args[0]));
    if (phrase.name == "abs") return row(operation("|") + write(phrase.args[0]) + operation("|"));
    const Phrase& arg = phrase.args[0];
    const bool bare =
        takes_exponent(phrase.name) && arg.kind == Kind::symbol && arg.info.kind != SymbolInfo::Kind::input;
    std::string args;
    for (const Phrase& each : phrase.args)
        args += fmt::format("{}{}", args.empty() ? "" : "<mo>,</mo>", write(each));
    if (phrase.name.empty()) return parenthesized(args);
    return row(name + applied + (bare ? thin_space + args : parenthesized(args)));
}

/// 3/2 on the line, not as a fraction in small print.
std::string write_exponent(const Phrase& exponent) {
    if (exponent.kind != Kind::number || !digits(exponent).empty()) return write(exponent);
    const std::string line = text(exponent);
    const std::size_t slash = line.find('/');
    return row(element("mn", line.substr(0, slash)) + operation("/") + element("mn", line.substr(slash + 1)));
}

std::string write_power(const Phrase& base, const Phrase& exponent) {
    const std::string raised = write_exponent(exponent);
    const bool is_whole = exponent.kind == Kind::number && is_integer(exponent.value);
    if (base.kind == Kind::call && takes_exponent(base.name) && is_whole)
        return write_call(base, element("msup", function_name_mathml(base.name) + raised));
    if (base.kind == Kind::symbol && base.info.kind != SymbolInfo::Kind::input) {
        const auto [stem, index] = symbol_parts(base.info);
        return index.empty() ? element("msup", stem + raised) : element("msubsup", stem + index + raised);
    }
    const bool simple = base.kind == Kind::symbol || (base.kind == Kind::number && !digits(base).empty()) ||
                        (base.kind == Kind::call && base.name == "abs");
    return element("msup", enclosed(base, !simple) + raised);
}

std::string write(const Phrase& phrase) {
    switch (phrase.kind) {
        case Kind::number:
            return number_mathml(phrase);
        case Kind::symbol:
            return symbol_mathml(phrase.info);
        case Kind::product:
            return write_product(phrase);
        case Kind::quotient:
            return write_quotient(phrase);
        case Kind::power:
            return write_power(phrase.args[0], phrase.args[1]);
        case Kind::call:
            return write_call(phrase, function_name_mathml(phrase.name));
        case Kind::negative:
            return row(minus + enclosed(phrase.args[0], is_signed_or_sum(phrase.args[0])));
        case Kind::sum:
            break;
    }
    std::string result;
    for (const Phrase& term : phrase.args) {
        const bool is_negative = term.kind == Kind::negative;
        const Phrase& value = is_negative ? term.args[0] : term;
        if (is_negative || !result.empty()) result += is_negative ? minus : operation("+");
        result += enclosed(value, is_signed_or_sum(value));
    }
    return row(result);
}

std::string math(const std::string& content) {
    return fmt::format("<math xmlns=\"http://www.w3.org/1998/Math/MathML\" display=\"block\">{}</math>", content);
}

}  // namespace

std::string in_brackets(const std::string& content, const std::string& open, const std::string& close) {
    const auto has = [&](const char* tall) { return content.find(tall) != std::string::npos; };
    const bool is_tall = has("<mfrac") || has("<msqrt") || has("<mtable");
    const std::string bracket = is_tall ? "<mo stretchy=\"true\">" : "<mo stretchy=\"false\">";
    return row(bracket + open + "</mo>" + content + bracket + close + "</mo>");
}

std::string mathml(const Phrase& phrase) {
    return math(write(phrase));
}

std::string mathml(const Phrase& lhs, const Phrase& rhs) {
    return math(row(write(lhs) + operation("=") + write(rhs)));
}

}  // namespace alembert
