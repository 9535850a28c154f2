// SPDX-License-Identifier: MIT
// The robots of pinocchio.sh as models of Pinocchio, for the program that times and the one that writes code:
//
//   const Robot robot = robot_of("tree30.table", false);
//   pinocchio::aba(robot.model, data, q, v, tau);
//
// A joint's torque is that of its damper, so that forward dynamics are those of the scene. A floating base has the
// coordinates x, y, z and the angles of Rz Ry Rx.
#pragma once

#include <cmath>
#include <fstream>
#include <map>
#include <stdexcept>
#include <string>
#include <vector>

#include <pinocchio/multibody.hpp>

namespace alembert {

/// The joints of these robots; all of Pinocchio's would take ten times as long to compile.
template <typename Scalar, int options>
struct RobotJoints {
    static constexpr int Options = options;
    using JointModelVariant = boost::variant<
        pinocchio::JointModelRevoluteTpl<Scalar, options, 0>, pinocchio::JointModelRevoluteTpl<Scalar, options, 1>,
        pinocchio::JointModelRevoluteTpl<Scalar, options, 2>,
        pinocchio::JointModelRevoluteUnalignedTpl<Scalar, options>,
        pinocchio::JointModelTranslationTpl<Scalar, options>,
        boost::recursive_wrapper<pinocchio::JointModelMimicTpl<Scalar, options, ::alembert::RobotJoints>>>;
    using JointDataVariant = boost::variant<
        pinocchio::JointDataRevoluteTpl<Scalar, options, 0>, pinocchio::JointDataRevoluteTpl<Scalar, options, 1>,
        pinocchio::JointDataRevoluteTpl<Scalar, options, 2>,
        pinocchio::JointDataRevoluteUnalignedTpl<Scalar, options>,
        pinocchio::JointDataTranslationTpl<Scalar, options>,
        boost::recursive_wrapper<pinocchio::JointDataMimicTpl<Scalar, options, ::alembert::RobotJoints>>>;
};

template <typename Scalar>
using ModelOf = pinocchio::ModelTpl<Scalar, 0, alembert::RobotJoints>;
template <typename Scalar>
using DataOf = pinocchio::DataTpl<Scalar, 0, alembert::RobotJoints>;
using Model = ModelOf<double>;

/// Damping constants of the joints besides.
struct Robot {
    Model model;
    Eigen::VectorXd damping;
};

/// A table of pinocchio.sh: a first line with the mass, centre and inertia (xx xy xz yy yz zz about the centre) of
/// the base, then for each joint its name, the number of its parent (0 for the base), axis, origin, roll, pitch
/// and yaw, damping, and the same of its link. A floating base hangs on a translation and three angles, each a
/// joint of its own kind.
inline Robot robot_of(const std::string& path, bool floats) {
    std::ifstream file(path);
    const auto number = [&] {
        double x = NAN;
        if (!(file >> x)) throw std::runtime_error(path + " ends too early");
        return x;
    };
    const auto three = [&] {
        const double x = number(), y = number(), z = number();
        return Eigen::Vector3d(x, y, z);
    };
    const auto inertia = [&] {
        const double mass = number();
        const Eigen::Vector3d centre = three();
        Eigen::Matrix3d I;
        for (int i = 0; i < 3; ++i)
            for (int j = i; j < 3; ++j) I(i, j) = I(j, i) = number();
        return pinocchio::Inertia(mass, centre, I);
    };
    Robot robot;
    Model& model = robot.model;
    std::vector<pinocchio::JointIndex> links{0};
    const pinocchio::SE3 here = pinocchio::SE3::Identity();
    const pinocchio::Inertia base = inertia();
    if (floats) {
        links[0] = model.addJoint(0, pinocchio::JointModelTranslation(), here, "base_shift");
        links[0] = model.addJoint(links[0], pinocchio::JointModelRZ(), here, "base_yaw");
        links[0] = model.addJoint(links[0], pinocchio::JointModelRY(), here, "base_pitch");
        links[0] = model.addJoint(links[0], pinocchio::JointModelRX(), here, "base_roll");
        model.appendBodyToJoint(links[0], base, here);
    }
    std::map<int, double> damping;
    for (std::string name; file >> name;) {
        const auto parent = links.at(static_cast<std::size_t>(number()));
        const Eigen::Vector3d axis = three(), origin = three(), angles = three();
        const Eigen::Matrix3d R = (Eigen::AngleAxisd(angles[2], Eigen::Vector3d::UnitZ()) *
                                   Eigen::AngleAxisd(angles[1], Eigen::Vector3d::UnitY()) *
                                   Eigen::AngleAxisd(angles[0], Eigen::Vector3d::UnitX()))
                                      .toRotationMatrix();
        const pinocchio::SE3 at(R, origin);
        const auto joint =
            axis == Eigen::Vector3d::UnitX()   ? model.addJoint(parent, pinocchio::JointModelRX(), at, name)
            : axis == Eigen::Vector3d::UnitY() ? model.addJoint(parent, pinocchio::JointModelRY(), at, name)
            : axis == Eigen::Vector3d::UnitZ()
                ? model.addJoint(parent, pinocchio::JointModelRZ(), at, name)
                : model.addJoint(parent, pinocchio::JointModelRevoluteUnaligned(axis.normalized()), at, name);
        damping[model.joints[joint].idx_v()] = number();
        model.appendBodyToJoint(joint, inertia(), here);
        links.push_back(joint);
    }
    robot.damping = Eigen::VectorXd::Zero(model.nv);
    for (const auto& [place, value] : damping) robot.damping[place] = value;
    return robot;
}

}  // namespace alembert
