// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// A claim without open names, compared with the equations at states.
///
///     settle_closed_claim(now, 2, states);     // writes now.verdicts[2]

#include "check/comparison.hpp"

namespace alembert {

/// `states`: states that obey the law and the constraints of `now`.
void settle_closed_claim(Comparison& now, std::size_t claim, ExactStates& states);

/// Where there are no such states, digits may decide on the scene's own branch. Whether they did.
bool settle_without_states(Comparison& now, std::size_t claim, const Motions& motions);

}  // namespace alembert
