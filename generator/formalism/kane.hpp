// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// Kane's equations: partial velocities, generalized active and inertia forces.
///
///     const Equations equations = kane(build(scene));
///
/// A route of its own: neither T nor the gradient of V is used. ([energy] potential alone, of which no force is
/// known, enters as −∂V/∂q.) The speeds are those of the scene, or the rates (kinematics.hpp). Constraints that
/// the speeds leave no room for are eliminated: partial velocities along them do not exist, and no multiplier
/// appears. The others enter with their multipliers.

#include "formalism/steps.hpp"

namespace alembert {

/// What Kane & Levinson's procedure shows on the way.
struct PartialVelocities {
    struct Of {
        std::string label;
        std::vector<Vector3> velocity,
            angular;  ///< for each speed: ∂v/∂u_r along N, ∂ω/∂u_r along the body's axes
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
/// obstacle where there is one.
Equations kane(const Mechanism& mechanism);
/// A scene without coordinates, one with [energy] kinetic or lagrangian: its velocities are not known, and those
/// of `kinematics`.
std::optional<std::string> obstacle_to_kane(const Mechanism& mechanism);
/// Partial velocities, F and F*.
OwnSteps steps_of_kane(const Mechanism& mechanism, const Equations& equations);

}  // namespace alembert
