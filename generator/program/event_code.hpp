// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// The events of a program as the runtime's list of instructions (alembert/ode/event_code.hpp), from which it
/// finds bounds on them within a step. An event that contains multipliers or functions without values, or that is
/// too long for bounds to say anything, gets no instructions.

#include <memory>

#include "alembert/ode/event_code.hpp"
#include "program/program.hpp"

namespace alembert {

std::shared_ptr<const EventCode> event_code(const Program& program);

/// Likewise the functions of the state in the right-hand side that may change fast in a small region alone
/// (alembert/ode/quick_places.hpp); null if there are none.
///
/// `kinks`: whether abs, min and max are among them where several of them may bound such a region. A run that ends
/// its steps at each change of a side (program/switches.hpp) knows them.
enum class Kinks { followed, watched };
std::shared_ptr<const EventCode> quick_places_code(const Program& program, Kinks kinks);

}  // namespace alembert
