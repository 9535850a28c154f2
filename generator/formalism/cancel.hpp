// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// Poles of sines and cosines that are none: (1 − cos²θ)/sin θ is sin θ.
///
/// Equations in speeds divide by determinants such as sin θ where q' is solved for; in velocities and inertia
/// forces most of these divisions cancel, which the Fourier normal form, having no division, does not see.

#include "model/mechanism.hpp"

namespace alembert {

/// `e` as a quotient without common powers of a sine or cosine, where that is shorter; `e` itself otherwise, and
/// where it holds no such division or one by a sum, and where it is beyond the readable size.
GiNaC::ex cancelled(const GiNaC::ex& e, const Mechanism& mechanism);

}  // namespace alembert
