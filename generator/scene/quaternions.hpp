// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// The quaternions of a scene: those of its frames, and those of spherical and free joints without `angles` that
/// place a body. The latter turn the frame with the body's name.
///
///     [[frame]] name = "F", quaternion = ["e0", "e1", "e2", "e3"]       // of F:   e0, e1, e2, e3
///     [[joint]] type = "spherical", child = "top", coordinates = {…}    // of top: its four coordinates
///
/// Each has the constraint e·e = 1 with the multiplier lambda_<frame>. If all four values of a joint's quaternion
/// are prescribed ([[joint]] motion), there is no constraint, because nothing is left to be constrained: the body
/// turns by e/|e|.

#include "scene/scene.hpp"

namespace alembert {

struct FrameQuaternion {
    Name of;              ///< the frame
    std::vector<Name> e;  ///< four, scalar first
};

/// To be called after bodies have been placed.
std::vector<FrameQuaternion> quaternions_of(const Scene& scene);

/// "lambda_F", the multiplier of e·e − 1 = 0.
Name multiplier_of(const FrameQuaternion& quaternion);

/// The four coordinates of a joint that turns by a quaternion, prescribed ones included; otherwise none.
std::vector<Name> quaternion_of(const Joint& joint);

}  // namespace alembert
