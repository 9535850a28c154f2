// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// A robot as the text of a scene.
///
///     const RobotScene scene = robot_scene(read_robot("arm.urdf"), {.source = "arm.urdf"});
///
/// Links that fixed joints hold together are one body, named after the one nearest to the root, along its frame;
/// what is fixed to the root is the ground, unless the root floats. Joints keep their names, which their
/// coordinates bear too (a floating joint's with _x, _y, _z and _yaw, _pitch, _roll, or _e0 … _e3). A joint that
/// mimics another has no coordinate: its body's frame turns, or its point is shifted, by factor · coordinate +
/// offset. Branches that move no mass are left out.

#include <string>
#include <vector>

#include "urdf/robot.hpp"

namespace alembert {

struct RobotSceneOptions {
    std::string source;       ///< file name for the scene's `source`
    bool floating = false;    ///< the root moves freely in space
    bool quaternion = false;  ///< floating joints turn by quaternions
    bool drives = false;      ///< an input for each joint that turns or slides by itself: its torque or force
};

struct RobotScene {
    std::string text;
    int bodies = 0;
    std::vector<std::string> coordinates;
    std::vector<std::string> drives;  ///< names of the inputs, one for each driven joint
    std::vector<std::string> merged;  ///< "tool is fixed to wrist", a sentence each
    std::vector<std::string> notes;   ///< names that had to be changed, limits that do not hold at the start
    std::vector<Robot::Dropped> dropped;
};

/// Throws ModelError where nothing moves.
RobotScene robot_scene(const Robot& robot, const RobotSceneOptions& options = {});

}  // namespace alembert
