// SPDX-License-Identifier: GPL-2.0-or-later
#include <algorithm>

#include "base/language/say.hpp"
#include "check/decide.hpp"
#include "check/multiple.hpp"
#include "check/static_combination.hpp"
#include "check/vanishing.hpp"

namespace alembert {

namespace {

CheckedClaim proved_combination(const Comparison& now, std::size_t k, double failure) {
    CheckedClaim c = proved(failure);
    c.normal_form = now.at == Claim::At::motion && is_multiple(now.forms[k].residual, now.m, now.law);
    return c;
}

std::map<std::size_t, CheckedClaim> combinations_at_rest(Comparison& now, const std::vector<std::size_t>& claims) {
    std::map<std::size_t, CheckedClaim> result;
    std::optional<bool> is_impossible;  // 1 = 0 follows too
    for (const std::size_t k : claims) {
        if (!now.forms[k].open.empty()) continue;
        const std::optional<double> failure = static_combination(now.claims, now.law, now.forms[k].residual);
        if (!failure) continue;
        if (!is_impossible) is_impossible = static_combination(now.claims, now.law, 1).has_value();
        result[k] = proved_combination(now, k, *failure);
        if (!*is_impossible) continue;
        result[k].verdict = Verdict::vacuous;
        result[k].reason = say("there is no state of rest, of which anything may be said");
    }
    return result;
}

std::map<std::size_t, CheckedClaim> combinations_in_motion(Comparison& now,
                                                           const std::vector<std::size_t>& claims) {
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
                                        .at = Motions::At::motion,
                                        .halvings = halvings_in(now, claims),
                                        .positions = Motions::Positions::free});
        double failure = 0;
        if (vanishes_at(*states, p, root, failure) != true) continue;
        found.emplace_back(k, failure);
        roots.push_back(root);
    }
    if (found.empty()) return {};
    std::map<std::size_t, CheckedClaim> result;
    const std::vector<bool> holds = hold_in_numbers(told(now), states->motions, p, roots);
    for (std::size_t i = 0; i < found.size(); ++i)
        if (holds[i]) result[found[i].first] = proved_combination(now, found[i].first, found[i].second);
    return result;
}

}  // namespace

std::map<std::size_t, CheckedClaim> combinations_among(Comparison& now, const std::vector<std::size_t>& claims) {
    // The share of a redundant constraint is determined only on the constraints.
    if (!now.m.redundant.empty()) return {};
    if (now.at == Claim::At::rest) return combinations_at_rest(now, claims);
    const bool is_bound = std::any_of(now.m.constraints.begin(), now.m.constraints.end(),
                                      [](const Mechanism::Constraint& c) { return c.position.has_value(); });
    if (now.at != Claim::At::motion || !is_bound) return {};
    return combinations_in_motion(now, claims);
}

}  // namespace alembert
