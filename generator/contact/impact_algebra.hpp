// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// The symbolic side of an impact: its equations in general coordinates, and their solution at the scene's pose.
///
/// The pose is the scene's, exactly: numbers, multiples of π, parameters stay symbols; so do guesses that moved,
/// and angles that are plain decimals (cos 0.3 is nothing to read). The numbers have found which contacts are
/// struck; the solution is valid as long as these are the ones.

#include "contact/impact.hpp"

namespace alembert {

/// Fills `equations`, `conditions`, `solution`, `reactions`, `energy_loss`, or `silence`, from the numeric part.
void add_algebra(Impact& impact, const Mechanism& mechanism);

}  // namespace alembert
