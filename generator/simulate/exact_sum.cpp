// SPDX-License-Identifier: GPL-2.0-or-later
#include "simulate/exact_sum.hpp"

#include <bit>
#include <cmath>

namespace alembert {

namespace {

constexpr std::uint32_t most_added = 1U << 30U;  // each adds less than 2³² to a digit
constexpr int lowest = -1074;                    // the exponent of the first digit

}  // namespace

void ExactSum::add(double x) {
    __extension__ using Wide = unsigned __int128;
    const auto bits = std::bit_cast<std::uint64_t>(x);
    const std::uint64_t exponent = bits >> 52U & 2047U, fraction = bits & ((std::uint64_t{1} << 52U) - 1);
    if (exponent == 0 && fraction == 0) return;
    const std::uint64_t place = exponent == 0 ? 0 : exponent - 1,
                        whole = exponent == 0 ? fraction : fraction | std::uint64_t{1} << 52U;
    Wide rest = Wide{whole} << (place % 32);
    for (std::size_t at = place / 32; rest != 0; ++at, rest >>= 32U) {
        const auto part = static_cast<std::int64_t>(rest & 0xFFFFFFFFU);
        digit_[at] += (bits >> 63U) != 0 ? -part : part;
    }
    if (++added_ == most_added) set(normal());
}

void ExactSum::add_square(double x) {
    const double square = x * x;
    if (!std::isfinite(square)) return;
    add(square);
    add(std::fma(x, x, -square));
}

void ExactSum::add(const ExactSum& other) {
    set(normal());
    const std::array<std::int64_t, digits> more = other.normal();
    for (std::size_t k = 0; k < digits; ++k) digit_[k] += more[k];
    set(normal());
}

std::array<std::int64_t, ExactSum::digits> ExactSum::normal() const {
    std::array<std::int64_t, digits> result = digit_;
    std::int64_t carry = 0;
    for (std::size_t k = 0; k + 1 < digits; ++k) {
        const std::int64_t sum = result[k] + carry;
        carry = sum >> 32;
        result[k] = sum & 0xFFFFFFFF;
    }
    result.back() += carry;
    return result;
}

void ExactSum::set(const std::array<std::int64_t, digits>& normal) {
    digit_ = normal;
    added_ = 0;
}

Quad ExactSum::value() const {
    std::array<std::int64_t, digits> size = normal();
    const bool is_negative = size.back() < 0;
    if (is_negative) {
        for (std::int64_t& digit : size) digit = -digit;
        ExactSum opposite;
        opposite.set(size);
        size = opposite.normal();
    }
    Quad sum = 0;
    for (std::size_t k = 0; k < digits; ++k)  // the smallest first
        sum += static_cast<Quad>(size[k]) * static_cast<Quad>(std::ldexp(1.0L, lowest + 32 * static_cast<int>(k)));
    return is_negative ? -sum : sum;
}

}  // namespace alembert
