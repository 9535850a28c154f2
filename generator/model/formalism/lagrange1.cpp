// SPDX-License-Identifier: GPL-2.0-or-later
// m r̈ = F + Σ λ ∂f/∂r (Zhang & Qin (1-82)): M is diagonal, and only the forces depend on the rates.
#include "model/formalism/lagrange1.hpp"

#include <fmt/format.h>

#include "algebra/notation/readable.hpp"
#include "algebra/notation/text.hpp"
#include "base/language/say.hpp"
#include "model/formalism/elements.hpp"

namespace alembert {

using GiNaC::ex;

namespace {

std::string text_of(const ex& e, const Mechanism& m) {
    if (m.z->tree_size(e) > 300) return "…";
    const auto f = fourier(m.z->expand(e), *m.symbols, 20);
    return f ? text(readable(*f)) : "…";
}

/// The coordinate that `place` is, up to a constant; −1 if it does not move. Nothing if it is neither.
std::optional<int> coordinate_of(const ex& place, const Mechanism& m) {
    if (!m.z->depends(place, m.moving())) return -1;
    const ex plain = m.z->expand(place);
    for (int i = 0; i < m.size(); ++i)
        if (!m.z->depends((plain - m.q[i]).expand(), m.moving())) return i;
    return std::nullopt;
}

std::string advice(const MassElement& particle, const Mechanism& m) {
    std::string position;
    const bool planar = particle.position[2].is_zero();
    for (int k = 0; k < (planar ? 2 : 3); ++k) position += (k == 0 ? "" : ", ") + text_of(particle.position[k], m);
    return say(
        "Lagrange's equations of the first kind want Cartesian coordinates: {} is at ({}); give it coordinates "
        "{} and put what ties them into a [[constraint]]",
        shown_label(particle.origin), position, planar ? "x, y" : "x, y, z");
}

/// The particle to which each coordinate belongs.
Possible<std::vector<const MassElement*>> owners(const Mechanism& m) {
    if (const auto unknown = masses_unknown(m, say("Lagrange's equations of the first kind")))
        return Obstacle{*unknown};
    std::vector<const MassElement*> owner(m.q.size(), nullptr);
    for (const MassElement& particle : m.masses) {
        const auto turns = [](const Vector3& w) { return !w[0].is_zero() || !w[1].is_zero() || !w[2].is_zero(); };
        if (particle.rotation && turns(particle.rotation->w_NB_B))
            return Obstacle{
                say("Lagrange's equations of the first kind know particles only, and {} turns; "
                    "use the formalism 'routh'",
                    shown_label(particle.origin))};
        for (const ex& component : particle.position) {
            const std::optional<int> i = coordinate_of(component, m);
            if (!i) return Obstacle{advice(particle, m)};
            if (*i < 0) continue;
            if (owner[*i] != nullptr)
                return Obstacle{
                    say("Lagrange's equations of the first kind want coordinates of their own for each "
                        "particle: '{}' belongs to {} and to {}",
                        m.q[*i].get_name(), shown_label(owner[*i]->origin), shown_label(particle.origin))};
            owner[*i] = &particle;
        }
    }
    for (int i = 0; i < m.size(); ++i)
        if (owner[i] == nullptr)
            return Obstacle{
                say("Lagrange's equations of the first kind want Cartesian coordinates of particles, and '{}' "
                    "is none; leave it out, with a [[constraint]] in its place",
                    m.q[i].get_name())};
    return owner;
}

}  // namespace

std::optional<std::string> obstacle_to_lagrange1(const Mechanism& m) {
    return owners(m).obstacle();
}

Equations lagrange1(const Mechanism& mechanism) {
    const Mechanism m = with_own_intermediates(mechanism);
    const std::vector<const MassElement*> owner = owners(m).value();
    Equations equations = equations_without_terms("lagrange1", m);
    for (int i = 0; i < m.size(); ++i) equations.M(i, i) = owner[i]->mass;
    for (const Rotor& rotor : m.rotors) equations.M(rotor.coordinate, rotor.coordinate) += rotor.inertia;

    // In these coordinates the generalized force of a force is the force itself; a force along an expression acts
    // along the gradient of that expression.
    std::vector<GiNaC::exvector> own(m.q.size());
    for (int i = 0; i < m.size(); ++i)  // of a mass that changes, (m x')' = m x'' + m' x'
        if (!owner[i]->mass_rate.is_zero()) own[i].push_back(-owner[i]->mass_rate * m.qdot[i]);
    for (const PlacedForce& force : conservative_forces(m)) {
        const std::optional<int> i = coordinate_of(force.place, m);
        if (i && *i < 0) continue;
        if (i) {
            own[*i].push_back(force.force);
            continue;
        }
        const std::vector<ex> gradient = m.z->pull_back({{force.place, force.force}}, m.q);
        for (int k = 0; k < m.size(); ++k) own[k].push_back(gradient[k]);
    }
    equations.dissipative = m.generalized_forces(true);
    equations.applied = m.generalized_forces(false);
    for (GiNaC::exvector& terms : own) equations.own.push_back(m.z->name(GiNaC::add(std::move(terms))));
    attach_constraints(m, equations);
    return equations;
}

OwnSteps steps_of_lagrange1(const Mechanism& m, const Equations& e) {
    const StepWriter write(m);
    Section section{
        .words = say("Newton's law for each Cartesian coordinate, m x'' = F + A^T lambda, with the forces:")};
    for (int i = 0; i < m.size(); ++i)
        if (const auto f = write.normal(e.forcing(i)))
            section.statements.push_back({Statement::Kind::force, "F", "", write.symbol_of(m.q[i]), readable(*f)});
    return {.sections = {std::move(section)}};
}

}  // namespace alembert
