// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// Random points of the constraint variety f(q, t) = 0, exactly, modulo the prime of program/modular.hpp.
///
///     const Variety variety = variety_points(program, positions, others, 3);
///     variety.on_variety && evaluate_mod(program, variety.points[0], positions)->value[positions[0]].is_zero()
///
/// Every f is solved for an unknown of its own, in which it is at most quadratic: a coordinate outside angles, a
/// parameter or t; a coordinate inside angles that is a sum of whole multiples of others (gears); the turn of a
/// coordinate inside angles, by the half-angle's tangent. Unknowns are given away one after the other: one that
/// occurs in a single constraint among those that are left is that constraint's. So the loop
///     a cos α + b cos β − c cos γ − d = 0,    a sin α + b sin β − c sin γ = 0
/// gets its d from the first and then, before it, its a from the second. Points with solved parameters are generic
/// points of {(q, t, parameters): f = 0}: what holds there holds for almost all parameters. Of a variety of
/// several sheets, such as x·y = 0, the points are on the one that the solving meets. Where some f finds no
/// unknown (both sums above with numbers in place of a … d) the points are random ones beside the variety, and
/// `on_variety` says so.

#include <vector>

#include "program/modular.hpp"

namespace alembert {

struct Variety {
    std::vector<ModularPoint> points;
    bool on_variety = true;  ///< or there was nothing to solve
    double degree = 1;       ///< of the solved values in the random ones, at most: a factor for every degree
    double conditions = 0;   ///< squares that the points were chosen for
};

/// `count` points where all nodes `positions` vanish and `others` can be evaluated. `given` is the same at all
/// points (a scene's parameters). Fewer points where no more were found within a few hundred trials.
Variety variety_points(const Program& program, const std::vector<int>& positions, const std::vector<int>& others,
                       int count, const std::map<std::pair<Variable::Kind, int>, Prime>& given = {});

}  // namespace alembert
