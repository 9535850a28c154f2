// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// A formula as it stands on paper. The order of terms and factors, the fractions and the parentheses are part of
/// it.
///
///     const Phrase p = phrases::product({m, phrases::power(v, 2)});    // m*v^2
///     text(p), latex(p), mathml(p), expression(p)
///
/// The printers change only the notation. Numbers in a phrase are not negative: signs are `negative` nodes, which
/// a sum prints as minus.

#include <ginac/ginac.h>

#include <string>
#include <vector>

#include "algebra/symbolic/polynomial.hpp"

namespace alembert {

struct Phrase {
    enum class Kind {
        number,
        symbol,    ///< info, symbol; π too
        sum,       ///< at least two args
        product,   ///< at least two args
        quotient,  ///< numerator, denominator
        power,     ///< base, exponent
        call,      ///< name, args
        negative,  ///< one arg
    };
    Kind kind = Kind::number;
    Rational value = 0;
    bool decimal = false;  ///< whether the number is written 0.4 rather than 2/5
    SymbolInfo info;
    GiNaC::ex symbol;
    std::string name;
    std::vector<Phrase> args;

    bool is_number(const Rational& n) const { return kind == Kind::number && value == n; }
};

/// Functions that make phrases.
namespace phrases {

/// A `negative` if value < 0. With `decimal`, a fraction that is a finite decimal is written as one.
Phrase number(const Rational& value, bool decimal = false);
Phrase symbol(const GiNaC::ex& symbol, const SymbolInfo& info);
Phrase pi();
Phrase sum(std::vector<Phrase> terms);        ///< 0 if there are no terms; terms that are sums are merged into it
Phrase product(std::vector<Phrase> factors);  ///< 1 if there are no factors, the factor itself if there is one
Phrase quotient(Phrase numerator, Phrase denominator);
Phrase power(Phrase base, const Rational& exponent);
Phrase power(Phrase base, Phrase exponent);
Phrase call(std::string name, std::vector<Phrase> args);
Phrase tuple(std::vector<Phrase> elements);  ///< (1, 0, -1): a call without a name
Phrase negative(Phrase arg);                 ///< drops a double negation

}  // namespace phrases

/// The length of a phrase for a reader; the shorter of two forms is the one with the lower cost.
int cost(const Phrase& phrase);

/// Converts a phrase to GiNaC. Throws std::runtime_error for a function that GiNaC does not know.
GiNaC::ex expression(const Phrase& phrase);

/// Whether a number is better written as a decimal, like 9.81. True for finite decimals that are no customary
/// fractions such as 3/4 and 2/5.
bool is_decimal(const Rational& value);
/// Whether a number beside decimals is written as a decimal too: 0.4 is, but a half stays 1/2.
bool reads_as_decimal(const Rational& value);
/// Whether the denominator has no prime factors other than 2 and 5.
bool is_finite_decimal(const Rational& value);

/// The digits of a number phrase: `12`, `9.81`, or empty for a fraction.
std::string digits(const Phrase& number);

/// In print a number such as the 2/3 of `2/3·x` or the 1/2 of `x/2` stands in front as a fraction. Splits a
/// product or quotient into the number in front (1 if there is none) and the rest.
struct Fronted {
    Phrase front;  ///< a number, 1 if there is none
    Phrase rest;   ///< 1 if nothing is left
};
Fronted take_front(const Phrase& phrase);

}  // namespace alembert
