// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// Determines which joint places which body.
///
///     N ─j1─ A ─j2─ B ─j3─ N      j1 places A, j2 places B, j3 closes a loop
///
/// The ground and the bodies with a position of their own are placed from the start. Then the following is
/// repeated: the first joint of the file between a placed body and one that is not placed yet places the latter,
/// whether that is its child or its parent. Joints with coordinates come before joints without, because a joint
/// that closes a loop has none. The joints that remain close loops.

#include "scene/scene.hpp"

namespace alembert {

/// Fills in Joint::places_child and Body::joint. Reports unknown bodies, bodies that are not placed or are placed
/// twice, joints in a circle, and wrong numbers of coordinates.
void place_by_joints(Scene& scene, std::vector<Diagnostic>& diagnostics);

}  // namespace alembert
