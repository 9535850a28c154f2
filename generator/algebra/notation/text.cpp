// SPDX-License-Identifier: GPL-2.0-or-later
#include "algebra/notation/text.hpp"

#include <fmt/format.h>

#include <sstream>

#include <cln/integer.h>
#include <cln/integer_io.h>

#include "algebra/notation/unspecified.hpp"

namespace alembert {

namespace {

using Kind = Phrase::Kind;

std::string write(const Phrase& phrase);

std::string enclosed(const Phrase& phrase, bool parentheses) {
    return parentheses ? fmt::format("({})", write(phrase)) : write(phrase);
}

bool is_signed_or_sum(const Phrase& phrase) {
    return phrase.kind == Kind::sum || phrase.kind == Kind::negative;
}

std::string number_text(const Phrase& phrase) {
    if (std::string plain = digits(phrase); !plain.empty()) return plain;
    std::ostringstream stream;
    stream << cln::numerator(phrase.value) << '/' << cln::denominator(phrase.value);
    return stream.str();
}

bool is_fraction(const Phrase& phrase) {
    return phrase.kind == Kind::number && digits(phrase).empty();
}

std::string write_sum(const Phrase& phrase, const char* plus, const char* minus) {
    std::string result;
    for (const Phrase& term : phrase.args) {
        const bool is_negative = term.kind == Kind::negative;
        const Phrase& value = is_negative ? term.args[0] : term;
        const char* first = is_negative ? "-" : "";
        const char* next = is_negative ? minus : plus;
        result += result.empty() ? first : next;
        result += enclosed(value, is_signed_or_sum(value));
    }
    return result;
}

std::string write_product(const Phrase& phrase) {
    std::string result;
    for (const Phrase& factor : phrase.args) {
        if (!result.empty()) result += '*';
        result += enclosed(factor, is_signed_or_sum(factor));
    }
    return result;
}

/// V(r), diff(V(r),r), diff(f(x,c*t),x,2): as the scene language has it. diff(f(a,b),1,1) is by the first
/// argument, where its own expression would say more or less than that.
std::string write_unspecified(const UnspecifiedPhrase& call) {
    std::string args;
    for (const Phrase* arg : call.arguments) args += fmt::format("{}{}", args.empty() ? "" : ",", write(*arg));
    std::string value = fmt::format("{}({})", call.function->info.name, args);
    if (call.order == 0) return value;
    for (std::size_t k = 0; k < call.orders.size(); ++k) {
        if (call.orders[k] == 0) continue;
        const bool by_itself = call.is_by_itself(k);
        value += by_itself ? fmt::format(",{}", write(*call.arguments[k])) : fmt::format(",{}", k + 1);
        if (call.orders[k] > 1 || !by_itself) value += fmt::format(",{}", call.orders[k]);
    }
    return fmt::format("diff({})", value);
}

std::string write_call(const Phrase& phrase) {
    if (const auto call = unspecified_phrase(phrase)) return write_unspecified(*call);
    std::string args;
    for (const Phrase& arg : phrase.args) args += fmt::format("{}{}", args.empty() ? "" : ",", write(arg));
    return fmt::format("{}({})", language_name(phrase.name), args);
}

std::string write(const Phrase& phrase) {
    switch (phrase.kind) {
        case Kind::number:
            return number_text(phrase);
        case Kind::symbol:
            return phrase.info.text();
        case Kind::sum:
            return write_sum(phrase, "+", "-");
        case Kind::product:
            return write_product(phrase);
        case Kind::quotient: {
            const Phrase& below = phrase.args[1];
            const bool compound = is_signed_or_sum(below) || is_fraction(below) || below.kind == Kind::product ||
                                  below.kind == Kind::quotient;
            return fmt::format("{}/{}", enclosed(phrase.args[0], is_signed_or_sum(phrase.args[0])),
                               enclosed(below, compound));
        }
        case Kind::power: {
            const Phrase& base = phrase.args[0];
            const Phrase& exponent = phrase.args[1];
            const bool simple = base.kind == Kind::symbol || base.kind == Kind::call ||
                                (base.kind == Kind::number && !is_fraction(base));
            const bool flat = exponent.kind == Kind::symbol || exponent.kind == Kind::call ||
                              (exponent.kind == Kind::number && !is_fraction(exponent));
            return fmt::format("{}^{}", enclosed(base, !simple), enclosed(exponent, !flat));
        }
        case Kind::call:
            return write_call(phrase);
        case Kind::negative:
            return fmt::format("-{}", enclosed(phrase.args[0], is_signed_or_sum(phrase.args[0])));
    }
    return {};
}

}  // namespace

std::string language_name(const std::string& function) {
    return function == "signum"    ? "sign"
           : function == "minimum" ? "min"
           : function == "maximum" ? "max"
                                   : function;
}

std::string text(const Phrase& phrase) {
    return phrase.kind == Kind::sum ? write_sum(phrase, " + ", " - ") : write(phrase);
}

}  // namespace alembert
