// SPDX-License-Identifier: GPL-2.0-or-later
// The mass matrix is M = Σ mᵢ Jᵢᵀ Jᵢ + Wᵢᵀ Iᵢ Wᵢ over the links, where Jᵢ and Wᵢ give the velocity of the mass
// centre and the angular velocity (Zhang & Qin, chapter 5).
#include "scene/import/robot_pose.hpp"

#include <Eigen/Cholesky>

#include "alembert/base/inertia.hpp"

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

/// A speed, and what it gives to the velocity of a point and to the angular velocity.
struct Column {
    int row;
    Real3 velocity, turn;
};

void add_columns(const Robot::Joint& joint, const RobotPlace& own, int first, const Real3& point,
                 std::vector<Column>& columns) {
    const auto slide = [&](const Real3& axis) { columns.push_back({first++, axis, Real3::Zero()}); };
    const auto turn = [&](const Real3& axis) {
        columns.push_back({first++, axis.cross(point - own.shift), axis});
    };
    if (joint.type == Type::prismatic) slide(own.R * joint.axis.normalized());
    if (turns(joint.type)) turn(own.R * joint.axis.normalized());
    if (joint.type == Type::floating)
        for (int k = 0; k < 3; ++k) slide(Real3::Unit(k));
    if (joint.type == Type::floating || joint.type == Type::spherical)
        for (int k = 0; k < 3; ++k) turn(own.R.col(k));
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
    std::vector<Eigen::Triplet<double>> parts;
    for (std::size_t k = 0; k < robot.joints.size(); ++k)
        for (int i = 0; i < ReferenceMass::speeds(robot.joints[k].type); ++i)
            parts.emplace_back(result.first[k] + i, result.first[k] + i, robot.joints[k].armature);
    const std::vector<RobotPlace> places = link_places(robot, std::vector<double>(robot.joints.size()));
    for (std::size_t i = 0; i < robot.links.size(); ++i) {
        const Robot::Link& link = robot.links[i];
        if (link.mass == 0 && link.inertia.isZero(0)) continue;
        std::vector<Column> columns;
        for (int j = link.joint; j >= 0; j = robot.links[at(robot.joints[at(j)].parent)].joint)
            add_columns(robot.joints[at(j)], places[at(robot.joints[at(j)].child)], result.first[at(j)],
                        places[i].shift + places[i].R * link.centre, columns);
        const Real33 I = turned<double>(link.inertia, places[i].R);
        for (const Column& a : columns)
            for (const Column& b : columns)
                parts.emplace_back(a.row, b.row, link.mass * a.velocity.dot(b.velocity) + a.turn.dot(I * b.turn));
    }
    result.M.resize(n, n);
    result.M.setFromTriplets(parts.begin(), parts.end());
    return result;
}

std::vector<double> ReferenceMass::mobilities() const {
    // M falls into blocks, of trees that nothing connects, each with an inverse of its own.
    std::vector<double> result(static_cast<std::size_t>(M.rows()));
    std::vector<int> place(result.size(), -1);  // in its block
    for (int row = 0; row < M.rows(); ++row) {
        if (place[at(row)] >= 0) continue;
        std::vector<int> block;
        const auto add = [&](int one) {
            if (place[at(one)] >= 0) return;
            place[at(one)] = static_cast<int>(block.size());
            block.push_back(one);
        };
        add(row);
        for (std::size_t k = 0; k < block.size(); ++k)
            for (Eigen::SparseMatrix<double>::InnerIterator it(M, block[k]); it; ++it)
                add(static_cast<int>(it.row()));
        const auto size = static_cast<Eigen::Index>(block.size());
        Eigen::MatrixXd whole = Eigen::MatrixXd::Zero(size, size);
        for (std::size_t k = 0; k < block.size(); ++k)
            for (Eigen::SparseMatrix<double>::InnerIterator it(M, block[k]); it; ++it)
                whole(place[at(static_cast<int>(it.row()))], static_cast<Eigen::Index>(k)) = it.value();
        const Eigen::LLT<Eigen::MatrixXd> solver(whole);
        if (solver.info() != Eigen::Success) continue;
        const Eigen::MatrixXd inverse = solver.solve(Eigen::MatrixXd::Identity(size, size));
        for (std::size_t k = 0; k < block.size(); ++k)
            result[at(block[k])] = inverse(static_cast<Eigen::Index>(k), static_cast<Eigen::Index>(k));
    }
    return result;
}

}  // namespace alembert
