// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// Angles modulo 2⁶¹ − 1: points of the circle x² + y² = 1, which multiply as complex numbers. Those with plain
/// coordinates (program/prime.hpp) form a cyclic group of order 2⁶¹, which contains every odd fraction of a turn
/// and every π/2ᵏ, but not π/3.
///
///     const PrimeTurn third = turn.power(*PrimeTurn::exponent(Rational(1) / 3));    // third.power(3) is turn
///     // cos(π/8), the same in every program
///     PrimeTurn::by_pi(Rational(1) / 8)->cos;

#include <cln/integer.h>

#include <cstdint>
#include <optional>

#include "program/prime.hpp"

namespace alembert {

struct PrimeTurn {
    Prime cos = 1, sin = 0;
    friend constexpr PrimeTurn operator*(const PrimeTurn& a, const PrimeTurn& b) {
        return {a.cos * b.cos - a.sin * b.sin, a.cos * b.sin + a.sin * b.cos};
    }
    constexpr PrimeTurn power(std::uint64_t exponent) const {
        PrimeTurn result, square = *this;
        for (; exponent != 0; exponent >>= 1, square = square * square)
            if ((exponent & 1U) != 0) result = result * square;
        return result;
    }
    /// c as an exponent, modulo the order of the group; nothing if its denominator is even.
    static std::optional<std::uint64_t> exponent(const Rational& c) {
        const auto low = [](const cln::cl_I& n) { return uint64_of(cln::ldb(n, cln::cl_byte(61, 0))); };
        if (cln::evenp(cln::denominator(c))) return std::nullopt;
        const std::uint64_t d = low(cln::denominator(c));
        std::uint64_t inverse = d;  // Newton's iteration for 1/d
        for (int k = 0; k < 6; ++k) inverse *= 2 - d * inverse;
        return (low(cln::numerator(c)) * inverse) & ((std::uint64_t{1} << 61) - 1);
    }
    /// The turn by c·π; nothing if the denominator of c is neither 2ᵏ nor 3·2ᵏ with k up to 40.
    static std::optional<PrimeTurn> by_pi(const Rational& c) {
        constexpr int most_halves = 40;
        if (cln::zerop(cln::mod(cln::denominator(c), cln::cl_I(3)))) {  // a third of a half turn, and the rest
            const PrimeTurn third{Prime(2).inverse(), *Prime::root_of(3) * Prime(2).inverse()};
            for (int k = 1; k <= 2; ++k)
                if (const Rational rest = c - Rational(k) / 3;
                    !cln::zerop(cln::mod(cln::denominator(rest), cln::cl_I(3)))) {
                    const auto other = by_pi(rest);
                    return other ? std::optional(*other * third.power(static_cast<std::uint64_t>(k)))
                                 : std::nullopt;
                }
            return std::nullopt;
        }
        const Prime s = *Prime::root_of(2) * Prime(2).inverse();
        PrimeTurn quarter{s, s};  // π/4, of order 8
        Rational eighths = 4 * c;
        for (int k = 0; cln::denominator(eighths) != 1; ++k, eighths = 2 * eighths) {
            if (k == most_halves || cln::oddp(cln::denominator(eighths))) return std::nullopt;
            const Prime half = ((quarter.cos + 1) * Prime(2).inverse()).root();
            quarter = {half, quarter.sin * (2 * half).inverse()};
        }
        return quarter.power(*exponent(eighths));
    }
    /// Whether the turn is in the group of order 2⁶¹, which contains every odd fraction of it.
    constexpr bool is_plain() const { return cos.is_plain() && sin.is_plain(); }
    /// ((1 − t²)/(1 + t²), 2t/(1 + t²)); −1 is no square, so the denominator is never zero.
    static constexpr PrimeTurn rational(Prime t) {
        const Prime below = (t * t + 1).inverse();
        return {(1 - t * t) * below, 2 * t * below};
    }
};

}  // namespace alembert
