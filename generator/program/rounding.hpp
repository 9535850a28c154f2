// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// How far rounding may move a value of a program away from the value at the exact state: numbers with a bound on
/// their error, to first order (Higham, Accuracy and Stability of Numerical Algorithms (2002), §3.3). And how
/// large the terms of a value are before they cancel.
///
///     const std::vector<double> error = rounding_errors(program, state);   // cos(θ) at θ = 1.5707963…: 3.5e-16
///     const std::vector<double> size = sizes_of_terms(program, state);     // 2*(a - b) at a = b = 3: 12

#include <algorithm>
#include <cmath>
#include <limits>

#include "program/interpret.hpp"

namespace alembert {

enum class Counted {
    rounding,  ///< half a unit of the last place of each operation and of the state
    cancelled  ///< what terms of a sum take away from each other
};

/// A value, and how much of what is counted is in it.
template <Counted counted>
struct CountedValue {
    double value = 0, error = 0;

    CountedValue(double x = 0) : value(x) {}
    CountedValue(double x, double e) : value(x), error(e) {
        if constexpr (counted == Counted::rounding) error += std::numeric_limits<double>::epsilon() * std::abs(x);
    }

    friend CountedValue operator*(const CountedValue& a, const CountedValue& b) {
        return {a.value * b.value, std::abs(a.value) * b.error + std::abs(b.value) * a.error + a.error * b.error};
    }
    friend CountedValue operator/(const CountedValue& a, const CountedValue& b) {
        const double quotient = a.value / b.value;
        return {quotient, (a.error + std::abs(quotient) * b.error) / std::abs(b.value)};
    }
    CountedValue& operator+=(const CountedValue& b) { return *this = plus(*this, b.value, b.error); }
    CountedValue& operator*=(const CountedValue& b) { return *this = *this * b; }
    friend CountedValue operator+(const CountedValue& a, const CountedValue& b) {
        return plus(a, b.value, b.error);
    }
    friend double place_of(const CountedValue& x) { return x.value; }
    static CountedValue of_double(double x) { return {x, 0}; }
    friend bool operator<(const CountedValue& a, const CountedValue& b) { return a.value < b.value; }
    friend bool operator>(const CountedValue& a, const CountedValue& b) { return a.value > b.value; }
    friend bool operator!=(const CountedValue& a, const CountedValue& b) { return a.value != b.value; }
    friend CountedValue operator-(const CountedValue& a, const CountedValue& b) {
        return plus(a, -b.value, b.error);
    }

private:
    static CountedValue plus(const CountedValue& a, double b, double error) {
        const double sum = a.value + b;
        if constexpr (counted == Counted::cancelled) error += std::abs(a.value) + std::abs(b) - std::abs(sum);
        return {sum, a.error + error};
    }
};

using RoundedValue = CountedValue<Counted::rounding>;
using CancelledValue = CountedValue<Counted::cancelled>;

template <>
inline RoundedValue real_of<RoundedValue>(const Rational& r) {
    return {cln::double_approx(r), 0};
}

template <>
inline CancelledValue real_of<CancelledValue>(const Rational& r) {
    return {cln::double_approx(r), 0};
}

/// f(x) with the spread of f over x's error. If f has no value at an end of that interval (√ below 0), x itself is
/// used instead of that end.
template <Counted counted, typename Function>
CountedValue<counted> spread(const CountedValue<counted>& x, const Function& f) {
    const double at = f(x.value), above = f(x.value + x.error), below = f(x.value - x.error);
    const double up = std::isfinite(above) ? std::abs(above - at) : 0,
                 down = std::isfinite(below) ? std::abs(below - at) : 0;
    return {at, std::max(up, down)};
}

template <Counted counted>
CountedValue<counted> sin(const CountedValue<counted>& x) {
    return {std::sin(x.value), std::min(x.error, 2.0)};
}
template <Counted counted>
CountedValue<counted> cos(const CountedValue<counted>& x) {
    return {std::cos(x.value), std::min(x.error, 2.0)};
}
template <Counted counted>
CountedValue<counted> abs(const CountedValue<counted>& x) {
    return {std::abs(x.value), x.error};
}
template <Counted counted>
CountedValue<counted> atan2(const CountedValue<counted>& y, const CountedValue<counted>& x) {
    const double size = std::hypot(x.value, y.value);
    return {std::atan2(y.value, x.value), size > 0 ? (x.error + y.error) / size : 0};
}
template <Counted counted>
CountedValue<counted> pow(const CountedValue<counted>& x, const CountedValue<counted>& y) {
    const CountedValue<counted> base = spread(x, [&](double b) { return std::pow(b, y.value); });
    const CountedValue<counted> exponent = spread(y, [&](double e) { return std::pow(x.value, e); });
    return {base.value, base.error + exponent.error};
}
// clang-format off
template <Counted c> CountedValue<c> tan(const CountedValue<c>& x)  { return spread(x, [](double v) { return std::tan(v); }); }
template <Counted c> CountedValue<c> asin(const CountedValue<c>& x) { return spread(x, [](double v) { return std::asin(v); }); }
template <Counted c> CountedValue<c> acos(const CountedValue<c>& x) { return spread(x, [](double v) { return std::acos(v); }); }
template <Counted c> CountedValue<c> atan(const CountedValue<c>& x) { return spread(x, [](double v) { return std::atan(v); }); }
template <Counted c> CountedValue<c> sinh(const CountedValue<c>& x) { return spread(x, [](double v) { return std::sinh(v); }); }
template <Counted c> CountedValue<c> cosh(const CountedValue<c>& x) { return spread(x, [](double v) { return std::cosh(v); }); }
template <Counted c> CountedValue<c> tanh(const CountedValue<c>& x) { return spread(x, [](double v) { return std::tanh(v); }); }
template <Counted c> CountedValue<c> exp(const CountedValue<c>& x)  { return spread(x, [](double v) { return std::exp(v); }); }
template <Counted c> CountedValue<c> log(const CountedValue<c>& x)  { return spread(x, [](double v) { return std::log(v); }); }
template <Counted c> CountedValue<c> sqrt(const CountedValue<c>& x) { return spread(x, [](double v) { return std::sqrt(v); }); }
// clang-format on

/// The counted parts of all nodes, those of the state and the parameters among them.
template <typename Value>
std::vector<Value> counted_values(const Program& program, const State<double>& state) {
    const auto counted = [](const std::vector<double>& values) {
        std::vector<Value> result;
        for (const double x : values) result.emplace_back(x, 0);
        return result;
    };
    return interpret<Value>(program, {.parameters = counted(state.parameters),
                                      .t = Value(state.t, 0),
                                      .q = counted(state.q),
                                      .qdot = counted(state.qdot),
                                      .qddot = counted(state.qddot),
                                      .unknown = counted(state.unknown)});
}

/// For each node, how far rounding of the state, of the parameters and of each operation may move its value.
inline std::vector<double> rounding_errors(const Program& program, const State<double>& state) {
    std::vector<double> errors;
    for (const RoundedValue& x : counted_values<RoundedValue>(program, state))
        errors.push_back(std::isfinite(x.error) ? x.error : 0);
    return errors;
}

/// For each node, the sum of the sizes of its terms before any of them cancel, also within the factors of a
/// product: of cos(φ)·(x − y), that is |cos φ|·(|x| + |y|). A function of a sum has its own size, and the part of
/// which it would move if what has cancelled were there: sin(x − y) at x = y = 0.3 has the size 0.6.
inline std::vector<double> sizes_of_terms(const Program& program, const State<double>& state) {
    std::vector<double> sizes;
    for (const CancelledValue& x : counted_values<CancelledValue>(program, state))
        sizes.push_back(std::abs(x.value) + (std::isfinite(x.error) ? x.error : 0));
    return sizes;
}

}  // namespace alembert
