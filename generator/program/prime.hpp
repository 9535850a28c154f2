// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// The field of exact arithmetic: numbers a + b·i with a, b whole numbers modulo the prime p = 2⁶¹ − 1.
///
///     Prime(3) * Prime(3).inverse() == 1;
///     *Prime::from(Rational(1) / 3) == Prime(3).inverse();
///     Prime::root_of(3)->power(2) == 3;        // √3, an i times a root of −3
///
/// p is 3 modulo 4: −1 is no square of a plain number (one with b = 0), and of the two roots of a square a, the
/// one that is a square itself is a^((p+1)/4). All random numbers are plain; i is needed for the square roots of
/// numbers such as 3 and 5 that have no plain root.

#include <cln/integer.h>

#include <cstdint>
#include <optional>

#include "program/program.hpp"

namespace alembert {

/// A whole number from 0 to 2⁶⁴ − 1. Where CLN's digits have 32 bits, its own function (of 1.3.6) gives the lowest
/// digit alone.
inline std::uint64_t uint64_of(const cln::cl_I& n) {
    if constexpr (sizeof(long) == sizeof(std::uint64_t)) return cln::cl_I_to_UQ(n);
    const auto half = [&](int from) -> std::uint64_t {
        return cln::cl_I_to_UL(cln::ldb(n, cln::cl_byte(32, from)));
    };
    return (half(32) << 32) | half(0);
}

class Prime {
public:
    static constexpr std::uint64_t modulus = (std::uint64_t{1} << 61) - 1;

    constexpr Prime() = default;
    constexpr Prime(std::int64_t n)  // NOLINT: a number is a number
        : n_(n >= 0 ? reduced(static_cast<std::uint64_t>(n))
                    : negative(reduced(0 - static_cast<std::uint64_t>(n)))) {}
    static constexpr Prime from_bits(std::uint64_t bits) {
        Prime result;
        result.n_ = reduced(bits);
        return result;
    }
    static constexpr Prime i() {
        Prime result;
        result.i_ = 1;
        return result;
    }
    /// Nothing if the modulus divides the denominator.
    static std::optional<Prime> from(const Rational& r) {
        const auto residue = [](const cln::cl_I& n) {
            constexpr int small = 31;  // bits
            return cln::integer_length(n) < small ? Prime(cln::cl_I_to_int(n))
                                                  : from_bits(uint64_of(cln::mod(n, cln::cl_I(modulus))));
        };
        const Prime above = residue(cln::numerator(r)), below = residue(cln::denominator(r));
        if (below == Prime(1)) return above;
        if (below.is_zero()) return std::nullopt;
        return above * below.inverse();
    }
    /// √r = known · √rest of a positive number r, where rest is 1 or a whole number, no square, without small
    /// factors.
    struct PartialRoot;
    /// The product of the roots of the small prime factors, so that √(ab) = √a √b. Nothing if the modulus divides
    /// the denominator.
    static std::optional<PartialRoot> partial_root_of(const Rational& r);
    /// √r of a positive number without large prime factors. Nothing for others.
    static std::optional<Prime> root_of(const Rational& r);
    /// A root of a plain number in this field, the same for the same number: an i times a root if it is no square.
    constexpr Prime any_root() const { return is_square() ? root() : i() * (-*this).root(); }

    /// The number itself if it is plain, otherwise a hash.
    constexpr std::uint64_t bits() const { return n_ ^ (i_ * 0x9e3779b97f4a7c15ULL); }
    constexpr bool is_zero() const { return n_ == 0 && i_ == 0; }
    constexpr bool is_plain() const { return i_ == 0; }
    friend constexpr bool operator==(Prime, Prime) = default;
    friend constexpr auto operator<=>(Prime, Prime) = default;

    friend constexpr Prime operator+(Prime a, Prime b) { return {reduced(a.n_ + b.n_), reduced(a.i_ + b.i_)}; }
    friend constexpr Prime operator-(Prime a, Prime b) {
        return {reduced(a.n_ + modulus - b.n_), reduced(a.i_ + modulus - b.i_)};
    }
    friend constexpr Prime operator-(Prime a) { return {negative(a.n_), negative(a.i_)}; }
    [[gnu::always_inline]] friend constexpr Prime operator*(Prime a, Prime b) {
        if ((a.i_ | b.i_) == 0) return {product(a.n_, b.n_), 0};
        return {reduced(product(a.n_, b.n_) + modulus - product(a.i_, b.i_)),
                reduced(product(a.n_, b.i_) + product(a.i_, b.n_))};
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
    /// The inverse; that of zero is zero.
    constexpr Prime inverse() const {
        if (is_plain()) return n_ <= 1 ? *this : plain_inverse();
        const Prime over = norm().inverse();
        return {product(n_, over.n_), product(negative(i_), over.n_)};
    }
    /// Whether the number is a square; for a plain number, the square of a plain number. 0 is a square.
    constexpr bool is_square() const { return is_plain() ? power((modulus - 1) / 2).n_ <= 1 : norm().is_square(); }
    /// A root of a square; for a plain number, the root that is a square itself.
    constexpr Prime root() const {
        if (is_plain()) return power((modulus + 1) / 4);
        const Prime half = Prime(2).inverse(), size = norm().root(), own{n_, 0};
        Prime square = (own + size) * half;
        if (!square.is_square()) square = (own - size) * half;
        const Prime root = square.root();
        return root + Prime{i_, 0} * (2 * root).inverse() * i();
    }

private:
    constexpr Prime(std::uint64_t n, std::uint64_t i) : n_(n), i_(i) {}
    constexpr Prime norm() const { return {reduced(product(n_, n_) + product(i_, i_)), 0}; }
    /// a^(p−2) with p − 2 = 4·(2⁵⁹ − 1) + 1; from a^(2ᵏ − 1) follows a^(2ᵏ⁺ʲ − 1) in j squarings.
    constexpr Prime plain_inverse() const {
        const auto shifted = [](std::uint64_t a, int squarings) {
            for (; squarings > 0; --squarings) a = product(a, a);
            return a;
        };
        const std::uint64_t of_2 = product(shifted(n_, 1), n_), of_4 = product(shifted(of_2, 2), of_2),
                            of_8 = product(shifted(of_4, 4), of_4), of_16 = product(shifted(of_8, 8), of_8),
                            of_32 = product(shifted(of_16, 16), of_16);
        std::uint64_t of_59 = product(shifted(of_32, 16), of_16);
        of_59 = product(shifted(of_59, 8), of_8);
        of_59 = product(shifted(of_59, 2), of_2);
        of_59 = product(shifted(of_59, 1), n_);
        return {product(shifted(of_59, 2), n_), 0};
    }
    static constexpr std::uint64_t reduced(std::uint64_t n) {
        n = (n & modulus) + (n >> 61);
        return n >= modulus ? n - modulus : n;
    }
    static constexpr std::uint64_t negative(std::uint64_t n) { return n == 0 ? 0 : modulus - n; }
    [[gnu::always_inline]] static constexpr std::uint64_t product(std::uint64_t a, std::uint64_t b) {
        __extension__ using Wide = unsigned __int128;
        const Wide wide = static_cast<Wide>(a) * b;
        return reduced((static_cast<std::uint64_t>(wide) & modulus) + static_cast<std::uint64_t>(wide >> 61));
    }
    std::uint64_t n_ = 0, i_ = 0;
};

struct Prime::PartialRoot {
    Prime known;
    cln::cl_I rest;
};

inline std::optional<Prime::PartialRoot> Prime::partial_root_of(const Rational& r) {
    constexpr int largest = 1000;
    const auto below = from(cln::denominator(r));
    if (!below || below->is_zero()) return std::nullopt;
    PartialRoot result{below->inverse(), cln::numerator(r) * cln::denominator(r)};
    for (int factor = 2; factor <= largest && result.rest != 1; ++factor)
        while (cln::zerop(cln::mod(result.rest, cln::cl_I(factor)))) {
            result.rest = cln::exquo(result.rest, cln::cl_I(factor));
            result.known *= Prime(factor).any_root();
        }
    cln::cl_I root;
    if (cln::sqrtp(result.rest, &root)) {
        result.known *= *from(root);
        result.rest = 1;
    }
    return result;
}

inline std::optional<Prime> Prime::root_of(const Rational& r) {
    const std::optional<PartialRoot> found = partial_root_of(r);
    return found && found->rest == 1 ? std::optional(found->known) : std::nullopt;
}

}  // namespace alembert
