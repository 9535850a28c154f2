// SPDX-License-Identifier: GPL-2.0-or-later
#include "model/energy.hpp"

#include <algorithm>

#include "algebra/symbolic/fourier.hpp"
#include "algebra/symbolic/nonzero.hpp"
#include "model/energies.hpp"

namespace alembert {

using GiNaC::ex;

namespace {

/// Nothing if that divides by a rate.
std::optional<ex> at_rest(const ex& e, const Mechanism& m) {
    GiNaC::exmap still;
    for (const GiNaC::symbol& rate : m.qdot) still[rate] = 0;
    try {
        return m.z->expand(e).subs(still, GiNaC::subs_options::no_pattern);
    } catch (const GiNaC::pole_error&) {
        return std::nullopt;
    }
}

/// A frame that turns at a given rate leaves T₁ and T₀ in T even if t itself cancels from T (a gyrocompass).
/// Therefore the positions are tested, not T.
bool places_depend_on_time(const Mechanism& m) {
    GiNaC::lst places;  // one list, so that intermediate symbols that many have in common are followed once
    const auto add = [&](const Vector3& v) {
        for (const ex& x : v) places.append(x);
    };
    for (const MassElement& body : m.masses) {
        add(body.position);
        if (body.rotation)
            for (const Vector3& axis : body.rotation->axes) add(axis);
    }
    return m.z->depends(places, m.clock());
}

}  // namespace

std::optional<bool> vanishes(const ex& e, const Mechanism& mechanism) {
    if (e.is_zero()) return true;
    if (shows_nonzero(e, *mechanism.z)) return false;
    if (mechanism.z->tree_size(e) > 20000) return std::nullopt;
    const auto normal = fourier(mechanism.z->expand(e), *mechanism.symbols);
    if (!normal) return std::nullopt;
    return is_zero(*normal);
}

bool is_identically_zero(const ex& e, const Mechanism& mechanism) {
    return vanishes(e, mechanism).value_or(false);
}

Mechanism in_terms_of(const Energy& energy, const Mechanism& mechanism) {
    Mechanism result = with_own_intermediates(mechanism);
    result.z->adopt(*energy.z);
    return result;
}

Energies energies_of(const Mechanism& m) {
    if (!m.given_lagrangian || !m.kinetic.empty()) return {m.kinetic_energy(), m.potential_energy()};
    Intermediates& z = *m.z;
    const ex& L = *m.given_lagrangian;
    const std::vector<ex> p = z.pull_back({{L, 1}}, m.qdot);
    GiNaC::exvector twice;
    for (int j = 0; j < m.size(); ++j)
        for (int i = 0; const ex& entry : z.push_forward(p, {{m.qdot[j], 1}}))
            twice.push_back(entry * m.qdot[i++] * m.qdot[j]);
    Energies result{.kinetic = z.name(GiNaC::add(std::move(twice)) / 2), .potential = 0};
    const std::optional<ex> still = at_rest(L, m);
    if (still) {
        result.potential = z.name(-*still);
        return result;
    }
    GiNaC::exvector jacobi{-L};  // at rest there is no value; E − T is none of less meaning
    for (int i = 0; i < m.size(); ++i) jacobi.push_back(p[i] * m.qdot[i]);
    result.potential = z.name(GiNaC::add(std::move(jacobi)) - result.kinetic);
    return result;
}

Energy energy_of(const Mechanism& mechanism) {
    const Mechanism m = with_own_intermediates(mechanism);
    Intermediates& z = *m.z;
    const int n = m.size();
    const ex L = m.lagrangian();
    Energy result;
    result.z = m.z;

    GiNaC::exvector p_dot_q;  // q'·∂L/∂q'
    const std::vector<ex> p = z.pull_back({{L, 1}}, m.qdot);
    for (int i = 0; i < n; ++i) p_dot_q.push_back(p[i] * m.qdot[i]);
    const ex pq = z.name(GiNaC::add(std::move(p_dot_q)));
    result.jacobi = z.name(pq - L);

    ex extra = 0;  // T₁ + 2T₀ = 2T − q'·∂T/∂q'
    const Energies energies = energies_of(m);
    result.kinetic = energies.kinetic;
    result.potential = energies.potential;
    if (m.given_lagrangian) {
        result.energy = result.jacobi;
    } else {
        result.energy = z.name(result.kinetic + result.potential);
        const bool bodies_alone =
            !m.kinetic.empty() && m.kinetic.back().origin.kind != Origin::Kind::given_kinetic;
        if (!bodies_alone || places_depend_on_time(m)) extra = z.name(2 * result.kinetic - pq);
        if (is_identically_zero(extra, m)) extra = 0;
    }

    GiNaC::exvector work;
    const std::vector<ex> damping = m.generalized_forces(true), applied = m.generalized_forces(false);
    for (int i = 0; i < n; ++i) work.push_back((damping[i] + applied[i]) * m.qdot[i]);
    ex jacobi_power = z.name(GiNaC::add(std::move(work)) - m.explicit_time_derivative({L})[0]);
    if (is_identically_zero(jacobi_power, m)) jacobi_power = 0;
    // Constraint forces do work where the constraints move: λ·A q' = −λ·b.
    for (const Mechanism::Constraint& c : m.constraints) jacobi_power -= c.multiplier * c.offset;
    for (const Mechanism::Constraint& c : m.redundant)
        if (c.tie) jacobi_power -= c.multiplier * c.offset;
    jacobi_power = z.name(jacobi_power);
    result.jacobi_conserved = jacobi_power.is_zero();
    result.power = z.name(jacobi_power + (extra.is_zero() ? ex(0) : m.time_derivative({extra})[0]));
    result.conserved = result.power.is_zero() || (extra.is_zero() && result.jacobi_conserved);
    return result;
}

}  // namespace alembert
