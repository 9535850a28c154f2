// SPDX-License-Identifier: MIT
#include "alembert/base/interval.hpp"

namespace alembert {

namespace {

constexpr Interval one{1, 1};

Interval square(const Interval& a) {
    return power(a, 2);
}

}  // namespace

Bounds power(const Bounds& a, int n) {
    if (n == 1) return a;
    return through(a, power(a.value, n), n * power(a.value, n - 1), n * (n - 1.0) * power(a.value, n - 2));
}

Bounds inverse(const Bounds& a) {
    const Interval f = inverse(a.value);
    return through(a, f, -square(f), 2 * power(f, 3));
}

Bounds sin(const Bounds& a) {
    const Interval s = sin(a.value);
    return through(a, s, cos(a.value), -s);
}

Bounds cos(const Bounds& a) {
    const Interval c = cos(a.value);
    return through(a, c, -sin(a.value), -c);
}

Bounds tan(const Bounds& a) {
    if (!cos(a.value).has_sign()) return a.nowhere ? no_bounds() : whole_bounds();
    const Interval f = rising(a.value, [](double x) { return std::tan(x); }), slope = one + square(f);
    return through(a, f, slope, 2 * (f * slope));
}

Bounds asin(const Bounds& a) {
    if (a.value.high < -1 || a.value.low > 1) return no_bounds();
    const Interval x{std::max(-1.0, a.value.low), std::min(1.0, a.value.high)};
    const Interval f = rising(x, [](double s) { return std::asin(s); });
    if (a.value.low <= -1 || a.value.high >= 1) return through(a, f, {1, HUGE_VAL}, Interval::whole());
    const Interval slope = inverse(sqrt({one - square(x), {}, {}}).value);
    return through(a, f, slope, x * power(slope, 3));
}

Bounds acos(const Bounds& a) {
    constexpr double right = std::numbers::pi / 2;
    return Bounds{{right, right}, {}, {}} + -1.0 * asin(a);
}

Bounds atan(const Bounds& a) {
    const Interval slope = inverse(one + square(a.value));
    return through(a, rising(a.value, [](double x) { return std::atan(x); }), slope,
                   -2 * (a.value * square(slope)));
}

Bounds sinh(const Bounds& a) {
    const Interval f = rising(a.value, [](double x) { return std::sinh(x); });
    return through(a, f, cosh(Bounds{a.value, {}, {}}).value, f);
}

Bounds cosh(const Bounds& a) {
    const double low = std::cosh(a.value.low), high = std::cosh(a.value.high);
    const Interval f = widened(a.value.has(0) ? 1 : std::min(low, high), std::max(low, high));
    return through(a, f, rising(a.value, [](double x) { return std::sinh(x); }), f);
}

Bounds tanh(const Bounds& a) {
    const Interval f = rising(a.value, [](double x) { return std::tanh(x); });
    const auto falling = [](double x) {  // 1 − tanh², which falls with |x|
        const double e = std::exp(-2 * std::abs(x));
        return 4 * e / ((1 + e) * (1 + e));
    };
    const double low = falling(a.value.low), high = falling(a.value.high);
    const Interval slope = widened(std::min(low, high), a.value.has(0) ? 1 : std::max(low, high));
    return through(a, f, slope, -2 * (f * slope));
}

Bounds exp(const Bounds& a) {
    Interval f = rising(a.value, [](double x) { return std::exp(x); });
    f.low = std::max(0.0, f.low);
    return through(a, f, f, f);
}

Bounds log(const Bounds& a) {
    if (a.value.high <= 0) return a.value.high < 0 ? no_bounds() : whole_bounds();
    const double low = std::max(0.0, a.value.low);
    const Interval slope = inverse(Interval{low, a.value.high});
    return through(a, widened(std::log(low), std::log(a.value.high)), slope, -square(slope));
}

Bounds sqrt(const Bounds& a) {
    if (a.value.high < 0) return no_bounds();
    const double low = std::sqrt(std::max(0.0, a.value.low)), high = std::sqrt(a.value.high);
    const Interval slope = widened(0.5 / high, 0.5 / low);
    const Interval root = widened(low, high);
    return through(a, {std::max(0.0, root.low), root.high}, slope, -2 * power(slope, 3));
}

Bounds abs(const Bounds& a) {
    if (a.value.low >= 0) return a;
    if (a.value.high <= 0) return -1.0 * a;
    return through(a, {0, a.value.size()}, {-1, 1}, Interval::whole());
}

Bounds sign(const Bounds& a) {
    if (a.value.has_sign()) return {a.value.low > 0 ? one : -one, {}, {}, a.nowhere};
    return {{-1, 1}, Interval::whole(), Interval::whole(), a.nowhere};
}

Bounds pow(const Bounds& a, const Bounds& b) {
    if (!(a.value.low > 0)) return a.nowhere || b.nowhere ? no_bounds() : whole_bounds();
    return exp(b * log(a));
}

Bounds atan2(const Bounds& y, const Bounds& x) {
    constexpr double right = std::numbers::pi / 2;
    if (x.value.low > 0) return atan(y * inverse(x));
    if (y.value.has_sign())
        return Bounds{{y.value.low > 0 ? right : -right, y.value.low > 0 ? right : -right}, {}, {}} +
               -1.0 * atan(x * inverse(y));
    return {{-std::numbers::pi - 1e-15, std::numbers::pi + 1e-15},
            Interval::whole(),
            Interval::whole(),
            x.nowhere || y.nowhere};
}

Bounds least_of(const Bounds& a, const Bounds& b) {
    if (a.nowhere || b.nowhere) return no_bounds();
    if (a.value.high < b.value.low) return a;
    if (b.value.high < a.value.low) return b;
    return {{std::min(a.value.low, b.value.low), std::min(a.value.high, b.value.high)},
            hull(a.first, b.first),
            Interval::whole()};
}

}  // namespace alembert
