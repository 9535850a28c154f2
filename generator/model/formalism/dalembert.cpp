// SPDX-License-Identifier: GPL-2.0-or-later
// Σ (F − m a)·δr = 0  (Zhang & Qin (1-22), (1-44)),   δr = Σ ∂r/∂q_i δq_i.
// A rigid body's points are r = r_C + Σ ρ_k e_k with its axes e_k; with J_kl = ∫ ρ_k ρ_l dm = ½ tr(I) δ_kl − I_kl
//   Σ dm a·δr = m r̈_C·δr_C + Σ J_kl ë_k·δe_l.
#include "model/formalism/dalembert.hpp"

#include "base/language/say.hpp"
#include "model/formalism/elements.hpp"

namespace alembert {

using GiNaC::ex;

namespace {

/// The positions that move and the inertia forces on them, −Σ m r̈, in components.
struct Moving {
    std::vector<ex> places, accelerations;  ///< the accelerations contain q''
    std::vector<std::pair<ex, ex>> pairs;   ///< position, inertia force
    std::vector<std::array<std::size_t, 2>> couples;
    std::vector<ex> masses;  ///< of pairs of positions, whose virtual work is mass·a(first)·δ(second)
    std::vector<std::pair<std::size_t, ex>> leaving;  ///< m' v of a mass that changes
};

Moving moving(const Mechanism& m) {
    Moving result;
    Intermediates& z = *m.z;
    const auto add_vector = [&](const Vector3& r) {
        result.places.insert(result.places.end(), r.begin(), r.end());
        return result.places.size() - 3;
    };
    const auto couple = [&](std::size_t a, std::size_t b, const ex& mass) {
        if (mass.is_zero()) return;
        for (std::size_t k = 0; k < 3; ++k) {
            result.couples.push_back({a + k, b + k});
            result.masses.push_back(mass);
        }
    };
    for (const MassElement& body : m.masses) {
        SourceScope source(z, label(body.origin));
        const std::size_t centre = add_vector(body.position);
        couple(centre, centre, body.mass);
        for (std::size_t k = 0; k < 3 && !body.mass_rate.is_zero(); ++k)
            result.leaving.emplace_back(centre + k, body.mass_rate * body.velocity[k]);
        if (!body.rotation) continue;
        const std::array<ex, 6> I = central_inertia(body, z);
        const ex half_trace = (I[0] + I[1] + I[2]) / 2;
        std::array<std::size_t, 3> e;
        for (int k = 0; k < 3; ++k) e[k] = add_vector(body.rotation->axes[k]);
        for (int k = 0; k < 3; ++k) {
            couple(e[k], e[k], z.name(half_trace - I[k]));
            const ex J = z.name(-I[3 + k]);
            couple(e[k], e[(k + 1) % 3], J);
            couple(e[(k + 1) % 3], e[k], J);
        }
    }
    for (const Rotor& rotor : m.rotors) {  // −J q'' δq
        result.couples.push_back({result.places.size(), result.places.size()});
        result.masses.push_back(rotor.inertia);
        result.places.push_back(m.q[rotor.coordinate]);
    }
    result.accelerations = m.time_derivative(m.time_derivative(result.places));
    std::vector<GiNaC::exvector> force(result.places.size());
    for (std::size_t c = 0; c < result.couples.size(); ++c)
        force[result.couples[c][1]].push_back(-result.masses[c] * result.accelerations[result.couples[c][0]]);
    for (const auto& [place, momentum] : result.leaving) force[place].push_back(-momentum);
    for (std::size_t k = 0; k < force.size(); ++k)
        result.pairs.emplace_back(result.places[k], z.name(GiNaC::add(std::move(force[k]))));
    return result;
}

}  // namespace

std::optional<std::string> obstacle_to_dalembert(const Mechanism& m) {
    return masses_unknown(m, say("d'Alembert's equations"));
}

VirtualWork virtual_work(const Mechanism& m) {
    need_none(obstacle_to_dalembert(m));
    std::vector<std::pair<ex, ex>> pairs;
    for (const PlacedForce& force : conservative_forces(m)) pairs.emplace_back(force.place, force.force);
    return {.conservative = m.z->pull_back(pairs, m.q),
            .dissipative = work_of_loads(m, true),
            .applied = work_of_loads(m, false),
            .inertia = m.z->pull_back(moving(m).pairs, m.q)};
}

Equations dalembert(const Mechanism& mechanism) {
    const Mechanism m = with_own_intermediates(mechanism);
    const VirtualWork work = virtual_work(m);
    Intermediates& z = *m.z;
    const int n = m.size();
    Equations equations = equations_without_terms("dalembert", m);
    equations.dissipative = work.dissipative;
    equations.applied = work.applied;
    // The work of inertia forces is linear in q'': the part with q'' is −M q'', and the rest is its value at q'' =
    // 0.
    GiNaC::exmap still;
    for (const GiNaC::symbol& a : m.qddot) still[a] = 0;
    for (int j = 0; j < n; ++j) {
        const std::vector<ex> column = z.push_forward(work.inertia, {{m.qddot[j], -1}});
        for (int i = 0; i < n; ++i) equations.M(i, j) = column[i];
    }
    const std::vector<ex> rest = substitute(z, work.inertia, still);
    for (int i = 0; i < n; ++i) equations.own.push_back(z.name(work.conservative[i] + rest[i]));
    attach_constraints(m, equations);
    return equations;
}

std::vector<ex> rest_conditions(const Mechanism& m, const Equations& equations) {
    GiNaC::exmap still;
    for (const GiNaC::symbol& rate : m.qdot) still[rate] = 0;
    std::vector<ex> conditions;
    for (int i = 0; i < m.size(); ++i) conditions.push_back(equations.forcing(i));
    return substitute(*m.z, conditions, still);
}

}  // namespace alembert
