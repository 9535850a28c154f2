// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// Periodic motions: multipliers of the variational equations over one period.
///
///     x' = f(t, x),   f(t + T, x) = f(t, x),   Φ' = ∂f/∂x Φ,   Φ(0) = 1:   multipliers are the eigenvalues of
///     Φ(T)
///
/// f and ∂f/∂x are the Program of the equations and its derivative, in 34 digits, integrated by extrapolation
/// (run/quad_motion.hpp) at two tolerances; what Φ differs by is the radius of its entries, from which the discs
/// of the multipliers follow. A start that the period does not lead back to is moved by Newton's method
/// (shooting); of equations that do not hold t the period is moved with it. All |ρ| < 1: asymptotically stable,
/// one beyond: unstable (Lyapunov's first approximation, which holds for periodic motions too). On the circle:
/// critical. Of linear equations with a Hamiltonian a simple multiplier whose disc is alone with its mirror image
/// in the circle lies on it (Krein; Yakubovich & Starzhinskii 1975), which proves stability. Of equations without
/// t one multiplier is 1, along the motion, and is not counted: stable means that the orbit is (Andronov & Witt).
/// With constraints the multipliers are those of the tangent space (periodic.hpp).

#include "derive/derived.hpp"
#include "stability/verdict.hpp"

namespace alembert {

struct FloquetResult {
    double period = 0;
    std::vector<std::complex<double>> multipliers;  ///< by size, the largest first
    std::vector<double> radii;
    std::vector<std::string> states;                    ///< independent coordinates and speeds
    std::vector<std::pair<std::string, double>> start;  ///< coordinates and speeds of the periodic motion
    Decision decision;
};

/// `period`: 0 stands for the one of [simulation]. Throws ModelError where there are contacts, where the
/// equations do not have this period, and where no periodic motion is found.
FloquetResult floquet(const Derived& derived, const Start& start, const ExactOverrides& exact_at, double period);

}  // namespace alembert
