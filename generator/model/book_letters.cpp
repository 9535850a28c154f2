// SPDX-License-Identifier: GPL-2.0-or-later
// ∂H/∂q at constant p = −∂L/∂q at constant q', ∂H/∂p = q', ∂H/∂t = −∂L/∂t (Zhang & Qin, §1.7).
// With C the mass centre, d = C − P and I about C: u·I_P v = u·I v + m ((u·v) d² − (u·d)(v·d)).
#include "model/book_letters.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "base/language/say.hpp"
#include "model/energies.hpp"
#include "scene/book_letters.hpp"

namespace alembert {

using GiNaC::ex;

namespace {

/// The values of the parts of that name; nothing if there are none. The names that there are, are added to
/// `known`.
class Chosen {
public:
    explicit Chosen(std::string name) : name_(std::move(name)) {}

    bool has(const std::vector<std::string>& names) {
        for (const std::string& name : names)
            if (std::find(known_.begin(), known_.end(), name) == known_.end()) known_.push_back(name);
        const bool is_it = std::find(names.begin(), names.end(), name_) != names.end();
        any_ = any_ || is_it;
        return is_it;
    }
    void need(const std::string& letter, Place place) const {
        if (any_) return;
        throw SceneMistake{{place, known_.empty()
                                       ? say("{} has no parts here, and none of the name '{}'", letter, name_)
                                       : say("{} has no part of the name '{}'; there are {}", letter, name_,
                                             fmt::join(known_, ", "))}};
    }

private:
    std::string name_;
    std::vector<std::string> known_;
    bool any_ = false;
};

}  // namespace

void BookLetters::offer(const std::string& name, std::function<ex()> value) {
    if (translator_.knows(name)) return;
    translator_.offer(name, [this, value = std::move(value)]() -> Value { return m_.z->name(value()); });
}

void BookLetters::teach() {
    offer("T", [this] { return energies_of(m_).kinetic; });
    offer("V", [this] { return energies_of(m_).potential; });
    offer("L", [this] { return m_.lagrangian(); });
    offer("E", [this] {
        if (m_.given_lagrangian && m_.kinetic.empty()) return hamiltonian();
        return m_.kinetic_energy() + m_.potential_energy();
    });
    const bool has_own_H = translator_.knows("H");
    offer("H", [this] { return hamiltonian(); });
    offer("deltaW", [this] { return work(); });
    for (int i = 0; i < m_.size(); ++i) {
        const std::string& q = m_.q[i].get_name();
        offer("Q_" + q, [this, i] { return force(i); });
        offer("delta_" + q, [this, i] { return displacement(i); });
    }
    translator_.know_calls([this](const Tree& tree) { return call(tree); });
    if (!has_own_H)
        translator_.know_partials([this](const Tree& of, const Tree& by) -> std::optional<ex> {
            const bool is_H = of.kind == Tree::Kind::name && of.text == "H" && of.primes == 0;
            return is_H ? partial_of_hamiltonian(by) : std::nullopt;
        });
}

void BookLetters::read_forces_as_whole(bool whole) {
    if (whole_ == whole) return;
    whole_ = whole;
    const auto again = [&](const std::string& name, const std::function<ex()>& value) {
        if (!translator_.is_offered(name)) return;
        translator_.forget(name);
        offer(name, value);
    };
    again("deltaW", [this] { return work(); });
    for (int i = 0; i < m_.size(); ++i) again("Q_" + m_.q[i].get_name(), [this, i] { return force(i); });
}

ex BookLetters::force(int i) {
    ex result = m_.generalized_forces(false)[i] + m_.generalized_forces(true)[i];
    if (whole_ && !m_.potential.empty()) result -= m_.z->pull_back({{m_.potential_energy(), 1}}, {m_.q[i]})[0];
    return result;
}

ex BookLetters::displacement(int i) {
    const std::string name = "delta_" + m_.q[i].get_name();
    const GiNaC::symbol symbol = m_.symbols->declare(name, SymbolInfo::Kind::other, i);
    displacements_.emplace_back(i, symbol);
    translator_.has_no_derivative(symbol);
    return symbol;
}

ex BookLetters::work() {
    ex result = 0;
    for (int i = 0; i < m_.size(); ++i)
        result += force(i) * translator_.scalar_named("delta_" + m_.q[i].get_name());
    return result;
}

ex BookLetters::hamiltonian() {
    const ex L = m_.lagrangian();
    const std::vector<ex> p = m_.z->pull_back({{L, 1}}, m_.qdot);
    ex result = -L;
    for (int i = 0; i < m_.size(); ++i) result += p[i] * m_.qdot[i];
    return result;
}

std::optional<ex> BookLetters::partial_of_hamiltonian(const Tree& by) {
    if (by.kind != Tree::Kind::name || by.primes > 0) return std::nullopt;
    const ex L = m_.lagrangian();
    if (by.text == "t") return -m_.z->push_forward({L}, {{m_.t, 1}})[0];
    for (int i = 0; i < m_.size(); ++i) {
        if (by.text == m_.q[i].get_name()) return -m_.z->pull_back({{L, 1}}, {m_.q[i]})[0];
        if (by.text == "p_" + m_.q[i].get_name()) return m_.qdot[i];
    }
    return std::nullopt;
}

std::optional<Value> BookLetters::call(const Tree& tree) {
    if (tree.text == "T") return Value(energy_part(tree, m_.kinetic));
    if (tree.text == "V") return Value(energy_part(tree, m_.potential));
    if (tree.text == book_inertia) return Value(inertia(tree));
    for (int i = 0; i < m_.size(); ++i)
        if (tree.text == "Q_" + m_.q[i].get_name()) return Value(force_part(tree, i));
    return std::nullopt;
}

ex BookLetters::energy_part(const Tree& tree, const std::vector<Part>& parts) {
    Chosen chosen(tree.args.at(0)->text);
    GiNaC::exvector sum;
    for (const Part& part : parts)
        if (chosen.has(names_of(part.origin))) sum.push_back(part.value);
    chosen.need(tree.text, translator_.place_of(*tree.args[0]));
    return GiNaC::add(std::move(sum));
}

ex BookLetters::force_part(const Tree& tree, int i) {
    Chosen chosen(tree.args.at(0)->text);
    GiNaC::exvector sum;
    for (const Part& part : m_.potential)
        if (chosen.has(names_of(part.origin))) sum.push_back(m_.z->pull_back({{part.value, -1}}, {m_.q[i]})[0]);
    for (const Load& load : m_.loads) {
        if (!chosen.has(names_of(load.origin))) continue;
        std::vector<std::pair<ex, ex>> targets;
        for (const Load::Pair& pair : load.pairs) targets.emplace_back(pair.velocity, pair.force);
        sum.push_back(m_.z->pull_back(targets, {m_.qdot[i]})[0]);
    }
    std::vector<const Mechanism::Constraint*> constraints = m_.undetermined();
    for (const Mechanism::Constraint& c : m_.constraints) constraints.push_back(&c);
    for (const Mechanism::Constraint* c : constraints)
        if (chosen.has({c->name})) sum.push_back(c->row[i] * c->multiplier);
    chosen.need(tree.text, translator_.place_of(*tree.args[0]));
    return GiNaC::add(std::move(sum));
}

ex BookLetters::inertia(const Tree& tree) {
    Intermediates& z = *m_.z;
    const std::string& name = tree.args.at(0)->text;
    const auto is_it = [&](const MassElement& body) { return body.origin.name == name; };
    const auto body = std::find_if(m_.masses.begin(), m_.masses.end(), is_it);
    if (body == m_.masses.end())
        throw SceneMistake{{translator_.place_of(*tree.args[0]), say("'{}' is no particle and no body", name)}};
    const Vector3 P = places_.position(tree.args.at(1)->text);
    const auto vector = [&](std::size_t k) { return translator_.vector_of(*tree.args.at(k)); };
    const Vector3 u = tree.args.size() > 2 ? vector(2) : Vector3{0, 0, 1};
    const Vector3 v = tree.args.size() > 3 ? vector(3) : u;
    const auto steiner = [&](const Vector3& d) {
        return body->mass * (dot(u, v, z) * dot(d, d, z) - dot(u, d, z) * dot(v, d, z));
    };
    ex result = steiner(add(body->position, scale(-1, P, z), z));
    if (body->rotation) {
        const auto& [axes, w, I, about] = *body->rotation;
        Vector3 a, b;  // u and v along the body's axes
        for (int k = 0; k < 3; ++k) a[k] = dot(axes[k], u, z), b[k] = dot(axes[k], v, z);
        for (int k = 0; k < 3; ++k) {
            const int next = (k + 1) % 3;
            result += I[k] * a[k] * b[k] + I[3 + k] * (a[k] * b[next] + a[next] * b[k]);
        }
        if (about) result -= steiner(*about);
    }
    return tree.args.size() == 3 ? result / dot(u, u, z) : result;  // u need not be a unit vector
}

}  // namespace alembert
