// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// A variable that a condition determines as a sum of multiples of others, as gears do. Its turn is a product of
/// powers of their turns. The group of the circle contains every odd fraction of a turn, so that at least one
/// variable of such a condition can be computed from the others.
///
///     // c − 2a + 3b − 1 = 0
///     if (const auto sum = angle_sum(program, condition, {Variable::Kind::coordinate, 2}))
///         // turn(c) = turn(a)²·turn(b)⁻³·turn(1)
///         set_angle(point, *sum, value_of_c);
///
/// Without this, a point would have the angle's value, but its sine would be unrelated to the sines of the others.

#include <optional>
#include <vector>

#include "program/modular.hpp"

namespace alembert {

struct AngleSum {
    std::vector<std::pair<Variable, std::uint64_t>>
        multiples{};           ///< multiples modulo the order of the circle's group
    std::uint64_t number = 0;  ///< a further turn in radians
    Rational half_turns = 0;   ///< and a further turn in units of π
};

/// Nothing if the condition is not a sum of numbers times variables (and π), or the denominator of a multiple is
/// even.
std::optional<AngleSum> angle_sum(const Program& program, int condition, const Variable& unknown);

/// Whether the condition is such a sum, whatever the multiples.
bool is_sum_of_variables(const Program& program, int condition);

/// Sets the turn of the angle whose value is `value`; false if the group does not have the half turns (π/3).
bool set_angle(ModularPoint& point, const AngleSum& sum, Prime value);

}  // namespace alembert
