// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// How far rounding may move a value of a program away from the value at the exact state: numbers with a bound on
/// their error, to first order (Higham, Accuracy and Stability of Numerical Algorithms (2002), §3.3).
///
///     const std::vector<double> error = rounding_errors(program, state);   // cos(θ) at θ = 1.5707963…: 3.5e-16

#include <algorithm>
#include <cmath>
#include <limits>

#include "program/interpret.hpp"

namespace alembert {

struct RoundedValue {
    double value = 0, error = 0;

    RoundedValue(double x = 0) : value(x) {}
    RoundedValue(double x, double e) : value(x), error(e + std::numeric_limits<double>::epsilon() * std::abs(x)) {}

    friend RoundedValue operator*(const RoundedValue& a, const RoundedValue& b) {
        return {a.value * b.value, std::abs(a.value) * b.error + std::abs(b.value) * a.error + a.error * b.error};
    }
    friend RoundedValue operator/(const RoundedValue& a, const RoundedValue& b) {
        const double quotient = a.value / b.value;
        return {quotient, (a.error + std::abs(quotient) * b.error) / std::abs(b.value)};
    }
    RoundedValue& operator+=(const RoundedValue& b) { return *this = {value + b.value, error + b.error}; }
    RoundedValue& operator*=(const RoundedValue& b) { return *this = *this * b; }
    friend bool operator<(const RoundedValue& a, const RoundedValue& b) { return a.value < b.value; }
    friend bool operator>(const RoundedValue& a, const RoundedValue& b) { return a.value > b.value; }
    friend bool operator!=(const RoundedValue& a, const RoundedValue& b) { return a.value != b.value; }
    friend RoundedValue operator-(const RoundedValue& a, const RoundedValue& b) {
        return {a.value - b.value, a.error + b.error};
    }
};

template <>
inline RoundedValue real_of<RoundedValue>(const Rational& r) {
    return {cln::double_approx(r), 0};
}

/// f(x) with the spread of f over x's error. If f has no value at an end of that interval (√ below 0), x itself is
/// used instead of that end.
template <typename Function>
RoundedValue spread(const RoundedValue& x, const Function& f) {
    const double at = f(x.value), above = f(x.value + x.error), below = f(x.value - x.error);
    const double up = std::isfinite(above) ? std::abs(above - at) : 0,
                 down = std::isfinite(below) ? std::abs(below - at) : 0;
    return {at, std::max(up, down)};
}

inline RoundedValue sin(const RoundedValue& x) {
    return {std::sin(x.value), std::min(x.error, 2.0)};
}
inline RoundedValue cos(const RoundedValue& x) {
    return {std::cos(x.value), std::min(x.error, 2.0)};
}
inline RoundedValue abs(const RoundedValue& x) {
    return {std::abs(x.value), x.error};
}
inline RoundedValue atan2(const RoundedValue& y, const RoundedValue& x) {
    const double size = std::hypot(x.value, y.value);
    return {std::atan2(y.value, x.value), size > 0 ? (x.error + y.error) / size : 0};
}
inline RoundedValue pow(const RoundedValue& x, const RoundedValue& y) {
    const RoundedValue base = spread(x, [&](double b) { return std::pow(b, y.value); });
    const RoundedValue exponent = spread(y, [&](double e) { return std::pow(x.value, e); });
    return {base.value, base.error + exponent.error};
}
// clang-format off
inline RoundedValue tan(const RoundedValue& x)  { return spread(x, [](double v) { return std::tan(v); }); }
inline RoundedValue asin(const RoundedValue& x) { return spread(x, [](double v) { return std::asin(v); }); }
inline RoundedValue acos(const RoundedValue& x) { return spread(x, [](double v) { return std::acos(v); }); }
inline RoundedValue atan(const RoundedValue& x) { return spread(x, [](double v) { return std::atan(v); }); }
inline RoundedValue sinh(const RoundedValue& x) { return spread(x, [](double v) { return std::sinh(v); }); }
inline RoundedValue cosh(const RoundedValue& x) { return spread(x, [](double v) { return std::cosh(v); }); }
inline RoundedValue tanh(const RoundedValue& x) { return spread(x, [](double v) { return std::tanh(v); }); }
inline RoundedValue exp(const RoundedValue& x)  { return spread(x, [](double v) { return std::exp(v); }); }
inline RoundedValue log(const RoundedValue& x)  { return spread(x, [](double v) { return std::log(v); }); }
inline RoundedValue sqrt(const RoundedValue& x) { return spread(x, [](double v) { return std::sqrt(v); }); }
// clang-format on

/// For each node, how far rounding of the state, of the parameters and of each operation may move its value.
inline std::vector<double> rounding_errors(const Program& program, const State<double>& state) {
    const auto rounded = [](const std::vector<double>& values) {
        std::vector<RoundedValue> result;
        for (const double x : values) result.emplace_back(x, 0);
        return result;
    };
    const std::vector<RoundedValue> values =
        interpret<RoundedValue>(program, {.parameters = rounded(state.parameters),
                                          .t = RoundedValue(state.t, 0),
                                          .q = rounded(state.q),
                                          .qdot = rounded(state.qdot),
                                          .qddot = rounded(state.qddot),
                                          .unknown = rounded(state.unknown)});
    std::vector<double> errors;
    for (const RoundedValue& x : values) errors.push_back(std::isfinite(x.error) ? x.error : 0);
    return errors;
}

}  // namespace alembert
