// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// Nielsen's form of Lagrange's equations: ∂L̇/∂q̇ − 2 ∂L/∂q = Q.
///
///     const Equations equations = nielsen(build(read_scene("pendulum.toml")));
///
/// L̇ is the time derivative of the Lagrangian along any motion and contains q̈. The formalism needs only L, so
/// that there is a second derivation also for scenes whose energies are given without bodies. Constraints enter
/// with their multipliers. (J. Nielsen, Vorlesungen über elementare Mechanik (1935); it follows from d/dt ∂L/∂q̇ =
/// ∂L̇/∂q̇ − ∂L/∂q.)

#include "model/formalism/steps.hpp"

namespace alembert {

/// Throws ModelError for a scene without coordinates.
Equations nielsen(const Mechanism& mechanism);
std::optional<std::string> obstacle_to_nielsen(const Mechanism& mechanism);
/// The steps shown: ∂L̇/∂q̇ and ∂L/∂q.
OwnSteps steps_of_nielsen(const Mechanism& mechanism, const Equations& equations);

}  // namespace alembert
