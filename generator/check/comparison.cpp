// SPDX-License-Identifier: GPL-2.0-or-later
#include "check/comparison.hpp"

#include <algorithm>

#include "check/arithmetic_error.hpp"
#include "check/diagnosis.hpp"
#include "check/jump.hpp"
#include "check/open_rows.hpp"
#include "check/quantities.hpp"
#include "check/vanishing.hpp"
#include "check/ways.hpp"
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

namespace {

Diagnosis diagnosis_of(Question& q) try {
    Comparison& now = q.now;
    const std::size_t claim = q.claim;
    const bool up_to_constant =
        now.at == Claim::At::motion && letters_in(now.scene.claims[claim], now.claims).constant;
    std::optional<AnyStates> any;
    if (up_to_constant) any.emplace(now.m, now.e, halvings_in(now, {claim}));
    ExactStates& states = any && any->get() != nullptr ? *any->get() : *q.explained_at;
    return diagnose({.scene = now.scene,
                     .claims = now.claims,
                     .law = now.law,
                     .forms = now.forms,
                     .wrong = now.wrong,
                     .claim = claim,
                     .in_motion = now.at == Claim::At::motion,
                     .at_impact = now.at == Claim::At::impact,
                     .known = *now.known,
                     .up_to_constant = any && any->get() != nullptr},
                    states);
} catch (const std::exception&) {
    words_of_arithmetic_error();  // the claim is refuted, with a state to see it, even if nothing explains it
    return {};
}

/// Whether the corrected claim stands a look in numbers, where exact arithmetic may err: signs, jumps of what is
/// called constant, multiples of the prime.
bool stands(Question& q, const ClaimForm& repaired) {
    Comparison& now = q.now;
    ExactStates& states = *q.explained_at;
    const Motions& motions = states.motions;
    if (!repaired.open.empty()) {
        std::vector<ClaimForm> forms = now.forms;
        forms[q.claim] = repaired;
        const OpenRows rows = open_rows(now.claims, forms, {q.claim});
        const FoundJump jump =
            find_jump(told(now), motions, rows.program, rows.list[0].rest, is_kept(now, states));
        if (jump.shown || jump.is_unknown) return false;
        if (!depends_on_sides(rows.program, rows.roots()) && !motions.has_sides()) return true;
        constexpr unsigned tries = 40;
        const std::set<std::size_t> wrong = {q.claim};
        return !counterexample(told(now), motions, rows,
                               {.claim = q.claim, .open = repaired.open, .wrong = wrong, .tries = tries});
    }
    Question of_repaired(q.together, q.claim, repaired);
    const auto seen = [&] { return in_numbers(told(now), motions, of_repaired.program(), of_repaired.root()); };
    const std::vector<int> root{of_repaired.root()};
    if (now.at == Claim::At::rest) return seen() != InNumbers::fails;
    if (has_long_numbers(of_repaired.program(), root)) return seen() == InNumbers::holds;
    if (fails_in_a_cell(of_repaired, states)) return false;
    const bool may_err = depends_on_sides(of_repaired.program(), root) || now.on_own_branch != nullptr;
    return !may_err || seen() != InNumbers::fails;
}

}  // namespace

void explain(Question& q) {
    const Diagnosis found = diagnosis_of(q);
    if (!found.reason.empty()) q.found.reason = found.reason;
    // An acceleration means nothing at an impact; x'' stands for x'(-) there.
    const bool is_beyond_impact = q.now.at == Claim::At::impact && found.nearest.find("''") != std::string::npos;
    if (is_beyond_impact || (found.repaired && !stands(q, *found.repaired))) return;
    q.found.nearest = found.nearest;
    q.found.difference = found.difference;
    q.found.likely = found.likely;
}

}  // namespace alembert
