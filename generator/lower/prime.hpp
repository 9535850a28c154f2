// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// The field of exact arithmetic: whole numbers modulo the prime 2⁶¹ − 1.
///
///     Prime(3) * Prime(3).inverse() == 1;
///     *Prime::from(Rational(1) / 3) == Prime(3).inverse();
///
/// The prime is 3 modulo 4: −1 is no square, and the root of a square a that is a square itself is a^((p+1)/4).

#include <cln/integer.h>

#include <cstdint>
#include <optional>

#include "lower/program.hpp"

namespace alembert {

/// A number modulo 2⁶¹ − 1.
class Prime {
public:
    static constexpr std::uint64_t modulus = (std::uint64_t{1} << 61) - 1;

    constexpr Prime() = default;
    constexpr Prime(std::int64_t n)  // NOLINT: a number is a number
        : n_(n >= 0 ? reduced(static_cast<std::uint64_t>(n)) : negative(reduced(0 - static_cast<std::uint64_t>(n)))) {}
    static constexpr Prime from_bits(std::uint64_t bits) {
        Prime result;
        result.n_ = reduced(bits);
        return result;
    }
    /// Nothing if the modulus divides the denominator.
    static std::optional<Prime> from(const Rational& r) {
        const auto residue = [](const cln::cl_I& n) {
            return from_bits(cln::cl_I_to_UQ(cln::mod(n, cln::cl_I(static_cast<unsigned long>(modulus)))));
        };
        const Prime below = residue(cln::denominator(r));
        if (below.is_zero()) return std::nullopt;
        return residue(cln::numerator(r)) * below.inverse();
    }

    constexpr std::uint64_t bits() const { return n_; }
    constexpr bool is_zero() const { return n_ == 0; }
    friend constexpr bool operator==(Prime, Prime) = default;
    friend constexpr auto operator<=>(Prime, Prime) = default;

    friend constexpr Prime operator+(Prime a, Prime b) { return from_bits(a.n_ + b.n_); }
    friend constexpr Prime operator-(Prime a, Prime b) { return from_bits(a.n_ + modulus - b.n_); }
    friend constexpr Prime operator-(Prime a) { return from_bits(modulus - a.n_); }
    friend constexpr Prime operator*(Prime a, Prime b) {
        __extension__ using Wide = unsigned __int128;
        const Wide product = static_cast<Wide>(a.n_) * b.n_;
        return from_bits((static_cast<std::uint64_t>(product) & modulus) + static_cast<std::uint64_t>(product >> 61));
    }
    constexpr Prime& operator+=(Prime other) { return *this = *this + other; }
    constexpr Prime& operator-=(Prime other) { return *this = *this - other; }
    constexpr Prime& operator*=(Prime other) { return *this = *this * other; }

    constexpr Prime power(std::uint64_t exponent) const {
        Prime result = 1, square = *this;
        for (; exponent != 0; exponent >>= 1, square *= square)
            if ((exponent & 1U) != 0) result *= square;
        return result;
    }
    /// Of zero: zero.
    constexpr Prime inverse() const { return power(modulus - 2); }
    /// 0 is a square.
    constexpr bool is_square() const { return power((modulus - 1) / 2).n_ <= 1; }
    /// The root that is a square itself, of a square. (The modulus is 3 modulo 4.)
    constexpr Prime root() const { return power((modulus + 1) / 4); }

private:
    static constexpr std::uint64_t reduced(std::uint64_t n) {
        n = (n & modulus) + (n >> 61);
        return n >= modulus ? n - modulus : n;
    }
    static constexpr std::uint64_t negative(std::uint64_t n) { return n == 0 ? 0 : modulus - n; }
    std::uint64_t n_ = 0;
};

}  // namespace alembert
