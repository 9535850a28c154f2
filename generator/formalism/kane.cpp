// SPDX-License-Identifier: GPL-2.0-or-later
// F_r + F*_r = 0,   F_r = Σ F·∂v/∂u_r + Σ M·∂ω/∂u_r,
// F*_r = −Σ [ m a·∂v/∂u_r + (I α + ω × I ω)·∂ω/∂u_r ]
// (Zhang & Qin, §1.8; Kane & Levinson, Dynamics (1985), chapters 4 and 6). With a = Σ ∂v/∂u_s u̇_s + a₀, α likewise:
//   M_rs = Σ m ∂v/∂u_r·∂v/∂u_s + ∂ω/∂u_r·I ∂ω/∂u_s,   f_r = F_r − Σ m a₀·∂v/∂u_r + (I α₀ + ω × I ω)·∂ω/∂u_r.
#include "formalism/kane.hpp"

#include "formalism/cancel.hpp"
#include "formalism/elements.hpp"
#include "formalism/kinematics.hpp"
#include "model/geometry.hpp"

namespace alembert {

using GiNaC::ex;

namespace {

Vector3 times(const std::array<ex, 6>& I, const Vector3& w, Intermediates& z) {
    return {z.name(I[0] * w[0] + I[3] * w[1] + I[5] * w[2]), z.name(I[3] * w[0] + I[1] * w[1] + I[4] * w[2]),
            z.name(I[5] * w[0] + I[4] * w[1] + I[2] * w[2])};
}

bool is_zero(const Vector3& v) { return v[0].is_zero() && v[1].is_zero() && v[2].is_zero(); }

/// Velocities as functions of q, u and t, and derivatives along the motion that they make.
struct Motion {
    const Mechanism& m;
    Kinematics k;
    GiNaC::exmap by = {};  ///< q' → h

    std::vector<ex> in_speeds(const std::vector<ex>& values) const { return by.empty() ? values : substitute(*m.z, values, by); }
    /// What cancels must be seen to cancel: w = w₁ x + w₂ y + w₃ z has no derivative in the body at u' = 0.
    std::vector<ex> short_in_speeds(const std::vector<ex>& values) const {
        std::vector<ex> result = in_speeds(values);
        for (ex& value : result) value = by.empty() ? value : shortened(value);
        return result;
    }
    ex shortened(const ex& value) const {
        if (m.z->tree_size(value) > 400) return value;  // beyond, looking for a short form costs more than it wins
        return k.poles.empty() ? short_form(value, m) : cancelled(short_form(value, m), m);
    }
    Vector3 short_in_speeds(const Vector3& v) const {
        const std::vector<ex> values = short_in_speeds(std::vector<ex>(v.begin(), v.end()));
        return {values[0], values[1], values[2]};
    }

    /// d/dt at u' = 0 of what is in speeds.
    std::vector<ex> without_acceleration(const std::vector<ex>& values) const {
        if (k.h.empty()) return m.time_derivative_without_acceleration(values);
        std::vector<ex> parts = m.explicit_time_derivative(values);
        Intermediates::Direction along;
        for (int i = 0; i < m.size(); ++i) along.emplace_back(m.q[i], k.h[i]);
        const std::vector<ex> convected = m.z->push_forward(values, along);
        for (std::size_t i = 0; i < parts.size(); ++i) parts[i] = m.z->name(parts[i] + convected[i]);
        return parts;
    }
    Vector3 without_acceleration(const Vector3& v) const {
        std::vector<ex> a = without_acceleration(std::vector<ex>{v[0], v[1], v[2]});
        for (ex& component : a) component = k.poles.empty() ? component : shortened(component);
        return {a[0], a[1], a[2]};
    }

    /// Σ force·∂velocity/∂u_r of velocities and forces in q'.
    std::vector<ex> generalized(const std::vector<ex>& velocities, const std::vector<ex>& forces) const {
        const std::vector<ex> v = short_in_speeds(velocities), F = short_in_speeds(forces);
        std::vector<std::pair<ex, ex>> pairs;
        for (std::size_t i = 0; i < v.size(); ++i) pairs.emplace_back(v[i], F[i]);
        return m.z->pull_back(pairs, k.u);
    }
};

Motion motion_of(const Mechanism& m, Kinematics k) {
    Motion motion{m, std::move(k)};
    for (std::size_t i = 0; i < motion.k.h.size(); ++i)
        if (!motion.k.h[i].is_equal(m.qdot[i])) motion.by[m.qdot[i]] = motion.k.h[i];
    return motion;
}

/// F_r of forces on places, v being the rate of the place.
std::vector<ex> active(const Motion& motion, const Mechanism& m, const std::vector<PlacedForce>& placed) {
    std::vector<ex> places, forces;
    for (const PlacedForce& force : placed) {
        places.push_back(force.place);
        forces.push_back(force.force);
    }
    return motion.generalized(m.time_derivative(places), forces);
}

std::vector<ex> active(const Motion& motion, const Mechanism& m, bool dissipative) {
    std::vector<ex> velocities, forces;
    for (const Load& load : m.loads)
        if (load.dissipative == dissipative)
            for (const Load::Pair& pair : load.pairs) {
                velocities.push_back(pair.velocity);
                forces.push_back(pair.force);
            }
    return motion.generalized(velocities, forces);
}

PartialVelocities partials(const Motion& motion, const Mechanism& m) {
    PartialVelocities result;
    std::vector<ex> velocities;
    for (const MassElement& body : m.masses) {
        result.bodies.push_back({body.label, {}, {}});
        velocities.insert(velocities.end(), body.velocity.begin(), body.velocity.end());
        if (body.rotation)
            velocities.insert(velocities.end(), body.rotation->w_NB_B.begin(), body.rotation->w_NB_B.end());
    }
    velocities = motion.short_in_speeds(velocities);
    for (const GiNaC::symbol& u : motion.k.u) {
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

KaneForces forces_of(const Motion& motion, const Mechanism& m) {
    Intermediates& z = *m.z;
    const int n = static_cast<int>(motion.k.u.size());
    const PartialVelocities partial = partials(motion, m);

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
        add_share(partial.bodies[b].velocity, [&](const Vector3& v) { return scale(body.mass, v, z); },
                  scale(body.mass, motion.without_acceleration(motion.short_in_speeds(body.velocity)), z));
        if (!body.rotation) continue;
        const std::array<ex, 6> I = central_inertia(body, z);
        const Vector3 w = motion.short_in_speeds(body.rotation->w_NB_B);
        add_share(partial.bodies[b].angular, [&](const Vector3& v) { return times(I, v, z); },
                  add(times(I, motion.without_acceleration(w), z), cross(w, times(I, w, z), z), z));
    }

    KaneForces result{.u = motion.k.u,
                      .udot = motion.k.udot,
                      .M = GiNaC::matrix(n, n),
                      .inertia = {},
                      .conservative = {},
                      .dissipative = {},
                      .applied = {}};
    result.dissipative = active(motion, m, true);
    result.applied = active(motion, m, false);
    result.conservative = active(motion, m, conservative_forces(m));
    const std::vector<ex> rest = motion.generalized({m.qdot.begin(), m.qdot.end()}, potential_without_forces(m));
    const auto final = [&](const ex& e) { return motion.k.poles.empty() ? e : cancelled(z.name(e), m); };
    for (int r = 0; r < n; ++r) {
        for (int s = 0; s <= r; ++s)
            result.M(r, s) = result.M(s, r) = final(z.name(GiNaC::add(GiNaC::exvector(mass[r * n + s]))));
        result.inertia.push_back(final(GiNaC::add(GiNaC::exvector(inertia[r]))));
        result.conservative[r] += rest[r];
    }
    return result;
}

/// A and γ of the constraints that are left, in speeds.
void attach_kept(const Motion& motion, const Mechanism& m, Equations& equations) {
    if (equations.h.empty()) return attach_constraints(m, equations);
    for (const int c : equations.kept(m)) {
        const Mechanism::Constraint& constraint = m.constraints[c];
        SourceScope source(*m.z, "constraint " + constraint.name);
        GiNaC::exvector terms{constraint.drift};
        for (int i = 0; i < m.size(); ++i) terms.push_back(constraint.row[i] * equations.h[i]);
        const ex velocity = m.z->name(GiNaC::add(std::move(terms)));
        std::vector<ex> row;
        for (const GiNaC::symbol& u : equations.u) row.push_back(m.z->push_forward({velocity}, {{u, 1}})[0]);
        equations.A.push_back(std::move(row));
        equations.gamma.push_back(m.z->name(-motion.without_acceleration(std::vector<ex>{velocity})[0]));
        equations.lambda.push_back(constraint.multiplier);
    }
}

/// Forces of the eliminated constraints: with all rates as speeds their partial velocities contribute,
/// Aₑᵀ λₑ = M q'' − f − Aᵀ λ, solved by (Aₑ Aₑᵀ) λₑ = Aₑ (…), which fails where Aₑ loses rank only.
void recover(const Mechanism& m, Equations& equations) {
    if (equations.eliminated.empty()) return;
    Intermediates& z = *m.z;
    const KaneForces all = forces_of(motion_of(m, {.u = m.qdot, .udot = m.qddot}), m);
    std::vector<ex> reaction;
    for (int i = 0; i < m.size(); ++i) {
        GiNaC::exvector terms{-all.inertia[i], -all.conservative[i], -all.dissipative[i], -all.applied[i]};
        for (int j = 0; j < m.size(); ++j) terms.push_back(all.M(i, j) * m.qddot[j]);
        for (const int c : equations.kept(m)) terms.push_back(-m.constraints[c].row[i] * m.constraints[c].multiplier);
        reaction.push_back(z.name(GiNaC::add(std::move(terms))));
    }
    const auto count = static_cast<unsigned>(equations.eliminated.size());
    const auto row = [&](unsigned e) -> const std::vector<ex>& { return m.constraints[equations.eliminated[e].constraint].row; };
    GiNaC::matrix S(count, count), right(count, 1);
    for (unsigned e = 0; e < count; ++e) {
        GiNaC::exvector along;
        for (int i = 0; i < m.size(); ++i) along.push_back(row(e)[i] * reaction[i]);
        right(e, 0) = z.name(GiNaC::add(std::move(along)));
        for (unsigned f = 0; f < count; ++f) {
            GiNaC::exvector terms;
            for (int i = 0; i < m.size(); ++i) terms.push_back(row(e)[i] * row(f)[i]);
            S(e, f) = z.name(GiNaC::add(std::move(terms)));
        }
    }
    const GiNaC::matrix x = solve_exactly(S, right, m, "Kane's equations: the constraints depend on each other");
    for (unsigned e = 0; e < count; ++e) equations.eliminated[e].multiplier = x(e, 0);
}

}  // namespace

PartialVelocities partial_velocities(const Mechanism& m) { return partials(motion_of(m, kinematics(m)), m); }

KaneForces kane_forces(const Mechanism& m) { return forces_of(motion_of(m, kinematics(m)), m); }

Equations kane(const Mechanism& m) {
    check_masses_known(m, "Kane's equations");
    const Motion motion = motion_of(m, kinematics(m));
    const KaneForces forces = forces_of(motion, m);
    Equations equations = equations_without_terms("kane", m);
    equations.u = forces.u;
    equations.udot = forces.udot;
    equations.M = forces.M;
    equations.dissipative = forces.dissipative;
    equations.applied = forces.applied;
    for (int r = 0; r < equations.size(); ++r) equations.own.push_back(m.z->name(forces.inertia[r] + forces.conservative[r]));
    equations.h = motion.k.h;
    if (!motion.k.h.empty()) equations.form = motion.k.form;
    equations.poles = motion.k.poles;
    for (const int c : motion.k.eliminated) equations.eliminated.push_back({c, 0});
    attach_kept(motion, m, equations);
    recover(m, equations);
    return equations;
}

}  // namespace alembert
