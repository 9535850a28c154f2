// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// Ranks of constraints are found in numbers, and a function that the scene leaves open has none. They are found
/// with polynomials in its place, whose coefficients are arbitrary: their ranks are those of almost every
/// function.

#include "model/mechanism.hpp"

namespace alembert {

/// Whether the constraints or the generalized speeds hold a function of [functions].
bool constraints_are_open(const Mechanism& mechanism);

/// If they do, the same mechanism with polynomials in place of these functions, whose initial values are guesses,
/// as nobody knows which values obey the constraints; otherwise the mechanism as it is.
Mechanism with_sample_functions(const Mechanism& mechanism);

}  // namespace alembert
