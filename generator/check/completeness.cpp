// SPDX-License-Identifier: GPL-2.0-or-later
#include "check/completeness.hpp"

#include <algorithm>

#include "check/open_rows.hpp"

namespace alembert {

using GiNaC::ex;

Completeness completeness(Basis& basis, const Claims& claims, const std::vector<const ClaimForm*>& right) {
    const Mechanism& m = claims.mechanism();
    const Equations& e = claims.equations();
    std::vector<GiNaC::symbol> unknowns = m.qddot;
    unknowns.insert(unknowns.end(), e.lambda.begin(), e.lambda.end());
    for (const Mechanism::Constraint& c : m.redundant) unknowns.push_back(c.multiplier);
    for (const Open& o : claims.open()) unknowns.push_back(o.symbol);
    std::vector<ex> list;
    for (const ClaimForm* const form : right) {
        const ex last = form->derivatives.empty() ? form->residual : form->derivatives.back();
        const std::vector<ex> slopes = m.z->pull_back({{last, 1}}, unknowns);
        list.insert(list.end(), slopes.begin(), slopes.end());
    }
    for (const auto& row : e.A) {
        list.insert(list.end(), row.begin(), row.end());
        list.insert(list.end(), unknowns.size() - row.size(), ex(0));
    }
    if (m.size() == 0) return {.is_complete = true};  // the scene gives the rates of its states
    if (list.empty()) return {.missing = m.size(), .freedom = m.size()};
    constexpr std::size_t tries = 16, most = 40;
    // On the scene's own branch of the constraints what is right there vanishes; on another one it may not.
    const std::size_t coefficients = list.size();
    for (const ClaimForm* const form : right)
        if (form->open.empty()) list.push_back(form->residual);
    Program p;
    const std::vector<int> nodes = claims.lower(p, list);
    std::optional<ModularValues> at;
    for (const int halves : {0, 1, 2}) {
        ExactStates& states = basis.states({.halves = halves, .halvings = halvings(p, nodes)});
        bool all_hold = false;
        for (std::size_t s = 0; (at ? s < tries && !all_hold : s < most) && states.get(s) != nullptr; ++s) {
            auto here = evaluate_mod(p, states.get(s)->point, nodes);
            if (!here) continue;
            all_hold = std::all_of(nodes.begin() + static_cast<std::ptrdiff_t>(coefficients), nodes.end(),
                                   [&](int node) { return here->value[node].is_zero(); });
            if (!at || all_hold) at = std::move(here);
        }
        if (at) break;
    }
    if (!at) return {};
    std::vector<std::vector<Prime>> all, others, constraints;
    for (std::size_t r = 0; r * unknowns.size() < coefficients; ++r) {
        all.emplace_back();
        for (std::size_t j = 0; j < unknowns.size(); ++j)
            all.back().push_back(at->value[nodes[r * unknowns.size() + j]]);
        others.emplace_back(all.back().begin() + m.size(), all.back().end());
    }
    constraints.assign(all.end() - static_cast<std::ptrdiff_t>(e.A.size()), all.end());
    const int missing = m.size() + rank_of(others, unknowns.size() - m.q.size()) - rank_of(all, unknowns.size());
    return {.is_complete = missing == 0 && !right.empty(),
            .missing = missing,
            .freedom = m.size() - rank_of(constraints, unknowns.size())};
}

}  // namespace alembert
