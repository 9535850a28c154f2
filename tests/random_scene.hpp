// SPDX-License-Identifier: MIT
#pragma once

/// Small valid scenes at random, for tests of what has to hold for every scene.

#include <string>

namespace alembert::test {

/// One to three coordinates with particles or a kinetic energy, then some of: gravity, forces with reactions,
/// springs, dampers, generalized forces, inputs, dissipation, a constraint, generalized speeds, a contact,
/// outputs, an event. Masses, inertias, forces and lengths are often bare parameters, with both signs in the same
/// scene. The same seed gives the same text.
std::string random_scene(unsigned seed);

}  // namespace alembert::test
