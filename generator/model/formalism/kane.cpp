// SPDX-License-Identifier: GPL-2.0-or-later
// F_r + F*_r = 0,   F_r = Σ F·∂v/∂u_r + Σ M·∂ω/∂u_r,
// F*_r = −Σ [ m a·∂v/∂u_r + (I α + ω × I ω)·∂ω/∂u_r ]
// (Zhang & Qin, §1.8; Kane & Levinson, Dynamics (1985), chapters 4 and 6). With a = Σ ∂v/∂u_s u̇_s + a₀, α
// likewise:
//   M_rs = Σ m ∂v/∂u_r·∂v/∂u_s + ∂ω/∂u_r·I ∂ω/∂u_s,   f_r = F_r − Σ m a₀·∂v/∂u_r + (I α₀ + ω × I ω)·∂ω/∂u_r.
#include "model/formalism/kane.hpp"

#include "base/language/say.hpp"
#include "model/formalism/in_speeds.hpp"
#include "model/formalism/newton_euler.hpp"
#include "model/geometry.hpp"

namespace alembert {

using GiNaC::ex;

namespace {

PartialVelocities partials(const InSpeeds& motion, const Mechanism& m) {
    PartialVelocities result;
    std::vector<ex> velocities;
    for (const MassElement& body : m.masses) {
        result.bodies.push_back({shown_label(body.origin), {}, {}});
        velocities.insert(velocities.end(), body.velocity.begin(), body.velocity.end());
        if (body.rotation)
            velocities.insert(velocities.end(), body.rotation->w_NB_B.begin(), body.rotation->w_NB_B.end());
    }
    velocities = motion.short_in_speeds(velocities);
    for (const GiNaC::symbol& u : motion.kinematics().u) {
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

KaneForces forces_of(const InSpeeds& motion, const Mechanism& m) {
    Intermediates& z = *m.z;
    const int n = static_cast<int>(motion.kinematics().u.size());
    const PartialVelocities partial = partials(motion, m);

    std::vector<GiNaC::exvector> mass(n * n);
    std::vector<GiNaC::exvector> inertia(n);  // minus the sum of the terms without u̇
    for (std::size_t b = 0; b < m.masses.size(); ++b) {
        const MassElement& body = m.masses[b];
        SourceScope source(z, label(body.origin));
        const auto add_share = [&](const std::vector<Vector3>& along, const auto& momentum, const Vector3& rest) {
            for (int r = 0; r < n; ++r) {
                if (is_zero(along[r])) continue;
                const Vector3 p = momentum(along[r]);
                for (int s = 0; s <= r; ++s)
                    if (!is_zero(along[s])) mass[r * n + s].push_back(dot(p, along[s], z));
                inertia[r].push_back(-dot(rest, along[r], z));
            }
        };
        add_share(
            partial.bodies[b].velocity, [&](const Vector3& v) { return scale(body.mass, v, z); },
            with_mass_rate(body,
                           scale(body.mass, motion.without_acceleration(motion.short_in_speeds(body.velocity)), z),
                           motion.short_in_speeds(body.velocity), z));
        if (!body.rotation) continue;
        const std::array<ex, 6> I = central_inertia(body, z);
        const Vector3 w = motion.short_in_speeds(body.rotation->w_NB_B);
        add_share(
            partial.bodies[b].angular, [&](const Vector3& v) { return inertia_times(I, v, z); },
            add(inertia_times(I, motion.without_acceleration(w), z), cross(w, inertia_times(I, w, z), z), z));
    }

    for (const Rotor& rotor : m.rotors) {
        SourceScope source(z, label(rotor.origin));
        const std::vector<ex> rate = motion.short_in_speeds(std::vector<ex>{m.qdot[rotor.coordinate]});
        const ex bias = motion.without_acceleration(rate)[0];
        std::vector<ex> along;
        for (const GiNaC::symbol& u : motion.kinematics().u) along.push_back(z.push_forward(rate, {{u, 1}})[0]);
        for (int r = 0; r < n; ++r) {
            for (int s = 0; s <= r; ++s) mass[r * n + s].push_back(rotor.inertia * along[r] * along[s]);
            inertia[r].push_back(-rotor.inertia * bias * along[r]);
        }
    }

    KaneForces result{.u = motion.kinematics().u,
                      .udot = motion.kinematics().udot,
                      .M = GiNaC::matrix(n, n),
                      .inertia = {},
                      .conservative = {},
                      .dissipative = {},
                      .applied = {}};
    result.dissipative = motion.loads(true);
    result.applied = motion.loads(false);
    result.conservative = motion.conservative();
    for (int r = 0; r < n; ++r) {
        for (int s = 0; s <= r; ++s)
            result.M(r, s) = result.M(s, r) =
                motion.without_false_poles(z.name(GiNaC::add(GiNaC::exvector(mass[r * n + s]))));
        result.inertia.push_back(motion.without_false_poles(GiNaC::add(GiNaC::exvector(inertia[r]))));
    }
    return result;
}

/// The constraint forces along each coordinate: M q'' − f, with all rates as speeds.
std::vector<ex> reaction_along_coordinates(const Mechanism& m) {
    const KaneForces all = forces_of(InSpeeds(m, rates_as_speeds(m)), m);
    std::vector<ex> reaction;
    for (int i = 0; i < m.size(); ++i) {
        GiNaC::exvector terms{-all.inertia[i], -all.conservative[i], -all.dissipative[i], -all.applied[i]};
        for (int j = 0; j < m.size(); ++j) terms.push_back(all.M(i, j) * m.qddot[j]);
        reaction.push_back(m.z->name(GiNaC::add(std::move(terms))));
    }
    return reaction;
}

constexpr const char* kane_title = to_say("Kane's equations");

}  // namespace

std::optional<std::string> obstacle_to_kane(const Mechanism& m) {
    return kinematics_of_masses(with_own_intermediates(m), translated(kane_title)).obstacle();
}

PartialVelocities partial_velocities(const Mechanism& m) {
    return partials(InSpeeds(m, kinematics(m).value()), m);
}

KaneForces kane_forces(const Mechanism& m) {
    return forces_of(InSpeeds(m, kinematics(m).value()), m);
}

Equations kane(const Mechanism& mechanism) {
    const Mechanism m = with_own_intermediates(mechanism);
    const InSpeeds motion(m, kinematics_of_masses(m, translated(kane_title)).value());
    const KaneForces forces = forces_of(motion, m);
    Equations equations = motion.begin("kane");
    equations.M = forces.M;
    equations.dissipative = forces.dissipative;
    equations.applied = forces.applied;
    for (int r = 0; r < equations.size(); ++r)
        equations.own.push_back(m.z->name(forces.inertia[r] + forces.conservative[r]));
    motion.attach_kept(equations);
    if (!equations.eliminated.empty()) recover_multipliers(m, equations, reaction_along_coordinates(m));
    return equations;
}

OwnSteps steps_of_kane(const Mechanism& m, const Equations& e) {
    const StepWriter write(m);
    OwnSteps result;
    for (const PartialVelocities::Of& body : partial_velocities(m).bodies) {
        Section section{.words = say("Partial velocities of {}:", body.label)};
        for (int r = 0; r < e.size(); ++r)
            for (int k = 0; k < 3; ++k) {
                write.partial(section, std::string("v_") + "xyz"[k], e.u[r], body.velocity[r][k]);
                if (!body.angular.empty())
                    write.partial(section, std::string("omega_") + "xyz"[k], e.u[r], body.angular[r][k]);
            }
        result.sections.push_back(std::move(section));
    }
    const KaneForces forces = kane_forces(m);
    Section section{.words = say("Generalized active forces F and inertia forces F*, F + F* = 0:")};
    if (!e.A.empty())
        section.words = say("Generalized active forces F and inertia forces F*, F + F* + A^T lambda = 0:");
    for (int r = 0; r < e.size(); ++r) {
        const GiNaC::symbol& of = e.speeds_are_rates() ? m.q[r] : e.u[r];
        GiNaC::exvector inertia{forces.inertia[r]};
        for (int s = 0; s < e.size(); ++s) inertia.push_back(-forces.M(r, s) * e.udot[s]);
        write.force(section, "F", of, forces.conservative[r] + forces.dissipative[r] + forces.applied[r]);
        write.force(section, "F*", of, GiNaC::add(std::move(inertia)));
    }
    result.sections.push_back(std::move(section));
    return result;
}

}  // namespace alembert
