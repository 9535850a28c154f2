// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// One step of Newton's method to the constraints, unrolled: the roots "projected" (q, then u) and "pivot".
///
///     add_projection(program, mechanism, equations, K);      // after "position"; K as the accelerations have it
///     program.nodes_of(Group::projected);                         // n + s
///
/// For constraints that keep a multiplier it is the least change in the metric of M, from the factors of K = [M
/// Aᵀ; A 0] that the accelerations have: positions along q' = S u, S = ∂h/∂u, then speeds where they have arrived.
/// Holonomic constraints that the speeds have eliminated (e·e = 1 of a quaternion, with the angular velocity; then
/// all are) hold in speeds by themselves, Aₑ S = 0. M knows nothing of directions across them, and coordinates go
/// along the rows of Aₑ, by the least change in the plain metric: a handful of operations for a quaternion. A
/// constraint has one pivot: of A M⁻¹Aᵀ, of Aₑ Aₑᵀ, or 0 if it is nonholonomic and eliminated, where there is
/// nothing to move. No roots at all where that is true of each.

#include "formalism/equations.hpp"
#include "program/program.hpp"

namespace alembert {

/// Of a program that has the roots "position". K: the lower triangle of [M Aᵀ; A 0], of size s and those
/// constraints that are kept; `fold`: parameters are numbers. Nothing is added where a matrix is singular at every
/// state.
void add_projection(Program& program, const Mechanism& mechanism, const Equations& equations,
                    const std::vector<int>& K, bool fold);

}  // namespace alembert
