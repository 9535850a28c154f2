// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// The quaternions of a scene: those of its frames, and those of spherical and free joints without `angles`, which
/// place a body and turn the frame that bears its name.
///
///     [[frame]] name = "F", quaternion = ["e0", "e1", "e2", "e3"]       // of F:   e0, e1, e2, e3
///     [[joint]] type = "spherical", child = "top", coordinates = {…}    // of top: its four coordinates
///
/// Each has e·e = 1 as a constraint, its multiplier being lambda_<frame>; a joint's whose four values are all
/// prescribed ([[joint]] motion) has none, since nothing is left to be constrained: it turns by e/|e|.

#include "scene/scene.hpp"

namespace alembert {

struct FrameQuaternion {
    Name of;              ///< the frame
    std::vector<Name> e;  ///< four, scalar first
};

/// Once bodies are placed.
std::vector<FrameQuaternion> quaternions_of(const Scene& scene);

/// "lambda_F": of e·e − 1 = 0.
Name multiplier_of(const FrameQuaternion& quaternion);

/// The four coordinates of a joint that turns by a quaternion, prescribed ones among them; else none.
std::vector<Name> quaternion_of(const Joint& joint);

}  // namespace alembert
