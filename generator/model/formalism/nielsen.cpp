// SPDX-License-Identifier: GPL-2.0-or-later
// ∂L̇/∂q̇ − 2 ∂L/∂q = M q̈ − own: M is ∂/∂q̈ of the left-hand side, and own is its negative at q̈ = 0.
#include "model/formalism/nielsen.hpp"

#include "base/language/say.hpp"
#include "model/formalism/elements.hpp"

namespace alembert {

using GiNaC::ex;

namespace {

/// ∂L̇/∂q̇ and ∂L/∂q.
std::pair<std::vector<ex>, std::vector<ex>> slopes(const Mechanism& m) {
    const ex L = m.lagrangian();
    const std::vector<ex> rate = m.z->pull_back({{m.time_derivative({L})[0], 1}}, m.qdot);
    return {rate, m.z->pull_back({{L, 1}}, m.q)};
}

}  // namespace

std::optional<std::string> obstacle_to_nielsen(const Mechanism& m) {
    return no_coordinates(m, say("Nielsen's equations"));
}

Equations nielsen(const Mechanism& mechanism) {
    const Mechanism m = with_own_intermediates(mechanism);
    need_none(obstacle_to_nielsen(m));
    const int n = m.size();
    Intermediates& z = *m.z;
    const auto [rate, force] = slopes(m);
    std::vector<ex> left;
    for (int i = 0; i < n; ++i) left.push_back(z.name(rate[i] - 2 * force[i]));

    Equations equations = equations_without_terms("nielsen", m);
    equations.dissipative = m.generalized_forces(true);
    equations.applied = m.generalized_forces(false);
    GiNaC::exmap at_rest;
    for (int j = 0; j < n; ++j) {
        const std::vector<ex> column = z.push_forward(left, {{m.qddot[j], 1}});
        for (int i = 0; i < n; ++i) equations.M(i, j) = column[i];
        at_rest[m.qddot[j]] = 0;
    }
    const std::vector<ex> still = substitute(z, left, at_rest);
    equations.own.clear();
    for (int i = 0; i < n; ++i) equations.own.push_back(z.name(-still[i]));
    attach_constraints(m, equations);
    return equations;
}

OwnSteps steps_of_nielsen(const Mechanism& m, const Equations&) {
    const StepWriter write(m);
    const auto [rate, force] = slopes(m);
    Section section{
        .words = say(
            "With L' the time derivative of L along any motion, for Nielsen's equations dL'/dq' - 2 dL/dq = Q:")};
    write.equality(section, StepWriter::letter("L'"), m.time_derivative({m.lagrangian()})[0]);
    for (int i = 0; i < m.size(); ++i) {
        write.partial(section, "L'", m.qdot[i], rate[i]);
        write.partial(section, "L", m.q[i], force[i]);
    }
    return {.sections = {std::move(section)}};
}

}  // namespace alembert
