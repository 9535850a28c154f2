// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// A robot description (URDF, MJCF or SDF) as plain values: links and joints in the order of the file, and the
/// names of those parts of it that do not concern dynamics.
///
///     const Robot robot = read_robot("arm.urdf");
///     robot.links[robot.joints[0].child].mass
///
/// A link's frame is that of the joint above it. `at` is the pose of a joint's frame in its parent link; its axis
/// is given in its own frame. Roll, pitch and yaw turn about the parent's fixed axes x, y, z: R = R_z(yaw)
/// R_y(pitch) R_x(roll). Inertias are converted to the link's frame, about the mass centre. Units are metres,
/// kilograms and radians. (For URDF, urdfdom checks names, types and the tree; numbers are read separately and
/// strictly, see elements.hpp. MJCF and SDF are read by mjcf.cpp and sdf.cpp.)

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "alembert/base/error.hpp"
#include "alembert/base/rotation.hpp"

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

/// Which files a description may name.
struct OtherFiles {
    bool outside = false;                 ///< also those outside the folder of the file and outside `packages`
    std::vector<std::string> packages{};  ///< folders in which the models of model:// are looked up
};

struct Robot {
    struct Link {
        std::string name;
        Place place;
        double mass = 0;
        Real3 centre = Real3::Zero();
        Real33 inertia = Real33::Zero();  ///< about the mass centre, along the link's axes
        /// The inertia along axes that are turned against the link's, where the file gives them so by angles.
        struct OwnAxes {
            Real3 rpy;
            Real33 inertia;
        };
        std::optional<OwnAxes> own_axes = {};
        double held = 0;  ///< the part of its weight that an upward force at its mass centre bears
        int joint = -1;   ///< the joint above; −1 for the root
    };
    enum class Type {
        fixed,
        revolute,
        continuous,
        prismatic,
        planar,
        floating,
        spherical,
        universal,
        screw,
        cylindrical
    };
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
        Real3 axis;                     ///< not normalized
        Real3 second = Real3::UnitY();  ///< of a universal joint, perpendicular to `axis`
        double pitch = 0;               ///< of a screw, metres a radian
        /// Damping and armature of a spherical joint belong to each component of its angular velocity; of a
        /// floating one to the velocity of its origin too.
        double damping = 0;
        double friction = 0;             ///< the Coulomb torque or force
        double armature = 0;             ///< the inertia of a rotor, n² J behind a gear of ratio n
        double stiffness = 0, rest = 0;  ///< of a spring along the coordinate
        RobotPose start = {};            ///< of a floating joint
        std::optional<std::array<double, 2>> limits = {};
        std::optional<Mimic> mimic = {};  ///< for a mimicking joint, the independent joint that it follows
    };
    /// A joint that closes a loop: `at_parent` and `at_child` coincide but for its free motion.
    struct Loop {
        std::string name;
        Type type;
        int parent, child;  ///< in `links`
        RobotPose at_parent = {}, at_child = {};
        Real3 axis = Real3::UnitZ(), second = Real3::UnitY();
        double pitch = 0;
    };
    /// A length L = Σ coefficient·q + Σ factor·(distance of two points), and what acts along it.
    struct Tendon {
        struct Term {
            int joint;
            double coefficient;
        };
        struct Stretch {
            int from, to;  ///< in `links`
            Real3 from_at, to_at;
            double factor = 1;
        };
        std::string name;
        std::vector<Term> terms = {};
        std::vector<Stretch> stretches = {};
        double stiffness = 0, damping = 0, friction = 0, armature = 0;
        std::array<double, 2> rest{0, 0};  ///< between these lengths the spring is slack
        std::optional<std::array<double, 2>> limits = {};
        double at_reference = 0;  ///< what L of the file is larger than L here
        double start = 0;         ///< L where all q are 0
    };
    /// q of `joint` = Σ polynomial[k]·(q of `other`)^k; a constant if there is no other. With `of_tendons`, both
    /// are tendons, and q is the difference of L from its value where all q are 0.
    struct Coupling {
        std::string name;
        int joint, other = -1;
        std::array<double, 5> polynomial{};
        bool of_tendons = false;
    };
    /// A motor with the control u: gear·(gain·u + constant + along·gear·q + rate·gear·q') along q, or along the
    /// length of a tendon.
    struct Actuator {
        /// A force at the origin of a link and a torque on it, each times (gain·u + constant), along the axes of a
        /// link or of the world (−1); `against` is the link that bears the opposite torque, if there is one.
        struct Wrench {
            int link, force_axes = -1, torque_axes = -1, against = -1;
            Real3 force = Real3::Zero(), torque = Real3::Zero();
        };
        std::string name;
        int joint, tendon = -1;
        double gear = 1, gain = 1, constant = 0, along = 0, rate = 0;
        std::optional<Wrench> wrench = {};  ///< in place of what acts along q or a length
        bool acts_alone() const { return constant != 0 || along != 0 || rate != 0; }
    };
    /// A state that the file names: coordinates and rates by joint, controls by motor. Positions of joints with
    /// one coordinate count from the pose of the file; a turn in space is a quaternion, scalar first, and its rate
    /// the angular velocity along the child.
    struct Keyframe {
        std::string name;
        std::vector<std::vector<double>> position = {}, rate = {};  ///< for each joint
        std::vector<double> control = {};                           ///< for each motor of the file
    };
    /// Whether the motion of the scene differs from that of the robot without it: `driven` where inputs for motors
    /// are added.
    enum class Effect { none, motion, driven };
    struct Dropped {
        std::string what;             ///< "<visual>", "Coulomb friction"
        std::vector<std::string> of;  ///< the names of the links or joints concerned, or its own; may be empty
        Effect effect = Effect::none;
    };

    std::string name;
    std::vector<Link> links;
    std::vector<Joint> joints;
    int root = 0;  ///< in `links`
    std::vector<Loop> loops;
    std::vector<Coupling> couplings;
    std::vector<Tendon> tendons;
    std::optional<std::vector<Actuator>> actuators;  ///< if the format has them
    std::vector<Keyframe> keyframes;
    Real3 gravity{0, 0, -9.81};
    bool has_world = false;  ///< whether the root is the ground, so that the file says what floats
    std::vector<Dropped> dropped;
    /// What was completed or is unusual, with its place; of the kind "version" what another version of the program
    /// to which the file belongs takes otherwise.
    std::vector<Diagnostic> remarks;
};

/// Angles of joints that are right angles written with few digits, as 1.5708 or 3.1415: a multiple of π/2, rounded
/// or cut off to at least two decimals. Returns how many there are; if `mend` is true, makes them exact,
/// and with them those by which the axes of inertias are turned.
int rounded_right_angles(Robot& robot, bool mend);

/// The format is told by the outermost element: <robot>, <mujoco> or <sdf>. Throws SceneError if the file is none
/// of them, if its links and joints form no tree, or if it has impossible values.
Robot read_robot(const std::string& file, const OtherFiles& others = {});
/// `file` is used only in messages, and for files that it includes.
Robot parse_robot(const std::string& text, const std::string& file, const OtherFiles& others = {});

/// Each for its format.
Robot parse_urdf(const std::string& text, const std::string& file);
Robot parse_mjcf(const std::string& text, const std::string& file, const OtherFiles& others);
Robot parse_sdf(const std::string& text, const std::string& file, const OtherFiles& others);

/// Roll, pitch and yaw of R = R_z(yaw) R_y(pitch) R_x(roll); roll is 0 if pitch is a right angle. The rounding of
/// right angles is removed.
Real3 roll_pitch_yaw(const Real33& R);

/// A pose with its rotation as a matrix.
struct RobotPlace {
    Real3 shift = Real3::Zero();
    Real33 R = Real33::Identity();
    RobotPose pose() const { return {shift, roll_pitch_yaw(R)}; }
};
/// The place of `inner`, which is given in `outer`; and that of the outer frame in the inner one.
RobotPlace composed(const RobotPlace& outer, const RobotPlace& inner);
RobotPlace inverted(const RobotPlace& place);

}  // namespace alembert
