// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// Claims that hold to first order near an equilibrium or a steady motion, such as theta'' + g*theta/l = 0 near
/// theta = 0.
///
/// With q = q0 + ε ξ, q' = u0 + ε η and the accelerations of the equations, q'' = −ε M⁻¹(D η + P ξ), both sides of
/// such a claim agree but for terms with ε².

#include "check/claims.hpp"
#include "check/verdict.hpp"

namespace alembert {

/// `claim` has Claim::near. Coordinates that it does not name may have any value, rates that it does not name are
/// small; so are inputs. Undecided, with the reason, where there are constraints or more than four coordinates.
void check_first_order(const Claim& claim, Claims& read, CheckedClaim& result);

}  // namespace alembert
