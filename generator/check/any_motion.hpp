// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// Equations that every motion obeys which the constraints allow: q'' = w + Aᵀλ, A q'' = γ with any w. What holds
/// by them is kinematics.
///
///     ExactStates states(mechanism, any_motion(equations, mechanism), Motions::At::motion, 0, 0);

#include "formalism/equations.hpp"

namespace alembert {

/// With the constraints of `equations`; w is written as q'' itself, which exact states draw before they solve.
Equations any_motion(Equations equations, const Mechanism& mechanism);

}  // namespace alembert
