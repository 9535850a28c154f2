// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// Stability of periodic motions by the multipliers of the variational equations over one period.
///
///     x' = f(t, x),   f(t + T, x) = f(t, x),   Φ' = ∂f/∂x Φ,   Φ(0) = 1:   multipliers are the eigenvalues of
///     Φ(T)
///
/// f and ∂f/∂x are the Program of the equations and its derivative, with 34 digits, integrated by extrapolation
/// (program/quad_motion.hpp) at two tolerances. The difference of the two Φ is the radius of its entries, from
/// which the discs of the multipliers follow. A start to which the motion does not return after the period is
/// moved by Newton's method (shooting); if the equations do not contain t, the period is moved too. If all |ρ| <
/// 1, the motion is asymptotically stable; if one |ρ| > 1, it is unstable (Lyapunov's first approximation, which
/// holds for periodic motions too). Multipliers on the circle are critical. For linear equations with a
/// Hamiltonian, a simple multiplier whose disc touches no other disc than its own mirror image in the circle lies
/// on the circle (Krein; Yakubovich & Starzhinskii 1975), which proves stability. If the equations do not contain
/// t, one multiplier, that along the motion, is 1 and is not counted: stability is then that of the orbit
/// (Andronov & Witt). With constraints the multipliers are those of the tangent space (periodic.hpp).

#include "analysis/derive/derived.hpp"
#include "stability/verdict.hpp"

namespace alembert {

struct FloquetResult {
    double period = 0;
    std::vector<std::complex<double>> multipliers;  ///< by size, the largest first
    std::vector<double> radii;
    std::vector<std::string> states;                    ///< independent coordinates and speeds
    std::vector<std::pair<std::string, double>> start;  ///< coordinates and speeds of the periodic motion
    Decision decision;
    bool is_in_numbers = false;  ///< by a motion in floating point
};

/// `period`: 0 stands for the one of [simulation]. Throws ModelError where there are contacts, where the
/// equations do not have this period, and where no periodic motion is found.
FloquetResult floquet(const Derived& derived, const Start& start, const ExactOverrides& exact_at, double period);

/// The same of a motion with impacts, events that change it, or forces that jump; `scene` has its own values. Such
/// a motion is followed in floating point, and the decision says so.
FloquetResult floquet_through_jumps(const Scene& scene, const std::string& by, double period);

/// The eigenvalues by their size, the largest first.
std::vector<RootOf> multipliers_in_order(const RealBallMatrix& Phi);

/// The decision on a motion of which nothing but its multipliers is known, in numbers.
Decision decision_by_multipliers(const FloquetResult& found, const std::vector<RootOf>& roots, bool autonomous);

}  // namespace alembert
