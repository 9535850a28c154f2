// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// Events whose functions have the zeros of a simpler one: (x − 5)² and |x − 5| only touch zero where x − 5 passes
/// it, and (x − 5)³ is flat there.
///
///     watch_bases(program, mechanism.event_actions);     // the events of the program are x − 5 instead

#include <vector>

#include "model/mechanism.hpp"
#include "program/program.hpp"

namespace alembert {

constexpr int never = 2;  ///< a direction in which nothing passes zero

/// Changes the first roots of Group::event, one for each action, into their bases. Where a function only touches
/// zero, its base may pass in both directions, if the approach has the direction of the action; else it never
/// does.
void watch_bases(Program& program, std::vector<Mechanism::EventAction>& actions);

}  // namespace alembert
