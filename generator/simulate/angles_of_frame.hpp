// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// Three angles that turn a frame, or a joint, and the same rotation by a quaternion (charts.hpp).

#include <Eigen/Geometry>
#include <array>
#include <vector>

#include "scene/scene.hpp"

namespace alembert {

struct AnglesOfFrame {
    std::size_t place;  ///< position in Scene::frames, or in Scene::joints
    bool is_joint;
    std::array<int, 3> axes;    ///< 0, 1, 2 for x, y, z
    std::array<int, 3> angles;  ///< positions of the coordinates

    bool is_proper() const { return axes[0] == axes[2]; }
    const Name& name(const Scene& scene) const {
        return is_joint ? scene.joints[place].name : scene.frames[place].name;
    }
    /// |sin b| or |cos b|.
    double evenness(const double* q) const;
    /// A vector of that length, whose direction the first angle turns.
    Eigen::Vector2d from_lock(const Eigen::Quaterniond& e) const;
};

/// The angles of each frame that three coordinates turn about axes x, y or z of which no two neighbours are the
/// same, and of each spherical or free joint that has angles.
std::vector<AnglesOfFrame> angles_in(const Scene& scene);

/// Whether anything but the frame or joint names the angles. Contacts, frictions, events and speeds are not looked
/// at; outputs and claims do not change a motion.
bool named_elsewhere(const Scene& scene, const AnglesOfFrame& angles);

/// The scene with a quaternion in place of the angles; its coordinates come last. It has no outputs, claims and
/// impulses.
Scene with_quaternion(const Scene& scene, const AnglesOfFrame& angles);

/// Rotation by three angles, and the axes about which their rates turn, along the parent's axes.
struct TurnedFrame {
    Eigen::Quaterniond e;
    Eigen::Matrix3d rates;

    TurnedFrame(const std::array<int, 3>& axes, const Eigen::Vector3d& angle);
};

/// The angles of a rotation that are the nearest to given ones.
Eigen::Vector3d angles_near(const AnglesOfFrame& of, const Eigen::Quaterniond& e, const Eigen::Vector3d& near);

/// The nearest of those whose middle angle is on the same side of gimbal lock as that of `near`.
Eigen::Vector3d angles_on_side(const AnglesOfFrame& of, const Eigen::Quaterniond& e, const Eigen::Vector3d& near);

/// Those with the first angle of `near`, in the lock, where the first and the third have only one sum or
/// difference.
Eigen::Vector3d angles_in_lock(const AnglesOfFrame& of, const Eigen::Quaterniond& e, const Eigen::Vector3d& near);

}  // namespace alembert
