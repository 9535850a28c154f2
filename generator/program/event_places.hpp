// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// Where the function of an event may come to zero and go back within a short time: at the zeros of these nodes.
///
///     event_places(program, {event});      // of |x − 1|, (x − 1)² and 1/(1 + (x − 1)²/w²) − 1/2: x − 1

#include <vector>

#include "program/program.hpp"

namespace alembert {

/// The arguments of abs, sign, tanh and atan, the differences of those of min and max, and the bases of even
/// powers, from which the events are computed; each once. They are in the program already, apart from differences.
std::vector<int> event_places(Program& program, const std::vector<int>& events);

}  // namespace alembert
