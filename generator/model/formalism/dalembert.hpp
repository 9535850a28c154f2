// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// The general equation of dynamics: virtual work of applied and of inertia forces.
///
///     const Equations equations = dalembert(build(scene));
///
/// Only positions are used: virtual displacements are ∂r/∂q, and accelerations are positions differentiated twice.
/// A rigid body consists of its mass points, r_C + R ρ, so that no angular velocity is needed. (Torques use
/// ∂ω/∂q', because only the rotation on which they do work is known.) Constraints enter with their multipliers.

#include "model/formalism/steps.hpp"

namespace alembert {

/// The virtual work per δq_i of the applied forces and of the inertia forces, which contain q''.
struct VirtualWork {
    std::vector<GiNaC::ex> conservative, dissipative, applied, inertia;
};
VirtualWork virtual_work(const Mechanism& mechanism);

/// Σ (F − m a)·δr = 0 (Zhang & Qin (1-22), (1-44)). Throws ModelError with the obstacle if there is one.
Equations dalembert(const Mechanism& mechanism);
/// Why the equations do not apply to a scene: its energies are given without the bodies that have them.
std::optional<std::string> obstacle_to_dalembert(const Mechanism& mechanism);
/// The steps shown: virtual works, and the condition of rest as a product with its roots (rest.cpp).
OwnSteps steps_of_dalembert(const Mechanism& mechanism, const Equations& equations);

/// The equations at rest relative to the coordinates: the virtual work with q' = q'' = 0; inputs and t stay
/// symbols.
std::vector<GiNaC::ex> rest_conditions(const Mechanism& mechanism, const Equations& equations);

}  // namespace alembert
