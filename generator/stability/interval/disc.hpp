// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// Whether there is an equilibrium or a steady motion at a state that was found in numbers, and one only near it.
///
///     disc_around(residuals, split, essential, point, 1e-26)      // StateKnown::proved: no number is off by more
///
/// The balance of forces, the constraints and their velocities are equations in the coordinates on which something
/// depends, the speeds that constraints give, their rates and the multipliers. Krawczyk's operator
///     K(X) = m − Y F(m) + (1 − Y F'(X)) (X − m)
/// over a box X around the numbers m, with Y near the inverse of F'(m), lies within X only if X holds one solution
/// and F' is regular in all of X (Moore, Kearfott and Cloud, Introduction to Interval Analysis (2009), chapter 8).

#include "model/assumption.hpp"
#include "stability/interval/point.hpp"
#include "stability/linear/tangent.hpp"

namespace alembert {

/// How well a state at which nothing moves, or moves steadily, is known.
enum class StateKnown {
    exactly,
    proved,      ///< there is one within a small distance of the numbers
    open,        ///< no regular inverse: within it there may be several or none
    in_numbers,  ///< nothing was proved, as where there are more equations than unknowns
};
/// "exact", "proved", "open", "in numbers".
const char* name_of(StateKnown known);

/// What a verdict rests on at a state that is known in numbers, and where signs were computed in them.
Assumption state_in_numbers();
Assumption signs_in_numbers();

/// `essential`: positions in split.q; `silent`: positions in split.u along which no force acts in any state.
/// `radius` is relative to numbers above 1.
StateKnown disc_around(const Residuals& residuals, const Split& split, const std::vector<int>& essential,
                       const std::vector<int>& silent, const RealBallPoint& point, double radius);

}  // namespace alembert
