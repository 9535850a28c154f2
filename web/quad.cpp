// SPDX-License-Identifier: GPL-2.0-or-later
// Functions of numbers with 113 bits. The C library of emscripten (musl) has exp, log and pow of `long double` with the
// 53 bits of a double; these take their places, and with them those of sinh, cosh and tanh.
//
// exp x = 2^k exp(r/2^s)^(2^s), |r| ≤ ln 2 / 2, by its series; log by a step of Halley's from the logarithm of a double:
// y ← y + 2 (x − e^y)/(x + e^y), whose error is the third power of that of y.
#include <cmath>
#include <limits>

namespace {

using Real = long double;
static_assert(std::numeric_limits<Real>::digits == 113);

constexpr Real ln_2_high = 0x1.62e42fefa39ef35793c7673007e5p-1L;   // 113 bits
constexpr Real ln_2_low = 0x7.6af40f343267298b62d8a0d175b8p-116L;  // the next

/// e^r − 1, |r| ≤ 0.35: the series at r/2⁶, then six times (1 + y)² − 1 = y (2 + y).
Real small_expm1(Real r) {
    constexpr int halvings = 6, terms = 14;
    const Real x = std::ldexp(r, -halvings);
    Real sum = 0;
    for (int k = terms; k >= 1; --k) sum = (1 + sum) * x / k;
    for (int k = 0; k < halvings; ++k) sum = sum * (2 + sum);
    return sum;
}

constexpr Real farthest = 11400;  // e to this and its reciprocal are no numbers of this kind

}  // namespace

extern "C" {

Real expl(Real x) {
    if (x != x) return x;
    if (x > farthest) return std::numeric_limits<Real>::infinity();
    if (x < -farthest - 100) return 0;
    const Real k = std::floor(x / ln_2_high + 0.5L);
    const Real r = (x - k * ln_2_high) - k * ln_2_low;
    return std::scalbn(1 + small_expm1(r), static_cast<int>(k));
}

Real expm1l(Real x) {
    return std::fabs(x) < 0.35L ? small_expm1(x) : expl(x) - 1;
}

Real logl(Real x) {
    if (!(x > 0) || x - x != 0) return x == 0 ? -std::numeric_limits<Real>::infinity() : x > 0 ? x : std::numeric_limits<Real>::quiet_NaN();
    int k = 0;
    Real m = std::frexp(x, &k);
    if (m < 0.7071067811865475244L) m *= 2, --k;
    Real y = std::log(static_cast<double>(m));
    for (int step = 0; step < 2; ++step) {
        const Real e = 1 + small_expm1(y);
        y += 2 * (m - e) / (m + e);
    }
    return static_cast<Real>(k) * ln_2_high + (y + static_cast<Real>(k) * ln_2_low);
}

Real log1pl(Real x) {
    const Real u = 1 + x;
    return u == 1 ? x : logl(u) - ((u - 1) - x) / u;
}

Real powl(Real x, Real y) {
    if (y == 0 || x == 1) return 1;
    if (x != x || y != y) return x + y;
    const bool is_whole = std::floor(y) == y;
    if (is_whole && std::fabs(y) < 1024) {  // exactly where that is possible
        Real result = 1, power = x;
        for (int n = std::abs(static_cast<int>(y)); n > 0; n /= 2, power *= power)
            if (n % 2 != 0) result *= power;
        return y < 0 ? 1 / result : result;
    }
    if (x == 0) return y > 0 ? 0 : std::numeric_limits<Real>::infinity();
    if (x < 0 && !is_whole) return std::numeric_limits<Real>::quiet_NaN();
    const bool is_odd = is_whole && std::fmod(y, 2.0L) != 0;
    const Real size = expl(y * logl(std::fabs(x)));
    return x < 0 && is_odd ? -size : size;
}

Real sinhl(Real x) {
    const Real e = expm1l(std::fabs(x));
    return std::copysign(0.5L * (e + e / (e + 1)), x);
}

Real coshl(Real x) {
    const Real e = expl(std::fabs(x));
    return 0.5L * (e + 1 / e);
}

Real tanhl(Real x) {
    if (std::fabs(x) > 50) return std::copysign(1.0L, x);
    const Real e = expm1l(2 * std::fabs(x));
    return std::copysign(e / (e + 2), x);
}

}  // extern "C"
