// SPDX-License-Identifier: GPL-2.0-or-later
// ⎡M 0⎤ ⎡u'⎤ = ⎡f⎤ + ⎡Aᵀ⎤ λ,   A u' = γ,   with the rates r of the states z.
// ⎣0 1⎦ ⎣z'⎦   ⎣r⎦   ⎣0 ⎦
#include "model/formalism/with_states.hpp"

#include "model/formalism/elements.hpp"

namespace alembert {

bool has_states(const Equations& equations, const Mechanism& m) {
    return !m.states.empty() && !equations.u.empty() && equations.u.back().is_equal(m.states.back().derivative[0]);
}

Equations with_states(const Equations& equations, const Mechanism& m) {
    Equations result = equations;
    if (m.states.empty() || has_states(equations, m)) return result;
    const auto n = static_cast<unsigned>(equations.u.size());
    const auto all = n + static_cast<unsigned>(m.states.size());
    for (const Mechanism::State& state : m.states) {
        const std::string source = "state " + state.derivative[0].get_name();
        result.u.push_back(state.derivative[0]);
        result.udot.push_back(state.derivative[1]);
        result.form.emplace_back(state.derivative[0]);
        result.own.emplace_back(0);
        result.dissipative.emplace_back(0);
        result.applied.emplace_back(state.rate);
        if (!result.row_sources.empty()) result.row_sources.push_back({source});
    }
    if (equations.M.rows() > 0 || n == 0) {
        result.M = GiNaC::matrix(all, all);
        for (unsigned i = 0; i < all; ++i)
            for (unsigned j = 0; j < all; ++j)
                result.M(i, j) = i < n && j < n ? equations.M(i, j) : GiNaC::ex(i == j ? 1 : 0);
    }
    for (std::vector<GiNaC::ex>& row : result.A) row.resize(all, 0);
    return result;
}

GiNaC::ex without_state_rates(const GiNaC::ex& value, const Mechanism& m) {
    std::vector<GiNaC::symbol> rates;
    for (const Mechanism::State& state : m.states)
        rates.insert(rates.end(), state.derivative.begin() + 1, state.derivative.end());
    GiNaC::ex result = value;
    while (!rates.empty() && m.z->depends(result, rates)) {
        GiNaC::exmap by;
        for (const Mechanism::State& state : m.states) {
            by[state.derivative[1]] = state.rate;
            by[state.derivative[2]] = m.time_derivative({state.rate})[0];
        }
        result = substitute(*m.z, {result}, by)[0];
    }
    return result;
}

}  // namespace alembert
