// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// A section of Poincaré: the states of a motion at which a − b grows through zero.
///
///     add_section(scene, mechanism, "theta1 = 0");
///     Run run = simulate(scene, wishes);
///     for (const EventRecord& crossing : take_crossings(run)) crossing.state;   // q, q', as integrated

#include "simulate/simulate.hpp"

namespace alembert {

/// Adds an event that is only recorded. Throws ModelError if `section` is not "a = b" with expressions of the
/// state of the mechanism, which is that of the scene.
void add_section(Scene& scene, const Mechanism& mechanism, const std::string& section);

/// Moves the records of that event out of the run's events.
std::vector<EventRecord> take_crossings(Run& run);

}  // namespace alembert
