// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// Values of inputs at one state, such as the torque of a drive: the input is this number for all time, and its
/// derivatives are zero.
///
///     const Overrides others = with_inputs_given(scene, {{"drive_j1", 2.0}, {"theta", 0.3}});   // theta alone

#include "program/lower/start.hpp"
#include "scene/scene.hpp"

namespace alembert {

/// Gives the inputs of the scene that are named their numbers, in SI, and returns what is left.
Overrides with_inputs_given(Scene& scene, Overrides at);

}  // namespace alembert
