// SPDX-License-Identifier: MIT
// Orocos KDL: mass matrix by columns, recursive Newton-Euler, dense LDLᵀ.
#include <kdl/chain.hpp>
#include <kdl/chainfdsolver_recursive_newton_euler.hpp>

#include <algorithm>
#include <memory>

#include "rivals.hpp"

namespace alembert::bench {

namespace {

KDL::Vector kdl_vector(const Vector& v) {
    return {v[0], v[1], v[2]};
}

KDL::Chain chain_of(const Tree& tree) {
    KDL::Chain chain;
    for (const TreeBody& b : tree.bodies) {
        const KDL::Rotation R(b.R[0][0], b.R[0][1], b.R[0][2], b.R[1][0], b.R[1][1], b.R[1][2], b.R[2][0],
                              b.R[2][1], b.R[2][2]);
        const KDL::Vector p = kdl_vector(b.p);
        const auto& [xx, xy, xz, yy, yz, zz] = b.inertia;
        const KDL::RotationalInertia own(xx, yy, zz, xy, xz, yz);
        chain.addSegment(KDL::Segment(KDL::Joint(p, R * kdl_vector(b.axis), KDL::Joint::RotAxis), KDL::Frame(R, p),
                                      KDL::RigidBodyInertia(b.mass, kdl_vector(b.com), own)));
    }
    return chain;
}

struct Solver {
    explicit Solver(const Tree& tree)
        : chain(chain_of(tree)),
          solver(chain, kdl_vector(tree.gravity)),
          n(chain.getNrOfJoints()),
          q(n),
          u(n),
          tau(n),
          a(n),
          outside(n, KDL::Wrench::Zero()) {
        for (unsigned i = 0; i < n; ++i) tau(i) = tree.tau[i];
    }
    KDL::Chain chain;
    KDL::ChainFdSolver_RNE solver;
    unsigned n;
    KDL::JntArray q, u, tau, a;
    KDL::Wrenches outside;
};

}  // namespace

Rival kdl(const Tree& tree) {
    const auto s = std::make_shared<Solver>(tree);
    return {"kdl", [s](const double* q, const double* u, double* a) {
                std::copy_n(q, s->n, s->q.data.data());
                std::copy_n(u, s->n, s->u.data.data());
                s->solver.CartToJnt(s->q, s->u, s->tau, s->outside, s->a);
                std::copy_n(s->a.data.data(), s->n, a);
            }};
}

}  // namespace alembert::bench
