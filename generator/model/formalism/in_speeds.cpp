// SPDX-License-Identifier: GPL-2.0-or-later
#include "model/formalism/in_speeds.hpp"

#include "base/language/say.hpp"
#include "model/formalism/cancel.hpp"

namespace alembert {

using GiNaC::ex;

InSpeeds::InSpeeds(const Mechanism& mechanism, Kinematics kinematics) : m_(mechanism), k_(std::move(kinematics)) {
    for (std::size_t i = 0; i < k_.h.size(); ++i)
        if (!k_.h[i].is_equal(m_.qdot[i])) by_[m_.qdot[i]] = k_.h[i];
}

std::vector<ex> InSpeeds::in_speeds(const std::vector<ex>& values) const {
    return by_.empty() ? values : substitute(*m_.z, values, by_);
}

std::vector<ex> InSpeeds::short_in_speeds(const std::vector<ex>& values) const {
    std::vector<ex> result = in_speeds(values);
    for (ex& value : result) value = by_.empty() ? value : shortened(value);
    return result;
}

Vector3 InSpeeds::short_in_speeds(const Vector3& v) const {
    const std::vector<ex> values = short_in_speeds(std::vector<ex>(v.begin(), v.end()));
    return {values[0], values[1], values[2]};
}

ex InSpeeds::shortened(const ex& value) const {
    // For larger values the search for a short form costs more than it saves.
    if (m_.z->tree_size(value) > 400) return value;
    return k_.poles.empty() ? short_form(value, m_) : cancelled(short_form(value, m_), m_);
}

std::vector<ex> InSpeeds::without_acceleration(const std::vector<ex>& values) const {
    if (speeds_are_rates(k_.u, k_.form, k_.h)) return m_.time_derivative_without_acceleration(values);
    std::vector<ex> parts = m_.explicit_time_derivative(values);
    Intermediates::Direction along;
    for (int i = 0; i < m_.size(); ++i) along.emplace_back(m_.q[i], k_.h[i]);
    const std::vector<ex> convected = m_.z->push_forward(values, along);
    for (std::size_t i = 0; i < parts.size(); ++i) parts[i] = m_.z->name(parts[i] + convected[i]);
    return parts;
}

Vector3 InSpeeds::without_acceleration(const Vector3& v) const {
    std::vector<ex> a = without_acceleration(std::vector<ex>{v[0], v[1], v[2]});
    for (ex& component : a) component = k_.poles.empty() ? component : shortened(component);
    return {a[0], a[1], a[2]};
}

std::vector<ex> InSpeeds::derivative(const std::vector<ex>& values) const {
    std::vector<ex> result = without_acceleration(values);
    Intermediates::Direction along;
    for (std::size_t k = 0; k < k_.u.size(); ++k) along.emplace_back(k_.u[k], k_.udot[k]);
    const std::vector<ex> accelerated = m_.z->push_forward(values, along);
    for (std::size_t i = 0; i < result.size(); ++i) result[i] = m_.z->name(result[i] + accelerated[i]);
    return result;
}

std::vector<ex> InSpeeds::generalized(const std::vector<ex>& velocities, const std::vector<ex>& forces) const {
    const std::vector<ex> v = short_in_speeds(velocities), F = short_in_speeds(forces);
    std::vector<std::pair<ex, ex>> pairs;
    for (std::size_t i = 0; i < v.size(); ++i) pairs.emplace_back(v[i], F[i]);
    return m_.z->pull_back(pairs, k_.u);
}

std::vector<ex> InSpeeds::conservative() const {
    std::vector<ex> places, forces;
    for (const PlacedForce& force : conservative_forces(m_)) {
        places.push_back(force.place);
        forces.push_back(force.force);
    }
    return generalized(m_.time_derivative(places), forces);
}

std::vector<ex> InSpeeds::loads(bool dissipative) const {
    std::vector<ex> velocities, forces;
    for (const Load& load : m_.loads)
        if (load.dissipative == dissipative)
            for (const Load::Pair& pair : load.pairs) {
                velocities.push_back(pair.velocity);
                forces.push_back(pair.force);
            }
    return generalized(velocities, forces);
}

ex InSpeeds::without_false_poles(const ex& e) const {
    return k_.poles.empty() ? e : cancelled(m_.z->name(e), m_);
}

Equations InSpeeds::begin(const std::string& formalism) const {
    Equations equations = equations_without_terms(formalism, m_);
    const auto n = static_cast<unsigned>(k_.u.size());
    equations.u = k_.u;
    equations.udot = k_.udot;
    equations.M = GiNaC::matrix(n, n);
    equations.h = k_.h;
    equations.form = k_.form;
    equations.poles = k_.poles;
    for (const int c : k_.eliminated) equations.eliminated.push_back({c, 0});
    return equations;
}

void InSpeeds::attach_kept(Equations& equations) const {
    if (equations.speeds_are_rates()) return attach_constraints(m_, equations);
    for (const int c : equations.kept(m_)) {
        const Mechanism::Constraint& constraint = m_.constraints[c];
        SourceScope source(*m_.z, "constraint " + constraint.name);
        GiNaC::exvector terms{constraint.offset};
        for (int i = 0; i < m_.size(); ++i) terms.push_back(constraint.row[i] * equations.h[i]);
        const ex velocity = m_.z->name(GiNaC::add(std::move(terms)));
        std::vector<ex> row;
        for (const GiNaC::symbol& u : equations.u) row.push_back(m_.z->push_forward({velocity}, {{u, 1}})[0]);
        equations.A.push_back(std::move(row));
        equations.gamma.push_back(m_.z->name(-without_acceleration(std::vector<ex>{velocity})[0]));
        equations.lambda.push_back(constraint.multiplier);
    }
}

void recover_multipliers(const Mechanism& m, Equations& equations, const std::vector<ex>& reaction) {
    Intermediates& z = *m.z;
    std::vector<ex> left;
    for (int i = 0; i < m.size(); ++i) {
        GiNaC::exvector terms{reaction[i]};
        for (const int c : equations.kept(m))
            terms.push_back(-m.constraints[c].row[i] * m.constraints[c].multiplier);
        left.push_back(z.name(GiNaC::add(std::move(terms))));
    }
    const auto count = static_cast<unsigned>(equations.eliminated.size());
    const auto row = [&](unsigned e) -> const std::vector<ex>& {
        return m.constraints[equations.eliminated[e].constraint].row;
    };
    GiNaC::matrix S(count, count), right(count, 1);
    for (unsigned e = 0; e < count; ++e) {
        GiNaC::exvector along;
        for (int i = 0; i < m.size(); ++i) along.push_back(row(e)[i] * left[i]);
        right(e, 0) = z.name(GiNaC::add(std::move(along)));
        for (unsigned f = 0; f < count; ++f) {
            GiNaC::exvector terms;
            for (int i = 0; i < m.size(); ++i) terms.push_back(row(e)[i] * row(f)[i]);
            S(e, f) = z.name(GiNaC::add(std::move(terms)));
        }
    }
    const GiNaC::matrix x = solve_exactly(S, right, m, say("the constraints depend on each other")).value().x;
    for (unsigned e = 0; e < count; ++e) equations.eliminated[e].multiplier = x(e, 0);
}

}  // namespace alembert
