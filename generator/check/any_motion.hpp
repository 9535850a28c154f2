// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// Equations that every motion obeys that the constraints allow: q'' = w + Aᵀλ, A q'' = γ with any w. What follows
/// from them alone is kinematics.
///
///     ExactStates states(mechanism, any_motion(equations, mechanism), {});

#include "model/formalism/equations.hpp"

namespace alembert {

/// The result has the constraints of `equations`. For w it contains the symbols q'' themselves, since exact states
/// choose values for them before they solve.
Equations any_motion(Equations equations, const Mechanism& mechanism);

}  // namespace alembert
