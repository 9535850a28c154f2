// SPDX-License-Identifier: MIT
// Bullet: articulated bodies; each link's frame is that of its principal axes.
#include <BulletDynamics/Featherstone/btMultiBody.h>

#include <memory>

#include "rivals_principal.hpp"

namespace alembert::bench {

namespace {

btVector3 bt(const Eigen::Vector3d& v) {
    return {v[0], v[1], v[2]};
}
btQuaternion bt(const Eigen::Quaterniond& q) {
    return {q.x(), q.y(), q.z(), q.w()};
}

struct Links {
    explicit Links(const Tree& tree)
        : n(static_cast<int>(tree.bodies.size())), body(n, 1, btVector3(1, 1, 1), true, false), tau(tree.tau) {
        std::vector<Principal> principal;
        for (const TreeBody& b : tree.bodies) principal.push_back(principal_of(b));
        for (int i = 0; i < n; ++i) {
            const TreeBody& b = tree.bodies[i];
            const Eigen::Matrix3d& own = principal[i].axes;
            const bool on_ground = b.parent < 0;
            const Eigen::Matrix3d parent = on_ground ? Eigen::Matrix3d::Identity() : principal[b.parent].axes;
            const Eigen::Vector3d com = on_ground ? Eigen::Vector3d::Zero() : eigen(tree.bodies[b.parent].com);
            const Eigen::Matrix3d turn = own.transpose() * rotation_of(b).transpose() * parent;
            body.setupRevolute(i, b.mass, bt(principal[i].moments), b.parent, bt(Eigen::Quaterniond(turn)),
                               bt(own.transpose() * eigen(b.axis)), bt(parent.transpose() * (eigen(b.p) - com)),
                               bt(own.transpose() * eigen(b.com)), true);
            weight.push_back(bt(b.mass * eigen(tree.gravity)));
        }
        body.finalizeMultiDof();
        body.setLinearDamping(0);
        body.setAngularDamping(0);
    }
    int n;
    btMultiBody body;
    std::vector<btVector3> weight;
    std::vector<double> tau;
    btAlignedObjectArray<btScalar> reals;
    btAlignedObjectArray<btVector3> vectors;
    btAlignedObjectArray<btMatrix3x3> matrices;
};

}  // namespace

Rival bullet(const Tree& tree) {
    const auto s = std::make_shared<Links>(tree);
    return {"bullet", [s](const double* q, const double* u, double* a) {
                s->body.clearForcesAndTorques();
                for (int i = 0; i < s->n; ++i) {
                    s->body.setJointPos(i, q[i]);
                    s->body.setJointVel(i, u[i]);
                    s->body.addLinkForce(i, s->weight[i]);
                    s->body.addJointTorque(i, s->tau[i]);
                }
                s->body.computeAccelerationsArticulatedBodyAlgorithmMultiDof(0, s->reals, s->vectors, s->matrices,
                                                                             false, false, false);
                for (int i = 0; i < s->n; ++i)
                    a[i] = s->reals[s->n + 6 + i];  // where it leaves them, after its own work space
            }};
}

}  // namespace alembert::bench
