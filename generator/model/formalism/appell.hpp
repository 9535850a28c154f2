// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// The Gibbs-Appell equations: the energy of accelerations, differentiated with respect to the accelerations.
///
///     const Equations equations = appell(build(scene));
///
/// This is an independent route: S = ½ Σ m a·a + ½ α·I α + α·(ω × I ω) is formed and differentiated, and neither T
/// nor partial velocities of the bodies are used. The speeds are those of the scene, or the rates
/// (kinematics.hpp). Nonholonomic constraints that the speeds eliminate need no multiplier; the other constraints
/// enter with their multipliers.

#include "model/formalism/steps.hpp"

namespace alembert {

/// ∂S/∂u'_r = Q_r, where Σ Q_r u_r is the power of the forces (Pars, A Treatise on Analytical Dynamics (1965), the
/// chapters on the Gibbs-Appell equations). Throws ModelError with the obstacle if there is one.
Equations appell(const Mechanism& mechanism);
/// Why the equations do not apply to a scene: it has no coordinates, or it has [energy] kinetic or lagrangian, so
/// that accelerations are not known, or `kinematics` has an obstacle.
std::optional<std::string> obstacle_to_appell(const Mechanism& mechanism);
/// The steps shown: S, its derivatives and Q.
OwnSteps steps_of_appell(const Mechanism& mechanism, const Equations& equations);

}  // namespace alembert
