// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// What the formalisms in generalized speeds share: velocities as functions of q, u and t, their derivatives along
/// the motion, generalized forces, and the constraints that the speeds do not eliminate.
///
///     const InSpeeds motion(mechanism, kinematics(mechanism).value());
///     const std::vector<ex> a = motion.derivative(motion.short_in_speeds(velocities));    // with u' in it

#include "model/formalism/elements.hpp"
#include "model/formalism/kinematics.hpp"

namespace alembert {

class InSpeeds {
public:
    /// The mechanism must outlive this.
    InSpeeds(const Mechanism& mechanism, Kinematics kinematics);

    const Kinematics& kinematics() const { return k_; }

    /// The values with h substituted for q'.
    std::vector<GiNaC::ex> in_speeds(const std::vector<GiNaC::ex>& values) const;
    /// The same in short form, so that terms that cancel are recognized: w = w₁ x + w₂ y + w₃ z has no derivative
    /// in the body at u' = 0.
    std::vector<GiNaC::ex> short_in_speeds(const std::vector<GiNaC::ex>& values) const;
    Vector3 short_in_speeds(const Vector3& v) const;

    /// d/dt at u' = 0 of values in terms of speeds; in short form if the rates have poles.
    std::vector<GiNaC::ex> without_acceleration(const std::vector<GiNaC::ex>& values) const;
    Vector3 without_acceleration(const Vector3& v) const;
    /// d/dt, with u', of values in terms of speeds.
    std::vector<GiNaC::ex> derivative(const std::vector<GiNaC::ex>& values) const;

    /// Σ force·∂velocity/∂u_r of velocities and forces in q'.
    std::vector<GiNaC::ex> generalized(const std::vector<GiNaC::ex>& velocities,
                                       const std::vector<GiNaC::ex>& forces) const;
    /// The generalized forces of gravity, springs and [energy] potential. They follow from partial velocities,
    /// except those of the last, whose forces are not known.
    std::vector<GiNaC::ex> conservative() const;
    /// The generalized forces of the loads; `dissipative` selects dampers and Rayleigh's function, or all the
    /// others.
    std::vector<GiNaC::ex> loads(bool dissipative) const;

    /// `e` without divisions that cancel, if the rates have poles.
    GiNaC::ex without_false_poles(const GiNaC::ex& e) const;

    /// Equations with u, u', h, form, poles and the constraints that are eliminated; M, forces and multipliers are
    /// not set yet.
    Equations begin(const std::string& formalism) const;
    /// Adds A, γ and λ of the constraints that are not eliminated.
    void attach_kept(Equations& equations) const;

private:
    GiNaC::ex shortened(const GiNaC::ex& value) const;

    const Mechanism& m_;
    Kinematics k_;
    GiNaC::exmap by_ = {};  ///< q' → h
};

/// Computes the multipliers of the eliminated constraints, which appear in the equations with all rates as speeds.
/// `reaction` is the residual of these equations in q, q', q'' for each coordinate, inertia minus forces. Aₑᵀ λₑ =
/// reaction − Aᵀ λ is solved by (Aₑ Aₑᵀ) λₑ = Aₑ (…), which fails only where Aₑ loses rank.
void recover_multipliers(const Mechanism& mechanism, Equations& equations, const std::vector<GiNaC::ex>& reaction);

}  // namespace alembert
