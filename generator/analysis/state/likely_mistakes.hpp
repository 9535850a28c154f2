// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// What a scene says and most likely does not mean, as far as its numbers at the start and its mechanism show.
///
///     [[force]]
///     at = "cart"                       # moves along x
///     vector = [0, "F"]                 # "nothing moves along this force"
///
///     for (const Diagnostic& warning : likely_mistakes(scene, mechanism)) …
///
/// What the text alone shows is warned of when it is read (scene/check.cpp).

#include <vector>

#include "model/mechanism.hpp"
#include "program/lower/start.hpp"

namespace alembert {

/// Warnings: forces and torques along which nothing moves; masses and moments of inertia that differ from their
/// neighbours by many powers of ten; springs without a length between points that start apart. `at` replaces some
/// of the scene's values. Scenes with open functions have no numbers, and no such warnings.
std::vector<Diagnostic> likely_mistakes(const Scene& scene, const Mechanism& mechanism, const Overrides& at = {});

}  // namespace alembert
