// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// Events of a scene at a state of rest, where a small disturbance sets them off.
///
///     if (const auto why = disturbed_by_event(derived, start)) …    // "event 'catch' is at its zero here …"
///
/// On one side of such a state the equations are others than on the other, or rates jump between them, so that no
/// first approximation describes the motion near it.

#include <optional>
#include <string>

#include "analysis/derive/derived.hpp"
#include "program/lower/start.hpp"

namespace alembert {

/// Why neither eigenvalues nor the energy tell about stability at this state: an event that changes the motion is
/// at its zero. Of events that look at multipliers nothing is said. The equations have the states among their
/// speeds.
std::optional<std::string> disturbed_by_event(const Derived& derived, const Start& start);

/// Whether some events of a scene set states or rates, or give impulses.
bool is_changed_by_events(const Scene& scene);

}  // namespace alembert
