// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// A formula as it stands on paper: the order of terms and factors, the fractions and parentheses are part of it.
///
///     const Phrase p = phrases::product({m, phrases::power(v, 2)});    // m*v^2
///     text(p), latex(p), mathml(p), expression(p)
///
/// The printers change nothing but the notation. Numbers in a phrase are not negative: signs are `negative` nodes,
/// and a sum reads them as minus.

#include <ginac/ginac.h>

#include <string>
#include <vector>

#include "symbolic/polynomial.hpp"

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
    bool decimal = false;  ///< the number is written 0.4, not 2/5
    SymbolInfo info;
    GiNaC::ex symbol;
    std::string name;
    std::vector<Phrase> args;

    bool is_number(const Rational& n) const { return kind == Kind::number && value == n; }
};

/// What phrases are made with.
namespace phrases {

/// A `negative` where value < 0. With `decimal` a fraction that ends as a decimal is written as one.
Phrase number(const Rational& value, bool decimal = false);
Phrase symbol(const GiNaC::ex& symbol, const SymbolInfo& info);
Phrase pi();
Phrase sum(std::vector<Phrase> terms);        ///< 0 for none; sums among the terms are joined to it
Phrase product(std::vector<Phrase> factors);  ///< 1 for none, the factor itself for one
Phrase quotient(Phrase numerator, Phrase denominator);
Phrase power(Phrase base, const Rational& exponent);
Phrase power(Phrase base, Phrase exponent);
Phrase call(std::string name, std::vector<Phrase> args);
Phrase tuple(std::vector<Phrase> elements);  ///< (1, 0, -1): a call without a name
Phrase negative(Phrase arg);                 ///< drops a double negation

}  // namespace phrases

/// How much there is to read; the shorter of two forms is the one with the lower cost.
int cost(const Phrase& phrase);

/// Back to GiNaC. Throws std::runtime_error for a function that GiNaC does not know.
GiNaC::ex expression(const Phrase& phrase);

/// 9.81 comes from a decimal, 3/4 and 2/5 are fractions: true where a finite decimal is no customary fraction.
bool is_decimal(const Rational& value);
/// Beside decimals a half is 1/2 and not 0.5, but two fifths are 0.4.
bool reads_as_decimal(const Rational& value);
/// No primes but 2 and 5 in the denominator.
bool is_finite_decimal(const Rational& value);

/// The digits of a number phrase: `12`, `9.81`, or empty for a fraction.
std::string digits(const Phrase& number);

/// `2/3·x` and `x/2` have the fraction in front where it is built over a bar. Gives the number in front (1 if
/// none) and what is left of a product or quotient.
struct Fronted {
    Phrase front;  ///< a number, 1 if none
    Phrase rest;   ///< 1 where nothing is left
};
Fronted take_front(const Phrase& phrase);

}  // namespace alembert
