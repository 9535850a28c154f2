// SPDX-License-Identifier: GPL-2.0-or-later
// d/dt ∂L/∂q̇ − ∂L/∂q = Q  (Zhang & Qin (1-45), (1-54)). With p = ∂L/∂q̇:
//   M = ∂p/∂q̇,   f = Q + ∂L/∂q − (∂p/∂q) q̇ − ∂p/∂t.
// ∂L/∂(q, q̇) comes from one reverse pass, each column of M and the bracket from one forward pass.
#include "model/formalism/lagrange.hpp"

#include "base/language/say.hpp"
#include "model/formalism/elements.hpp"

namespace alembert {

using GiNaC::ex;

std::optional<std::string> obstacle_to_lagrange(const Mechanism& mechanism) {
    if (!mechanism.constraints.empty())
        return say(
            "Lagrange's equations of the second kind need independent coordinates, and the scene has "
            "constraints; use the formalism 'routh', which carries multipliers");
    return no_coordinates(mechanism, say("Lagrange's equations"));
}

Equations lagrange(const Mechanism& mechanism) {
    need_none(obstacle_to_lagrange(mechanism));
    return lagrange_operator(with_own_intermediates(mechanism));
}

Equations lagrange_operator(const Mechanism& mechanism) {
    const int n = mechanism.size();
    need_none(no_coordinates(mechanism, say("Lagrange's equations")));
    Intermediates& z = *mechanism.z;

    std::vector<GiNaC::symbol> state = mechanism.q;
    state.insert(state.end(), mechanism.qdot.begin(), mechanism.qdot.end());
    const std::vector<ex> gradient = z.pull_back({{mechanism.lagrangian(), 1}}, state);
    const std::vector<ex> p(gradient.begin() + n, gradient.end());
    const std::vector<ex> pdot = mechanism.time_derivative_without_acceleration(p);

    Equations equations = equations_without_terms("lagrange", mechanism);
    equations.dissipative = mechanism.generalized_forces(true);
    equations.applied = mechanism.generalized_forces(false);
    for (int j = 0; j < n; ++j) {
        // M is symmetric, so only the rows from j on are computed.
        const std::vector<ex> rows(p.begin() + j, p.end());
        const std::vector<ex> column = z.push_forward(rows, {{mechanism.qdot[j], 1}});
        for (int i = j; i < n; ++i) equations.M(i, j) = equations.M(j, i) = column[i - j];
    }
    // m a = F + m' u, not (m v)' = F + m' (v + u), as textbooks write it.
    const std::vector<ex> carried = carried_momentum(mechanism);
    for (int i = 0; i < n; ++i) {
        equations.own.push_back(z.name(gradient[i] - pdot[i] + (carried.empty() ? ex(0) : carried[i])));
        if (!carried.empty()) equations.applied[i] = z.name(equations.applied[i] - carried[i]);
    }
    return equations;
}

}  // namespace alembert
