// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// The general equation of dynamics: virtual work of applied and of inertia forces.
///
///     const Equations equations = dalembert(build(scene));
///
/// From positions alone: virtual displacements are ∂r/∂q, accelerations are positions differentiated twice. A
/// rigid body is its mass points, r_C + R ρ: no angular velocity is used. (Torques, of which only the turning that
/// they work on is known, take ∂ω/∂q'.) Constraints enter with their multipliers.

#include "formalism/steps.hpp"

namespace alembert {

/// Virtual works per δq_i: of the applied forces, and of the inertia forces with q'' in them.
struct VirtualWork {
    std::vector<GiNaC::ex> conservative, dissipative, applied, inertia;
};
VirtualWork virtual_work(const Mechanism& mechanism);

/// Σ (F − m a)·δr = 0 (Zhang & Qin (1-22), (1-44)). Throws ModelError with the obstacle where there is one.
Equations dalembert(const Mechanism& mechanism);
/// A scene whose energies are given without the bodies that have them.
std::optional<std::string> obstacle_to_dalembert(const Mechanism& mechanism);
/// Virtual works, and the condition of rest as a product with its roots (rest.cpp).
OwnSteps steps_of_dalembert(const Mechanism& mechanism, const Equations& equations);

/// The equations at rest relative to the coordinates: virtual work with q' = q'' = 0, inputs and t as they are.
std::vector<GiNaC::ex> rest_conditions(const Mechanism& mechanism, const Equations& equations);

}  // namespace alembert
