// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// Claims that give a motion in closed form, x = x0*cosh(sqrt(g/l)*t): the motion is put into the equations of
/// motion and the constraints, which must then hold at all times and for all values of the constants.

#include "check/claims.hpp"
#include "check/verdict.hpp"

namespace alembert {

/// `which`: the positions in Scene::claims of the claims at "solution". Together they describe one motion; each
/// has the name of a coordinate or a multiplier on its left side. The verdicts are stored in `claims` at the same
/// positions.
void check_solution(const Scene& scene, Claims& read, const std::vector<std::size_t>& which,
                    std::vector<CheckedClaim>& claims);

}  // namespace alembert
