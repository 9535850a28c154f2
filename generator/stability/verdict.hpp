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
};

/// Of x' = A x itself, or of a polynomial (then `A` is null and a multiple root on the axis is unstable).
Decision decide_linear(const std::vector<RootOf>& roots, const CertainMatrix* A);

/// Of the roots alone, what they say of the nonlinear equations; undecided where one lies on the axis or near it.
Decision decide_first(const std::vector<RootOf>& roots);

/// Are the equations linear in coordinates and speeds?
bool is_linear(const Mechanism& mechanism, const Equations& equations);

/// Roots of the blocks of A; `even`: those of M s² + G s + K with symmetric M, K and skew G.
std::vector<RootOf> eigenvalues_of(const CertainMatrix& A, bool even);

}  // namespace alembert
