// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// Laws in general letters, which a textbook states of all systems: d/dt ∂L/∂q̇ − ∂L/∂q = Q, δW = Σ Q δq,
/// F + F* = 0, M q̈ = F + Aᵀ λ. They say nothing of the scene, and their letters are none of its names.

#include "check/derivation/letters.hpp"
#include "check/written/math.hpp"

namespace alembert {

/// Whether a side of an equality has a letter or sign that only such a law has. `displayed`: whether it stands in
/// a display; among words more letters are general, since a derivation's own forces stand in displays.
bool states_general_law(const Math& side, const Letters& letters, bool displayed);

}  // namespace alembert
