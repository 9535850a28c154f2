// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// Combines links of a robot that fixed joints hold together into one body each.
///
///     const WeldedLinks links = welded(robot, {.floating = false});
///     links.bodies[0].ground                       // what is fixed to the root stands still
///     links.seats[i].group, links.seats[i].shift   // where link i stands in its body
///
/// A body's frame is that of its link nearest to the root. Metres, kilograms, radians.

#include <string>
#include <vector>

#include "scene/import/robot.hpp"

namespace alembert {

/// Links that do not move relative to each other.
struct WeldedBody {
    int top;                 ///< the link nearest to the root
    std::vector<int> links;  ///< all of them, in the order of the file
    double mass = 0;
    Real3 centre = Real3::Zero();     ///< the mass centre, in the frame of `top`
    Real33 inertia = Real33::Zero();  ///< about the mass centre, along the frame of `top`
    bool ground = false;              ///< the body is fixed to the ground
    bool kept = true;                 ///< false if neither the body nor any body that hangs from it has mass
};

/// The place of a link in its body.
struct Seat {
    int group = -1;  ///< in WeldedLinks::bodies
    Real3 shift = Real3::Zero();
    Real33 R = Real33::Identity();
    std::vector<Real3> turns = {};  ///< roll, pitch, yaw of each fixed joint on the path to it
};

struct WeldedLinks {
    std::vector<WeldedBody> bodies;       ///< from the root outwards; the first contains the root
    std::vector<Seat> seats;              ///< one for each link
    std::vector<std::string> merged;      ///< one sentence each: "tool is fixed to wrist"
    std::vector<std::string> mended;      ///< one sentence for each inertia that was changed
    std::vector<Robot::Dropped> dropped;  ///< masses fixed to the ground, joints that move no mass
};

/// `floating`: the root moves freely in space. Throws ModelError for a body with a negative moment of inertia,
/// unless `mend` is true: such a body, and one whose moments break the triangle inequality, then gets the nearest
/// inertia that masses can have.
WeldedLinks welded(const Robot& robot, bool floating, bool mend = false);

}  // namespace alembert
