// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// Kane's equations: partial velocities, generalized active and inertia forces.
///
///     const Equations equations = kane(build(scene));
///
/// This is an independent route: neither T nor the gradient of V is used. (Only [energy] potential, whose forces
/// are not known, enters as −∂V/∂q.) The speeds are those of the scene, or the rates (kinematics.hpp). Constraints
/// that the speeds satisfy by themselves are eliminated: there are no partial velocities that violate them, and
/// their multipliers do not appear. The others enter with their multipliers.

#include "model/formalism/steps.hpp"

namespace alembert {

/// The intermediate results of Kane & Levinson's procedure.
struct PartialVelocities {
    struct Of {
        std::string label;
        std::vector<Vector3> velocity,
            angular;  ///< for each speed ∂v/∂u_r along N and ∂ω/∂u_r along the body's axes
    };
    std::vector<Of> bodies;
};
PartialVelocities partial_velocities(const Mechanism& mechanism);

/// F_r = conservative + dissipative + applied,   F*_r = inertia − Σ M_rs u'_s.
struct KaneForces {
    std::vector<GiNaC::symbol> u, udot;
    GiNaC::matrix M;
    std::vector<GiNaC::ex> inertia, conservative, dissipative, applied;
};
KaneForces kane_forces(const Mechanism& mechanism);

/// F_r + F*_r = 0 (Zhang & Qin, §1.8; Kane & Levinson, Dynamics (1985), chapter 6). Throws ModelError with the
/// obstacle if there is one.
Equations kane(const Mechanism& mechanism);
/// Why the equations do not apply to a scene: it has no coordinates, or it has [energy] kinetic or lagrangian, so
/// that velocities are not known, or `kinematics` has an obstacle.
std::optional<std::string> obstacle_to_kane(const Mechanism& mechanism);
/// The steps shown: partial velocities, F and F*.
OwnSteps steps_of_kane(const Mechanism& mechanism, const Equations& equations);

}  // namespace alembert
