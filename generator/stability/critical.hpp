// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// Lyapunov's critical cases, from terms of higher degree of the equations of motion.
///
/// One zero root, the others with negative real parts: on the curve x(c) on which all equations except one are at
/// rest, that one is G c^m + …. If m is even, the state is unstable; if m is odd, it is asymptotically stable for
/// G < 0 and unstable for G > 0 (Lyapunov 1892, §§28-32; Malkin, Theory of Stability of Motion (1952), §32).
///
/// One pair ±iω, the others with negative real parts: the sign of the first Lyapunov coefficient
///     l₁ = Re[⟨p, C(q,q,q̄)⟩ − 2⟨p, B(q, A⁻¹B(q,q̄))⟩ + ⟨p, B(q̄, (2iω − A)⁻¹B(q,q))⟩] / 2ω
/// (Kuznetsov, Elements of Applied Bifurcation Theory (2004), equation (5.62)).
///
/// If there are as many zero roots as parameters of the neighbouring steady motions, the state is stable (Lyapunov
/// and Malkin). That these motions exist is proved by forces that vanish whenever some speeds are zero, as the one
/// along the speed of a bicycle; where this does not succeed (in a dead zone), it is found by Newton's method a
/// small distance along each zero eigenvector, in 34 digits.

#include "stability/verdict.hpp"

namespace alembert {

/// How it is shown that neighbouring steady motions exist.
enum class FamilyProof { exact, in_numbers };

/// Undecided if the case does not apply or is not decided.
Decision one_zero_root(const Local& local, const std::vector<RootOf>& roots);
Decision pair_on_axis(const Local& local, const std::vector<RootOf>& roots);
Decision family_of_motions(const Local& local, const std::vector<RootOf>& roots, FamilyProof by);

}  // namespace alembert
