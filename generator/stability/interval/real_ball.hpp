// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// A real number with its accuracy: exact if that is possible, otherwise an interval given by its middle and
/// radius.
///
///     const RealBall x = sqrt(RealBall(Rational(8)));    // 2·√2, exactly
///     (x*x - 8).sign()                                   // 0
///     exp(RealBall(1)).sign()                            // 1: the interval lies to the right of zero
///     (exp(RealBall(1)) - exp(RealBall(1))).sign()       // nothing: the interval holds zero
///
/// Exact numbers have the form a + b·√d (a and b rational, d a whole number without square factors) or a + b·π;
/// sums and products of other forms become intervals with 34 digits. Sines and cosines of multiples of π/12 and
/// the usual arcs are exact. A verdict of stability needs signs; if a sign is not known, there is no verdict.

#include <optional>
#include <string>

#include "program/quad.hpp"

namespace alembert {

using Rational = cln::cl_RA;

class RealBall {
public:
    RealBall() = default;
    RealBall(int whole) : a_(whole) {}                    // NOLINT: a number is a number
    RealBall(const Rational& rational) : a_(rational) {}  // NOLINT
    static RealBall about(Quad middle, double radius);    ///< [middle − radius, middle + radius]
    static RealBall root(const Rational& a, const Rational& b, const cln::cl_I& d);  ///< a + b·√d
    static RealBall pi_multiple(const Rational& a, const Rational& b);               ///< a + b·π

    bool is_exact() const { return form_ != Form::interval; }
    std::optional<Rational> rational() const;
    std::optional<Rational> multiple_of_pi() const;  ///< b if the number is b·π; 0 for 0
    std::optional<int> sign() const;                 ///< nothing if the interval contains zero
    bool is_zero() const { return sign() == 0; }
    bool may_be_zero() const { return !sign() || sign() == 0; }
    Quad middle() const;
    double radius() const;
    double number() const { return static_cast<double>(middle()); }

    RealBall& operator+=(const RealBall& b) { return *this = *this + b; }
    RealBall& operator-=(const RealBall& b) { return *this = *this - b; }
    RealBall& operator*=(const RealBall& b) { return *this = *this * b; }
    friend RealBall operator+(const RealBall& a, const RealBall& b);
    friend RealBall operator-(const RealBall& a, const RealBall& b) { return a + -b; }
    friend RealBall operator-(const RealBall& a);
    friend RealBall operator*(const RealBall& a, const RealBall& b);
    /// The quotient; an interval without bounds if b may be zero.
    friend RealBall operator/(const RealBall& a, const RealBall& b);

private:
    enum class Form { root, pi, interval };
    static RealBall unknown() { return about(0, 1e300); }
    RealBall kept() const;  ///< the number, as an interval if its fractions are too long

    Form form_ = Form::root;
    Rational a_ = 0, b_ = 0;
    cln::cl_I d_ = 1;
    Quad middle_ = 0;
    double radius_ = 0;

    friend RealBall inverse(const RealBall& a);
};

RealBall sin(const RealBall& x);
RealBall cos(const RealBall& x);
RealBall tan(const RealBall& x);
RealBall asin(const RealBall& x);
RealBall acos(const RealBall& x);
RealBall atan(const RealBall& x);
RealBall atan2(const RealBall& y, const RealBall& x);
RealBall sinh(const RealBall& x);
RealBall cosh(const RealBall& x);
RealBall tanh(const RealBall& x);
RealBall exp(const RealBall& x);
RealBall log(const RealBall& x);
RealBall sqrt(const RealBall& x);
RealBall pow(const RealBall& x, const RealBall& exponent);

}  // namespace alembert
