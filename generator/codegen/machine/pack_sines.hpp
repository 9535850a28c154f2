// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// The sine and the cosine of an angle as lines of a function for several systems, to stand between its other
/// lines.
///
///     const auto [sine, cosine] = sine_and_cosine_inside({.add = …, .number = …}, angle);
///
/// They have the bits of sines_for_code and sines_of_packs_for_code (alembert/native/simd_math.hpp), whose
/// formulas they follow step by step, for angles up to farthest_for_code.

#include <functional>

#include "codegen/machine/lines.hpp"

namespace alembert::machine {

struct LineMaker {
    std::function<int(const Line&)> add;  ///< gives the value of the line
    std::function<int(double)> number;    ///< the value of a constant
    int lanes;                            ///< 4 or 8
};

std::array<int, 2> sine_and_cosine_inside(const LineMaker& make, int angle);

}  // namespace alembert::machine
