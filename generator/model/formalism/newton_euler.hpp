// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// Newton's and Euler's equations of all bodies, stacked, and their projection on the coordinates. Multibody
/// formalisms share this once each has its Jacobians and accelerations.
///
/// For body i with mass m, central inertia I (along the body's axes), velocity and angular velocity linear in the
/// rates,
///     v = J_T q' + …,   ω = J_R q' + …,   a = J_T q'' + ā,   α = J_R q'' + ᾱ,
/// the equations of all bodies with the reactions g are M̄ J̄ q'' + k̄ = q̄ᵉ + Q̄ g, with
///     M̄ = diag(m E, I),   J̄ = (J_T, J_R),   k̄ = (m ā, I ᾱ + ω × I ω).
/// Reactions do no work along J̄, J̄ᵀ Q̄ = 0, so that
///     M = J̄ᵀ M̄ J̄,   f = J̄ᵀ (q̄ᵉ − k̄)
/// (Schiehlen, Technische Dynamik (1986), chapter 4; Multibody System Dynamics 1 (1997) 149, §2).

#include "model/formalism/equations.hpp"

namespace alembert {

/// One body's rows of J̄ and its accelerations at q'' = 0.
struct BodyMotion {
    std::vector<Vector3> J_T;  ///< for each coordinate, along N
    std::vector<Vector3> J_R;  ///< for each coordinate, along the body's axes; empty for a particle
    Vector3 a_bar;             ///< along N
    Vector3 w, alpha_bar;      ///< along the body's axes
};

/// `motions` are in the order of Mechanism::masses. Gravity acts on the bodies and is projected by J_T, other
/// loads by the Jacobians of the points and expressions on which they act. Constraints enter with their
/// multipliers.
Equations projected(const std::string& formalism, const Mechanism& mechanism,
                    const std::vector<BodyMotion>& bodies);

/// M̄ of a body's rotation times w: I w.
Vector3 inertia_times(const std::array<GiNaC::ex, 6>& I, const Vector3& w, Intermediates& z);

}  // namespace alembert
