// SPDX-License-Identifier: MIT
// Simbody: the whole system realized from positions to accelerations. (Its headers crash with -DNDEBUG.)
#undef NDEBUG
#include <Simbody.h>

#include <algorithm>
#include <memory>

#include "rivals.hpp"

namespace alembert::bench {

namespace {

SimTK::Vec3 vec(const Vector& v) {
    return {v[0], v[1], v[2]};
}

struct System {
    explicit System(const Tree& tree) : matter(system), forces(system), loads(forces, matter) {
        SimTK::Force::UniformGravity(forces, matter, vec(tree.gravity));
        SimTK::MobilizedBody last = matter.Ground();
        for (const TreeBody& b : tree.bodies) {
            const auto& [xx, xy, xz, yy, yz, zz] = b.inertia;
            const SimTK::Inertia about_centre(xx, yy, zz, xy, xz, yz);
            const SimTK::Body::Rigid body(
                SimTK::MassProperties(b.mass, vec(b.com), about_centre.shiftFromMassCenter(-vec(b.com), b.mass)));
            // A pin turns about z of its frames.
            const SimTK::Rotation to_axis(SimTK::UnitVec3(vec(b.axis)), SimTK::ZAxis);
            SimTK::Mat33 R;
            for (int i = 0; i < 3; ++i)
                for (int j = 0; j < 3; ++j)
                    R(i, j) = b.R[static_cast<std::size_t>(i)][static_cast<std::size_t>(j)];
            const SimTK::Rotation placed(R, true);
            last = SimTK::MobilizedBody::Pin(last, SimTK::Transform(placed * to_axis, vec(b.p)), body,
                                             SimTK::Transform(to_axis));
        }
        state = system.realizeTopology();
        const int n = matter.getNumMobilities();
        SimTK::Vector tau(n);
        for (int i = 0; i < n; ++i) tau[i] = tree.tau[static_cast<std::size_t>(i)];
        loads.setAllMobilityForces(state, tau);
    }
    SimTK::MultibodySystem system;
    SimTK::SimbodyMatterSubsystem matter;
    SimTK::GeneralForceSubsystem forces;
    SimTK::Force::DiscreteForces loads;
    SimTK::State state;
};

}  // namespace

Rival simbody(const Tree& tree) {
    const auto s = std::make_shared<System>(tree);
    const int n = s->matter.getNumMobilities();
    return {"simbody", [s, n](const double* q, const double* u, double* a) {
                SimTK::Vector& positions = s->state.updQ();
                SimTK::Vector& rates = s->state.updU();
                for (int i = 0; i < n; ++i) positions[i] = q[i], rates[i] = u[i];
                s->system.realize(s->state, SimTK::Stage::Acceleration);
                const SimTK::Vector& result = s->state.getUDot();
                for (int i = 0; i < n; ++i) a[i] = result[i];
            }};
}

}  // namespace alembert::bench
