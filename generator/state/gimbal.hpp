// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// Gimbal lock: three angles turn a body about two lines only, so that no rates of theirs give some angular
/// velocities. For z-x-z that is at sin theta = 0.

#include <optional>
#include <string>

#include "model/mechanism.hpp"
#include "program/interpret.hpp"

namespace alembert {

/// "the angles phi, theta, psi of frame 'F' …", with the advice to take a quaternion, if the Jacobian ∂ω/∂q' of a
/// body is of rank 3 in general (at points beside this state) and at this state near a lower one: its smallest
/// singular value below 1e-3 of the largest.
std::optional<std::string> gimbal_lock(const Scene& scene, const Mechanism& mechanism, const State<double>& state);

}  // namespace alembert
