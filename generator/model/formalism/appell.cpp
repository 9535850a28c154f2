// SPDX-License-Identifier: GPL-2.0-or-later
// S = Σ ½ m a·a + ½ α·I α + α·(ω × I ω), ∂S/∂u̇_r = Q_r (Pars, A Treatise on Analytical Dynamics (1965)). I is the
// central inertia, α and ω are along the body's axes, in which I is constant: α is the derivative of the
// components of ω. Terms of S without accelerations are left out, because their derivatives are zero. ∂S/∂u̇ is
// linear in u̇:
//   M = ∂²S/∂u̇²,   own = Q − ∂S/∂u̇ at u̇ = 0.
#include "model/formalism/appell.hpp"

#include "base/language/say.hpp"
#include "model/formalism/in_speeds.hpp"
#include "model/formalism/newton_euler.hpp"
#include "model/geometry.hpp"

namespace alembert {

using GiNaC::ex;

namespace {

constexpr const char* appell_title = to_say("The Gibbs-Appell equations");

/// S of all bodies as a function of q, u, u', t.
ex acceleration_energy(const Mechanism& m, const InSpeeds& motion) {
    Intermediates& z = *m.z;
    const auto derivative = [&](const Vector3& v) {
        const std::vector<ex> a = motion.derivative({v[0], v[1], v[2]});
        return Vector3{a[0], a[1], a[2]};
    };
    GiNaC::exvector S;
    for (const MassElement& body : m.masses) {
        SourceScope source(z, label(body.origin));
        const Vector3 a = derivative(motion.short_in_speeds(body.velocity));
        S.push_back(z.name(body.mass * dot(a, a, z) / 2));
        if (!body.mass_rate.is_zero())
            S.push_back(z.name(body.mass_rate * dot(motion.short_in_speeds(body.velocity), a, z)));
        if (!body.rotation) continue;
        const std::array<ex, 6> I = central_inertia(body, z);
        const Vector3 w = motion.short_in_speeds(body.rotation->w_NB_B), alpha = derivative(w);
        const Vector3 gyroscopic = cross(w, inertia_times(I, w, z), z);
        S.push_back(z.name(dot(alpha, inertia_times(I, alpha, z), z) / 2 + dot(alpha, gyroscopic, z)));
    }
    for (const Rotor& rotor : m.rotors) {
        const ex a = motion.derivative(motion.short_in_speeds(std::vector<ex>{m.qdot[rotor.coordinate]}))[0];
        S.push_back(z.name(rotor.inertia * a * a / 2));
    }
    return z.name(GiNaC::add(std::move(S)));
}

std::vector<ex> without_accelerations(const std::vector<ex>& values, const std::vector<GiNaC::symbol>& udot,
                                      Intermediates& z) {
    GiNaC::exmap still;
    for (const GiNaC::symbol& a : udot) still[a] = 0;
    return substitute(z, values, still);
}

}  // namespace

std::optional<std::string> obstacle_to_appell(const Mechanism& m) {
    return kinematics_of_masses(with_own_intermediates(m), translated(appell_title)).obstacle();
}

Equations appell(const Mechanism& mechanism) {
    const Mechanism m = with_own_intermediates(mechanism);
    Intermediates& z = *m.z;
    const InSpeeds motion(m, kinematics_of_masses(m, translated(appell_title)).value());
    Equations equations = motion.begin("appell");
    const std::vector<ex> slope = z.pull_back({{acceleration_energy(m, motion), 1}}, equations.udot);
    const std::vector<ex> rest = without_accelerations(slope, equations.udot, z),
                          conservative = motion.conservative();
    equations.dissipative = motion.loads(true);
    equations.applied = motion.loads(false);
    for (int r = 0; r < equations.size(); ++r) {
        const std::vector<ex> column = z.push_forward(slope, {{equations.udot[r], 1}});
        for (int s = 0; s < equations.size(); ++s) equations.M(s, r) = motion.without_false_poles(column[s]);
        equations.own.push_back(z.name(conservative[r] - motion.without_false_poles(rest[r])));
    }
    motion.attach_kept(equations);
    if (equations.eliminated.empty()) return equations;

    // With all rates as speeds, the constraint forces are the difference between ∂S/∂q̈ and the other forces.
    const InSpeeds in_rates(m, rates_as_speeds(m));
    const std::vector<ex> inertia = z.pull_back({{acceleration_energy(m, in_rates), 1}}, m.qddot);
    const std::vector<ex> active = in_rates.conservative(), damping = in_rates.loads(true),
                          applied = in_rates.loads(false);
    std::vector<ex> reaction;
    for (int i = 0; i < m.size(); ++i)
        reaction.push_back(z.name(inertia[i] - active[i] - damping[i] - applied[i]));
    recover_multipliers(m, equations, reaction);
    return equations;
}

OwnSteps steps_of_appell(const Mechanism& m, const Equations& e) {
    const StepWriter write(m);
    const InSpeeds motion(m, kinematics_of_masses(m, translated(appell_title)).value());
    const ex S = acceleration_energy(m, motion), still = without_accelerations({S}, e.udot, *m.z)[0];
    Section energy{
        .words = say(
            "The energy of the accelerations, S = sum of m a^2/2 + alpha.I alpha/2 + alpha.(w x I w), without the "
            "terms that hold no acceleration:")};
    write.equality(energy, StepWriter::letter("S"), S - still);
    Section forces{.words = e.A.empty()
                                ? say("Its derivatives, and the generalized forces Q, dS/du' = Q:")
                                : say("Its derivatives, and the generalized forces Q, dS/du' = Q + A^T lambda:")};
    const std::vector<ex> slope = m.z->pull_back({{S, 1}}, e.udot), conservative = motion.conservative();
    for (int r = 0; r < e.size(); ++r) {
        write.partial(forces, "S", e.udot[r], slope[r]);
        write.force(forces, "Q", e.u[r], conservative[r] + e.dissipative[r] + e.applied[r]);
    }
    return {.sections = {std::move(energy), std::move(forces)}};
}

}  // namespace alembert
