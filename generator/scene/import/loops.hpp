// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// Closes loops of a robot by the [[joint]]s of a file. They are written as in a scene, with links in place of
/// bodies: the points count from the origins of the links, along their axes.

#include "scene/import/robot.hpp"

namespace alembert {

/// Throws SceneError, with the places in `file`, for a link that the robot does not have and for values that are
/// no numbers.
void close_loops(Robot& robot, const std::string& file);

}  // namespace alembert
