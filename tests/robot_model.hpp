// SPDX-License-Identifier: MIT
#pragma once

/// A robot as its URDF has it, and its inverse dynamics by the recursion of Newton and Euler, which goes link by
/// link (fixed ones too) along the axes of the world. It uses neither merged bodies nor scenes.
///
///     const RobotModel robot(source_path("tests/robots/arm6.urdf"));
///     robot.loads(q, u, a, 9.81, true)["shoulder"];

#include <Eigen/Dense>
#include <map>
#include <string>
#include <vector>

namespace alembert::test {

struct RobotLink {
    double mass = 0;
    Eigen::Vector3d centre = Eigen::Vector3d::Zero(), centre_rpy = Eigen::Vector3d::Zero();
    Eigen::Matrix3d inertia = Eigen::Matrix3d::Zero();
};
/// A simple joint with its child; a floating joint is six of them.
struct RobotHinge {
    std::string name, type, parent, child, leader;
    Eigen::Vector3d xyz = Eigen::Vector3d::Zero(), rpy = Eigen::Vector3d::Zero(), axis = Eigen::Vector3d::UnitX();
    double damping = 0, factor = 1, offset = 0;
};

struct RobotModel {
    using Values = std::map<std::string, double>;  ///< by the names of joints

    /// Reads the file.
    explicit RobotModel(const std::string& file);

    const RobotHinge& named(const std::string& name) const;
    /// Position (or rate, with no offsets) of a joint that may follow another.
    double value(const RobotHinge& h, const Values& of, bool with_offset) const;
    /// Σ over all joints that follow it, of the loads that these accelerations need.
    Values loads(const Values& q, const Values& u, const Values& a, double g, bool damped) const;

    std::map<std::string, RobotLink> bodies;
    std::vector<RobotHinge> hinges;  ///< parents first

private:
    void add_floating(const RobotHinge& joint);
};

}  // namespace alembert::test
