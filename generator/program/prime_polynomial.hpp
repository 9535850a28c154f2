// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// Polynomials in one unknown modulo 2⁶¹ − 1: interpolation, and all roots in the field.
///
///     const PrimePolynomial f = interpolate(points, values);    // ascending powers
///     for (const Prime root : roots(f, seed)) …                 // each once
///
/// Roots: gcd(x^q − x, f), with q the size of the field, is the product of the distinct linear factors, split by
/// gcd with (x + a)^((q−1)/2) − 1 for random a (Cantor & Zassenhaus, Math. Comp. 36 (1981) 587).

#include <vector>

#include "program/modular.hpp"

namespace alembert {

using PrimePolynomial = std::vector<Prime>;  ///< in ascending powers, without leading zeros; empty for zero

namespace prime_polynomial {

inline void trim(PrimePolynomial& f) {
    while (!f.empty() && f.back().is_zero()) f.pop_back();
}

inline PrimePolynomial remainder(PrimePolynomial f, const PrimePolynomial& g) {
    const Prime lead = g.back().inverse();
    while (f.size() >= g.size()) {
        const Prime factor = f.back() * lead;
        const std::size_t shift = f.size() - g.size();
        for (std::size_t k = 0; k < g.size(); ++k) f[shift + k] -= factor * g[k];
        trim(f);
    }
    return f;
}

inline PrimePolynomial product_modulo(const PrimePolynomial& f, const PrimePolynomial& g,
                                      const PrimePolynomial& m) {
    if (f.empty() || g.empty()) return {};
    PrimePolynomial result(f.size() + g.size() - 1);
    for (std::size_t i = 0; i < f.size(); ++i)
        for (std::size_t j = 0; j < g.size(); ++j) result[i + j] += f[i] * g[j];
    trim(result);
    return remainder(std::move(result), m);
}

inline PrimePolynomial power_modulo(PrimePolynomial base, std::uint64_t exponent, const PrimePolynomial& m) {
    PrimePolynomial result = remainder({1}, m);
    base = remainder(std::move(base), m);
    for (; exponent != 0; exponent >>= 1) {
        if ((exponent & 1U) != 0) result = product_modulo(result, base, m);
        base = product_modulo(base, base, m);
    }
    return result;
}

inline PrimePolynomial divisor(PrimePolynomial f, PrimePolynomial g) {
    while (!g.empty()) {
        f = remainder(std::move(f), g);
        std::swap(f, g);
    }
    return f;
}

inline PrimePolynomial quotient(PrimePolynomial f, const PrimePolynomial& g) {
    PrimePolynomial result(f.size() - g.size() + 1);
    const Prime lead = g.back().inverse();
    while (f.size() >= g.size()) {
        const std::size_t shift = f.size() - g.size();
        result[shift] = f.back() * lead;
        for (std::size_t k = 0; k < g.size(); ++k) f[shift + k] -= result[shift] * g[k];
        trim(f);
    }
    return result;
}

inline void split(const PrimePolynomial& f, bool plain, std::uint64_t seed, std::vector<Prime>& found) {
    if (f.size() < 2) return;
    if (f.size() == 2) return found.push_back(-f[0] * f[1].inverse());
    for (;; ++seed) {
        Prime shift = ModularPoint{.seed = seed}.random(500, f.size());
        if (!plain) shift += Prime::i() * ModularPoint{.seed = seed}.random(501, f.size());
        PrimePolynomial half = power_modulo({shift, 1}, (Prime::modulus - 1) / 2, f);
        if (!plain) half = power_modulo(std::move(half), Prime::modulus + 1, f);
        half.resize(std::max<std::size_t>(half.size(), 1));
        half[0] -= 1;
        trim(half);
        if (half.empty()) continue;
        const PrimePolynomial part = divisor(f, half);
        if (part.size() < 2 || part.size() == f.size()) continue;
        split(part, plain, seed + 1, found);
        return split(quotient(f, part), plain, seed + 1, found);
    }
}

}  // namespace prime_polynomial

/// The polynomial through all points (x_k, y_k), by Newton's divided differences; all x must be different.
inline PrimePolynomial interpolate(const std::vector<Prime>& x, std::vector<Prime> y) {
    for (std::size_t order = 1; order < x.size(); ++order)
        for (std::size_t k = x.size() - 1; k >= order; --k)
            y[k] = (y[k] - y[k - 1]) * (x[k] - x[k - order]).inverse();
    PrimePolynomial result;
    for (std::size_t k = x.size(); k-- > 0;) {
        result.insert(result.begin(), 0);
        for (std::size_t i = 0; i + 1 < result.size(); ++i) result[i] -= x[k] * result[i + 1];
        result[0] += y[k];
    }
    prime_polynomial::trim(result);
    return result;
}

inline Prime value_at(const PrimePolynomial& f, Prime x) {
    Prime result = 0;
    for (std::size_t k = f.size(); k-- > 0;) result = result * x + f[k];
    return result;
}

/// Zero if and only if f and g have a common root, or one of them is zero (von zur Gathen & Gerhard, Modern
/// Computer Algebra, §6.3).
inline Prime resultant(PrimePolynomial f, PrimePolynomial g) {
    Prime result = 1;
    while (true) {
        if (f.empty() || g.empty()) return 0;
        if (g.size() == 1) return result * g[0].power(f.size() - 1);
        // Res(f, g) = (−1)^(deg f · deg g) lc(g)^(deg f − deg r) Res(g, r), r the remainder of f
        PrimePolynomial rest = prime_polynomial::remainder(f, g);
        if (rest.empty()) return 0;
        if ((f.size() - 1) % 2 == 1 && (g.size() - 1) % 2 == 1) result = -result;
        result *= g.back().power(f.size() - rest.size());
        f = std::move(g);
        g = std::move(rest);
    }
}

/// The roots in ascending order; if all coefficients are plain (program/prime.hpp), only the plain roots. For the
/// zero polynomial the list is empty.
inline std::vector<Prime> roots(const PrimePolynomial& f, std::uint64_t seed) {
    using namespace prime_polynomial;
    std::vector<Prime> found;
    if (f.size() < 2) return found;
    const bool plain = std::all_of(f.begin(), f.end(), [](Prime c) { return c.is_plain(); });
    PrimePolynomial all = power_modulo({0, 1}, Prime::modulus, f);
    if (!plain) all = power_modulo(std::move(all), Prime::modulus, f);
    all.resize(std::max<std::size_t>(all.size(), 2));
    all[1] -= 1;
    trim(all);
    split(all.empty() ? f : divisor(f, all), plain, seed, found);
    std::sort(found.begin(), found.end());
    return found;
}

}  // namespace alembert
