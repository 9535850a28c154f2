// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// What events look at and what they set.
///
///     events_of_forces(mechanism)[2]                               // whether event 2 looks at forces of constraints
///     z.depends(energy, states_set(mechanism, action))             // whether an event may change the energy

#include <vector>

#include "model/mechanism.hpp"

namespace alembert {

/// The states that an event sets.
std::vector<GiNaC::symbol> states_set(const Mechanism& mechanism, const Mechanism::EventAction& action);

/// For each event whether its value holds multipliers.
std::vector<bool> events_of_forces(const Mechanism& mechanism);

/// For each event whether its value changes only where events set states: states without a rate are all that moves
/// it.
std::vector<bool> events_of_modes(const Mechanism& mechanism);

}  // namespace alembert
