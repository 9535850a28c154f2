// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// A robot description (URDF) as plain values: links and joints in the order of the file, and what of it is no
/// dynamics.
///
///     const Robot robot = read_robot("arm.urdf");
///     robot.links[robot.joints[0].child].mass
///
/// A link's frame is that of the joint above it. A joint's frame stands in its parent link by `at`; its axis is in
/// its own frame. Roll, pitch and yaw turn about the parent's fixed axes x, y, z: R = R_z(yaw) R_y(pitch)
/// R_x(roll). Inertias are turned into the link's frame, about the mass centre. Metres, kilograms, radians.
/// (urdfdom checks names, types and the tree; numbers are read beside it, strictly: elements.hpp.)

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "alembert/error.hpp"
#include "alembert/rotation.hpp"

namespace alembert {

using Real3 = Vector3r<double>;
using Real33 = Matrix3<double>;

struct RobotPose {
    Real3 shift = Real3::Zero();
    Real3 rpy = Real3::Zero();
    /// With cosines and sines of right angles exact.
    Real33 rotation() const;
};

/// k with angle = k π/12, where that is the nearest double.
std::optional<int> twelfths_of_pi(double angle);

struct Robot {
    struct Link {
        std::string name;
        Place place;
        double mass = 0;
        Real3 centre = Real3::Zero();
        Real33 inertia = Real33::Zero();  ///< about the mass centre, along the link's axes
        int joint = -1;                   ///< the one above; −1 for the root
    };
    enum class Type { fixed, revolute, continuous, prismatic, planar, floating };
    struct Mimic {
        int joint;
        double factor = 1, offset = 0;  ///< position = factor · position of `joint` + offset
    };
    struct Joint {
        std::string name;
        Place place;
        Type type;
        int parent, child;  ///< in `links`
        RobotPose at;
        Real3 axis;  ///< not normalized
        double damping = 0;
        std::optional<std::array<double, 2>> limits = {};
        std::optional<Mimic> mimic = {};  ///< of a joint that moves by itself
    };
    struct Dropped {
        std::string what;             ///< "<visual>", "Coulomb friction"
        std::vector<std::string> of;  ///< names of links or joints, or its own; may be empty
    };

    std::string name;
    std::vector<Link> links;
    std::vector<Joint> joints;
    int root = 0;  ///< in `links`
    std::vector<Dropped> dropped;
    std::vector<Diagnostic> remarks;  ///< what was completed or is odd, with its place
};

/// Angles of joints that are right angles written with few digits, as 1.5708 or 3.1415: a multiple of π/2, rounded
/// or cut off to at least two decimals. Gives how many there are, and makes them exact where `mend` is true.
int rounded_right_angles(Robot& robot, bool mend);

/// Throws SceneError for what is no URDF, for links and joints that are no tree, and for values that no body has.
Robot read_robot(const std::string& file);
/// `file` stands in messages alone.
Robot parse_robot(const std::string& text, const std::string& file);

}  // namespace alembert
