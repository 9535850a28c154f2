// SPDX-License-Identifier: GPL-2.0-or-later
#include "model/own_quantities.hpp"

#include "model/energies.hpp"
#include "model/places.hpp"

namespace alembert {

using GiNaC::ex;

namespace {

/// One load that has these generalized forces.
Load load_of(const Origin& origin, bool dissipative, const std::vector<ex>& Q, const Mechanism& m) {
    Load load{.origin = origin, .dissipative = dissipative, .pairs = {}};
    for (int i = 0; i < m.size(); ++i)
        if (!Q[i].is_zero()) load.pairs.push_back({.velocity = m.qdot[i], .force = Q[i]});
    return load;
}

void state_forces(Mechanism& m, const OwnQuantities& own) {
    std::vector<ex> damping = m.generalized_forces(true), applied = m.generalized_forces(false);
    std::vector<ex> of_potential(static_cast<std::size_t>(m.size()), 0);
    if (own.forces_are_whole) of_potential = m.z->pull_back({{energies_of(m).potential, 1}}, m.q);
    for (const auto& [coordinate, Q] : own.forces) {
        const std::size_t i = coordinate_index(coordinate, m);
        damping[i] = 0;
        applied[i] = m.z->name(Q + of_potential[i]);
    }
    m.loads.clear();
    const Origin origin{.kind = Origin::Kind::generalized_force};
    for (const bool dissipative : {false, true}) {
        Load load = load_of(origin, dissipative, dissipative ? damping : applied, m);
        if (!load.pairs.empty()) m.loads.push_back(std::move(load));
    }
}

}  // namespace

Mechanism with_own(const Mechanism& mechanism, const OwnQuantities& own) {
    Mechanism result = mechanism;
    const bool is_split = own.kinetic || own.potential;
    if (is_split && mechanism.given_lagrangian && mechanism.kinetic.empty()) {
        const Energies given = energies_of(mechanism);
        result.kinetic = {{{.kind = Origin::Kind::given_kinetic}, given.kinetic}};
        result.potential = {{{.kind = Origin::Kind::given_potential}, given.potential}};
        result.given_lagrangian.reset();
    }
    if (own.kinetic) result.kinetic = {{{.kind = Origin::Kind::given_kinetic}, result.z->name(*own.kinetic)}};
    if (own.potential)
        result.potential = {{{.kind = Origin::Kind::given_potential}, result.z->name(*own.potential)}};
    if (own.lagrangian) result.given_lagrangian = result.z->name(*own.lagrangian);
    if (!own.forces.empty()) state_forces(result, own);
    return result;
}

}  // namespace alembert
