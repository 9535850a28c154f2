// SPDX-License-Identifier: GPL-2.0-or-later
#include "check/comparison.hpp"

#include <algorithm>

#include "check/arithmetic_error.hpp"
#include "check/diagnosis.hpp"
#include "check/quantities.hpp"

namespace alembert {

Told told(Comparison& now) {
    return {.mechanism = now.m,
            .equations = now.e,
            .claims = now.claims,
            .spoken = now.spoken,
            .positive = now.positive,
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

}  // namespace

void explain(Comparison& now, std::size_t claim, ExactStates& states) {
    const Diagnosis found = diagnosis_of(now, claim, states);
    CheckedClaim& c = now.verdicts[claim];
    if (!found.reason.empty()) c.reason = found.reason;
    c.nearest = found.nearest;
    c.difference = found.difference;
    c.likely = found.likely;
}

}  // namespace alembert
