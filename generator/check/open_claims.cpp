// SPDX-License-Identifier: GPL-2.0-or-later
#include "check/open_claims.hpp"

#include <algorithm>

#include "base/language/say.hpp"
#include "check/jump.hpp"
#include "check/open_rows.hpp"
#include "check/vanishing.hpp"

namespace alembert {

namespace {

/// Whether it leaves both unknown functions and constants of the motion open.
bool mixes(const Comparison& now, std::size_t k) {
    bool constant = false, function = false;
    for (const int o : now.forms[k].open) (now.claims.open()[o].constant ? constant : function) = true;
    return constant && function;
}

bool gives_constants(const Comparison& now, std::size_t k) {
    return now.claims.open()[static_cast<std::size_t>(now.forms[k].open[0])].constant;
}

/// A claim that gives constants, and whose derivative is zero wherever it has one, is not proved if it jumps.
/// Returns whether it may.
bool settle_jump(Comparison& now, std::size_t k, const OpenRows& rows, ExactStates& states) {
    const Motions& motions = states.motions;
    CheckedClaim& c = now.verdicts[k];
    const auto row = std::find_if(rows.list.begin(), rows.list.end(),
                                  [&](const OpenRows::Row& one) { return one.claim == k && !one.derived; });
    const FoundJump jump = find_jump(told(now), motions, rows.program, row->rest, is_kept(now, states));
    if (jump.shown) {
        refute(c, *jump.shown);
        c.reason = jump.border.empty() ? say("it is not constant: it jumps where a sign changes")
                                       : say("it is not constant: it jumps where {} = 0", jump.border);
        return true;
    }
    std::vector<int> slopes = row->slope;
    if (!jump.is_unknown && !depends_on_sides(rows.program, slopes)) return false;
    c.reason =
        say("it is constant as long as no sign changes, and it was not decided whether it jumps where one "
            "does");
    return true;
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
        } else if (!judged->is_complete) {
            c.reason = say("it could not be evaluated at enough states");
        } else if (pins(rows, judged->first, wrong, k)) {
            const bool constant = gives_constants(now, k);
            c.verdict = constant ? Verdict::undecided : Verdict::vacuous;
            c.reason = constant ? say("a further time derivative would be needed to tell whether what it leaves "
                                      "open is constant")
                                : say("what it leaves open can take up whatever it says: no other claim fixes it");
        } else if (!gives_constants(now, k) || !settle_jump(now, k, rows, states)) {
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
