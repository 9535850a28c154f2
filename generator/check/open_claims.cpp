// SPDX-License-Identifier: GPL-2.0-or-later
#include <algorithm>

#include "base/language/say.hpp"
#include "check/jump.hpp"
#include "check/open_rows.hpp"
#include "check/vanishing.hpp"
#include "check/ways.hpp"

namespace alembert {

namespace {

/// Whether it leaves both unknown functions and constants of the motion open.
bool mixes(const Comparison& now, std::size_t k) {
    bool constant = false, function = false;
    for (const int o : now.forms[k].open) (now.claims.open()[o].constant ? constant : function) = true;
    return constant && function;
}

bool gives_constants(const Question& q) {
    return q.now.claims.open()[static_cast<std::size_t>(q.form().open[0])].constant;
}

/// The claims that share its names, on the scene's own branch if there are several and some fail.
std::pair<const std::vector<std::size_t>, JudgedGroup>& group_of(Question& q) {
    Comparison& now = q.now;
    std::vector<std::size_t> group = group_of(now.scene, now.forms, q.claim);
    std::erase_if(group, [&](std::size_t other) { return mixes(now, other); });
    now.compare_on_sheet_of(group);
    const auto [found, is_new] = q.together.groups.try_emplace(group);
    if (!is_new) return *found;
    auto& [rows, judged] = found->second;
    rows = open_rows(now.claims, now.forms, group);
    judged = judge(rows, group, *q.together.states);
    ExactStates* const own = now.on_own_branch;
    if (judged && !judged->wrong.empty() && own != nullptr && own->get(0) != nullptr)
        judged = judge(rows, group, *own);
    return *found;
}

CheckedClaim wrong_one(Question& q, const OpenRows& rows, bool are_all_wrong) {
    Comparison& now = q.now;
    const auto shown = counterexample(told(now), q.together.states->motions, rows,
                                      {.claim = q.claim, .open = q.form().open, .wrong = now.wrong});
    CheckedClaim c = shown ? refuted(*shown) : CheckedClaim();
    if (shown) q.explained_at = q.together.states;
    c.reason = shown && shown->of_derivative
                   ? say("it is not constant: the residual is that of its time derivative")
               : now.wrong.size() > 1 && are_all_wrong
                   ? say("no choice of what is left open satisfies these claims together")
                   : say("the other claims leave no choice with which it holds");
    return c;
}

}  // namespace

std::optional<CheckedClaim> with_open_names(Question& q) {
    if (q.form().open.empty()) return std::nullopt;
    Comparison& now = q.now;
    if (!q.together.states->motions.rows_with_friction().empty())
        return undecided(
            say("it leaves names open, and the side that a constraint with friction presses is known in numbers "
                "only"));
    if (!q.together.states->motions.loose().empty())
        return undecided(say("the constraints cannot be solved one after the other, and it leaves names open"));
    if (!q.form().linear) return undecided(say("it is not linear in the names that it leaves open"));
    if (mixes(now, q.claim))
        return undecided(
            say("it holds an unknown function beside a constant of the motion, and the function's derivative is "
                "not known"));
    const auto& [group, of_group] = group_of(q);
    const auto& [rows, judged] = of_group;
    if (!judged) return undecided(say("it could not be evaluated at any state"));
    now.wrong = judged->wrong;
    if (now.wrong.contains(q.claim)) return wrong_one(q, rows, now.wrong.size() == group.size());
    if (!judged->is_complete) return undecided(say("it could not be evaluated at enough states"));
    if (!pins(rows, judged->first, now.wrong, q.claim)) return proved(judged->failure);
    if (gives_constants(q))
        return undecided(
            say("a further time derivative would be needed to tell whether what it leaves open is constant"));
    CheckedClaim c;
    c.verdict = Verdict::vacuous;
    c.reason = say("what it leaves open can take up whatever it says: no other claim fixes it");
    return c;
}

/// A claim that gives constants, and whose derivative is zero wherever it has one, is not proved if it jumps.
std::optional<CheckedClaim> at_jumps(Question& q) {
    if (q.form().open.empty() || q.together.states == nullptr || !gives_constants(q)) return std::nullopt;
    const OpenRows& rows = group_of(q).second.rows;
    const Motions& motions = q.together.states->motions;
    const auto row = std::find_if(rows.list.begin(), rows.list.end(),
                                  [&](const OpenRows::Row& one) { return one.claim == q.claim && !one.derived; });
    const FoundJump jump =
        find_jump(told(q.now), motions, rows.program, row->rest, is_kept(q.now, *q.together.states));
    if (jump.shown) {
        CheckedClaim c = refuted(*jump.shown);
        c.reason = jump.border.empty() ? say("it is not constant: it jumps where a sign changes")
                                       : say("it is not constant: it jumps where {} = 0", jump.border);
        return c;
    }
    if (!jump.is_unknown && !depends_on_sides(rows.program, row->slope)) return std::nullopt;
    return undecided(
        say("it is constant as long as no sign changes, and it was not decided whether it jumps where one does"));
}

}  // namespace alembert
