// SPDX-License-Identifier: GPL-2.0-or-later
// V(q) = −∫₀¹ Q(s q)·q ds, along the straight line from the origin.
#include "stability/conservative.hpp"

#include <algorithm>

#include "model/energy.hpp"

namespace alembert {

using GiNaC::ex;

namespace {

constexpr double short_form_nodes = 2000;  // nodes

std::optional<ex> potential_of(const Mechanism& m, const std::vector<ex>& Q) {
    GiNaC::symbol s("s");
    GiNaC::exmap scaled;
    for (const GiNaC::symbol& q : m.q) scaled[q] = s * q;
    std::vector<GiNaC::symbol> other = m.qdot;
    other.push_back(m.t);
    for (const Mechanism::Input& input : m.inputs)
        other.insert(other.end(), input.derivative.begin(), input.derivative.end());
    GiNaC::lst coordinates;
    for (const GiNaC::symbol& q : m.q) coordinates.append(q);
    ex V = 0;
    for (int i = 0; i < m.size(); ++i) {
        if (m.z->tree_size(Q[i]) > short_form_nodes || m.z->depends(Q[i], other)) return {};
        const ex force = m.z->expand(Q[i]);
        if (!force.is_polynomial(coordinates)) return {};
        for (int j = 0; j < i; ++j)
            if (!is_identically_zero(force.diff(m.q[j]) - m.z->expand(Q[j]).diff(m.q[i]), m)) return {};
        const ex along = force.subs(scaled).expand();
        for (int k = 0; k <= along.degree(s); ++k) V -= along.coeff(s, k) * m.q[i] / (k + 1);
    }
    return V.expand();
}

}  // namespace

Mechanism with_potential_of_loads(const Mechanism& m) {
    const std::vector<ex> Q = m.generalized_forces(false);
    if (std::all_of(Q.begin(), Q.end(), [](const ex& one) { return one.is_zero(); })) return m;
    const auto V = potential_of(m, Q);
    if (!V) return m;
    Mechanism result = m;
    std::erase_if(result.loads, [](const Load& load) { return !load.dissipative; });
    const ex value = m.z->name(*V);
    if (result.given_lagrangian)
        result.given_lagrangian = m.z->name(*result.given_lagrangian - value);
    else
        result.potential.push_back({.origin = m.loads.front().origin, .value = value});
    return result;
}

}  // namespace alembert
