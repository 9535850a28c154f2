// SPDX-License-Identifier: GPL-2.0-or-later
#include "check/comparison.hpp"

#include <algorithm>

#include "model/formalism/rest.hpp"

namespace alembert {

namespace {

/// Of each constraint that is a product, the factor that vanishes at the initial state, if one alone does: states
/// of rest belong to that branch.
const std::vector<GiNaC::ex>& own_factors(Comparison& now) {
    static const std::vector<GiNaC::ex> none;
    if (now.at != Claim::At::rest) return none;
    if (now.own_factors) return *now.own_factors;
    now.own_factors.emplace();
    for (const Mechanism::Constraint& constraint : now.m.constraints) {
        if (!constraint.position) continue;
        const TrigonometricProduct product = product_of(now.m.z->expand(*constraint.position), now.m);
        std::vector<GiNaC::ex> own;
        for (const GiNaC::ex& base : product.bases) {
            const GiNaC::ex factor = base.subs(product.functions, GiNaC::subs_options::no_pattern);
            if (now.own_motion.is_zero_at_start(factor)) own.push_back(factor);
        }
        if (product.bases.size() > 1 && own.size() == 1) now.own_factors->push_back(own[0]);
    }
    return *now.own_factors;
}

}  // namespace

void add_positive(std::vector<GiNaC::ex>& list, const GiNaC::ex& positive) {
    if (std::none_of(list.begin(), list.end(),
                     [&](const GiNaC::ex& known) { return (known - positive).expand().is_zero(); }))
        list.push_back(positive);
}

void Comparison::compare_on_sheet_of(const std::vector<std::size_t>& of) {
    positive = assumed;
    for (const std::size_t k : of)
        for (const auto* const list : {&sheets[k], &domains[k]})
            for (const GiNaC::ex& one : *list) add_positive(positive, one);
}

bool has_branches(Comparison& now) {
    return now.assumed.empty() && now.knows_own_branch();
}

Told told(Comparison& now) {
    return {.mechanism = now.m,
            .equations = now.e,
            .claims = now.claims,
            .spoken = now.spoken,
            .positive = now.positive,
            .own_factors = own_factors(now),
            .is_impact = now.at == Claim::At::impact,
            .on_own_branch = now.on_own_branch != nullptr};
}

int halvings_in(const Comparison& now, const std::vector<std::size_t>& claims) {
    int result = 0;
    for (const std::size_t k : claims) {
        Program p;
        result = std::max(result, halvings(p, now.claims.lower(p, {now.forms[k].residual})));
    }
    return result;
}

}  // namespace alembert
