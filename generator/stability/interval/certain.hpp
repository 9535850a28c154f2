// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// A real number with its accuracy: exact if that is possible, otherwise an interval given by its middle and
/// radius.
///
///     const Certain x = sqrt(Certain(Rational(8)));      // 2·√2, exactly
///     (x*x - 8).sign()                                   // 0
///     exp(Certain(1)).sign()                             // 1: the interval lies to the right of zero
///     (exp(Certain(1)) - exp(Certain(1))).sign()         // nothing: the interval holds zero
///
/// Exact numbers have the form a + b·√d (a and b rational, d a whole number without square factors) or a + b·π;
/// sums and products of other forms become intervals with 34 digits. Sines and cosines of multiples of π/12 and
/// the usual arcs are exact. A verdict of stability needs signs; if a sign is not known, there is no verdict.

#include <optional>
#include <string>

#include "program/quad.hpp"

namespace alembert {

using Rational = cln::cl_RA;

class Certain {
public:
    Certain() = default;
    Certain(int whole) : a_(whole) {}                    // NOLINT: a number is a number
    Certain(const Rational& rational) : a_(rational) {}  // NOLINT
    static Certain about(Quad middle, double radius);    ///< [middle − radius, middle + radius]
    static Certain root(const Rational& a, const Rational& b, const cln::cl_I& d);  ///< a + b·√d
    static Certain pi_multiple(const Rational& a, const Rational& b);               ///< a + b·π

    bool is_exact() const { return form_ != Form::interval; }
    std::optional<Rational> rational() const;
    std::optional<Rational> multiple_of_pi() const;  ///< b if the number is b·π; 0 for 0
    std::optional<int> sign() const;                 ///< nothing if the interval contains zero
    bool is_zero() const { return sign() == 0; }
    bool may_be_zero() const { return !sign() || sign() == 0; }
    Quad middle() const;
    double radius() const;
    double number() const { return static_cast<double>(middle()); }

    Certain& operator+=(const Certain& b) { return *this = *this + b; }
    Certain& operator-=(const Certain& b) { return *this = *this - b; }
    Certain& operator*=(const Certain& b) { return *this = *this * b; }
    friend Certain operator+(const Certain& a, const Certain& b);
    friend Certain operator-(const Certain& a, const Certain& b) { return a + -b; }
    friend Certain operator-(const Certain& a);
    friend Certain operator*(const Certain& a, const Certain& b);
    /// The quotient; an interval without bounds if b may be zero.
    friend Certain operator/(const Certain& a, const Certain& b);

private:
    enum class Form { root, pi, interval };
    static Certain unknown() { return about(0, 1e300); }
    Certain kept() const;  ///< the number, as an interval if its fractions are too long

    Form form_ = Form::root;
    Rational a_ = 0, b_ = 0;
    cln::cl_I d_ = 1;
    Quad middle_ = 0;
    double radius_ = 0;

    friend Certain inverse(const Certain& a);
};

Certain sin(const Certain& x);
Certain cos(const Certain& x);
Certain tan(const Certain& x);
Certain asin(const Certain& x);
Certain acos(const Certain& x);
Certain atan(const Certain& x);
Certain atan2(const Certain& y, const Certain& x);
Certain sinh(const Certain& x);
Certain cosh(const Certain& x);
Certain tanh(const Certain& x);
Certain exp(const Certain& x);
Certain log(const Certain& x);
Certain sqrt(const Certain& x);
Certain pow(const Certain& x, const Certain& exponent);

}  // namespace alembert
