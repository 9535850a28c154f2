// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// A Lyapunov function that the user proposes: does it prove anything?
///
///     V positive definite, dV/dt ≤ 0                 stable (Lyapunov)
///     … and dV/dt < 0                                asymptotically stable (Lyapunov)
///     … and no other motion stays where dV/dt = 0    asymptotically stable (Barbashin, Krasovskii, LaSalle)
///     dV/dt positive definite, V > 0 somewhere       unstable (Lyapunov's first theorem on instability)
///     dV/dt = λ V + W, λ > 0, W definite, likewise   unstable (Lyapunov's second theorem)
///     dV/dt > 0 wherever V > 0, likewise             unstable (Chetaev)
///
/// dV/dt is taken along the equations of motion. The signs are proved from the Taylor series and the normal form
/// (signs.hpp, semidefinite.hpp). If that does not succeed, they are sampled, which proves nothing. With
/// constraints the series are those in the independent coordinates and speeds, a semidefinite dV/dt is proved for
/// the energy alone, and nothing is sampled. References: Lyapunov (1892) §§13-16, Chetaev, The Stability of Motion
/// (1961), LaSalle & Lefschetz (1961), chapter 2.

#include "stability/verdict.hpp"

namespace alembert {

/// The answer, and the verdict that follows from V alone. `local` is null if the equations have no series at the
/// point. Throws ModelError if V cannot be read, is not zero at the point, or contains accelerations, multipliers,
/// t or a coordinate on which nothing depends; also if the scene has contacts or its equations change with time.
std::pair<LyapunovAnswer, Decision> by_lyapunov_function(const std::string& V, const LinearizedScene& scene,
                                                         const Local* local);

}  // namespace alembert
