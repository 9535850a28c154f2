// SPDX-License-Identifier: MIT
#pragma once

/// Intervals that contain all values of an expression, and with them its first and second derivative.
///
///     const Interval x{1, 2};
///     sin(x) * x;                                       // contains sin(a)·a for each a in x
///     const Bounds y = sin({x, {1, 1}, {0, 0}});        // sin x, and its derivatives by x
///
/// Each result is widened by a few rounding errors (Moore, Interval Analysis, 1966, §§3, 11). An operation that is
/// undefined somewhere in its arguments gives the whole line where it is defined at all; Bounds tell if it is
/// defined nowhere.

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace alembert {

struct Interval {
    double low = 0, high = 0;

    static Interval whole() { return {-HUGE_VAL, HUGE_VAL}; }
    bool has(double x) const { return low <= x && x <= high; }
    bool has_sign() const { return low > 0 || high < 0; }
    double size() const { return std::max(std::abs(low), std::abs(high)); }
};

/// The ends, moved apart by `rounded` of their size and by the smallest normal number, which an underflow loses. A
/// low end that overflows is at least the largest number.
inline Interval widened(double low, double high, double rounded) {
    constexpr double least = std::numeric_limits<double>::min(), most = std::numeric_limits<double>::max();
    low = std::min(low, most), high = std::max(high, -most);
    const double a = low - rounded * std::abs(low) - least, b = high + rounded * std::abs(high) + least;
    return {std::isnan(a) ? -HUGE_VAL : a, std::isnan(b) ? HUGE_VAL : b};
}
/// By the error of a function of the library.
inline Interval widened(double low, double high) {
    return widened(low, high, 4 * std::numeric_limits<double>::epsilon());
}
/// By the error of an operation that is rounded to the nearest number.
inline Interval rounded(double low, double high) {
    return widened(low, high, std::numeric_limits<double>::epsilon());
}
inline Interval hull(const Interval& a, const Interval& b) {
    return {std::min(a.low, b.low), std::max(a.high, b.high)};
}
inline bool is_zero(const Interval& a) {
    return a.low == 0 && a.high == 0;
}
inline Interval operator+(const Interval& a, const Interval& b) {
    if (is_zero(a)) return b;
    if (is_zero(b)) return a;
    return rounded(a.low + b.low, a.high + b.high);
}
inline Interval operator-(const Interval& a) {
    return {-a.high, -a.low};
}
inline Interval operator-(const Interval& a, const Interval& b) {
    return a + -b;
}
/// Zero times what has no bounds has none: it may not exist.
inline Interval operator*(const Interval& a, const Interval& b) {
    if (is_zero(a) || is_zero(b))
        return std::isfinite(a.size()) && std::isfinite(b.size()) ? Interval{} : Interval::whole();
    const auto product = [](double x, double y) { return x == 0 || y == 0 ? 0 : x * y; };
    const double p[4] = {product(a.low, b.low), product(a.low, b.high), product(a.high, b.low),
                         product(a.high, b.high)};
    return rounded(std::min({p[0], p[1], p[2], p[3]}), std::max({p[0], p[1], p[2], p[3]}));
}
inline Interval operator*(double c, const Interval& a) {
    return Interval{c, c} * a;
}
inline Interval inverse(const Interval& a) {
    return a.has_sign() ? rounded(1 / a.high, 1 / a.low) : Interval::whole();
}
/// aⁿ, n ≥ 0.
inline Interval power(const Interval& a, int n) {
    if (n == 0) return {1, 1};
    if (n == 1 || is_zero(a)) return a;
    const double low = std::pow(a.low, n), high = std::pow(a.high, n);
    if (n % 2 == 1) return widened(low, high);
    const Interval values = widened(a.has(0) ? 0 : std::min(low, high), std::max(low, high));
    return {std::max(0.0, values.low), values.high};
}
template <typename Function>
Interval rising(const Interval& a, Function f) {
    return widened(f(a.low), f(a.high));
}
/// The range of a sine or cosine, whose values at the ends these are: it is 1 at `top` and −1 half a turn from
/// there.
inline Interval range_of_wave(const Interval& a, double first, double last, double top) {
    constexpr double turn = 2 * std::numbers::pi, exact = 1e15;
    if (!(a.high - a.low < turn) || a.size() > exact) return {-1, 1};
    const double few = 1e-15 * std::max(1.0, a.size());
    const auto passes = [&](double phase) {  // a place phase + turn k lies in the interval
        return std::floor((a.high + few - phase) / turn) >= std::ceil((a.low - few - phase) / turn);
    };
    const Interval ends = widened(std::min(first, last), std::max(first, last));
    return {passes(top + std::numbers::pi) ? -1 : std::max(-1.0, ends.low),
            passes(top) ? 1 : std::min(1.0, ends.high)};
}
inline Interval cos(const Interval& a) {
    return range_of_wave(a, std::cos(a.low), std::cos(a.high), 0);
}
inline Interval sin(const Interval& a) {
    return range_of_wave(a, std::sin(a.low), std::sin(a.high), std::numbers::pi / 2);
}

/// The values between two points at a distance w of the cubic polynomial with these values and slopes: it lies
/// between its Bézier points. `margin` is what a smooth function may differ from it, as a part of the range.
inline Interval cubic_range(double a, double a_slope, double b, double b_slope, double w, double margin) {
    const double next = a + a_slope * w / 3, before = b - b_slope * w / 3;
    const double low = std::min({a, b, next, before}), high = std::max({a, b, next, before});
    const double more = margin * (high - low);
    return widened(low - more, high + more);
}

/// A quantity along a motion and its first two derivatives by time.
struct Bounds {
    Interval value, first, second;
    bool nowhere = false;  ///< whether it has no value at all, as the root of what is negative
};

inline Bounds whole_bounds() {
    return {Interval::whole(), Interval::whole(), Interval::whole()};
}
inline Bounds no_bounds() {
    return {Interval::whole(), Interval::whole(), Interval::whole(), true};
}
inline Bounds operator+(const Bounds& a, const Bounds& b) {
    return {a.value + b.value, a.first + b.first, a.second + b.second, a.nowhere || b.nowhere};
}
inline Bounds operator*(double c, const Bounds& a) {
    return {c * a.value, c * a.first, c * a.second, a.nowhere};
}
inline Bounds operator*(const Bounds& a, const Bounds& b) {
    return {a.value * b.value, a.first * b.value + a.value * b.first,
            a.second * b.value + 2.0 * (a.first * b.first) + a.value * b.second, a.nowhere || b.nowhere};
}
/// f(a), given the bounds of f, f' and f'' on a.value.
inline Bounds through(const Bounds& a, const Interval& f, const Interval& slope, const Interval& bend) {
    return {f, slope * a.first, bend * power(a.first, 2) + slope * a.second, a.nowhere};
}
Bounds power(const Bounds& a, int n);
Bounds inverse(const Bounds& a);
Bounds sin(const Bounds& a);
Bounds cos(const Bounds& a);
Bounds tan(const Bounds& a);
Bounds asin(const Bounds& a);
Bounds acos(const Bounds& a);
Bounds atan(const Bounds& a);
Bounds sinh(const Bounds& a);
Bounds cosh(const Bounds& a);
Bounds tanh(const Bounds& a);
Bounds exp(const Bounds& a);
Bounds log(const Bounds& a);
Bounds sqrt(const Bounds& a);
Bounds abs(const Bounds& a);
Bounds sign(const Bounds& a);
Bounds pow(const Bounds& a, const Bounds& b);
Bounds atan2(const Bounds& y, const Bounds& x);
Bounds least_of(const Bounds& a, const Bounds& b);

}  // namespace alembert
