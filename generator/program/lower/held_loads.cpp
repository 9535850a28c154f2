// SPDX-License-Identifier: GPL-2.0-or-later
#include "program/lower/held_loads.hpp"

#include "model/formalism/elements.hpp"
#include "model/formalism/newton_euler.hpp"
#include "model/geometry.hpp"
#include "program/lower/lower.hpp"

namespace alembert {

using GiNaC::ex;

namespace {

/// The mechanism for time derivatives, in which only the coordinates before `first` move.
Mechanism clock_of(const Mechanism& m, int first) {
    Mechanism clock;
    clock.symbols = m.symbols;
    clock.z = m.z;
    clock.t = m.t;
    clock.inputs = m.inputs;
    clock.q.assign(m.q.begin(), m.q.begin() + first);
    clock.qdot.assign(m.qdot.begin(), m.qdot.begin() + first);
    clock.qddot.assign(m.qddot.begin(), m.qddot.begin() + first);
    return clock;
}

}  // namespace

std::vector<int> held_loads(Program& program, const Mechanism& m, int first,
                            const std::vector<std::pair<GiNaC::symbol, int>>& given) {
    Intermediates& z = *m.z;
    const std::vector<GiNaC::symbol> held(m.q.begin() + first, m.q.end()),
        held_rates(m.qdot.begin() + first, m.qdot.end());
    GiNaC::exmap in_place, at_rest;
    for (const GiNaC::symbol& c : held) in_place[c] = 0;
    for (const GiNaC::symbol& rate : held_rates) at_rest[rate] = 0;

    std::vector<const MassElement*> bodies;
    std::vector<ex> velocities, forces;
    for (const MassElement& body : m.masses) {
        if (body.mass.is_zero() && !body.rotation) continue;
        bodies.push_back(&body);
        velocities.insert(velocities.end(), body.velocity.begin(), body.velocity.end());
        if (body.rotation)
            velocities.insert(velocities.end(), body.rotation->w_NB_B.begin(), body.rotation->w_NB_B.end());
    }
    const std::size_t inertial = velocities.size();
    for (const Load& load : m.loads)
        for (const Load::Pair& pair : load.pairs)
            velocities.push_back(pair.velocity), forces.push_back(-pair.force);
    velocities = substitute(z, velocities, in_place);
    const std::vector<ex> moving =
        substitute(z, {velocities.begin(), velocities.begin() + static_cast<std::ptrdiff_t>(inertial)}, at_rest);
    const std::vector<ex> accelerations = clock_of(m, first).time_derivative(moving);

    std::vector<std::pair<ex, ex>> virtual_work, potential;
    for (const MassElement* body : bodies) {
        SourceScope source(z, label(body->origin));
        const std::size_t at = virtual_work.size();
        for (std::size_t k = at; k < at + 3; ++k)
            virtual_work.emplace_back(velocities[k], z.name(body->mass * accelerations[k]));
        if (!body->rotation) continue;
        const Vector3 w{moving[at + 3], moving[at + 4], moving[at + 5]},
            alpha{accelerations[at + 3], accelerations[at + 4], accelerations[at + 5]};
        const std::array<ex, 6> I = central_inertia(*body, z);
        const Vector3 moment = add(inertia_times(I, alpha, z), cross(w, inertia_times(I, w, z), z), z);
        for (std::size_t k = 0; k < 3; ++k) virtual_work.emplace_back(velocities[at + 3 + k], moment[k]);
    }
    for (std::size_t k = 0; k < forces.size(); ++k) virtual_work.emplace_back(velocities[inertial + k], forces[k]);
    for (const Part& part : m.potential) potential.emplace_back(part.value, 1);

    const std::vector<ex> inertia_and_forces = z.pull_back(virtual_work, held_rates),
                          slope = z.pull_back(potential, held);
    const auto lowering = lowering_into(program, m, given);
    std::vector<int> loads;
    for (std::size_t i = 0; i < held.size(); ++i)
        loads.push_back(program.sum(0, {{1, lowering(inertia_and_forces[i])}, {1, lowering(slope[i])}}));
    return loads;
}

}  // namespace alembert
