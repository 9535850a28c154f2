// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// The Gibbs-Appell equations: the energy of the accelerations, differentiated by the accelerations.
///
///     const Equations equations = appell(build(scene));
///
/// A route of its own: S = ½ Σ m a·a + ½ α·I α + α·(ω × I ω) is formed and differentiated; neither T nor partial
/// velocities of the bodies are used. The speeds are those of the scene, or the rates (kinematics.hpp);
/// nonholonomic constraints that they leave no room for need no multiplier. The others enter with theirs.

#include "formalism/steps.hpp"

namespace alembert {

/// ∂S/∂u'_r = Q_r, Σ Q_r u_r being the power of the forces (Pars, A Treatise on Analytical Dynamics (1965), the
/// chapters on the Gibbs-Appell equations). Throws ModelError with the obstacle where there is one.
Equations appell(const Mechanism& mechanism);
/// A scene without coordinates, one with [energy] kinetic or lagrangian: its accelerations are not known, and
/// those of `kinematics`.
std::optional<std::string> obstacle_to_appell(const Mechanism& mechanism);
/// S, its derivatives and Q.
OwnSteps steps_of_appell(const Mechanism& mechanism, const Equations& equations);

}  // namespace alembert
