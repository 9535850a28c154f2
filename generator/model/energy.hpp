// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// What is conserved, and what the energy of a mechanism owes to whom.
///
/// E = T + V (where a Lagrangian is given: E = q'·∂L/∂q' − L). Jacobi's generalized energy is
/// h = q'·∂L/∂q' − L = T₂ − T₀ + V, T₂ and T₀ being the parts of T of second and no degree in the rates.
/// Along every motion
///     dh/dt = Q·q' − ∂L/∂t,      dE/dt = dh/dt + d(T₁ + 2T₀)/dt
/// and − λ·b beside each for constraints A q' + b = 0 that move (from Lagrange's equations; Zhang & Qin, §1.5).
/// The right-hand side of the second is `power`: what loads outside V and prescribed motions do. It is integrated
/// beside the motion, so that E − E₀ − ∫power dt measures the run.

#include "model/mechanism.hpp"

namespace alembert {

struct Energy {
    GiNaC::ex kinetic, potential;  ///< where a Lagrangian is given: its second-degree part, and −L at rest
    GiNaC::ex energy, jacobi, power;
    bool conserved = false;         ///< E is constant along every motion
    bool jacobi_conserved = false;  ///< h is
};

/// Conservation is decided by exact zero tests where the expressions are of readable size, and structurally (does
/// t occur at all, are there loads at all) beyond.
Energy energy_of(const Mechanism& mechanism);

/// Is `e` zero for all values of its symbols? No where one state shows it; else decided by the Fourier normal form
/// up to a size; nothing beyond that.
std::optional<bool> vanishes(const GiNaC::ex& e, const Mechanism& mechanism);

/// The same, where "not seen to be" counts as no.
bool is_identically_zero(const GiNaC::ex& e, const Mechanism& mechanism);

}  // namespace alembert
