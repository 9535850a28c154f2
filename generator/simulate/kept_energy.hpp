// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// Which events and impacts may change the energy of a motion whose equations keep it. Those that do not, such as
/// a counter, leave its drift a measure of the error.
///
///     may_jump_in_energy(mechanism, energy)                      // of any motion
///     has_jumped_in_energy(motion, mechanism, restitution)       // of this one

#include "alembert/hybrid/hybrid_motion.hpp"
#include "model/energy.hpp"

namespace alembert {

/// Whether some motion with these contacts and events may lose or gain energy where it jumps. `energy` is that of
/// the mechanism.
bool may_jump_in_energy(const Mechanism& mechanism, const Energy& energy);

/// Whether this motion has had an impact or impulse that may have changed it. What set states do to the energy is
/// known in numbers (EnergyError::set_change).
bool has_jumped_in_energy(const HybridMotion& motion, const Mechanism& mechanism,
                          const std::vector<double>& restitution);

}  // namespace alembert
