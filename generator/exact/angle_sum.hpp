// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// A variable that a condition makes a sum of multiples of others, as gears do: its turn is the product of theirs.
/// The circle's group has every odd part of a turn: of the variables of a condition there is always one that can
/// be had from the others.
///
///     // c − 2a + 3b − 1 = 0
///     if (const auto sum = angle_sum(program, condition, {Variable::Kind::coordinate, 2}))
///         // turn(c) = turn(a)²·turn(b)⁻³·turn(1)
///         set_angle(point, *sum, value_of_c);
///
/// Without this a point knows the angle's value and not that its sine has to do with those of the others.

#include <optional>
#include <vector>

#include "program/modular.hpp"

namespace alembert {

struct AngleSum {
    std::vector<std::pair<Variable, std::uint64_t>> multiples{};  ///< modulo the order of the circle's group
    std::uint64_t number = 0;                                     ///< a turn by so many radians
    Rational half_turns = 0;                                      ///< and by so many π
};

/// Nothing if the condition is not a sum of numbers times variables (and π), or the denominator of a multiple is
/// even.
std::optional<AngleSum> angle_sum(const Program& program, int condition, const Variable& unknown);

/// The condition is such a sum, whatever the multiples.
bool is_sum_of_variables(const Program& program, int condition);

/// Sets the turn of the angle whose value is `value`; false if the group does not have the half turns (π/3).
bool set_angle(ModularPoint& point, const AngleSum& sum, Prime value);

}  // namespace alembert
