// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// Decides by terms of higher degree of the potential if its second derivatives do not decide.
///
///     V = x⁴              a minimum: stable
///     V = −x⁴, V = x³     none: unstable
///
/// W is the potential V, minus T₀ if the frame moves, with the contribution of conserved momenta (Routh's amended
/// potential). Let its second derivatives be positive except for a kernel of one dimension. By the splitting lemma
/// W is, in other coordinates, Σ y² + a x^k + …, with a the first coefficient of W along the curve on which W_y =
/// 0. W has a strict minimum, which makes the position stable (Lagrange and Dirichlet), if and only if k is even
/// and a positive. Otherwise it is unstable: for one degree of freedom by the phase plane; for a natural system
/// without gyroscopic forces by Kozlov's theorem (J. Appl. Math. Mech. 46 (1982) 14; Kozlov & Palamodov 1982);
/// with complete damping because the energy falls below its value at the position and no other equilibrium is
/// near. For two coordinates without any second derivatives the leading form decides in the same way.

#include "stability/integrals.hpp"

namespace alembert {

struct DegenerateMinimum {
    bool minimum = false;   ///< whether there is a strict minimum; otherwise there is none
    bool unstable = false;  ///< whether instability is proved
    int degree = 0;         ///< the degree of the term that decides
    double coefficient = 0;
};

/// Nothing if this does not apply or nothing is decided.
std::optional<DegenerateMinimum> degenerate_minimum(const Local& local, const PowerSign& power);

}  // namespace alembert
