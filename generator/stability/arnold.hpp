// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// Arnold's theorem for two degrees of freedom: a Hamiltonian with distinct frequencies ω₁, ω₂ without resonances
/// up to order four, in Birkhoff's normal form
///
///     H = Ω₁ I₁ + Ω₂ I₂ + a I₁² + b I₁ I₂ + c I₂² + …,      I = (x² + y²)/2,
///
/// is stable at the origin if D = a Ω₂² − b Ω₁ Ω₂ + c Ω₁² ≠ 0 (Arnold, Dokl. Akad. Nauk 137 (1961) 255; Moser
/// 1968; Meyer, Hall & Offin, Introduction to Hamiltonian Dynamical Systems (2009), §13.3). The theorem decides
/// cases in which H is indefinite, such as the triangular points of the restricted three-body problem.

#include "stability/verdict.hpp"

namespace alembert {

/// Undecided if it does not apply, at a resonance, and if D is not certainly different from zero.
Decision by_arnold(const Local& local, const PowerSign& power, const std::vector<RootOf>& roots);

}  // namespace alembert
