// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// Schiehlen's Newton-Euler formalism: the equations of all bodies with global Jacobians, projected on the
/// coordinates.
///
///     const Equations equations = schiehlen(build(scene));
///
/// This is an independent route: the Jacobians come from positions r(q,t) and rotation matrices S(q,t) only, J_T =
/// ∂r/∂q and J_R from the skew matrix Sᵀ ∂S/∂q. Neither T nor the angular velocities of the kinematics are used.
/// The speeds are the rates, whatever [speeds] the scene has. For the reactions of joints see
/// analysis/reaction/joint_reactions.hpp.

#include "model/formalism/newton_euler.hpp"
#include "model/formalism/steps.hpp"

namespace alembert {

/// J̄, and the accelerations at q'' = 0, of every body.
std::vector<BodyMotion> global_motions(const Mechanism& mechanism);

/// J̄ᵀ M̄ J̄ q'' + J̄ᵀ k̄ = J̄ᵀ q̄ᵉ. Throws ModelError with the obstacle if there is one.
Equations schiehlen(const Mechanism& mechanism);
/// Why the equations do not apply to a scene: its energies are given without the bodies that have them.
std::optional<std::string> obstacle_to_schiehlen(const Mechanism& mechanism);
/// The steps shown: the rows of J̄, and ā, of every body.
OwnSteps steps_of_schiehlen(const Mechanism& mechanism, const Equations& equations);

}  // namespace alembert
