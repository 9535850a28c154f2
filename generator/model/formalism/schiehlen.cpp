// SPDX-License-Identifier: GPL-2.0-or-later
// With S = (e₁ e₂ e₃), the body's axes along N, the columns of J_R and the rest of ω follow from S only:
//   (Sᵀ ∂S/∂q_j)  =  ũ_j,   u_j = (e₃·∂e₂/∂q_j,  e₁·∂e₃/∂q_j,  e₂·∂e₁/∂q_j),
// and in the same way with ∂/∂t; then ω = Σ u_j q'_j + u_t, ᾱ = dω/dt at q'' = 0 (along the body's axes, where ω ×
// ω = 0), and
//   J_T = ∂r/∂q,   v = J_T q' + ∂r/∂t,   ā = dv/dt at q'' = 0
// (Schiehlen, Technische Dynamik (1986), §2.3 and §4.1).
#include "model/formalism/schiehlen.hpp"

#include "base/language/say.hpp"
#include "model/formalism/elements.hpp"
#include "model/geometry.hpp"

namespace alembert {

using GiNaC::ex;

namespace {

/// The positions of all bodies, then their axes, as one list to be differentiated.
std::vector<ex> places_of(const Mechanism& m) {
    std::vector<ex> places;
    for (const MassElement& body : m.masses) {
        places.insert(places.end(), body.position.begin(), body.position.end());
        for (int k = 0; body.rotation && k < 3; ++k)
            places.insert(places.end(), body.rotation->axes[k].begin(), body.rotation->axes[k].end());
    }
    return places;
}

Vector3 next(std::vector<ex>::const_iterator& at) {
    const Vector3 v{at[0], at[1], at[2]};
    at += 3;
    return v;
}

/// Replaces cos² + sin² by 1; for larger expressions the search costs more than it saves.
ex tidy(const ex& e, const Mechanism& m) {
    return m.z->tree_size(e) > 400 ? e : short_form(e, m);
}

/// J_T and J_R, or v and ω, from the derivatives of all places by one variable.
struct Moved {
    Vector3 centre, turn{0, 0, 0};
};
std::vector<Moved> moved(const Mechanism& m, const std::vector<ex>& derivatives) {
    Intermediates& z = *m.z;
    std::vector<Moved> result;
    std::vector<ex>::const_iterator at = derivatives.begin();
    for (const MassElement& body : m.masses) {
        result.push_back({.centre = next(at)});
        if (!body.rotation) continue;
        const std::array<Vector3, 3>& e = body.rotation->axes;
        const Vector3 first = next(at), second = next(at), third = next(at);
        result.back().turn = {tidy(dot(e[2], second, z), m), tidy(dot(e[0], third, z), m),
                              tidy(dot(e[1], first, z), m)};
    }
    return result;
}

/// Σ J_j q'_j + rest
Vector3 with_rates(const std::vector<Vector3>& J, const Vector3& rest, const Mechanism& m) {
    Vector3 result;
    for (int k = 0; k < 3; ++k) {
        GiNaC::exvector terms{rest[k]};
        for (int j = 0; j < m.size(); ++j) terms.push_back(J[j][k] * m.qdot[j]);
        result[k] = m.z->name(GiNaC::add(std::move(terms)));
    }
    return result;
}

}  // namespace

std::vector<BodyMotion> global_motions(const Mechanism& m) {
    const std::vector<ex> places = places_of(m);
    std::vector<BodyMotion> result(m.masses.size());
    for (int j = 0; j < m.size(); ++j) {
        const std::vector<Moved> columns = moved(m, m.z->push_forward(places, {{m.q[j], 1}}));
        for (std::size_t b = 0; b < columns.size(); ++b) {
            result[b].J_T.push_back(columns[b].centre);
            result[b].J_R.push_back(columns[b].turn);
        }
    }
    const std::vector<Moved> by_time = moved(m, m.explicit_time_derivative(places));
    std::vector<ex> velocities;
    for (std::size_t b = 0; b < result.size(); ++b) {
        const Vector3 v = with_rates(result[b].J_T, by_time[b].centre, m);
        result[b].w = with_rates(result[b].J_R, by_time[b].turn, m);
        velocities.insert(velocities.end(), v.begin(), v.end());
        velocities.insert(velocities.end(), result[b].w.begin(), result[b].w.end());
    }
    const std::vector<ex> rest = m.time_derivative_without_acceleration(velocities);
    std::vector<ex>::const_iterator at = rest.begin();
    for (BodyMotion& body : result) {
        body.a_bar = next(at);
        body.alpha_bar = next(at);
    }
    return result;
}

std::optional<std::string> obstacle_to_schiehlen(const Mechanism& m) {
    return masses_unknown(m, say("Schiehlen's equations"));
}

Equations schiehlen(const Mechanism& mechanism) {
    const Mechanism m = with_own_intermediates(mechanism);
    need_none(obstacle_to_schiehlen(m));
    return projected("schiehlen", m, global_motions(m));
}

OwnSteps steps_of_schiehlen(const Mechanism& m, const Equations&) {
    const StepWriter write(m);
    const std::vector<BodyMotion> motions = global_motions(m);
    OwnSteps result;
    for (std::size_t b = 0; b < motions.size(); ++b) {
        Section section{.words = say("Global Jacobians of {}, J_T = dr/dq along N and J_R = dw/dq' along its "
                                     "axes, and the accelerations at "
                                     "q'' = 0:",
                                     shown_label(m.masses[b].origin))};
        const auto add_rows = [&](const std::string& letter, const std::vector<GiNaC::symbol>& by,
                                  const std::vector<Vector3>& J) {
            for (int j = 0; j < m.size(); ++j)
                for (int k = 0; k < 3; ++k) write.partial(section, letter + "_" + "xyz"[k], by[j], J[j][k]);
        };
        add_rows("r", m.q, motions[b].J_T);
        if (m.masses[b].rotation) add_rows("omega", m.qdot, motions[b].J_R);
        for (int k = 0; k < 3; ++k)
            if (const auto f = write.normal(motions[b].a_bar[k]); f && f->size() > 0)
                section.statements.push_back(
                    {Statement::Kind::energy, std::string("a_") + "xyz"[k], "", {}, readable(*f)});
        result.sections.push_back(std::move(section));
    }
    return result;
}

}  // namespace alembert
