// SPDX-License-Identifier: GPL-2.0-or-later
#include "codegen/emit/numbers.hpp"

#include <cln/float.h>
#include <cln/integer.h>
#include <cln/integer_io.h>
#include <cln/real.h>
#include <fmt/format.h>

#include <cmath>
#include <sstream>

#include "alembert/base/error.hpp"
#include "base/language/say.hpp"
#include "codegen/emit/dialect.hpp"

namespace alembert {

namespace {

std::string digits(const cln::cl_I& value) {
    std::ostringstream out;
    out << value;
    return out.str();
}

/// The nearest double, which must exist.
double nearest_double(const Rational& value) {
    const double nearest = cln::double_approx(value);
    if (std::isfinite(nearest)) return nearest;
    const double digits =
        (cln::integer_length(cln::numerator(value)) - cln::integer_length(cln::denominator(value))) *
        std::log10(2.0);
    throw ModelError(
        say("the equations contain a number of about 1e{:.0f}, which is too large for double precision: "
            "no code can hold it; give the scene other units, or a parameter in place of the number",
            digits));
}

}  // namespace

std::string shortest(double value) {
    return fmt::format("{}", value);
}

std::string literal(const std::string& digits, CodeLanguage language) {
    return dialect_of(language).literal(digits);
}

std::string number_text(const Rational& value, CodeLanguage language) {
    const cln::cl_I numerator = cln::numerator(value), denominator = cln::denominator(value);
    const cln::cl_I largest = cln::expt_pos(cln::cl_I(2), 53);
    if (denominator == 1 && cln::abs(numerator) <= largest) return literal(digits(numerator), language);
    const double nearest = nearest_double(value);
    // Where numbers are doubles a decimal such as 9.81 is written with its digits; else what no double is, 1/3, is
    // left to the division of Real, which has more digits or less.
    cln::cl_I rest = denominator;
    while (cln::zerop(cln::mod(rest, 2))) rest = cln::exquo(rest, 2);
    if (dialect_of(language).has_decimals)
        while (cln::zerop(cln::mod(rest, 5))) rest = cln::exquo(rest, 5);
    if (rest != 1 && cln::abs(numerator) <= largest && denominator <= largest)
        return fmt::format("({} / {})", literal(digits(numerator), language),
                           literal(digits(denominator), language));
    return literal(shortest(nearest), language);
}

std::string exact_text(const Rational& value) {
    const auto is_double = [](const Rational& r) {
        return cln::zerop(r) || cln::equal(cln::rational(cln::cl_DF(nearest_double(r))), r);
    };
    const auto text = [](const Rational& r) { return fmt::format("Real({})", shortest(cln::double_approx(r))); };
    nearest_double(value);
    if (is_double(value)) return text(value);
    const Rational above = cln::numerator(value), below = cln::denominator(value);
    if (is_double(above) && is_double(below)) return fmt::format("({} / {})", text(above), text(below));
    std::string sum;
    Rational rest = value;
    for (int part = 0; part < 3 && !cln::zerop(rest); ++part) {
        const Rational piece = cln::rational(cln::cl_DF(cln::double_approx(rest)));
        sum += (part > 0 ? " + " : "") + text(piece);
        rest = rest - piece;
    }
    return "(" + sum + ")";
}

}  // namespace alembert
