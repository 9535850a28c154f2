// SPDX-License-Identifier: GPL-2.0-or-later
#include "model/formulas.hpp"

#include <set>

namespace alembert {

Formulas::Formulas(const Scene& scene, const Mechanism& m, std::shared_ptr<RootSheets> sheets)
    : translator_(m, {.position = [this](const std::string& p) { return places_.position(p); },
                      .velocity = [this](const std::string& p) { return places_.velocity(p); },
                      .orientation = [this](const std::string& f) -> const Orientation& {
                          return places_.orientation(f);
                      }}),
      places_(scene, m, translator_),
      letters_(m, translator_, places_) {
    translator_.go_on(std::move(sheets));
    know("t", m.t);
    for (const Mechanism::Parameter& p : m.parameters) know(p.symbol.get_name(), p.symbol);
    for (const Mechanism::Input& input : m.inputs) know(input.derivative[0].get_name(), input.derivative[0]);
    for (const Mechanism::State& state : m.states) {
        know(state.derivative[0].get_name(), state.derivative[0]);
        has_no_derivative(state.derivative[2]);
    }
    for (const GiNaC::symbol& function : m.symbols->functions()) translator_.know_function(function);
    std::set<std::string> numbers;
    for (const Mechanism::Definition& d : m.definitions) {
        numbers.insert(d.name);
        know(d.name, d.value);
    }
    for (const Definition& d : scene.definitions)
        if (!numbers.contains(d.name.text))  // a vector
            translator_.know_later(d.name.text, [this, &d] { return translator_.value(d.value); });
    for (const Mechanism::Speed& s : m.speeds) know(s.u.get_name(), s.form);
    for (const GiNaC::symbol& acceleration : m.qddot) has_no_derivative(acceleration);
    for (const Mechanism::Input& input : m.inputs) has_no_derivative(input.derivative[2]);
    std::vector<const Mechanism::Constraint*> held = m.undetermined();
    for (const Mechanism::Constraint& c : m.constraints) held.push_back(&c);
    for (const Mechanism::Constraint* c : held) {
        has_no_derivative(c->multiplier);
        know(c->multiplier.get_name(), c->multiplier);
    }
    for (const std::string& name : m.identities) know("lambda_" + name, 0);
    const std::vector<GiNaC::ex> p = m.z->pull_back({{m.lagrangian(), 1}}, m.qdot);
    for (int i = 0; i < m.size(); ++i) {
        const std::string name = "p_" + m.q[i].get_name();
        const auto taken = [&](const auto& list, const auto& name_of) {
            for (const auto& item : list)
                if (name_of(item) == name) return true;
            return false;
        };
        // The scene may use a name of this form itself.
        if (!taken(m.parameters, [](const auto& item) { return item.symbol.get_name(); }) &&
            !taken(m.inputs, [](const auto& item) { return item.derivative[0].get_name(); }) &&
            !taken(m.definitions, [](const auto& item) { return item.name; }))
            know(name, p[i]);
    }
    letters_.teach();
}

}  // namespace alembert
