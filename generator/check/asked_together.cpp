// SPDX-License-Identifier: GPL-2.0-or-later
#include "check/asked_together.hpp"

#include <algorithm>

#include "model/energy.hpp"

namespace alembert {

using GiNaC::ex;

namespace {

constexpr int most_halves = 2;

/// With holonomic constraints as they are at the pose where the scene starts: what of it is known in numbers only
/// obeys them.
Mechanism struck(Comparison& now) {
    Mechanism result = now.m;
    const GiNaC::exmap& pose = now.claims.after_impact()->pose;
    for (auto* constraints : {&result.constraints, &result.redundant})
        for (Mechanism::Constraint& c : *constraints) {
            if (!c.position) continue;
            const ex here = now.m.z->expand(*c.position).subs(pose, GiNaC::subs_options::no_pattern).expand();
            const bool holds = GiNaC::is_a<GiNaC::numeric>(here) || is_identically_zero(here, now.m);
            c.position = holds ? std::nullopt : std::optional(now.m.z->name(here));
        }
    return result;
}

}  // namespace

AskedTogether::AskedTogether(Comparison& compared, std::vector<std::size_t> asked)
    : now(compared), claims(std::move(asked)) {
    if (now.at == Claim::At::near || now.at == Claim::At::solution) return;
    now.compare_on_sheet_of(claims);
    combinations = combinations_among(now, claims);
    std::vector<std::size_t> here = claims;
    std::erase_if(here, [&](std::size_t k) { return combinations.contains(k); });
    if (here.empty()) return;
    states = usable(here, false, most_halves, made_);
    const bool may_branch = states->motions.has_branches() || !states->motions.loose().empty();
    if (states->get(0) != nullptr && may_branch && now.knows_own_branch())
        now.on_own_branch =
            usable(here, true, std::min(most_halves, std::max(halvings_in(now, here), states->motions.halves())),
                   made_on_own_branch_);
}

/// Shared by all claims unless the claims assume something, or are about an impact, which has a mechanism of its
/// own; `made` then keeps them.
ExactStates& AskedTogether::states_for(const Basis::Wanted& wanted, std::unique_ptr<ExactStates>& made) {
    const bool is_impact = now.at == Claim::At::impact;
    if (!is_impact && now.assumed.empty()) return now.basis.states(wanted);
    made = now.basis.own_states(wanted, is_impact ? struck(now) : now.m);
    if (!now.assumed.empty()) keep_assumed(*made);
    return *made;
}

/// Angles in halves only where they occur: every halving doubles the degrees.
ExactStates* AskedTogether::usable(const std::vector<std::size_t>& here, bool stays, int most,
                                   std::unique_ptr<ExactStates>& made) {
    const int halvings = halvings_in(now, here);
    ExactStates* found = nullptr;
    for (int halves = 0; halves <= most; ++halves) {
        found = &states_for({.spoken = now.spoken,
                             .is_any_motion = now.is_any_motion,
                             .at = now.at == Claim::At::rest ? Motions::At::rest : Motions::At::motion,
                             .halves = halves,
                             .halvings = halvings,
                             .knows_own_branch = now.knows_own_branch(),
                             .stays_on_own_branch = stays},
                            made);
        if (halves < most && found->get(0) != nullptr && can_be_evaluated(here, *found)) break;
    }
    return found;
}

/// Whether each of the claims has a value at one of the first states.
bool AskedTogether::can_be_evaluated(const std::vector<std::size_t>& here, ExactStates& at) const {
    constexpr std::size_t tries = 24;
    return std::all_of(here.begin(), here.end(), [&](std::size_t k) {
        Program p;
        const std::vector<int> root = now.claims.lower(p, {now.forms[k].residual});
        for (std::size_t s = 0; s < tries && at.get(s) != nullptr; ++s)
            if (evaluate_mod(p, at.get(s)->point, root)) return true;
        return false;
    });
}

/// What is assumed to be positive is a square in exact arithmetic, whose signs are Legendre's symbols.
void AskedTogether::keep_assumed(ExactStates& at) const {
    Program p;
    const std::vector<int> roots = now.claims.lower(p, now.assumed);
    at.keep_where(
        [p = std::move(p), roots](const ModularPoint& point) {
            const auto values = evaluate_mod(p, point, roots);
            return values && std::all_of(roots.begin(), roots.end(), [&](int root) {
                       return !values->value[root].is_zero() && values->value[root].is_square();
                   });
        },
        static_cast<double>(roots.size()));
}

}  // namespace alembert
