// SPDX-License-Identifier: GPL-2.0-or-later
#include "check/comparison.hpp"

#include <algorithm>

#include "check/arithmetic_error.hpp"
#include "check/diagnosis.hpp"
#include "check/in_cells.hpp"
#include "check/jump.hpp"
#include "check/open_rows.hpp"
#include "check/quantities.hpp"
#include "check/vanishing.hpp"
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

bool has_branches(Comparison& now) {
    return now.at == Claim::At::motion && now.assumed.empty() && now.basis.own_branch().has_value();
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

void refute(CheckedClaim& verdict, const Counterexample& shown) {
    verdict.verdict = Verdict::refuted;
    verdict.counterexample = shown.values;
    verdict.residual = shown.residual;
    verdict.residual_value = shown.residual_value;
}

namespace {

Diagnosis diagnosis_of(Comparison& now, std::size_t claim, ExactStates& given) try {
    const bool up_to_constant =
        now.at == Claim::At::motion && letters_in(now.scene.claims[claim], now.claims).constant;
    std::optional<AnyStates> any;
    if (up_to_constant) any.emplace(now.m, now.e, halvings_in(now, {claim}));
    ExactStates& states = any && any->get() != nullptr ? *any->get() : given;
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
bool stands(Comparison& now, std::size_t claim, ClaimForm repaired, ExactStates& states) {
    const Motions& motions = states.motions;
    if (!repaired.open.empty()) {
        std::vector<ClaimForm> forms = now.forms;
        forms[claim] = repaired;
        const OpenRows rows = open_rows(now.claims, forms, {claim});
        const FoundJump jump =
            find_jump(told(now), motions, rows.program, rows.list[0].rest, is_kept(now, states));
        if (jump.shown || jump.is_unknown) return false;
        if (!depends_on_sides(rows.program, rows.roots()) && !motions.has_sides()) return true;
        constexpr unsigned tries = 40;
        const std::set<std::size_t> wrong = {claim};
        return !counterexample(told(now), motions, rows,
                               {.claim = claim, .open = repaired.open, .wrong = wrong, .tries = tries});
    }
    Program p;
    const std::vector<int> root = now.claims.lower(p, {repaired.residual});
    if (now.at == Claim::At::rest) return in_numbers(told(now), motions, p, root[0]) != InNumbers::fails;
    if (has_long_numbers(p, root)) return in_numbers(told(now), motions, p, root[0]) == InNumbers::holds;
    std::swap(now.forms[claim], repaired);
    InCells sided(now, claim, states);
    const bool fails_in_a_cell = sided.any() && sided.fails();
    std::swap(now.forms[claim], repaired);
    if (fails_in_a_cell) return false;
    const bool may_err = depends_on_sides(p, root) || now.on_own_branch != nullptr;
    return !may_err || in_numbers(told(now), motions, p, root[0]) != InNumbers::fails;
}

}  // namespace

void explain(Comparison& now, std::size_t claim, ExactStates& states) {
    const Diagnosis found = diagnosis_of(now, claim, states);
    CheckedClaim& c = now.verdicts[claim];
    if (!found.reason.empty()) c.reason = found.reason;
    // An acceleration means nothing at an impact; x'' stands for x'(-) there.
    const bool is_beyond_impact = now.at == Claim::At::impact && found.nearest.find("''") != std::string::npos;
    if (is_beyond_impact) return;
    if (found.repaired && !stands(now, claim, *found.repaired, states)) return;
    c.nearest = found.nearest;
    c.difference = found.difference;
    c.likely = found.likely;
}

}  // namespace alembert
