// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// The energy of a mechanism, whether it is conserved, and the power of everything that changes it.
///
/// E = T + V (if a Lagrangian is given, E = q'·∂L/∂q' − L). Jacobi's generalized energy is h = q'·∂L/∂q' − L = T₂
/// − T₀ + V, where T₂ and T₀ are the parts of T of degree two and zero in the rates. Along every motion
///     dh/dt = Q·q' − ∂L/∂t,      dE/dt = dh/dt + d(T₁ + 2T₀)/dt
/// with − λ·b added to both for constraints A q' + b = 0 that move (from Lagrange's equations; Zhang & Qin, §1.5).
/// The right-hand side of the second is `power`, that of loads outside V and of prescribed motions. It is
/// integrated together with the motion, so that E − E₀ − ∫power dt measures the accuracy of a run.

#include "model/mechanism.hpp"

namespace alembert {

struct Energy {
    GiNaC::ex kinetic, potential;  ///< if a Lagrangian is given: its part of second degree, and −L at rest
    GiNaC::ex energy, jacobi, power;
    bool conserved = false;            ///< whether E is constant along every motion
    bool jacobi_conserved = false;     ///< whether h is
    std::shared_ptr<Intermediates> z;  ///< the table of the intermediate symbols of these values
};

/// For expressions of readable size conservation is decided by exact zero tests, for larger ones by structure
/// (whether t occurs at all, whether there are loads at all).
Energy energy_of(const Mechanism& mechanism);

/// The mechanism with a table that has the entries of the energy's table and of its own, so that the expressions
/// of both can be used with the result.
Mechanism in_terms_of(const Energy& energy, const Mechanism& mechanism);

/// Is `e` zero for all values of its symbols? It is not if its value at one state shows that. Otherwise the
/// Fourier normal form decides for expressions up to a certain size; larger ones give no answer.
std::optional<bool> vanishes(const GiNaC::ex& e, const Mechanism& mechanism);

/// The same, where no answer counts as no.
bool is_identically_zero(const GiNaC::ex& e, const Mechanism& mechanism);

}  // namespace alembert
