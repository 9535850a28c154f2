// SPDX-License-Identifier: MIT
#pragma once

/// Real numbers of 60 digits, for tests that decide what is true.
///
///     interpret<Digits>(program, state)        // accelerations that no rounding of ours can spoil
///
/// A division by zero throws what CLN throws.

#include <cln/float.h>
#include <cln/real.h>

#include <algorithm>

#include "program/interpret.hpp"

namespace alembert::test {

class Digits {
public:
    Digits(int n = 0) : x_(cln::cl_float(cln::cl_I(n), format())) {}  // NOLINT: a number is a number
    Digits(bool b) : Digits(b ? 1 : 0) {}                             // NOLINT
    explicit Digits(double x) : x_(cln::cl_float(cln::rational(cln::cl_DF(x)), format())) {}
    explicit Digits(const cln::cl_R& x) : x_(cln::cl_float(x, format())) {}

    const cln::cl_F& value() const { return x_; }
    bool is_zero() const { return cln::zerop(x_); }
    /// log₁₀ of the size; −1000 for zero.
    double magnitude() const {
        if (is_zero()) return -1000;
        const auto exponent = static_cast<double>(cln::float_exponent(x_));
        return std::log10(std::abs(cln::double_approx(cln::scale_float(x_, -cln::float_exponent(x_))))) +
               exponent * std::log10(2.0);
    }

    friend Digits operator+(const Digits& a, const Digits& b) { return Digits(cln::cl_R(a.x_ + b.x_)); }
    friend Digits operator-(const Digits& a, const Digits& b) { return Digits(cln::cl_R(a.x_ - b.x_)); }
    friend Digits operator*(const Digits& a, const Digits& b) { return Digits(cln::cl_R(a.x_ * b.x_)); }
    friend Digits operator/(const Digits& a, const Digits& b) { return Digits(cln::cl_R(a.x_ / b.x_)); }
    friend Digits operator-(const Digits& a) { return Digits(cln::cl_R(-a.x_)); }
    Digits& operator+=(const Digits& b) { return *this = *this + b; }
    Digits& operator-=(const Digits& b) { return *this = *this - b; }
    Digits& operator*=(const Digits& b) { return *this = *this * b; }
    friend bool operator<(const Digits& a, const Digits& b) { return a.x_ < b.x_; }
    friend bool operator>(const Digits& a, const Digits& b) { return b < a; }
    friend bool operator!=(const Digits& a, const Digits& b) { return a < b || b < a; }

    friend Digits abs(const Digits& a) { return Digits(cln::cl_R(cln::abs(a.x_))); }
    friend Digits sin(const Digits& a) { return of(cln::sin(real(a))); }
    friend Digits cos(const Digits& a) { return of(cln::cos(real(a))); }
    friend Digits tan(const Digits& a) { return sin(a) / cos(a); }
    friend Digits atan(const Digits& a) { return of(cln::atan(real(a))); }
    friend Digits atan2(const Digits& y, const Digits& x) { return of(cln::atan(real(x), real(y))); }
    friend Digits asin(const Digits& a) { return atan2(a, sqrt(1 - a * a)); }
    friend Digits acos(const Digits& a) { return atan2(sqrt(1 - a * a), a); }
    friend Digits sqrt(const Digits& a) {
        if (a < 0) throw std::domain_error("the root of a negative number");
        return of(cln::sqrt(real(a)));
    }
    friend Digits exp(const Digits& a) { return of(cln::exp(real(a))); }
    friend Digits log(const Digits& a) {
        if (!(a > 0)) throw std::domain_error("the logarithm of a number that is not positive");
        return of(cln::ln(real(a)));
    }
    friend Digits sinh(const Digits& a) { return (exp(a) - exp(-a)) / 2; }
    friend Digits cosh(const Digits& a) { return (exp(a) + exp(-a)) / 2; }
    friend Digits tanh(const Digits& a) { return sinh(a) / cosh(a); }
    friend Digits pow(const Digits& a, const Digits& b) { return exp(b * log(a)); }

private:
    static cln::float_format_t format() { return cln::float_format(60); }
    static cln::cl_R real(const Digits& a) { return a.x_; }
    static Digits of(const cln::cl_R& x) { return Digits(x); }
    cln::cl_F x_;
};

}  // namespace alembert::test

namespace alembert {
template <>
inline test::Digits real_of<test::Digits>(const Rational& r) {
    return test::Digits(cln::cl_R(r));
}
}  // namespace alembert
