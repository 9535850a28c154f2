// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// Adds one unrolled step of Newton's method to the constraints: the roots "projected" (q, then u) and "pivot".
///
///     add_projection(program, mechanism, equations, K);      // after "position"; K as the accelerations have it
///     program.nodes_of(Group::projected);                         // n + s
///
/// For constraints with a multiplier it is the least change in the metric of M, computed with the factors of K =
/// [M Aᵀ; A 0] that the accelerations have: first positions along q' = S u, S = ∂h/∂u, then speeds at the new
/// positions. Any speeds obey holonomic constraints that the speeds have eliminated, Aₑ S = 0 (e·e = 1 of a
/// quaternion if the speeds are angular velocities; then all holonomic constraints are eliminated). M has no
/// entries for directions across these, so coordinates are moved along the rows of Aₑ, by the least change in the
/// Euclidean metric; for a quaternion this takes a handful of operations. The same is done if e·e = 1 of
/// quaternions are the only constraints with multipliers: there the least change in the metric of M is along e,
/// where M has no inertia. Each constraint has one pivot: of A M⁻¹Aᵀ, of the rows' own products such as Aₑ Aₑᵀ, or
/// 0 if it is nonholonomic and eliminated, when there is nothing to move. If all constraints are of the last kind,
/// there are no roots.

#include "model/formalism/equations.hpp"
#include "program/program.hpp"
#include "program/solve.hpp"

namespace alembert {

/// The matrix of the accelerations, as a projection needs it.
struct MotionMatrix {
    const std::vector<int>& K;  ///< the lower triangle of [M Aᵀ; A 0]: speeds, constraints that are kept, `tied`
    const std::vector<const Mechanism::Constraint*>& tied;  ///< further unknowns of K (program/tie.hpp)
    const Witness& witness;
};

/// The program must have the roots "position". With `fold`, parameters are numbers. Nothing is added if a matrix
/// is singular at every state.
void add_projection(Program& program, const Mechanism& mechanism, const Equations& equations,
                    const MotionMatrix& matrix, bool fold);

}  // namespace alembert
