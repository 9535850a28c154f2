// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// Exact random points of the constraint variety f(q, t) = 0, modulo the prime of program/modular.hpp.
///
///     const Variety variety = variety_points(program, positions, others, 3);
///     variety.on_variety && evaluate_mod(program, variety.points[0], positions)->value[positions[0]].is_zero()
///
/// Every f is solved for a different unknown, in which it is at most quadratic: a coordinate outside angles, a
/// parameter or t; a coordinate inside angles that is a sum of whole multiples of others (gears); or the turn of a
/// coordinate inside angles, by the tangent of the half angle. Unknowns are assigned one after the other: an
/// unknown that occurs in only one of the remaining constraints is assigned to that constraint. So the loop
///     a cos α + b cos β − c cos γ − d = 0,    a sin α + b sin β − c sin γ = 0
/// is solved for d by the first equation and, before that, for a by the second. Points with solved parameters are
/// generic points of {(q, t, parameters): f = 0}: a statement that holds there holds for almost all parameters. If
/// the variety has several sheets, such as x·y = 0, the points are on the sheet that the solution happens to find.
/// If some f has no such unknown (both sums above with numbers in place of a … d), the points are random ones
/// outside the variety, and `on_variety` is false.

#include <vector>

#include "program/modular.hpp"

namespace alembert {

struct Variety {
    std::vector<ModularPoint> points;
    bool on_variety = true;  ///< also true if there was nothing to solve
    double degree = 1;  ///< a bound on the degree of the solved values in the random ones, by which other degrees
                        ///< must be multiplied
    double conditions = 0;  ///< the number of values that had to be squares
};

/// `count` points at which all nodes `positions` vanish and `others` can be evaluated. `given` values (a scene's
/// parameters) are the same at all points. There are fewer points if no more were found in a few hundred trials.
Variety variety_points(const Program& program, const std::vector<int>& positions, const std::vector<int>& others,
                       int count, const std::map<std::pair<Variable::Kind, int>, Prime>& given = {});

}  // namespace alembert
