// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// How frames and bodies turn.

#include "model/places.hpp"
#include "simulate/kinematics/vectors.hpp"

namespace alembert {

/// Names of all frames, then of all bodies, N left out.
std::vector<std::string> frames_and_bodies(const Scene& scene);

/// Without values. The name is one of these.
FrameKinematics frame_kinematics(const std::string& name, const Scene& scene, Places& places, VectorWriter& write,
                                 bool steps);

}  // namespace alembert
