// SPDX-License-Identifier: GPL-2.0-or-later
#include "check/combinations.hpp"

#include "check/multiple.hpp"
#include "check/static_combination.hpp"
#include "check/vanishing.hpp"

namespace alembert {

namespace {

void prove(Comparison& now, std::size_t k, double failure) {
    CheckedClaim& c = now.verdicts[k];
    c.verdict = Verdict::proved;
    c.failure = failure;
    c.normal_form = now.at == Claim::At::motion && is_multiple(now.forms[k].residual, now.m, now.law);
}

}  // namespace

std::vector<std::size_t> without_combinations(Comparison& now, const std::vector<std::size_t>& claims,
                                              Motions::At at) {
    if (!now.m.redundant.empty()) return claims;  // the share of each is determined only on the constraints
    std::vector<std::size_t> left = claims;
    if (at == Motions::At::rest) {
        std::optional<bool> is_impossible;  // 1 = 0 follows too
        std::erase_if(left, [&](std::size_t k) {
            if (!now.forms[k].open.empty()) return false;
            const std::optional<double> failure = static_combination(now.claims, now.law, now.forms[k].residual);
            if (!failure) return false;
            if (!is_impossible) is_impossible = static_combination(now.claims, now.law, 1).has_value();
            if (*is_impossible) {
                now.verdicts[k].verdict = Verdict::vacuous;
                now.verdicts[k].reason = say("there is no state of rest, of which anything may be said");
            } else {
                prove(now, k, *failure);
            }
            return true;
        });
        return left;
    }
    ExactStates* states = nullptr;
    Program p;
    std::vector<int> roots;
    std::vector<std::pair<std::size_t, double>> found;
    for (const std::size_t k : claims) {
        if (!now.forms[k].open.empty()) continue;
        const int root = now.claims.lower(p, {now.forms[k].residual})[0];
        if (p.is_zero(root)) continue;
        if (states == nullptr)
            states = &now.basis.states({.spoken = now.spoken,
                                        .is_any_motion = now.is_any_motion,
                                        .at = at,
                                        .halvings = halvings_in(now, claims),
                                        .positions = Motions::Positions::free});
        double failure = 0;
        if (vanishes_at(*states, p, root, failure) != std::optional(true)) continue;
        found.emplace_back(k, failure);
        roots.push_back(root);
    }
    if (found.empty()) return left;
    const std::vector<bool> holds = hold_in_numbers(told(now), states->motions, p, roots);
    for (std::size_t i = 0; i < found.size(); ++i)
        if (holds[i]) {
            prove(now, found[i].first, found[i].second);
            std::erase(left, found[i].first);
        }
    return left;
}

}  // namespace alembert
