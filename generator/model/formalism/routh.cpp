// SPDX-License-Identifier: GPL-2.0-or-later
// d/dt ∂L/∂q̇ − ∂L/∂q = Q + Aᵀλ,   A q̇ + b = 0  (Zhang & Qin (1-76)). For a holonomic constraint f(q,t) = 0 the row
// is ∂f/∂q and b = ∂f/∂t; differentiated once more, A q̈ = γ with γ = −Ȧ q̇ − ḃ.
#include "model/formalism/routh.hpp"

#include "base/language/say.hpp"
#include "model/formalism/elements.hpp"
#include "model/formalism/lagrange.hpp"

namespace alembert {

std::optional<std::string> obstacle_to_routh(const Mechanism& mechanism) {
    return no_coordinates(mechanism, say("Lagrange's equations"));
}

Equations routh(const Mechanism& mechanism) {
    Equations equations = lagrange_operator(with_own_intermediates(mechanism));
    equations.formalism = "routh";
    attach_constraints(mechanism, equations);
    return equations;
}

}  // namespace alembert
