// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// Whether an identity says something of the scene.

#include "model/mechanism.hpp"
#include "scene/scene.hpp"

namespace alembert {

/// Does the claim hold a name or a function that the scene defines, such as T, vel(P), an input or a parameter
/// that follows from others? If it does not, and holds identically, it would hold in every scene, as 0 = 0 does.
bool speaks_of_scene(const Claim& claim, const Mechanism& mechanism);

}  // namespace alembert
