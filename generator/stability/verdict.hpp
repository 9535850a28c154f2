// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// Verdicts from eigenvalues, and from the structure of the forces.

#include "stability/integrals.hpp"
#include "stability/stability.hpp"

namespace alembert {

struct Decision {
    StabilityVerdict verdict = StabilityVerdict::undecided;
    StabilityTheorem theorem = StabilityTheorem::none;
    std::string reason;
    std::vector<Assumption> assumed = {};
};

/// The verdict for x' = A x itself, or for a polynomial (then `A` is null, and a multiple root on the axis is
/// unstable).
Decision decide_linear(const std::vector<RootOf>& roots, const RealBallMatrix* A);

/// The verdict of the roots on the nonlinear equations; undecided if one lies on the axis or near it.
Decision decide_first(const std::vector<RootOf>& roots);

/// Are the equations linear in coordinates and speeds?
bool is_linear(const Mechanism& mechanism, const Equations& equations);

/// The roots of the blocks of A; with `even`, those of M s² + G s + K with symmetric M, K and skew G.
std::vector<RootOf> eigenvalues_of(const RealBallMatrix& A, bool even);

}  // namespace alembert
