// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// Gimbal lock: three angles turn a body about two lines only, so that some angular velocities cannot be reached
/// by any rates of the angles. For z-x-z that is at sin theta = 0.

#include <optional>
#include <string>

#include "model/mechanism.hpp"
#include "program/interpret.hpp"

namespace alembert {

/// "the angles phi, theta, psi of frame 'F' …", with the advice to use a quaternion. It is given if the Jacobian
/// ∂ω/∂q' of a body has rank 3 in general (at points close to this state), while at this state its smallest
/// singular value is below 1e-3 of the largest.
std::optional<std::string> gimbal_lock(const Scene& scene, const Mechanism& mechanism, const State<double>& state);

}  // namespace alembert
