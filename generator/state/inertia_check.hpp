// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// Do the masses and moments of inertia of a scene belong to bodies that can be? At the numbers that a run has, replaced
/// parameters among them.
///
///     scene.toml:12:1: warning: the principal moments of inertia of body 'B', 1, 1 and 3, break the triangle inequality 1 + 1 >= 3 …
///
/// Moments are looked at about the mass centre, whatever point the scene gives them about.

#include "model/mechanism.hpp"
#include "program/interpret.hpp"

namespace alembert {

/// Errors: a negative mass, a negative principal moment. Warnings: a broken triangle inequality. A planar scene's one moment has no
/// triangle to break. `state`: with parameters, and q where moments are about another point.
std::vector<Diagnostic> inertia_findings(const Scene& scene, const Mechanism& mechanism, const State<double>& state);

}  // namespace alembert
