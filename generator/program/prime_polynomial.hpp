// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// Polynomials in one unknown modulo 2⁶¹ − 1 (program/univariate.hpp): all roots in the field.
///
///     const PrimePolynomial f = interpolate(points, values);    // ascending powers
///     for (const Prime root : roots(f, seed)) …                 // each once
///
/// Roots: gcd(x^q − x, f), with q the size of the field, is the product of the distinct linear factors, split by
/// gcd with (x + a)^((q−1)/2) − 1 for random a (Cantor & Zassenhaus, Math. Comp. 36 (1981) 587).

#include <algorithm>
#include <bit>
#include <vector>

#include "program/modular.hpp"
#include "program/univariate.hpp"

namespace alembert {

using PrimePolynomial = Univariate<Prime>;

namespace prime_polynomial {

using univariate::divisor;
using univariate::quotient;
using univariate::remainder;
using univariate::trim;

inline PrimePolynomial product_modulo(const PrimePolynomial& f, const PrimePolynomial& g,
                                      const PrimePolynomial& m) {
    if (f.empty() || g.empty()) return {};
    PrimePolynomial result(f.size() + g.size() - 1);
    for (std::size_t i = 0; i < f.size(); ++i)
        for (std::size_t j = 0; j < g.size(); ++j) result[i + j] += f[i] * g[j];
    trim(result);
    return remainder(std::move(result), m);
}

/// From the highest bit of the exponent on, so that a short base stays short.
inline PrimePolynomial power_modulo(PrimePolynomial base, std::uint64_t exponent, const PrimePolynomial& m) {
    PrimePolynomial result = remainder(PrimePolynomial{1}, m);
    base = remainder(std::move(base), m);
    for (int bit = std::bit_width(exponent); bit-- > 0;) {
        result = product_modulo(result, result, m);
        if ((exponent >> bit & 1U) != 0) result = product_modulo(result, base, m);
    }
    return result;
}

/// The roots of f₂ x² + f₁ x + f₀.
inline std::vector<Prime> roots_of_quadratic(const PrimePolynomial& f) {
    const Prime square = f[1] * f[1] - 4 * f[0] * f[2], scale = (2 * f[2]).inverse();
    if (square.is_zero()) return {-f[1] * scale};
    if (!square.is_square()) return {};
    const Prime root = square.root(), a = (root - f[1]) * scale, b = (-root - f[1]) * scale;
    return {std::min(a, b), std::max(a, b)};
}

inline void split(const PrimePolynomial& f, bool plain, std::uint64_t seed, std::vector<Prime>& found) {
    if (f.size() < 2) return;
    if (f.size() == 2) return found.push_back(-f[0] * f[1].inverse());
    for (;; ++seed) {
        Prime shift = ModularPoint{.seed = seed}.random(500, f.size());
        if (!plain) shift += Prime::i() * ModularPoint{.seed = seed}.random(501, f.size());
        PrimePolynomial half = power_modulo(PrimePolynomial{shift, 1}, (Prime::modulus - 1) / 2, f);
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

/// The roots in ascending order; if all coefficients are plain (program/prime.hpp), only the plain roots. For the
/// zero polynomial the list is empty.
inline std::vector<Prime> roots(PrimePolynomial f, std::uint64_t seed) {
    using namespace prime_polynomial;
    std::vector<Prime> found;
    if (f.size() < 2) return found;
    if (f.size() == 3) return roots_of_quadratic(f);
    univariate::make_monic(f);
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
