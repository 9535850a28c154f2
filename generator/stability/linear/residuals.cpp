// SPDX-License-Identifier: GPL-2.0-or-later
// The equations of motion as residuals of one program, and its state with a derivative for each variable.
#include <algorithm>

#include "model/formalism/with_states.hpp"
#include "program/lower/lower.hpp"
#include "stability/linear/tangent.hpp"

namespace alembert {

using GiNaC::ex;

Residuals::Residuals(const Mechanism& m, const Equations& e, const std::vector<bool>& at_rest)
    : n(m.size()),
      s(e.size()),
      holonomic(0),
      kept(static_cast<int>(e.A.size())),
      states(has_states(e, m) ? static_cast<int>(m.states.size()) : 0),
      rates_are_speeds(e.speeds_are_rates()) {
    Program all;
    all.source_labels = m.z->source_labels();
    std::vector<std::pair<GiNaC::symbol, int>> given;
    for (std::size_t i = 0; i < m.inputs.size(); ++i)
        for (int order = 0; order < 3; ++order)
            given.emplace_back(m.inputs[i].derivative[order],
                               all.variable({Variable::Kind::unknown, 3 * static_cast<int>(i) + order}));
    std::vector<std::pair<Group, ex>> inertia, forces, motion;
    for (int i = 0; i < s; ++i) {
        for (int j = 0; j <= i; ++j) inertia.emplace_back(Group::mass, e.M(i, j));
        forces.emplace_back(Group::forcing, e.forcing(i));
    }
    for (int k = 0; k < kept; ++k) {
        for (const ex& entry : e.A[k]) forces.emplace_back(Group::row, entry);
        forces.emplace_back(Group::gamma, e.gamma[k]);
    }
    const auto rate_of = [&](int i) { return e.h[i]; };
    for (int i = 0; i < n; ++i) motion.emplace_back(Group::rate, rate_of(i));
    for (const Mechanism::Constraint& c : m.constraints)
        if (c.position) {
            motion.emplace_back(Group::position, *c.position);
            ++holonomic;
        }
    for (const int k : e.kept(m)) {
        const Mechanism::Constraint& c = m.constraints[k];
        GiNaC::exvector terms{c.offset};
        for (int i = 0; i < n; ++i) terms.push_back(c.row[i] * rate_of(i));
        motion.emplace_back(Group::velocity, m.z->name(GiNaC::add(std::move(terms))));
    }
    const auto add = [&](const std::vector<std::pair<Group, ex>>& roots, const std::vector<bool>& is_zero) {
        std::vector<std::pair<GiNaC::symbol, int>> known = given;
        for (int i = 0; i < s; ++i)
            known.emplace_back(e.u[i], !is_zero.empty() && is_zero[static_cast<std::size_t>(i)]
                                           ? all.number(0)
                                           : all.variable({Variable::Kind::rate, i}));
        std::vector<ex> values;
        for (const auto& [group, value] : roots) values.push_back(value);
        const std::vector<int> nodes = lower_expressions(all, m, values, known);
        for (std::size_t i = 0; i < nodes.size(); ++i) all.roots.push_back({roots[i].first, "", nodes[i]});
    };
    add(forces, at_rest);
    add(motion, {});
    steady_needs_mass = std::any_of(all.roots.begin(), all.roots.end(), [&](const Root& root) {
        return root.group == Group::gamma && !(all[root.node].is_number() && cln::zerop(all[root.node].number));
    });
    if (at_rest.empty() || steady_needs_mass) add(inertia, at_rest);
    std::vector<ex> input_symbols;
    for (const Mechanism::Input& input : m.inputs)
        input_symbols.insert(input_symbols.end(), input.derivative.begin(), input.derivative.end());
    for (const int id : lower_expressions(all, m, input_symbols)) all.roots.push_back({Group::input, "", id});
    program = all.canonical();
    for (int id = 0; id < program.size(); ++id)
        if (program[id].op == Op::variable && program[id].variable.kind == Variable::Kind::unknown)
            inputs.push_back(program[id].variable.index);
    std::sort(inputs.begin(), inputs.end());
    for (const auto& [group, list] : {std::pair{Group::mass, &mass},
                                      {Group::forcing, &forcing},
                                      {Group::row, &row},
                                      {Group::gamma, &gamma},
                                      {Group::rate, &rate},
                                      {Group::position, &position},
                                      {Group::velocity, &velocity},
                                      {Group::input, &input_values}})
        *list = program.nodes_of(group);
    geometry = position;
    geometry.insert(geometry.end(), velocity.begin(), velocity.end());
    geometry = program.needed(geometry);
    steady = position;
    for (const std::vector<int>* list : {&velocity, &forcing, &row, &gamma, &rate})
        steady.insert(steady.end(), list->begin(), list->end());
    if (steady_needs_mass) steady.insert(steady.end(), mass.begin(), mass.end());
    steady = program.needed(steady);
}

template <typename Real>
Varied<Real>::Varied(const Residuals& r, const Instant<Real>& at, std::size_t unknowns) {
    for (const Real x : at.parameters) state.parameters.push_back(Jet<Real>(x));
    for (const Real x : at.q) state.q.push_back(next(x));
    for (const Real x : at.u) state.qdot.push_back(next(x));
    state.t = next(at.t);
    state.unknown.resize(unknowns);
    for (std::size_t k = 0; k < r.inputs.size(); ++k)
        state.unknown[static_cast<std::size_t>(r.inputs[k])] = next(at.inputs[k]);
}

template <typename Real>
Jet<Real> Varied<Real>::next(Real value) {
    std::vector<Real> d(++next_, Real(0));  // derivatives by later variables are zero
    d.back() = Real(1);
    return Jet<Real>(value, std::move(d));
}

template struct Varied<double>;
template struct Varied<long double>;

}  // namespace alembert
