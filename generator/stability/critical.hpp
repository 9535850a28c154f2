// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// Lyapunov's critical cases, from terms of higher degree of the equations of motion.
///
/// One zero root, the others with negative real parts: on the curve x(c) on which all equations but one are at
/// rest, the one left is G c^m + …; m even: unstable; m odd: G < 0 asymptotically stable, G > 0 unstable (Lyapunov
/// 1892, §§28-32; Malkin, Theory of Stability of Motion (1952), §32).
///
/// One pair ±iω, the others with negative real parts: the sign of the first Lyapunov coefficient
///     l₁ = Re[⟨p, C(q,q,q̄)⟩ − 2⟨p, B(q, A⁻¹B(q,q̄))⟩ + ⟨p, B(q̄, (2iω − A)⁻¹B(q,q))⟩] / 2ω
/// (Kuznetsov, Elements of Applied Bifurcation Theory (2004), equation (5.62)).
///
/// Zero roots as many as the steady motions near have parameters: stable (Lyapunov and Malkin). That these exist
/// is found by Newton's method a little way along each zero eigenvector.

#include "stability/verdict.hpp"

namespace alembert {

/// Undecided where it does not apply, or nothing is decided.
Decision one_zero_root(const Local& local, const std::vector<RootOf>& roots);
Decision pair_on_axis(const Local& local, const std::vector<RootOf>& roots);
Decision family_of_motions(const Local& local, const std::vector<RootOf>& roots);

}  // namespace alembert
