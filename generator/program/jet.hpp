// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// A value with its gradient: `interpret` over jets differentiates a Program exactly, node by node.
///
///     State<Jet<long double>> state = …;
///     state.q[0] = {.value = 0.3, .d = {1, 0}};                  // x itself: ∂x/∂x = 1
///     interpret(program, state)[node].d                          // ∂node/∂x, ∂node/∂y; empty stands for zeros
///
/// Forward mode (Griewank & Walther, Evaluating Derivatives (2008), §3.1): each node's gradient follows by the
/// chain rule from those of its arguments, so the derivative has rounding errors only. At a kink of abs, sign, min
/// or max it is the derivative of one side of this function; in a sum of several such functions the result need
/// not belong to any side of the sum. puiseux_series.hpp gives one-sided derivatives.

#include "program/interpret.hpp"

namespace alembert {

template <typename Real>
struct Jet {
    Real value = 0;
    std::vector<Real> d = {};

    Jet() = default;
    Jet(int n) : value(static_cast<Real>(n)) {}    // NOLINT: a number is a number
    Jet(bool b) : value(b ? Real(1) : Real(0)) {}  // NOLINT
    explicit Jet(Real x) : value(x) {}
    Jet(Real x, std::vector<Real> gradient) : value(x), d(std::move(gradient)) {}

    static Jet of_double(double x) { return Jet(static_cast<Real>(x)); }
    friend double place_of(const Jet& a) { return static_cast<double>(a.value); }

    Real derivative(std::size_t k) const { return k < d.size() ? d[k] : Real(0); }

    Jet& operator+=(const Jet& b) {
        value += b.value;
        add(b, Real(1));
        return *this;
    }
    Jet& operator*=(const Jet& b) {
        for (Real& x : d) x *= b.value;
        add(b, value);
        value *= b.value;
        return *this;
    }
    friend Jet operator+(Jet a, const Jet& b) { return a += b; }
    friend Jet operator*(Jet a, const Jet& b) { return a *= b; }
    friend Jet operator-(const Jet& a, const Jet& b) {
        Jet result = a;
        result.value -= b.value;
        result.add(b, Real(-1));
        return result;
    }
    friend Jet operator/(Jet a, const Jet& b) {
        Jet result = std::move(a);
        result.value /= b.value;
        for (Real& x : result.d) x /= b.value;
        result.add(b, -result.value / b.value);
        return result;
    }
    friend bool operator<(const Jet& a, const Jet& b) { return a.value < b.value; }
    friend bool operator>(const Jet& a, const Jet& b) { return b < a; }
    friend bool operator!=(const Jet& a, const Jet& b) { return a.value != b.value; }

    friend Jet sin(const Jet& a) { return through(a, std::sin(a.value), std::cos(a.value)); }
    friend Jet cos(const Jet& a) { return through(a, std::cos(a.value), -std::sin(a.value)); }
    friend Jet tan(const Jet& a) {
        return through(a, std::tan(a.value), 1 / (std::cos(a.value) * std::cos(a.value)));
    }
    friend Jet asin(const Jet& a) { return through(a, std::asin(a.value), 1 / std::sqrt(1 - a.value * a.value)); }
    friend Jet acos(const Jet& a) { return through(a, std::acos(a.value), -1 / std::sqrt(1 - a.value * a.value)); }
    friend Jet atan(const Jet& a) { return through(a, std::atan(a.value), 1 / (1 + a.value * a.value)); }
    friend Jet sinh(const Jet& a) { return through(a, std::sinh(a.value), std::cosh(a.value)); }
    friend Jet cosh(const Jet& a) { return through(a, std::cosh(a.value), std::sinh(a.value)); }
    friend Jet tanh(const Jet& a) {
        return through(a, std::tanh(a.value), 1 / (std::cosh(a.value) * std::cosh(a.value)));
    }
    friend Jet exp(const Jet& a) { return through(a, std::exp(a.value), std::exp(a.value)); }
    friend Jet log(const Jet& a) { return through(a, std::log(a.value), 1 / a.value); }
    friend Jet sqrt(const Jet& a) { return through(a, std::sqrt(a.value), 1 / (2 * std::sqrt(a.value))); }
    friend Jet abs(const Jet& a) { return through(a, std::abs(a.value), a.value < 0 ? Real(-1) : Real(1)); }
    friend Jet pow(const Jet& a, const Jet& b) {
        const Real p = std::pow(a.value, b.value);
        Jet result = through(a, p, b.value * std::pow(a.value, b.value - 1));
        if (!b.d.empty()) result.add(b, p * std::log(a.value));
        return result;
    }
    friend Jet atan2(const Jet& y, const Jet& x) {
        const Real square = x.value * x.value + y.value * y.value;
        Jet result = through(y, std::atan2(y.value, x.value), x.value / square);
        result.add(x, -y.value / square);
        return result;
    }

    /// The value and the gradient of b times a number are added to these.
    void add_multiple_of(const Jet& b, Real factor) {
        value += factor * b.value;
        add(b, factor);
    }

private:
    void add(const Jet& b, Real factor) {
        const std::size_t common = std::min(d.size(), b.d.size());
        for (std::size_t k = 0; k < common; ++k) d[k] += factor * b.d[k];
        d.reserve(b.d.size());
        for (std::size_t k = common; k < b.d.size(); ++k) d.push_back(factor * b.d[k]);
    }
    static Jet through(const Jet& a, Real value, Real slope) {
        Jet result(value, a.d);
        for (Real& x : result.d) x *= slope;
        return result;
    }
};

template <>
inline Jet<double> real_of<Jet<double>>(const Rational& r) {
    return Jet<double>(real_of<double>(r));
}
template <>
inline Jet<long double> real_of<Jet<long double>>(const Rational& r) {
    return Jet<long double>(real_of<long double>(r));
}

template <typename Real>
void add_multiple(Jet<Real>& sum, const Rational& factor, const Jet<Real>& x) {
    sum.add_multiple_of(x, real_of<Real>(factor));
}

}  // namespace alembert
