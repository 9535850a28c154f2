// SPDX-License-Identifier: MIT
#pragma once

/// v + d ε with ε² = 0: a function of it carries its derivative along, by rules of its own (Griewank & Walther,
/// §3.1).

#include <cmath>

namespace alembert::test {

struct Dual {
    double v = 0, d = 0;

    Dual() = default;
    Dual(double value) : v(value) {}  // NOLINT: numbers are duals
    Dual(double value, double derivative) : v(value), d(derivative) {}

    Dual& operator+=(const Dual& o) { return *this = {v + o.v, d + o.d}; }
    Dual& operator*=(const Dual& o) { return *this = {v * o.v, d * o.v + v * o.d}; }
    friend Dual operator+(Dual a, const Dual& b) { return a += b; }
    friend Dual operator-(const Dual& a, const Dual& b) { return {a.v - b.v, a.d - b.d}; }
    friend Dual operator*(Dual a, const Dual& b) { return a *= b; }
    friend Dual operator/(const Dual& a, const Dual& b) { return {a.v / b.v, (a.d - a.v / b.v * b.d) / b.v}; }
    friend bool operator<(const Dual& a, const Dual& b) { return a.v < b.v; }
    friend bool operator>(const Dual& a, const Dual& b) { return a.v > b.v; }
    friend bool operator!=(const Dual& a, const Dual& b) { return a.v != b.v; }
};

inline Dual sin(const Dual& x) {
    return {std::sin(x.v), std::cos(x.v) * x.d};
}
inline Dual cos(const Dual& x) {
    return {std::cos(x.v), -std::sin(x.v) * x.d};
}
inline Dual tan(const Dual& x) {
    return sin(x) / cos(x);
}
inline Dual asin(const Dual& x) {
    return {std::asin(x.v), x.d / std::sqrt((1 - x.v) * (1 + x.v))};
}
inline Dual acos(const Dual& x) {
    return {std::acos(x.v), x.d == 0 ? 0 : -x.d / std::sqrt((1 - x.v) * (1 + x.v))};  // pi is acos(-1)
}
inline Dual atan(const Dual& x) {
    return {std::atan(x.v), x.d / (1 + x.v * x.v)};
}
inline Dual sinh(const Dual& x) {
    return {std::sinh(x.v), std::cosh(x.v) * x.d};
}
inline Dual cosh(const Dual& x) {
    return {std::cosh(x.v), std::sinh(x.v) * x.d};
}
inline Dual tanh(const Dual& x) {
    return sinh(x) / cosh(x);
}
inline Dual exp(const Dual& x) {
    return {std::exp(x.v), std::exp(x.v) * x.d};
}
inline Dual log(const Dual& x) {
    return {std::log(x.v), x.d / x.v};
}
inline Dual sqrt(const Dual& x) {
    return {std::sqrt(x.v), x.d / (2 * std::sqrt(x.v))};
}
inline Dual abs(const Dual& x) {
    return x.v < 0 ? Dual{-x.v, -x.d} : x;
}
inline Dual pow(const Dual& x, const Dual& y) {
    const double value = std::pow(x.v, y.v);
    return {value, y.v * std::pow(x.v, y.v - 1) * x.d + (y.d == 0 ? 0 : value * std::log(x.v) * y.d)};
}
inline Dual atan2(const Dual& y, const Dual& x) {
    return {std::atan2(y.v, x.v), (x.v * y.d - y.v * x.d) / (x.v * x.v + y.v * y.v)};
}

}  // namespace alembert::test
