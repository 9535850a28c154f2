// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// Stability from conserved quantities: the energy, or a combination of it with other first integrals (Chetaev's
/// method).
///
///     if (const auto proof = proof_by_integrals(local)) …     // stable, and by which theorem
///
/// H is the energy, or Jacobi's T₂ − T₀ + V if the frame of the scene moves, with dH/dt ≤ 0 along every motion.
/// F_k are integrals: momenta of cyclic coordinates, angular momenta, and the constraints. If multipliers make d(H
/// + Σ λ_k F_k) = 0 at the state, and the second differential of this sum is positive definite on the directions
/// in which all F_k keep their values, the motion is stable (Chetaev, The Stability of Motion (1961), §§10-14;
/// Rumyantsev 1968): H + Σ λ_k F_k + μ Σ (F_k − F_k⁰)² is a Lyapunov function for a large μ. With H alone this is
/// the theorem of Lagrange and Dirichlet, with momenta of cyclic coordinates Routh's.

#include "stability/local.hpp"

namespace alembert {

/// The effect of loads outside V on H along a motion.
struct PowerSign {
    bool known = false;      ///< whether it is known that dH/dt is never positive near the state
    bool is_zero = false;    ///< whether H is conserved
    RealBallMatrix damping;  ///< of −dH/dt = q'ᵀ D q' + …, over split.u; zeros if H is conserved
    GiNaC::ex H;
};
PowerSign power_sign(const Local& local);

/// Whether −dH/dt is positive definite in all rates except those of cyclic coordinates with conserved momenta.
bool damping_is_complete(const Local& local, const PowerSign& power);

/// Is the function of q and q' proved to keep its value along every motion? (In exact arithmetic, at random
/// motions.)
bool is_integral(const GiNaC::ex& function, const Local& local);

struct IntegralProof {
    enum class By { energy, momenta, angular_momenta };
    By by = By::energy;
    bool relative = false;  ///< whether H is Jacobi's integral and not the energy
};

/// Nothing if no definite combination is found.
std::optional<IntegralProof> proof_by_integrals(const Local& local, const PowerSign& power);

}  // namespace alembert
