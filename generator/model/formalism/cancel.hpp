// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// Cancels removable poles of sines and cosines: (1 − cos²θ)/sin θ is sin θ.
///
/// Equations in generalized speeds divide by determinants such as sin θ, because q' is solved for. In velocities
/// and inertia forces most of these divisions cancel. The Fourier normal form has no division and does not see
/// that.

#include "model/mechanism.hpp"

namespace alembert {

/// `e` as a quotient without common powers of a sine or cosine, if that is shorter. The result is `e` itself if it
/// is not shorter, contains no such division or one by a sum, or exceeds the readable size.
GiNaC::ex cancelled(const GiNaC::ex& e, const Mechanism& mechanism);

}  // namespace alembert
