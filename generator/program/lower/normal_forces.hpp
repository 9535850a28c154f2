// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// Dry friction whose normal force is the multiplier of a constraint: the reaction determines the friction, and
/// the friction changes the reaction.
///
///     M u' = f + Aᵀλ + Σ c_k N_k,   A u' = γ,   N_k = s_k λ_k,   c_k = −μ_k sign(v_k) ∂v_k/∂u
///
/// Let x be the solution for f and y_k that for c_k alone, all with one factorization. Then u' and λ are x + Σ N_k
/// y_k, and the N follow from as many equations (1 − S D) N = S λ(x), where D are the multipliers in y. s is 1 for
/// a contact, which only presses; for a constraint it is the sign of λ, which is that of λ(x) as long as 1 − s D >
/// 0 if the friction is on it alone. If a determinant of 1 − S D is not positive, the reaction has no value or
/// more than one (Painlevé, Leçons sur le frottement, 1895; Génot & Brogliato, Eur. J. Mech. A 18 (1999) 653).

#include "model/formalism/equations.hpp"
#include "program/lower/lowering.hpp"

namespace alembert {

class NormalForces {
public:
    /// No friction of this kind.
    explicit NormalForces(const Equations& e) : e_(e) {}
    /// Throws ModelError if the equations do not have a multiplier.
    NormalForces(const Mechanism& m, const Equations& e);

    bool any() const { return !pressed_.empty(); }
    const std::vector<GiNaC::symbol>& multipliers() const { return multipliers_; }
    /// Sets these normal forces to 0 from now on.
    void leave_out(Lowering& lowering, Program& program) const;
    /// The friction on one multiplier, s_k c_k.
    struct Column {
        std::size_t row;  ///< the row in A
        std::vector<int> nodes;
    };
    struct Solution {
        std::vector<int> unknowns;  ///< u', −λ
        int determinant;            ///< of 1 − S D
        std::vector<Column> columns;
    };
    /// Solves with the lower triangle of [M Aᵀ; A 0] and its right-hand side, and defines N.
    std::optional<Solution> solve(Lowering& lowering, Program& program, const std::vector<int>& matrix,
                                  const std::vector<int>& right) const;
    /// Whether the normal force of this friction depends on friction.
    bool determine(const Mechanism::Friction& f) const;

private:
    struct Pressed {
        std::size_t row;  ///< the row in A
        GiNaC::symbol multiplier;
        bool may_pull;
        std::vector<const Mechanism::Friction*> frictions = {};
    };

    struct Forces {
        std::vector<int> normal, signs;
        int determinant;
    };
    Forces forces(Program& program, const std::vector<std::vector<int>>& found) const;

    const Equations& e_;
    std::vector<Pressed> pressed_;
    std::vector<GiNaC::symbol> multipliers_;
};

}  // namespace alembert
