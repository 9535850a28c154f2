// SPDX-License-Identifier: GPL-2.0-or-later
#include "check/open_claims.hpp"

#include "base/language/say.hpp"
#include "check/open_rows.hpp"

namespace alembert {

namespace {

/// Whether it leaves both unknown functions and constants of the motion open.
bool mixes(const Comparison& now, std::size_t k) {
    bool constant = false, function = false;
    for (const int o : now.forms[k].open) (now.claims.open()[o].constant ? constant : function) = true;
    return constant && function;
}

void settle_group(Comparison& now, const std::vector<std::size_t>& group, ExactStates& states) {
    const OpenRows rows = open_rows(now.claims, now.forms, group);
    std::optional<OpenJudgement> judged = judge(rows, group, states);
    if (judged && !judged->wrong.empty() && now.on_own_branch != nullptr && now.on_own_branch->get(0) != nullptr)
        judged = judge(rows, group, *now.on_own_branch);
    if (!judged) {
        for (const std::size_t k : group) now.verdicts[k].reason = say("it could not be evaluated at any state");
        return;
    }
    now.wrong = judged->wrong;
    const std::set<std::size_t> wrong = now.wrong;
    for (const std::size_t k : group) {
        CheckedClaim& c = now.verdicts[k];
        c.failure = judged->failure;
        if (wrong.contains(k)) {
            c.reason = wrong.size() > 1 && wrong.size() == group.size()
                           ? say("no choice of what is left open satisfies these claims together")
                           : say("the other claims leave no choice with which it holds");
            const auto shown = counterexample(told(now), states.motions, rows,
                                              {.claim = k, .open = now.forms[k].open, .wrong = wrong});
            if (!shown) continue;
            refute(c, *shown);
            if (shown->of_derivative)
                c.reason = say("it is not constant: the residual is that of its time derivative");
            explain(now, k, states);
        } else if (pins(rows, judged->first, wrong, k)) {
            const bool constant = now.claims.open()[now.forms[k].open[0]].constant;
            c.verdict = constant ? Verdict::undecided : Verdict::vacuous;
            c.reason = constant ? say("a further time derivative would be needed to tell whether what it leaves "
                                      "open is constant")
                                : say("what it leaves open can take up whatever it says: no other claim fixes it");
        } else {
            c.verdict = Verdict::proved;
        }
    }
}

}  // namespace

void settle_open_claims(Comparison& now, const std::vector<std::size_t>& open, ExactStates& states) {
    std::set<std::size_t> done;
    for (const std::size_t k : open) {
        CheckedClaim& c = now.verdicts[k];
        if (!now.forms[k].linear) {
            c.reason = say("it is not linear in the names that it leaves open");
            continue;
        }
        if (mixes(now, k)) {
            c.reason =
                say("it holds an unknown function beside a constant of the motion, and the function's derivative "
                    "is not known");
            continue;
        }
        if (done.contains(k)) continue;
        std::vector<std::size_t> group = group_of(now.scene, now.forms, k);
        std::erase_if(group, [&](std::size_t other) { return mixes(now, other); });
        done.insert(group.begin(), group.end());
        settle_group(now, group, states);
    }
}

}  // namespace alembert
