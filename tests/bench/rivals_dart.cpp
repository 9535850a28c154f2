// SPDX-License-Identifier: MIT
// DART: articulated bodies.
#include <dart/dynamics/BodyNode.hpp>
#include <dart/dynamics/RevoluteJoint.hpp>
#include <dart/dynamics/Skeleton.hpp>

#include <string>

#include "rivals_principal.hpp"

namespace alembert::bench {

Rival dart(const Tree& tree) {
    const auto skeleton = ::dart::dynamics::Skeleton::create(tree.name);
    skeleton->setGravity(eigen(tree.gravity));
    ::dart::dynamics::BodyNode* last = nullptr;
    for (const TreeBody& body : tree.bodies) {
        ::dart::dynamics::RevoluteJoint::Properties joint;
        joint.mAxis = eigen(body.axis);
        joint.mT_ParentBodyToJoint.linear() = rotation_of(body);
        joint.mT_ParentBodyToJoint.translation() = eigen(body.p);
        joint.mName =
            "joint" + std::to_string(skeleton->getNumJoints());  // it announces the names that it makes itself
        const ::dart::dynamics::BodyNode::AspectProperties named("body" +
                                                                 std::to_string(skeleton->getNumBodyNodes()));
        last = skeleton
                   ->createJointAndBodyNodePair<::dart::dynamics::RevoluteJoint>(
                       last, joint, ::dart::dynamics::BodyNode::Properties(named))
                   .second;
        last->setInertia(::dart::dynamics::Inertia(body.mass, eigen(body.com), inertia_of(body)));
    }
    const auto n = static_cast<Eigen::Index>(tree.bodies.size());
    skeleton->setForces(Eigen::Map<const Eigen::VectorXd>(tree.tau.data(), n));
    return {"dart", [skeleton, n](const double* q, const double* u, double* a) {
                skeleton->setPositions(Eigen::Map<const Eigen::VectorXd>(q, n));
                skeleton->setVelocities(Eigen::Map<const Eigen::VectorXd>(u, n));
                skeleton->computeForwardDynamics();
                Eigen::Map<Eigen::VectorXd>(a, n) = skeleton->getAccelerations();
            }};
}

}  // namespace alembert::bench
