// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// States on the branch of the constraints' positions that goes through the initial state.
///
///     for (const Start& place : places_on_branch(mechanism, lower_constraints(mechanism), start, 8, 1)) …
///
/// The same constraints may hold on several branches, which meet at single poses: a parallelogram with cranks of
/// equal lengths is also assembled with one of them crossed. What follows from the rest on one branch need not do
/// so on another. A search from a place chosen at random ends on any of them, while a walk of short steps along
/// the positions stays on its branch.

#include <optional>
#include <vector>

#include "analysis/exact/own_branch.hpp"
#include "program/lower/start.hpp"
#include "program/program.hpp"

namespace alembert {

/// Up to `wanted` states at t = start.t whose positions and rates obey the constraints, none of them the initial
/// state itself; all coordinates and rates may move. At a pose where branches meet, the first step of a walk goes
/// along the initial rates, forwards or backwards. If no walk gets anywhere (the pose is the only one, or branches
/// meet in it and all rates are zero), the states are found by searches from places around it. The random numbers
/// follow from the seed. If `rates_must_obey` is false, rates that cannot be made to obey are left as they are.
/// The program is lower_constraints(mechanism).
std::vector<Start> places_on_branch(const Mechanism& mechanism, const Program& program, const Start& start,
                                    int wanted, unsigned seed, bool rates_must_obey = true);

/// The branch on which the scene starts, by some places on it. Nothing without holonomic constraints, if no
/// initial state obeys the constraints, or if branches meet at it and it is at rest, so that it is on several of
/// them.
std::optional<OwnBranch> own_branch(const Mechanism& mechanism);

}  // namespace alembert
