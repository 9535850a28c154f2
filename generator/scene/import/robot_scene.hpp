// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// A robot as the text of a scene.
///
///     const RobotScene scene = robot_scene(read_robot("arm.urdf"), {.source = "arm.urdf"});
///
/// Links that are connected by fixed joints become one body, with the name and the frame of the one nearest to the
/// root; its mass centre has a name of its own, NAME_centre, if it is not the origin of that link. The others
/// become a frame and a point of their name, and a point of the name of each link is its origin. Links that are
/// fixed to the root belong to the ground, unless the root floats. Joints keep their names, which their
/// coordinates have too (a floating joint's with _x, _y, _z and _yaw, _pitch, _roll, or _e0 … _e3). A joint that
/// mimics another has no coordinate: the frame of its body turns, or its point is shifted, by factor · coordinate
/// + offset. Branches without moving mass are left out.

#include <map>
#include <string>
#include <vector>

#include "scene/import/robot.hpp"

namespace alembert {

struct RobotSceneOptions {
    std::string source;       ///< file name for the scene's `source`
    bool floating = false;    ///< whether the root moves freely in space
    bool quaternion = false;  ///< whether floating joints turn by quaternions
    /// Whether to add an input, a torque or a force, for each independent joint that turns or slides.
    bool drives = false;
    bool friction = false;      ///< whether to add the Coulomb friction of joints that turn or slide
    bool mend_inertia = false;  ///< whether an inertia that no body has becomes the nearest one that a body has
    std::string keyframe = {};  ///< the state of the file in which the scene starts; empty for its reference pose
    bool guesses = false;       ///< whether all starts may move until loops close
    bool stops = false;         ///< whether to add contacts at the limits of joints that turn or slide
};

struct RobotScene {
    std::string text;
    int bodies = 0;
    std::vector<std::string> coordinates;
    std::vector<std::string> frames;  ///< names of the frames, and points, of links that are fixed to others
    std::vector<std::string> drives;  ///< names of the inputs, one for each driven joint or motor
    std::vector<std::string> loops, couplings;  ///< names of closing joints, and of constraints between joints
    /// The names of links and joints in the file, and in the scene: of a body, of a frame and point, or N.
    std::vector<std::pair<std::string, std::string>> links, joints;
    std::map<std::string, std::vector<std::string>> coordinates_of;  ///< by the joint's name in the file
    std::vector<std::string> merged;  ///< sentences such as "tool is fixed to wrist"
    std::vector<std::string> notes;   ///< names that had to be changed, limits that do not hold at the start
    std::vector<Robot::Dropped> dropped;
};

/// Throws ModelError if nothing moves.
RobotScene robot_scene(const Robot& robot, const RobotSceneOptions& options = {});

}  // namespace alembert
