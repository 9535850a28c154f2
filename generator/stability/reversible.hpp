// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// Steady motions of reversible systems with one frequency, such as those of a disc that rolls without slipping.
///
/// Let the states be (z, v), and let the equations stay the same if v and t change their signs:
///
///     z' = v b(z, v²),        v' = g(z) + v² h(z, v²).
///
/// States with v = 0 and g = 0 are steady motions. Let (z₀, 0) be one of them with b·∂g/∂z = −ω² < 0: the
/// eigenvalues of the first approximation are ±iω and zeros, which decide nothing. With ds = v dt and e = v²/2
///
///     dz/ds = b(z, 2e),       de/ds = g(z) + 2 e h(z, 2e),
///
/// a regular field near (z₀, 0) with d²e/ds² = −ω² there. So e is strictly concave along each of its curves, and
/// the part of a curve with e ≥ 0 is an arc, which is short if g and e are small at one of its points. The motion
/// goes to and fro on this arc. All motions near z₀ are therefore periodic and stay near: z₀ is stable. (The
/// symmetric periodic motions of reversible systems: Devaney, Trans. AMS 218 (1976) 89. Rolling bodies of
/// revolution: Routh, Advanced Rigid Dynamics (1905), §§241-247; O'Reilly, Nonlinear Dynamics 10 (1996) 287.)

#include "stability/verdict.hpp"

namespace alembert {

/// Stable if one speed can be found whose reversal, with that of time, leaves the equations as they are, which is
/// proved in exact arithmetic (exact_field.hpp); undecided otherwise.
Decision by_reversal(const Local& local, const std::vector<RootOf>& roots);

}  // namespace alembert
