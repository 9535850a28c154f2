// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// Which joint places which body.
///
///     N ─j1─ A ─j2─ B ─j3─ N      j1 places A, j2 places B, j3 closes a loop
///
/// Placed from the start are the ground and the bodies with a position of their own. Then, again and again, the
/// first joint of the file between a placed body and one that is not places that one, be it the child or the
/// parent; joints that have their coordinates come before those that have none, since a joint that closes a loop
/// has none. What is left closes loops.

#include "scene/scene.hpp"

namespace alembert {

/// Fills in Joint::places_child and Body::joint; tells unknown bodies, bodies that nothing places or that are
/// placed twice, joints in a circle, and wrong numbers of coordinates.
void place_by_joints(Scene& scene, std::vector<Diagnostic>& diagnostics);

}  // namespace alembert
