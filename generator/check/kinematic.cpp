// SPDX-License-Identifier: GPL-2.0-or-later
#include "check/kinematic.hpp"

#include <algorithm>

#include "base/language/say.hpp"
#include "check/quantities.hpp"
#include "check/vanishing.hpp"

namespace alembert {

namespace {

void tell_kinematic(Comparison& now, std::size_t k, ExactStates& states) {
    CheckedClaim& c = now.verdicts[k];
    Program p;
    const int root = now.claims.lower(p, {now.forms[k].residual})[0];
    double failure = 0;
    c.kinematic = p.is_zero(root) || vanishes_at(states, p, root, failure) == std::optional(true);
    if (c.kinematic && c.reason.empty())
        c.reason = words_without_forces(
            now, k, say("a relation of kinematics: it holds for every motion that the constraints allow"));
}

}  // namespace

void tell_kinematics(Comparison& now) {
    std::vector<GiNaC::symbol> multipliers = now.e.lambda;
    for (const Mechanism::Constraint* c : now.m.undetermined()) multipliers.push_back(c->multiplier);
    std::vector<std::size_t> here;
    for (std::size_t k = 0; k < now.forms.size(); ++k) {
        const CheckedClaim& c = now.verdicts[k];
        if (now.scene.claims[k].at == Claim::At::motion && c.verdict == Verdict::proved && c.assumed.empty() &&
            now.forms[k].open.empty() && !now.forms[k].third &&
            !now.m.z->depends(now.forms[k].residual, multipliers))
            here.push_back(k);
    }
    const bool is_bound_by_forces = std::any_of(now.m.constraints.begin(), now.m.constraints.end(),
                                                [](const Mechanism::Constraint& c) { return c.balance; });
    if (here.empty() || is_bound_by_forces) return;
    for (const int halves : {0, 1, 2}) {
        ExactStates& states =
            now.basis.states({.is_any_motion = true, .halves = halves, .halvings = halvings_in(now, here)});
        if (states.get(0) == nullptr) continue;
        for (const std::size_t k : here) tell_kinematic(now, k, states);
        return;
    }
}

}  // namespace alembert
