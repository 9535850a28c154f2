// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// Exact random points of the constraint variety f(q, t) = 0, modulo the prime of program/modular.hpp.
///
///     const Variety variety = variety_points(program, positions, others, 3);
///     variety.on_variety && evaluate_mod(program, variety.points[0], positions)->value[positions[0]].is_zero()
///
/// Each f is solved for an unknown that it determines when those before it are known, or two together for two
/// unknowns (analysis/exact/solving_order.hpp): coordinates, or a parameter. Points with solved parameters are
/// generic points of
/// {(q, t, parameters): f = 0}: a statement that holds there holds for almost all parameters. No parameter is
/// solved for that would have to take a value of its own, as L = 0 in L sin a + L sin b = 0. If the variety has
/// several sheets, such as x·y = 0, each point is on one of them. If the equations have no such order, the points
/// are random ones outside the variety, and `on_variety` is false.

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
