// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// A robot description (URDF) as plain values: links and joints in the order of the file, and the parts of it that
/// do not concern dynamics.
///
///     const Robot robot = read_robot("arm.urdf");
///     robot.links[robot.joints[0].child].mass
///
/// A link's frame is that of the joint above it. `at` is the pose of a joint's frame in its parent link; its axis
/// is given in its own frame. Roll, pitch and yaw turn about the parent's fixed axes x, y, z: R = R_z(yaw)
/// R_y(pitch) R_x(roll). Inertias are converted to the link's frame, about the mass centre. Units are metres,
/// kilograms and radians. (urdfdom checks names, types and the tree; numbers are read separately and strictly, see
/// elements.hpp.)

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
    /// The rotation, with exact cosines and sines of right angles.
    Real33 rotation() const;
};

/// k with angle = k π/12, if that is the nearest double.
std::optional<int> twelfths_of_pi(double angle);

struct Robot {
    struct Link {
        std::string name;
        Place place;
        double mass = 0;
        Real3 centre = Real3::Zero();
        Real33 inertia = Real33::Zero();  ///< about the mass centre, along the link's axes
        int joint = -1;                   ///< the joint above; −1 for the root
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
        Real3 axis;                        ///< not normalized
        double damping = 0, friction = 0;  ///< friction: the Coulomb torque or force
        std::optional<std::array<double, 2>> limits = {};
        std::optional<Mimic> mimic = {};  ///< for a mimicking joint, the independent joint that it follows
    };
    struct Dropped {
        std::string what;             ///< "<visual>", "Coulomb friction"
        std::vector<std::string> of;  ///< the names of the links or joints concerned, or its own; may be empty
    };

    std::string name;
    std::vector<Link> links;
    std::vector<Joint> joints;
    int root = 0;  ///< in `links`
    std::vector<Dropped> dropped;
    std::vector<Diagnostic> remarks;  ///< what was completed or is unusual, with its place
};

/// Angles of joints that are right angles written with few digits, as 1.5708 or 3.1415: a multiple of π/2, rounded
/// or cut off to at least two decimals. Returns how many there are, and makes them exact if `mend` is true.
int rounded_right_angles(Robot& robot, bool mend);

/// Throws SceneError if the file is no URDF, if its links and joints form no tree, or if it has impossible values.
Robot read_robot(const std::string& file);
/// `file` is used only in messages.
Robot parse_robot(const std::string& text, const std::string& file);

}  // namespace alembert
