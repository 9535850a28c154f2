// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// Holds the values of a scene against what the language says that they are, by their units.
///
///     contradicting_dimensions(scene);     // "the position of 'P' is in m, but its units make 1"

#include <vector>

#include "scene/scene.hpp"

namespace alembert {

/// Warns where the dimensions that the units give contradict each other: in sums and functions, and where the
/// language says what a value is: positions, masses, forces …
std::vector<Diagnostic> contradicting_dimensions(const Scene& scene);

}  // namespace alembert
