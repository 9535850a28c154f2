// SPDX-License-Identifier: GPL-2.0-or-later
// The mass matrix is M = Σ mᵢ Jᵢᵀ Jᵢ + Wᵢᵀ Iᵢ Wᵢ over the links, where Jᵢ and Wᵢ give the velocity of the mass
// centre and the angular velocity (Zhang & Qin, chapter 5).
#include "urdf/robot_pose.hpp"

#include "alembert/inertia.hpp"

namespace alembert {

namespace {

using Type = Robot::Type;

std::size_t at(int i) {
    return static_cast<std::size_t>(i);
}

bool turns(Type type) {
    return type == Type::revolute || type == Type::continuous;
}

RobotPlace moved_by(const Robot::Joint& joint, double q) {
    if (joint.type == Type::prismatic) return {q * joint.axis.normalized(), Real33::Identity()};
    if (turns(joint.type))
        return {Real3::Zero(), Eigen::AngleAxisd(q, joint.axis.normalized()).toRotationMatrix()};
    return {};
}

/// Adds what the speeds of a joint above give to the velocity of a point and to the angular velocity.
void add_columns(const Robot::Joint& joint, const RobotPlace& own, int first, const Real3& point,
                 Eigen::MatrixXd& J, Eigen::MatrixXd& W) {
    const auto turn = [&](int column, const Real3& axis) {
        W.col(column) = axis;
        J.col(column) = axis.cross(point - own.shift);
    };
    if (joint.type == Type::prismatic) J.col(first) = own.R * joint.axis.normalized();
    if (turns(joint.type)) turn(first, own.R * joint.axis.normalized());
    if (joint.type == Type::floating)
        for (int k = 0; k < 3; ++k) J(k, first++) = 1;
    if (joint.type == Type::floating || joint.type == Type::spherical)
        for (int k = 0; k < 3; ++k) turn(first + k, own.R.col(k));
}

}  // namespace

std::vector<RobotPlace> link_places(const Robot& robot, const std::vector<double>& q) {
    std::vector<RobotPlace> places(robot.links.size());
    for (std::size_t k = 0; k < robot.joints.size(); ++k) {
        const Robot::Joint& joint = robot.joints[k];
        const RobotPose& pose = joint.type == Type::floating ? joint.start : joint.at;
        places[at(joint.child)] =
            composed(composed(places[at(joint.parent)], {pose.shift, pose.rotation()}), moved_by(joint, q[k]));
    }
    return places;
}

double tendon_length(const Robot::Tendon& tendon, const std::vector<RobotPlace>& places,
                     const std::vector<double>& q) {
    double length = 0;
    for (const Robot::Tendon::Term& term : tendon.terms) length += term.coefficient * q[at(term.joint)];
    const auto point = [&](int link, const Real3& inside) -> Real3 {
        return places[at(link)].shift + places[at(link)].R * inside;
    };
    for (const Robot::Tendon::Stretch& s : tendon.stretches)
        length += s.factor * (point(s.to, s.to_at) - point(s.from, s.from_at)).norm();
    return length;
}

int ReferenceMass::speeds(Type type) {
    return type == Type::floating                                          ? 6
           : type == Type::spherical                                       ? 3
           : turns(type) || type == Type::prismatic || type == Type::screw ? 1
                                                                           : 0;
}

ReferenceMass reference_mass(const Robot& robot) {
    ReferenceMass result;
    int n = 0;
    for (const Robot::Joint& joint : robot.joints) {
        result.first.push_back(n);
        n += ReferenceMass::speeds(joint.type);
    }
    result.M = Eigen::MatrixXd::Zero(n, n);
    for (std::size_t k = 0; k < robot.joints.size(); ++k)
        for (int i = 0; i < ReferenceMass::speeds(robot.joints[k].type); ++i)
            result.M(result.first[k] + i, result.first[k] + i) = robot.joints[k].armature;
    const std::vector<RobotPlace> places = link_places(robot, std::vector<double>(robot.joints.size()));
    for (std::size_t i = 0; i < robot.links.size(); ++i) {
        const Robot::Link& link = robot.links[i];
        if (link.mass == 0 && link.inertia.isZero(0)) continue;
        Eigen::MatrixXd J = Eigen::MatrixXd::Zero(3, n), W = J;
        for (int j = link.joint; j >= 0; j = robot.links[at(robot.joints[at(j)].parent)].joint)
            add_columns(robot.joints[at(j)], places[at(robot.joints[at(j)].child)], result.first[at(j)],
                        places[i].shift + places[i].R * link.centre, J, W);
        result.M += link.mass * J.transpose() * J + W.transpose() * turned<double>(link.inertia, places[i].R) * W;
    }
    return result;
}

}  // namespace alembert
