// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// What the formalisms in generalized speeds share: velocities as functions of q, u and t, derivatives along the
/// motion that they make, generalized forces, and the constraints that the speeds leave.
///
///     const InSpeeds motion(mechanism, kinematics(mechanism).value());
///     const std::vector<ex> a = motion.derivative(motion.short_in_speeds(velocities));    // with u' in it

#include "formalism/elements.hpp"
#include "formalism/kinematics.hpp"

namespace alembert {

class InSpeeds {
public:
    /// The mechanism must outlive this.
    InSpeeds(const Mechanism& mechanism, Kinematics kinematics);

    const Kinematics& kinematics() const { return k_; }

    /// With h for q'.
    std::vector<GiNaC::ex> in_speeds(const std::vector<GiNaC::ex>& values) const;
    /// The same in short form. What cancels must be seen to cancel: w = w₁ x + w₂ y + w₃ z has no derivative in
    /// the body at u' = 0.
    std::vector<GiNaC::ex> short_in_speeds(const std::vector<GiNaC::ex>& values) const;
    Vector3 short_in_speeds(const Vector3& v) const;

    /// d/dt at u' = 0 of what is in speeds; in short form where the rates have poles.
    std::vector<GiNaC::ex> without_acceleration(const std::vector<GiNaC::ex>& values) const;
    Vector3 without_acceleration(const Vector3& v) const;
    /// d/dt of what is in speeds, with u'.
    std::vector<GiNaC::ex> derivative(const std::vector<GiNaC::ex>& values) const;

    /// Σ force·∂velocity/∂u_r of velocities and forces in q'.
    std::vector<GiNaC::ex> generalized(const std::vector<GiNaC::ex>& velocities,
                                       const std::vector<GiNaC::ex>& forces) const;
    /// Of gravity, springs and [energy] potential: by partial velocities, but for the last, of which no force is
    /// known.
    std::vector<GiNaC::ex> conservative() const;
    /// Of the loads: `dissipative` selects dampers and Rayleigh's function, or all the others.
    std::vector<GiNaC::ex> loads(bool dissipative) const;

    /// Without the divisions that cancel, where the rates have poles.
    GiNaC::ex without_false_poles(const GiNaC::ex& e) const;

    /// Equations with u, u', h, form, poles and the constraints that are eliminated; M, forces and multipliers are
    /// open.
    Equations begin(const std::string& formalism) const;
    /// A, γ and λ of the constraints that are left.
    void attach_kept(Equations& equations) const;

private:
    GiNaC::ex shortened(const GiNaC::ex& value) const;

    const Mechanism& m_;
    Kinematics k_;
    GiNaC::exmap by_ = {};  ///< q' → h
};

/// Forces of the eliminated constraints: with all rates as speeds their rows contribute. `reaction` is what is
/// left of the equations in q, q', q'' for each coordinate, inertia minus forces; Aₑᵀ λₑ = reaction − Aᵀ λ is
/// solved by (Aₑ Aₑᵀ) λₑ = Aₑ (…), which fails where Aₑ loses rank only.
void recover_multipliers(const Mechanism& mechanism, Equations& equations, const std::vector<GiNaC::ex>& reaction);

}  // namespace alembert
