// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// Numbers with 34 digits: IEEE binary128, with the compiler's arithmetic and glibc's functions (2.26 or later,
/// x86-64). On processors whose `long double` is such a number, these are its functions.
///
///     const Quad x = quad_of(Rational(1)/10);
///     text(sin(x), 30);
///
/// <cmath> has no names for it under every compiler, so the functions are bound by their symbols.

#include <cln/float.h>
#include <cln/rational.h>
#include <cln/real.h>

#include <cmath>
#include <cstdio>
#include <limits>
#include <string>

namespace alembert {

#ifdef __SIZEOF_FLOAT128__
__extension__ typedef __float128 Quad;

#define ALEMBERT_QUAD(name) Quad name(Quad) __asm__(#name "f128")
ALEMBERT_QUAD(sin);
ALEMBERT_QUAD(cos);
ALEMBERT_QUAD(tan);
ALEMBERT_QUAD(asin);
ALEMBERT_QUAD(acos);
ALEMBERT_QUAD(atan);
ALEMBERT_QUAD(sinh);
ALEMBERT_QUAD(cosh);
ALEMBERT_QUAD(tanh);
ALEMBERT_QUAD(exp);
ALEMBERT_QUAD(log);
ALEMBERT_QUAD(sqrt);
#undef ALEMBERT_QUAD

Quad pow(Quad, Quad) __asm__("powf128");
Quad atan2(Quad, Quad) __asm__("atan2f128");
int format(char*, std::size_t, const char*, Quad) __asm__("strfromf128");

inline Quad abs(Quad x) {
    return x < 0 ? -x : x;
}
#else
using Quad = long double;
static_assert(std::numeric_limits<Quad>::digits == 113);
using std::abs, std::acos, std::asin, std::atan, std::atan2, std::cos, std::cosh, std::exp, std::log, std::pow,
    std::sin, std::sinh, std::sqrt, std::tan, std::tanh;
inline int format(char* to, std::size_t size, const char* form, Quad x) {
    std::string wide = form;
    return std::snprintf(to, size, wide.insert(wide.size() - 1, "L").c_str(), x);
}
#endif

inline bool is_finite(Quad x) {
    return x - x == 0;
}

/// Exact to the last bit or two, because three doubles hold 159 bits.
inline Quad quad_of(cln::cl_RA r) {
    Quad sum = 0;
    for (int part = 0; part < 3; ++part) {
        const double high = cln::double_approx(r);
        sum += static_cast<Quad>(high);
        if (high - high != 0) break;
        r = r - cln::rational(cln::cl_DF(high));
    }
    return sum;
}

inline std::string text(Quad x, int digits) {
    char buffer[64];
    const std::string form = "%." + std::to_string(digits) + "g";
    format(buffer, sizeof buffer, form.c_str(), x);
    return buffer;
}

}  // namespace alembert
