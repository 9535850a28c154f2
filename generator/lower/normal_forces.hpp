// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// Dry friction whose normal force is the multiplier of a constraint: the reaction makes friction, and friction
/// changes the reaction.
///
///     M u' = f + Aᵀλ + Σ c_k N_k,   A u' = γ,   N_k = s_k λ_k,   c_k = −μ_k sign(v_k) ∂v_k/∂u
///
/// With x the solution for f and y_k that for c_k alone, all by one factorization, u' and λ are x + Σ N_k y_k, and
/// the N follow from as many equations (1 − S D) N = S λ(x), D being the multipliers in y. s is 1 for a contact,
/// which only presses, and the sign of λ for a constraint: that of λ(x), as long as 1 − s D > 0. Where a
/// determinant of 1 − S D is not positive the reaction has no value, or more than one (Painlevé, Leçons sur le
/// frottement, 1895; Génot & Brogliato, Eur. J. Mech. A 18 (1999) 653).

#include "formalism/equations.hpp"
#include "lower/lowering.hpp"

namespace alembert {

class NormalForces {
public:
    /// Throws ModelError where a multiplier is none of the equations', or several constraints that may pull as
    /// well as press have friction.
    NormalForces(const Mechanism& m, const Equations& e);

    bool any() const { return !pressed_.empty(); }
    const std::vector<GiNaC::symbol>& multipliers() const { return multipliers_; }
    /// These are 0 from now on.
    void leave_out(Lowering& lowering, Program& program) const;
    /// (u', −λ) of [M Aᵀ; A 0] with its lower triangle and right-hand side; defines N.
    std::optional<std::vector<int>> solve(Lowering& lowering, Program& program, const std::vector<int>& matrix,
                                          const std::vector<int>& right) const;
    /// After `solve`: what N of this friction is divided by, 1 where it does not depend on friction.
    int determinant(Program& program, const Mechanism::Friction& f) const;

private:
    struct Pressed {
        std::size_t row;  ///< in A
        GiNaC::symbol multiplier;
        bool may_pull;
        std::vector<const Mechanism::Friction*> frictions = {};
    };

    const Equations& e_;
    std::vector<Pressed> pressed_;
    std::vector<GiNaC::symbol> multipliers_;
    mutable int determinant_ = -1;
};

}  // namespace alembert
