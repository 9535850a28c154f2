// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// The kind of point at which curves of equilibria cross.
///
///     const BranchCrossing crossing = crossing_at(tracer, point);
///     crossing.kind, crossing.directions          // two tangents
///
/// There F_y has two null vectors v₁, v₂ and one left null vector ψ. With b_ij = ψᵀ F_yy v_i v_j, the tangents α
/// v₁ + β v₂ obey b₁₁ α² + 2 b₁₂ α β + b₂₂ β² = 0. If the parameter does not change along one of them, the point
/// is a pitchfork. (Keller, Lectures on Numerical Methods in Bifurcation Problems (1987), §5.20.)

#include "stability/equilibrium/tracer.hpp"

namespace alembert {

enum class PointKind { fold, pitchfork, transcritical, touching, family, hopf, hamiltonian_hopf };
const char* name_of(PointKind kind);

struct BranchCrossing {
    PointKind kind = PointKind::touching;
    std::vector<VectorOf<long double>> directions;  ///< of y, of length 1
};

BranchCrossing crossing_at(const Tracer& tracer, const TracedPoint& point);

}  // namespace alembert
