// SPDX-License-Identifier: GPL-2.0-or-later
#include <algorithm>
#include <array>

#include "analysis/exact/angle_sum.hpp"
#include "base/language/say.hpp"
#include "check/in_print.hpp"
#include "check/quantities.hpp"
#include "check/root_form.hpp"
#include "check/vanishing.hpp"
#include "check/ways.hpp"

namespace alembert {

using GiNaC::ex;

namespace {

Told told_on_own_branch(Comparison& now) {
    Told own = told(now);
    own.on_own_branch = true;
    return own;
}

/// What numbers say, where the motions know the scene's own branch.
bool holds_on_own_branch(Comparison& now, const Motions& motions, const Program& p, int root) {
    return now.at == Claim::At::motion && motions.own() &&
           in_numbers(told_on_own_branch(now), motions, p, root) == InNumbers::holds;
}

/// Tells where another branch decides otherwise.
CheckedClaim with_other_branch(Question& q, CheckedClaim c, const Program& p, int root, Verdict there) {
    OtherBranch other{.verdict = there};
    if (auto found = state_where(told(q.now), q.together.states->motions, p, root, there == Verdict::proved)) {
        other.where = std::move(found->where);
        if (there == Verdict::refuted) other.counterexample = std::move(found->values);
    }
    c.other_branch = std::move(other);
    return c;
}
CheckedClaim with_other_branch(Question& q, CheckedClaim c, Verdict there) {
    return with_other_branch(q, std::move(c), q.program(), q.root(), there);
}

/// Does the claim hold at one of the first states, on any branch?
bool holds_somewhere(const Question& q) {
    constexpr std::size_t enough = 32;
    ExactStates& states = *q.together.states;
    for (std::size_t s = 0; s < enough && states.get(s) != nullptr; ++s)
        if (const auto at = evaluate_mod(q.program(), states.get(s)->point, std::array{q.root()});
            at && at->value[q.root()].is_zero())
            return true;
    return false;
}

/// Whether it holds values of asin or acos, whose sines and cosines are roots: y = l*sin(acos(x/l)) holds on one
/// half of a circle, in exact arithmetic too.
bool has_arcs(const Program& p, int root) {
    const std::vector<int> needed = p.needed(std::array{root});
    return std::any_of(needed.begin(), needed.end(), [&](int id) {
        return (p[id].op == Op::asin || p[id].op == Op::acos) && p[id].depends != 0;
    });
}

/// Whether `value` is positive on the scene's own branch: at all of several states of it, or at the initial state.
bool is_positive_on_own_branch(Comparison& now, const Motions& motions, const ex& value) {
    Program p;
    const int root = now.claims.lower(p, {value})[0];
    const std::optional<int> sign = sign_on_own_branch(told(now), motions, p, root);
    return sign ? *sign > 0 : now.own_motion.is_positive_at_start(value);
}

/// Whether roots are taken of what changes with rates: no length, whose sign the initial state would tell.
bool has_roots_of_rates(const Question& q) {
    const Mechanism& m = q.now.m;
    const std::vector<ex> squares = squares_in(q.form().residual, m);
    return std::any_of(squares.begin(), squares.end(), [&](const ex& s) {
        return m.z->depends(s, m.qdot) || m.z->depends(s, m.qddot) || m.z->depends(s, q.now.e.lambda);
    });
}

/// Whether the initial state has what the claims assume: only then does its branch decide.
bool starts_where_assumed(Comparison& now) {
    return std::all_of(now.assumed.begin(), now.assumed.end(),
                       [&](const ex& positive) { return now.own_motion.is_positive_at_start(positive); });
}

CheckedClaim proved_where(const std::vector<std::string>& where, double failure) {
    CheckedClaim c = proved(failure);
    for (const std::string& words : where) c.assumed.push_back({Assumption::Kind::branch, words});
    return c;
}

/// A claim with roots that holds at every exact state for some choice of their signs, and on the scene's own
/// branch with the signs that roots have in numbers: of the factors of a product that is zero this one is.
std::optional<CheckedClaim> with_signs_of_own_branch(Question& q) {
    Comparison& now = q.now;
    ExactStates& states = q.here();
    double failure = 0;
    if (!holds_on_own_branch(now, states.motions, q.program(), q.root()) ||
        vanishes_with_some_signs(states, q.program(), q.root(), failure) != true)
        return std::nullopt;
    std::vector<std::string> where;
    for (const ex& square : squares_in(q.form().residual, now.m)) {
        const std::optional<ex> position = root_of_positions(square, now.m);
        if (!position) continue;
        const bool is_positive = is_positive_on_own_branch(now, states.motions, *position);
        const std::string words = inequality(is_positive ? *position : (-*position).expand(), now.m);
        if (std::find(where.begin(), where.end(), words) == where.end()) where.push_back(words);
    }
    if (where.empty())
        if (const std::optional<RootForm> form = root_form(q.form().residual, now.m))
            where.push_back(inequality(form->root, now.m));
    if (where.empty()) where.push_back(say("the roots have the signs of the initial state"));
    return proved_where(where, failure);
}

/// A claim with a root that holds for one of the root's signs at every state: that of the initial state.
std::optional<CheckedClaim> with_one_root(Question& q) {
    const std::optional<RootForm> form = root_form(q.form().residual, q.now.m);
    if (!form) return std::nullopt;
    Program p;
    const int norm = q.now.claims.lower(p, {form->norm})[0];
    double failure = 0;
    if (!p.is_zero(norm) && vanishes_at(q.here(), p, norm, failure) != true) return std::nullopt;
    if (!q.now.own_motion.is_positive_at_start(form->root)) return std::nullopt;
    CheckedClaim c = proved_where({inequality(form->root, q.now.m)}, failure);
    c.normal_form = p.is_zero(norm);
    return c;
}

}  // namespace

/// A claim that a sum of angles is zero, as q1 = q2 does, where that sum is a number of whole turns on every
/// motion. It changes by none along a branch, so that the initial state decides.
std::optional<CheckedClaim> by_whole_turns(Question& q) {
    const Motions& motions = q.here().motions;
    if (q.is_zero() != false || q.now.at != Claim::At::motion || !motions.own() ||
        !is_sum_of_variables(q.program(), q.root()) || (q.is_of_own_branch() && &q.here() != q.now.on_own_branch))
        return std::nullopt;
    Program p;
    const int turns = q.now.claims.lower(p, {1 - cos(q.form().residual)})[0];
    double failure = 0, failure_elsewhere = 0;
    if (vanishes_at(q.here(), p, turns, failure) != true ||
        !holds_on_own_branch(q.now, motions, q.program(), q.root()))
        return std::nullopt;
    if (&q.here() == q.together.states || vanishes_at(*q.together.states, p, turns, failure_elsewhere) == true)
        return proved(failure);
    return with_other_branch(q, proved(failure), p, turns, Verdict::refuted);
}

std::optional<CheckedClaim> at_states_of_own_branch(Question& q) {
    if (!q.is_of_own_branch() || &q.here() != q.now.on_own_branch) return std::nullopt;
    double failure = 0;
    if (vanishes_at(q.here(), q.program(), q.root(), failure) != true || has_arcs(q.program(), q.root()))
        return std::nullopt;
    if (depends_on_sides(q.program(), {q.root()}) &&
        in_numbers(told(q.now), q.here().motions, q.program(), q.root()) != InNumbers::holds)
        return std::nullopt;
    return with_other_branch(q, proved(failure), Verdict::refuted);
}

std::optional<bool> holds_by_digits(Question& q) {
    const Motions& motions = q.together.states->motions;
    if (q.now.at != Claim::At::motion || !motions.own() || motions.has_sides() ||
        !motions.rows_with_friction().empty() || !q.now.spoken.empty() || !q.form().open.empty() ||
        !is_smooth(q.program(), q.root()))
        return std::nullopt;
    const InNumbers seen = in_many_digits(told(q.now), motions, q.program(), q.root());
    return seen == InNumbers::unknown ? std::nullopt : std::optional(seen == InNumbers::holds);
}

std::optional<CheckedClaim> by_digits(Question& q) {
    if (!q.is_of_own_branch() || holds_by_digits(q) != true) return std::nullopt;
    return with_other_branch(q, proved(failure_of_digits), Verdict::refuted);
}

std::optional<CheckedClaim> on_own_sheet(Question& q) {
    if (q.now.at != Claim::At::motion || has_roots_of_rates(q) || !starts_where_assumed(q.now))
        return std::nullopt;
    auto found = with_signs_of_own_branch(q);
    if (!found) found = with_one_root(q);
    if (found && !q.is_of_own_branch()) found->reason = say("on the branch of the initial state");
    return found;
}

std::optional<CheckedClaim> by_a_state(Question& q) {
    Comparison& now = q.now;
    const bool has_sides = depends_on_sides(q.program(), {q.root()}), is_own = q.is_of_own_branch();
    if (!is_own && q.is_zero() == false && !has_sides &&
        holds_on_own_branch(now, q.together.states->motions, q.program(), q.root()))
        return undecided(
            say("it differs in exact arithmetic, but no state near the initial one was found at which it fails"));
    const Motions& motions = is_own ? now.on_own_branch->motions : q.together.states->motions;
    Told of = told(now);  // |a| = |3 b| may fail on another branch, without signs that exact arithmetic knows
    of.on_own_branch = of.on_own_branch || (has_sides && has_branches(now));
    if (const auto shown = counterexample(of, motions, q.program(), q.root())) {
        // Repairs are compared in the arithmetic that was wrong where it is zero.
        if (q.is_zero() == false || !motions.rows_with_friction().empty()) q.explained_at = &q.here();
        if (is_own && !has_sides && holds_somewhere(q))
            return with_other_branch(q, refuted(*shown), Verdict::proved);
        return refuted(*shown);
    }
    // Exact arithmetic does not know every identity; nothing is called wrong without a state at which it fails.
    if (!is_own)
        return undecided(
            say("it differs in exact arithmetic, and no state in numbers was found at which it fails"));
    return undecided(
        q.together.states->motions.loose().empty()
            ? say("it fails on a branch of the constraints, and it could not be decided whether it holds on that "
                  "of "
                  "the initial state")
            : say("the constraints cannot be solved exactly one after the other; no state was found at which it "
                  "fails"));
}

namespace {

/// Whether the scene's own motion has a word in it. What letters leave open, and what is told of an impact, is
/// read otherwise there.
bool is_about_own_motion(const Question& q) {
    return (q.now.at == Claim::At::motion || q.now.at == Claim::At::rest) && !q.found.up_to &&
           !q.now.is_any_motion && !q.form().third && !speaks_of_letters(q.now, q.claim);
}

}  // namespace

/// Where the claim holds on a side or a branch only, at the initial state.
std::optional<CheckedClaim> along_own_motion(Question& q) {
    if (!is_about_own_motion(q)) return std::nullopt;
    Comparison& now = q.now;
    const ex& residual = q.form().residual;
    std::optional<OwnMotion::Failure> found;
    if (now.at == Claim::At::motion)
        found = now.own_motion.fails(residual, now.positive);
    else if (const auto at_rest = now.own_motion.fails_at_rest(residual); at_rest && now.assumed.empty())
        found = {.state = *at_rest};
    const bool has_sides = std::any_of(q.found.assumed.begin(), q.found.assumed.end(), [](const Assumption& one) {
        return one.kind == Assumption::Kind::side || one.kind == Assumption::Kind::branch;
    });
    if (!found || (has_sides && !found->at_start)) return std::nullopt;
    CheckedClaim c = refuted(found->state);
    c.reason = found->at_start ? say("it fails at the initial state of the scene")
                               : say("it fails along the motion of the scene");
    return c;
}

/// Branches of constraints whose numbers the prime field lacks, such as x = √3 y, are not seen in exact
/// arithmetic, and the scene may be on one of them.
std::optional<CheckedClaim> in_numbers_on_own_branch(Question& q) {
    Comparison& now = q.now;
    const bool has_states = q.together.states != nullptr && q.together.states->get(0) != nullptr;
    if (!has_states || q.together.combinations.contains(q.claim) || !is_about_own_motion(q) ||
        now.at != Claim::At::motion || !now.assumed.empty() || !q.form().open.empty())
        return std::nullopt;
    const Motions& motions = q.together.states->motions;
    if (!motions.own() || (!motions.has_branches() && motions.loose().empty())) return std::nullopt;
    const Told own = told_on_own_branch(now);
    if (in_numbers(own, motions, q.program(), q.root()) != InNumbers::fails) return std::nullopt;
    const auto shown = counterexample(own, motions, q.program(), q.root());
    CheckedClaim c = shown ? refuted(*shown) : CheckedClaim();
    c.reason = say("it fails on the branch of the constraints to which the initial state belongs");
    return c;
}

}  // namespace alembert
