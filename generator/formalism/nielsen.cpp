// SPDX-License-Identifier: GPL-2.0-or-later
// ∂L̇/∂q̇ − 2 ∂L/∂q = M q̈ − own:   M = ∂/∂q̈ of the left side,   own its negative at q̈ = 0.
#include "formalism/nielsen.hpp"

#include "formalism/elements.hpp"

namespace alembert {

using GiNaC::ex;

Equations nielsen(const Mechanism& m) {
    const int n = m.size();
    if (n == 0) throw ModelError("Nielsen's equations need at least one coordinate; the scene has none");
    Intermediates& z = *m.z;
    const ex L = m.lagrangian();
    const std::vector<ex> rate = z.pull_back({{m.time_derivative({L})[0], 1}}, m.qdot), force = z.pull_back({{L, 1}}, m.q);
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

}  // namespace alembert
