// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// The common zeros of two conditions in two unknowns, modulo 2⁶¹ − 1, as for a four-bar linkage with given
/// lengths.
///
///     const CommonZeros at = common_zeros(values, {.turned = {true, true}, .seed = 7});
///     at.list[0]           // {tan(beta/2), tan(gamma/2)}
///
/// y is eliminated: Res_y(f(x, y), g(x, y)) is interpolated over x, its roots are found, and at each the common
/// roots of f(x, ·) and g(x, ·) (Cox, Little & O'Shea, Ideals, Varieties, and Algorithms, 3rd ed., §3.6,
/// proposition 3). A condition with a sine and a cosine is a fraction over powers of 1 + x², where x is the
/// tangent of the half angle, and is multiplied by these powers.

#include <array>
#include <functional>
#include <optional>
#include <vector>

#include "program/prime_polynomial.hpp"

namespace alembert {

/// The values of both conditions at (x, y); nothing at a pole.
using TwoConditions = std::function<std::optional<std::array<Prime, 2>>(Prime x, Prime y)>;

struct ZerosOptions {
    std::array<bool, 2> turned{false, false};  ///< is the unknown a tangent of a part of an angle?
    std::uint64_t seed = 0;
};

struct CommonZeros {
    std::vector<std::array<Prime, 2>> list;
    std::size_t degree = 0;  ///< degree of the eliminated equation; 0 if there is none
};

/// The list is empty if the degrees are too high, if the conditions depend on each other, or if no zero is in the
/// field.
CommonZeros common_zeros(const TwoConditions& conditions, const ZerosOptions& options);

}  // namespace alembert
