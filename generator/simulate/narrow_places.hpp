// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// Whether a force may change fast in a region that is narrow beside the way of the motion. Runs of this program
/// find such places (alembert/ode/quick_places.hpp); emitted programs and units do not look for them, and say so.
///
///     tell_narrow_places(prepared, program, Kinks::watched, start.state(), start.duration);

#include "analysis/state/prepared.hpp"
#include "program/event_code.hpp"
#include "program/interpret.hpp"

namespace alembert {

/// Warns if there is one within a way of the start as long as its speed, or its distance from zero, would make it.
void tell_narrow_places(Prepared& prepared, const Program& program, Kinks kinks, const State<double>& start,
                        double duration);

}  // namespace alembert
