// SPDX-License-Identifier: GPL-2.0-or-later
// d/dt ∂L/∂q̇ − ∂L/∂q = Q + Aᵀλ,   A q̇ + b = 0  (Zhang & Qin (1-76)). For a holonomic constraint f(q,t) = 0 the row is
// ∂f/∂q and b = ∂f/∂t; differentiated once more, A q̈ = γ with γ = −Ȧ q̇ − ḃ.
#include "formalism/routh.hpp"

#include "formalism/lagrange.hpp"

namespace alembert {

Equations routh(const Mechanism& mechanism) {
    Equations equations = lagrange_operator(mechanism);
    equations.formalism = "routh";
    for (const Mechanism::Constraint& constraint : mechanism.constraints) {
        equations.A.push_back(constraint.row);
        equations.gamma.push_back(constraint.acceleration);
        equations.lambda.push_back(constraint.multiplier);
    }
    return equations;
}

}  // namespace alembert
