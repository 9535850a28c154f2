// SPDX-License-Identifier: GPL-2.0-or-later
// A q' + b = 0, solved row by row: a row with one rate that is not known yet gives it.
#include "model/formalism/driven.hpp"

#include "model/formalism/elements.hpp"

namespace alembert {

using GiNaC::ex;

namespace {

using Constraint = Mechanism::Constraint;

/// Whether it consists of numbers and parameters.
bool is_steady(const ex& e, const Mechanism& m) {
    if (GiNaC::is_a<GiNaC::symbol>(e))
        return m.symbols->info(GiNaC::ex_to<GiNaC::symbol>(e)).kind == SymbolInfo::Kind::parameter;
    for (const ex& part : e)
        if (!is_steady(part, m)) return false;
    return true;
}

GiNaC::exmap shift(const GiNaC::exmap& rates) {
    GiNaC::exmap result;
    for (const auto& [rate, value] : rates) result[rate] = rate + value;
    return result;
}

}  // namespace

GiNaC::exmap driven_rates(const Mechanism& m) {
    std::map<int, ex> known;  // also those that are zero
    const auto solve = [&](const Constraint& c) {
        ex rest = m.z->expand(c.offset);
        int unknown = -1;
        for (int i = 0; i < m.size(); ++i) {
            if (c.row[i].is_zero()) continue;
            if (const auto found = known.find(i); found != known.end())
                rest += m.z->expand(c.row[i]) * found->second;
            else if (unknown >= 0)
                return false;
            else
                unknown = i;
        }
        if (unknown < 0) return false;
        const ex rate = (-rest / m.z->expand(c.row[unknown])).normal();
        if (!is_steady(rate, m)) return false;
        known[unknown] = rate;
        return true;
    };
    for (bool again = true; again;) {
        again = false;
        for (const auto* list : {&m.constraints, &m.redundant})
            for (const Constraint& c : *list) again = solve(c) || again;
    }
    GiNaC::exmap result;
    for (const auto& [i, rate] : known)
        if (!rate.is_zero()) result[m.qdot[i]] = rate;
    return result;
}

ex counted_from(const ex& e, const Mechanism& m, const GiNaC::exmap& rates) {
    return rates.empty() ? e : substitute(*m.z, {e}, shift(rates))[0];
}

Mechanism counted_from(Mechanism m, const GiNaC::exmap& rates) {
    const auto count = [&](Constraint& c) {
        GiNaC::exvector terms{c.offset};
        for (int i = 0; i < m.size(); ++i)
            if (const auto found = rates.find(m.qdot[i]); found != rates.end())
                terms.push_back(c.row[i] * found->second);
        c.offset = m.z->name(m.z->expand(GiNaC::add(std::move(terms))));
        c.acceleration = counted_from(c.acceleration, m, rates);
    };
    for (auto* list : {&m.constraints, &m.redundant})
        for (Constraint& c : *list) count(c);
    for (Mechanism::Unilateral& contact : m.unilateral) count(contact.gap);
    return m;
}

Equations counted_from(Equations e, const GiNaC::exmap& rates) {
    for (auto* part : {&e.own, &e.dissipative, &e.applied, &e.gamma})
        *part = substitute(*e.z, *part, shift(rates));
    return e;
}

}  // namespace alembert
