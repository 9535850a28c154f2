// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// The points of a scene and the bodies whose mass centres are among them. A body's name is that of its frame; its
/// mass centre may have another (Body::centre), and a point may then have the body's.
///
///     body_at(scene, "arm_centre")->name      // "arm"

#include <string>
#include <vector>

#include "scene/scene.hpp"

namespace alembert {

/// The body whose mass centre this point is; null if it is of none.
const Body* body_at(const Scene& scene, const std::string& point);

/// The mass centre of the body of this name; the origin of "N"; any other name itself.
std::string centre_of(const Scene& scene, const std::string& body);

/// The names of points, particles and mass centres, in this order; without the origin.
std::vector<std::string> points_of(const Scene& scene);

}  // namespace alembert
