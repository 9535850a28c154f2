// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// Claims that give a motion in closed form, x = x0*cosh(sqrt(g/l)*t): put into the equations of motion and the
/// constraints, these must hold at all times, for all values of the constants.

#include "check/claims.hpp"
#include "check/verdict.hpp"

namespace alembert {

/// `which`: the positions in Scene::claims of those at "solution", which describe one motion together, each with
/// the name of a coordinate or a multiplier on its left. Verdicts go to `claims` at the same positions.
void check_solution(const Scene& scene, Claims& read, const std::vector<std::size_t>& which,
                    std::vector<CheckedClaim>& claims);

}  // namespace alembert
