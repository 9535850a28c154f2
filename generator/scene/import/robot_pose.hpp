// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// Where the links of a robot stand in a given pose, and its mass matrix in the pose of the file. Readers use it
/// for what a file gives only by these: the rest length of a tendon, a spring that is given by its time constant.
///
///     const std::vector<RobotPlace> places = link_places(robot, q);       // in the ground
///     const ReferenceMass mass = reference_mass(robot);
///     mass.M.coeff(mass.first[j], mass.first[j])                          // of the first speed of joint j
///
/// Metres, kilograms, radians. A joint stands in the list after that which holds its parent.

#include <Eigen/SparseCore>
#include <vector>

#include "scene/import/robot.hpp"

namespace alembert {

/// `q` has a value for each joint, which counts for revolute, continuous and prismatic ones; all others stand as
/// in the file.
std::vector<RobotPlace> link_places(const Robot& robot, const std::vector<double>& q);

/// The length of a tendon where the links stand so.
double tendon_length(const Robot::Tendon& tendon, const std::vector<RobotPlace>& places,
                     const std::vector<double>& q);

/// The speeds are q' of joints with one coordinate; the angular velocity of a spherical joint along the axes of
/// its child; the velocity of the origin of a floating link along the axes of the ground, and then its angular
/// velocity along its own. Armatures of joints are included.
struct ReferenceMass {
    Eigen::SparseMatrix<double> M;
    std::vector<int> first;  ///< for each joint the row of its first speed
    static int speeds(Robot::Type type);
    /// The diagonal of M⁻¹; 0 where M is singular.
    std::vector<double> mobilities() const;
};
ReferenceMass reference_mass(const Robot& robot);

}  // namespace alembert
