// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// A sum of numbers in double precision without rounding, so that it does not depend on their order.
///
///     ExactSum sum;
///     for (double x : {1e300, 1.0, -1e300}) sum.add(x);
///     sum.value();                                         // 1
///
/// Method: an integer that is as long as the range of double precision, in digits of 32 bits (U. Kulisch, Computer
/// Arithmetic and Validity, 2nd ed., §8). The numbers must be finite.

#include <array>
#include <cstdint>

#include "program/quad.hpp"

namespace alembert {

class ExactSum {
public:
    static constexpr std::size_t digits = 70;

    void add(double x);
    /// x², which double precision does not hold, as the sum of two numbers; exact unless they are below 1e-308.
    void add_square(double x);
    void add(const ExactSum& other);
    /// To 113 bits.
    Quad value() const;

    /// The one form of a sum: digits from 0 to 2³² − 1, the last with its sign. `set` takes them back.
    std::array<std::int64_t, digits> normal() const;
    void set(const std::array<std::int64_t, digits>& normal);

private:
    std::array<std::int64_t, digits> digit_ = {};  ///< the first one counts 2⁻¹⁰⁷⁴
    std::uint32_t added_ = 0;                      ///< since the digits were normal
};

}  // namespace alembert
