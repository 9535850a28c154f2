// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// Where the second derivatives of the potential do not decide: its terms of higher degree.
///
///     V = x⁴              a minimum: stable
///     V = −x⁴, V = x³     none: unstable
///
/// W is the potential V, less T₀ where the frame moves, with the share of conserved momenta (Routh's amended
/// potential). Let its second derivatives be positive but for a kernel of one dimension. By the splitting lemma W
/// is, in other coordinates, Σ y² + a x^k + …, with a the first coefficient of W along the curve on which W_y = 0.
/// W has a strict minimum, which makes the position stable (Lagrange and Dirichlet), if and only if k is even and
/// a positive. Else it is unstable: of one degree of freedom by the phase plane; of a natural system without
/// gyroscopic forces by Kozlov's theorem (J. Appl. Math. Mech. 46 (1982) 14; Kozlov & Palamodov 1982); with
/// complete damping because the energy falls below its value at the position and no other equilibrium is near. Of
/// two coordinates with no second derivatives at all the leading form decides likewise.

#include "stability/integrals.hpp"

namespace alembert {

struct DegenerateMinimum {
    bool minimum = false;   ///< strict; else there is none
    bool unstable = false;  ///< proved
    int degree = 0;         ///< of the term that decides
    double coefficient = 0;
};

/// Nothing where it does not apply or nothing is decided.
std::optional<DegenerateMinimum> degenerate_minimum(const Local& local, const PowerSign& power);

}  // namespace alembert
