// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// The symbolic part of an impact: its equations in general coordinates, and their solution at the scene's pose.
///
/// The pose is the exact pose of the scene, with numbers and multiples of π. Parameters stay symbols; so do
/// guesses that moved, and angles that are plain decimals (cos 0.3 would not be readable). The numeric solution
/// determines which contacts are struck, and the symbolic one is valid as long as these are struck.

#include "analysis/contact/impact.hpp"

namespace alembert {

/// Fills `equations`, `conditions`, `solution`, `reactions`, `energy_loss`, or else `silence`, from the numeric
/// part.
void add_algebra(Impact& impact, const Mechanism& mechanism);

}  // namespace alembert
