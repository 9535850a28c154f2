// SPDX-License-Identifier: GPL-2.0-or-later
// M = J̄ᵀ M̄ J̄,   f = J̄ᵀ (q̄ᵉ − k̄)  (Schiehlen, Technische Dynamik (1986), chapter 4), body by body:
//   M_rs = Σ m J_Tr·J_Ts + J_Rr·I J_Rs,   f_r = Σ J_Tr·(m g − m ā) − J_Rr·(I ᾱ + ω × I ω) + Σ ∂x/∂q_r F.
#include "model/formalism/newton_euler.hpp"

#include "model/formalism/elements.hpp"
#include "model/geometry.hpp"

namespace alembert {

using GiNaC::ex;

Vector3 inertia_times(const std::array<ex, 6>& I, const Vector3& w, Intermediates& z) {
    return {z.name(I[0] * w[0] + I[3] * w[1] + I[5] * w[2]), z.name(I[3] * w[0] + I[1] * w[1] + I[4] * w[2]),
            z.name(I[5] * w[0] + I[4] * w[1] + I[2] * w[2])};
}

Equations projected(const std::string& formalism, const Mechanism& m, const std::vector<BodyMotion>& bodies) {
    Intermediates& z = *m.z;
    const int n = m.size();
    std::vector<GiNaC::exvector> mass(n * n), own(n);
    for (std::size_t b = 0; b < bodies.size(); ++b) {
        const MassElement& body = m.masses[b];
        const BodyMotion& motion = bodies[b];
        SourceScope source(z, label(body.origin));
        // Adds the rows J of translation or rotation, with their block of M̄ and their right-hand side.
        const auto add_rows = [&](const std::vector<Vector3>& J, const auto& block, const Vector3& right) {
            for (int r = 0; r < n; ++r) {
                if (is_zero(J[r])) continue;
                const Vector3 p = block(J[r]);
                for (int s = 0; s <= r; ++s)
                    if (!is_zero(J[s])) mass[r * n + s].push_back(dot(p, J[s], z));
                own[r].push_back(dot(right, J[r], z));
            }
        };
        add_rows(
            motion.J_T, [&](const Vector3& v) { return scale(body.mass, v, z); },
            scale(-1,
                  with_mass_rate(body, scale(body.mass, add(motion.a_bar, scale(-1, m.gravity, z), z), z),
                                 body.velocity, z),
                  z));
        if (!body.rotation) continue;
        const std::array<ex, 6> I = central_inertia(body, z);
        const Vector3 gyroscopic = cross(motion.w, inertia_times(I, motion.w, z), z);
        add_rows(
            motion.J_R, [&](const Vector3& v) { return inertia_times(I, v, z); },
            scale(-1, add(inertia_times(I, motion.alpha_bar, z), gyroscopic, z), z));
    }
    for (const Rotor& rotor : m.rotors) mass[rotor.coordinate * n + rotor.coordinate].push_back(rotor.inertia);
    Equations equations = equations_without_terms(formalism, m);
    equations.dissipative = work_of_loads(m, true);
    equations.applied = work_of_loads(m, false);
    std::vector<std::pair<ex, ex>> springs;
    for (const PlacedForce& force : conservative_forces(m))
        if (force.origin.kind != Origin::Kind::gravity) springs.emplace_back(force.place, force.force);
    const std::vector<ex> known = z.pull_back(springs, m.q);
    for (int r = 0; r < n; ++r) {
        for (int s = 0; s <= r; ++s)
            equations.M(r, s) = equations.M(s, r) = z.name(GiNaC::add(GiNaC::exvector(mass[r * n + s])));
        equations.own.push_back(z.name(GiNaC::add(GiNaC::exvector(own[r])) + known[r]));
    }
    attach_constraints(m, equations);
    return equations;
}

}  // namespace alembert
