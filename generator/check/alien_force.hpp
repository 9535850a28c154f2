// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// Forces in a claim that belong to another equation: one too many, or one in place of the claim's own.
///
///     alien_forces(nearest, edits, mechanism, equations, size)    // "m1*g*sin(theta1)" in the equation of theta2

#include "check/edits.hpp"
#include "check/nearest.hpp"

namespace alembert {

/// Changes that put it right, if what the claim has beyond its nearest equation is such a force.
std::vector<Edit> alien_forces(const Nearest& nearest, const Edits& edits, const Mechanism& mechanism,
                               const Equations& equations, double size);

}  // namespace alembert
