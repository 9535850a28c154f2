// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// What a run leaves behind: the rows of its CSV file, and what is said about contacts.

#include "reaction/joint_reactions.hpp"
#include "commands/modes.hpp"

namespace alembert {

/// Columns: t, coordinates, rates (theta1'), multipliers of constraints, then of unilateral contacts (0 while open), energy,
/// outputs. Where rates jump there are two rows for one time, before and after; where they only change their law, one.
/// `reactions` may be null; then JOINT.fx … JOINT.mz are the last columns, at the parameters of `first`.
std::string csv(const PhasedMotion& motion, const Derived& derived, Modes& modes, const JointReactions* reactions, const State<double>& first);

/// {name, time}; with impulses also {impulses: {coordinate: number}, energy_gain}
Json event_as_json(const EventRecord& event, const Mechanism& mechanism);

/// A line each; of more than twenty those in the middle are counted.
std::string events_as_text(const std::vector<EventRecord>& events, const Mechanism& mechanism);

/// [{time, name, event: impact|release|rest, speed_before, speed_after, energy_loss, reaction_impulse}]
Json contacts_as_json(const std::vector<ContactEvent>& events, const std::vector<std::string>& names);

/// A line each for the first twenty, then how many more.
std::string contacts_as_text(const std::vector<ContactEvent>& events, const std::vector<std::string>& names);

}  // namespace alembert
