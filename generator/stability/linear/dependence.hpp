// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// Finds the coordinates on which the motion of the others depends, and those that are cyclic.
///
///     const Dependences depends = dependences(residuals, split, instant);
///     const std::vector<bool> essential = essential_coordinates(depends, residuals, split, instant);
///
/// They are found at random states near the given one, not from the form of the equations. So a coordinate that
/// cancels is cyclic too, also if constraints have been eliminated. What decides on a side of a sign, an absolute
/// value, a larger or a smaller value, or is an argument of a table, counts by the form of the equations: the
/// border may be far from the state.

#include "stability/linear/tangent.hpp"

namespace alembert {

/// Rows: w', r'; columns: r, w, t. True where the derivative is not zero at one of a few states, or beyond a
/// border.
using Dependences = Eigen::Matrix<bool, Eigen::Dynamic, Eigen::Dynamic>;

/// Whether a node has a sign, an absolute value, a larger or a smaller value that t decides, or a table of t.
bool switches_in_time(const Program& program, int node);

Dependences dependences(const Residuals& residuals, const Split& split, const Instant<long double>& at);

/// The independent coordinates on which the rates of the speeds depend, those on which the rates of these
/// coordinates depend, and so on; and those that drive themselves, as x' = x does: in r' = S(r) w + b(r), b
/// changes with the coordinates that it moves, and no speeds c, the same for all of their values, give b = S c. (A
/// ball that rolls on a turntable has such c: the angles of its attitude are cyclic.) The others are cyclic.
std::vector<bool> essential_coordinates(const Dependences& depends, const Residuals& residuals, const Split& split,
                                        const Instant<long double>& at);

}  // namespace alembert
