// SPDX-License-Identifier: GPL-2.0-or-later
// F_r + F*_r = 0,   F_r = Σ F·∂v/∂u_r + Σ M·∂ω/∂u_r,
// F*_r = −Σ [ m a·∂v/∂u_r + (I α + ω × I ω)·∂ω/∂u_r ]
// (Zhang & Qin, §1.8; Kane & Levinson, Dynamics (1985), chapters 4 and 6). With a = Σ ∂v/∂u_s u̇_s + a₀, α likewise:
//   M_rs = Σ m ∂v/∂u_r·∂v/∂u_s + ∂ω/∂u_r·I ∂ω/∂u_s,   f_r = F_r − Σ m a₀·∂v/∂u_r + (I α₀ + ω × I ω)·∂ω/∂u_r.
#include "formalism/kane.hpp"

#include "formalism/elements.hpp"
#include "model/geometry.hpp"

namespace alembert {

using GiNaC::ex;

namespace {

Vector3 times(const std::array<ex, 6>& I, const Vector3& w, Intermediates& z) {
    return {z.name(I[0] * w[0] + I[3] * w[1] + I[5] * w[2]), z.name(I[3] * w[0] + I[1] * w[1] + I[4] * w[2]),
            z.name(I[5] * w[0] + I[4] * w[1] + I[2] * w[2])};
}

bool is_zero(const Vector3& v) { return v[0].is_zero() && v[1].is_zero() && v[2].is_zero(); }

Vector3 without_acceleration(const Mechanism& m, const Vector3& v) {
    const std::vector<ex> a = m.time_derivative_without_acceleration({v[0], v[1], v[2]});
    return {a[0], a[1], a[2]};
}

/// F_r of forces on places: Σ F·∂v/∂u_r, v being the rate of the place.
std::vector<ex> active(const Mechanism& m, const std::vector<PlacedForce>& forces) {
    std::vector<ex> places;
    for (const PlacedForce& force : forces) places.push_back(force.place);
    const std::vector<ex> velocities = m.time_derivative(places);
    std::vector<std::pair<ex, ex>> pairs;
    for (std::size_t i = 0; i < forces.size(); ++i) pairs.emplace_back(velocities[i], forces[i].force);
    return m.z->pull_back(pairs, m.qdot);
}

}  // namespace

PartialVelocities partial_velocities(const Mechanism& m) {
    PartialVelocities result;
    std::vector<ex> velocities;
    for (const MassElement& body : m.masses) {
        result.bodies.push_back({body.label, {}, {}});
        velocities.insert(velocities.end(), body.velocity.begin(), body.velocity.end());
        if (body.rotation)
            velocities.insert(velocities.end(), body.rotation->w_NB_B.begin(), body.rotation->w_NB_B.end());
    }
    for (const GiNaC::symbol& u : m.qdot) {
        const std::vector<ex> partial = m.z->push_forward(velocities, {{u, 1}});
        auto next = partial.begin();
        const auto take = [&] {
            const Vector3 v{next[0], next[1], next[2]};
            next += 3;
            return v;
        };
        for (std::size_t b = 0; b < m.masses.size(); ++b) {
            result.bodies[b].velocity.push_back(take());
            if (m.masses[b].rotation) result.bodies[b].angular.push_back(take());
        }
    }
    return result;
}

Equations kane(const Mechanism& m) {
    check_masses_known(m, "Kane's equations");
    Intermediates& z = *m.z;
    const int n = m.size();
    const PartialVelocities partial = partial_velocities(m);

    std::vector<GiNaC::exvector> mass(n * n);
    std::vector<GiNaC::exvector> inertia(n);  // −Σ of what does not hold u̇
    for (std::size_t b = 0; b < m.masses.size(); ++b) {
        const MassElement& body = m.masses[b];
        SourceScope source(z, body.label);
        const auto add_share = [&](const std::vector<Vector3>& along, const auto& momentum, const Vector3& rest) {
            for (int r = 0; r < n; ++r) {
                if (is_zero(along[r])) continue;
                const Vector3 p = momentum(along[r]);
                for (int s = 0; s <= r; ++s)
                    if (!is_zero(along[s])) mass[r * n + s].push_back(dot(p, along[s], z));
                inertia[r].push_back(-dot(rest, along[r], z));
            }
        };
        const auto& velocity = partial.bodies[b].velocity;
        add_share(velocity, [&](const Vector3& v) { return scale(body.mass, v, z); },
                  scale(body.mass, without_acceleration(m, body.velocity), z));
        if (!body.rotation) continue;
        const std::array<ex, 6> I = central_inertia(body, z);
        const Vector3& w = body.rotation->w_NB_B;
        add_share(partial.bodies[b].angular, [&](const Vector3& v) { return times(I, v, z); },
                  add(times(I, without_acceleration(m, w), z), cross(w, times(I, w, z), z), z));
    }

    Equations equations = equations_without_terms("kane", m);
    equations.dissipative = m.generalized_forces(true);
    equations.applied = m.generalized_forces(false);
    const std::vector<ex> own = active(m, conservative_forces(m)), rest = potential_without_forces(m);
    for (int r = 0; r < n; ++r) {
        for (int s = 0; s <= r; ++s)
            equations.M(r, s) = equations.M(s, r) = z.name(GiNaC::add(GiNaC::exvector(mass[r * n + s])));
        equations.own.push_back(z.name(GiNaC::add(GiNaC::exvector(inertia[r])) + own[r] + rest[r]));
    }
    attach_constraints(m, equations);
    return equations;
}

}  // namespace alembert
