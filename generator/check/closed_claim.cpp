// SPDX-License-Identifier: GPL-2.0-or-later
#include "check/closed_claim.hpp"

#include <algorithm>
#include <array>

#include "analysis/exact/angle_sum.hpp"
#include "base/language/say.hpp"
#include "check/in_cells.hpp"
#include "check/in_print.hpp"
#include "check/multiple.hpp"
#include "check/quantities.hpp"
#include "check/root_form.hpp"
#include "check/speaks_of_scene.hpp"
#include "check/vanishing.hpp"
#include "model/energy.hpp"

namespace alembert {

namespace {

/// What numbers say of a claim that vanishes in exact arithmetic, if they are asked: where signs decide in the
/// claim, or in the equations, with which it can be compared if states are found.
InNumbers seen_in_numbers(Comparison& now, const Motions& motions, const Program& p, int root) {
    if (!motions.rows_with_friction().empty())
        return hold_in_numbers(told(now), motions, p, {root})[0] ? InNumbers::holds : InNumbers::fails;
    if (depends_on_sides(p, {root}) || has_long_numbers(p, {root})) return in_numbers(told(now), motions, p, root);
    // The prime field lacks some roots of the equations of rest, as √3.
    if (motions.where() == Motions::At::rest)
        return in_numbers(told(now), motions, p, root) == InNumbers::fails ? InNumbers::fails : InNumbers::holds;
    std::vector<int> entries = motions.entries().M;
    for (const auto* part :
         {&motions.entries().f, &motions.entries().A, &motions.entries().offset, &motions.entries().gamma})
        entries.insert(entries.end(), part->begin(), part->end());
    const bool may_fail =
        depends_on_sides(motions.program(), entries) || has_long_numbers(motions.program(), entries);
    const bool fails = may_fail && in_numbers(told(now), motions, p, root) == InNumbers::fails;
    return fails ? InNumbers::fails : InNumbers::holds;
}

/// A claim that holds with other signs of the multipliers of friction, and in numbers, has the right ones.
bool holds_with_signs_turned(Comparison& now, std::size_t k, const ExactStates& states, const Program& p,
                             int root) {
    const unsigned choices = 1U << states.motions.rows_with_friction().size();
    for (unsigned turned = 1; turned < choices; ++turned) {
        ExactStates others(
            now.m, now.law,
            {.at = states.motions.where(), .halves = states.motions.halves(), .halvings = halvings_in(now, {k})},
            turned);
        if (vanishes_at(others, p, root, now.verdicts[k].failure) == std::optional(true) &&
            hold_in_numbers(told(now), states.motions, p, {root})[0])
            return true;
    }
    return false;
}

/// Whether `value` is positive on the scene's own branch: at all of several states of it, or at the initial state.
bool is_positive_on_own_branch(Comparison& now, const Motions& motions, const GiNaC::ex& value) {
    Program p;
    const int root = now.claims.lower(p, {value})[0];
    const std::optional<int> sign = sign_on_own_branch(told(now), motions, p, root);
    return sign ? *sign > 0 : now.own_motion.is_positive_at_start(value);
}

/// What numbers say, where the motions know the scene's own branch.
bool holds_on_own_branch(Comparison& now, const Motions& motions, const Program& p, int root) {
    if (now.at != Claim::At::motion || !motions.own()) return false;
    Told own = told(now);
    own.on_own_branch = true;
    return in_numbers(own, motions, p, root) == InNumbers::holds;
}

/// A claim with roots that holds at every exact state for some choice of their signs, and on the scene's own
/// branch with the signs that roots have in numbers: of the factors of a product that is zero this one is.
std::optional<std::vector<std::string>> sheet_on_own_branch(Comparison& now, std::size_t k, ExactStates& states) {
    Program p;
    const int root = now.claims.lower(p, {now.forms[k].residual})[0];
    double failure = 0;
    if (!holds_on_own_branch(now, states.motions, p, root) ||
        vanishes_with_some_signs(states, p, root, failure) != true)
        return std::nullopt;
    std::vector<std::string> where;
    for (const GiNaC::ex& square : squares_in(now.forms[k].residual, now.m)) {
        const std::optional<GiNaC::ex> position = root_of_positions(square, now.m);
        if (!position) continue;
        const bool is_positive = is_positive_on_own_branch(now, states.motions, *position);
        const std::string words = inequality(is_positive ? *position : (-*position).expand(), now.m);
        if (std::find(where.begin(), where.end(), words) == where.end()) where.push_back(words);
    }
    if (where.empty())
        if (const std::optional<RootForm> form = root_form(now.forms[k].residual, now.m))
            where.push_back(inequality(form->root, now.m));
    if (where.empty()) where.push_back(say("the roots have the signs of the initial state"));
    now.verdicts[k].failure = failure;
    return where;
}

/// Whether roots are taken of what changes with rates: no length, whose sign the initial state would tell.
bool has_roots_of_rates(const Comparison& now, std::size_t k) {
    const std::vector<GiNaC::ex> squares = squares_in(now.forms[k].residual, now.m);
    return std::any_of(squares.begin(), squares.end(), [&](const GiNaC::ex& s) {
        return now.m.z->depends(s, now.m.qdot) || now.m.z->depends(s, now.m.qddot) ||
               now.m.z->depends(s, now.e.lambda);
    });
}

/// Whether the initial state has what the claims assume: only then does its branch decide.
bool starts_where_assumed(Comparison& now) {
    return std::all_of(now.assumed.begin(), now.assumed.end(),
                       [&](const GiNaC::ex& positive) { return now.own_motion.is_positive_at_start(positive); });
}

/// A claim with a root that holds for one of the root's signs at every state: that of the initial state's
/// branch.
std::optional<std::vector<std::string>> branch_of(Comparison& now, std::size_t k, ExactStates& states) {
    if (now.at != Claim::At::motion || has_roots_of_rates(now, k) || !starts_where_assumed(now))
        return std::nullopt;
    if (auto sheet = sheet_on_own_branch(now, k, states)) return sheet;
    const std::optional<RootForm> form = root_form(now.forms[k].residual, now.m);
    if (!form) return std::nullopt;
    Program p;
    const int norm = now.claims.lower(p, {form->norm})[0];
    double failure = 0;
    if (!p.is_zero(norm) && vanishes_at(states, p, norm, failure) != std::optional(true)) return std::nullopt;
    if (!now.own_motion.is_positive_at_start(form->root)) return std::nullopt;
    now.verdicts[k].failure = failure;
    now.verdicts[k].normal_form = p.is_zero(norm);
    return std::vector<std::string>{inequality(form->root, now.m)};
}

/// Tells where another branch decides otherwise.
void tell_other_branch(Comparison& now, std::size_t k, const Motions& motions, const Program& p, int root,
                       Verdict there) {
    OtherBranch other{.verdict = there};
    if (auto found = state_where(told(now), motions, p, root, there == Verdict::proved)) {
        other.where = std::move(found->where);
        if (there == Verdict::refuted) other.counterexample = std::move(found->values);
    }
    now.verdicts[k].other_branch = std::move(other);
}

/// Does the claim hold at one of the first states, on any branch?
bool holds_somewhere(ExactStates& states, const Program& p, int root) {
    constexpr std::size_t enough = 32;
    for (std::size_t s = 0; s < enough && states.get(s) != nullptr; ++s)
        if (const auto at = evaluate_mod(p, states.get(s)->point, std::array{root});
            at && at->value[root].is_zero())
            return true;
    return false;
}

/// Whether the claim says that a sum of angles is zero, as q1 = q2 does, and that sum is a number of whole turns
/// on every motion. It changes by none along a branch, so that the initial state decides.
bool is_whole_turns(Comparison& now, std::size_t k, const Motions& motions, ExactStates& states) {
    if (now.at != Claim::At::motion || !motions.own()) return false;
    Program p;
    const std::vector<int> roots = now.claims.lower(p, {now.forms[k].residual, 1 - cos(now.forms[k].residual)});
    if (!is_sum_of_variables(p, roots[0])) return false;
    return vanishes_at(states, p, roots[1], now.verdicts[k].failure) == true &&
           holds_on_own_branch(now, motions, p, roots[0]);
}

/// Whether what exact arithmetic has no states for holds on the scene's own branch by its digits; nothing if these
/// do not tell. A smooth function that is zero near a state of a branch is zero on all of it.
std::optional<bool> holds_by_digits(Comparison& now, std::size_t k, const Motions& motions) {
    if (now.at != Claim::At::motion || !motions.own() || motions.has_sides() ||
        !motions.rows_with_friction().empty() || !now.spoken.empty() || !now.forms[k].open.empty())
        return std::nullopt;
    Program p;
    const int root = now.claims.lower(p, {now.forms[k].residual})[0];
    if (!is_smooth(p, root)) return std::nullopt;
    const InNumbers told_by_digits = in_many_digits(told(now), motions, p, root);
    return told_by_digits == InNumbers::unknown ? std::nullopt : std::optional(told_by_digits == InNumbers::holds);
}

void assume_branch(CheckedClaim& c, const std::vector<std::string>& where) {
    for (const std::string& words : where) c.assumed.push_back({Assumption::Kind::branch, words});
}

void prove_by_digits(CheckedClaim& c) {
    constexpr double failure = -60;  // three states of 2³⁰ numbers each, for a claim of a degree below 2¹⁰
    c.verdict = Verdict::proved;
    c.failure = failure;
}

/// Whether it holds values of asin or acos, whose sines and cosines are roots: y = l*sin(acos(x/l)) holds on one
/// half of a circle, in exact arithmetic too.
bool has_arcs(const Program& p, int root) {
    const std::vector<int> needed = p.needed(std::array{root});
    return std::any_of(needed.begin(), needed.end(), [&](int id) {
        return (p[id].op == Op::asin || p[id].op == Op::acos) && p[id].depends != 0;
    });
}

/// Of a claim that holds on one branch of the constraints and fails on another, the scene's own branch decides.
/// Returns whether it did.
bool settle_by_branch(Comparison& now, std::size_t k, ExactStates& states, const Program& p, int root) {
    CheckedClaim& c = now.verdicts[k];
    ExactStates& own = *now.on_own_branch;
    double failure = 0;
    if (own.get(0) != nullptr && is_whole_turns(now, k, own.motions, own)) {
        c.verdict = Verdict::proved;
        failure = c.failure;
        const bool is_so_everywhere = is_whole_turns(now, k, own.motions, states);
        c.failure = failure;
        if (!is_so_everywhere) {
            Program turns;
            const int turned = now.claims.lower(turns, {1 - cos(now.forms[k].residual)})[0];
            tell_other_branch(now, k, states.motions, turns, turned, Verdict::refuted);
        }
        return true;
    }
    const std::optional<bool> zero = own.get(0) != nullptr ? vanishes_at(own, p, root, failure) : std::nullopt;
    if (zero == true && !has_arcs(p, root)) {
        if (depends_on_sides(p, {root}) && in_numbers(told(now), own.motions, p, root) != InNumbers::holds)
            return false;
        c.verdict = Verdict::proved;
        c.failure = failure;
        tell_other_branch(now, k, states.motions, p, root, Verdict::refuted);
        return true;
    }
    if (holds_by_digits(now, k, states.motions) == true) {
        prove_by_digits(c);
        tell_other_branch(now, k, states.motions, p, root, Verdict::refuted);
        return true;
    }
    if (const auto sheet = branch_of(now, k, own.get(0) != nullptr ? own : states)) {
        c.verdict = Verdict::proved;
        assume_branch(c, *sheet);
        return true;
    }
    if (const auto shown = counterexample(told(now), own.motions, p, root)) {
        refute(c, *shown);
        explain(now, k, own.get(0) != nullptr ? own : states);
        if (!depends_on_sides(p, {root}) && holds_somewhere(states, p, root))
            tell_other_branch(now, k, states.motions, p, root, Verdict::proved);
        return true;
    }
    c.reason =
        states.motions.loose().empty()
            ? say("it fails on a branch of the constraints, and it could not be decided whether it holds on that "
                  "of "
                  "the initial state")
            : say("the constraints cannot be solved exactly one after the other; no state was found at which it "
                  "fails");
    return true;
}

}  // namespace

namespace {

void settle_as_it_stands(Comparison& now, std::size_t k, ExactStates& states);

/// Refutes a claim that fails along the motion of the scene; where the claim holds on a side or a branch only, at
/// its initial state.
bool fails_along_own_motion(Comparison& now, std::size_t k) {
    CheckedClaim& c = now.verdicts[k];
    const GiNaC::ex& residual = now.forms[k].residual;
    std::optional<OwnMotion::Failure> found;
    if (now.at == Claim::At::motion)
        found = now.own_motion.fails(residual, now.positive);
    else if (const auto at_rest = now.own_motion.fails_at_rest(residual); at_rest && now.assumed.empty())
        found = {.state = *at_rest};
    const bool has_sides = std::any_of(c.assumed.begin(), c.assumed.end(), [](const Assumption& one) {
        return one.kind == Assumption::Kind::side || one.kind == Assumption::Kind::branch;
    });
    if (!found || (has_sides && !found->at_start)) return false;
    c = {};
    refute(c, found->state);
    c.reason = found->at_start ? say("it fails at the initial state of the scene")
                               : say("it fails along the motion of the scene");
    return true;
}

/// What is proved holds on the scene's own branch in numbers, and along its own motion. Branches of constraints
/// whose numbers the prime field lacks, such as x = √3 y, are not seen in exact arithmetic, and the scene may be
/// on one of them.
void hold_against_own(Comparison& now, std::size_t k, const Motions& motions) {
    CheckedClaim& c = now.verdicts[k];
    if (c.verdict != Verdict::proved || c.up_to || now.at == Claim::At::impact || now.is_any_motion ||
        now.forms[k].third || speaks_of_letters(now, k))
        return;
    if (fails_along_own_motion(now, k) || !now.assumed.empty()) return;
    if (now.at != Claim::At::motion || !motions.own() || (!motions.has_branches() && motions.loose().empty()))
        return;
    Told own = told(now);
    own.on_own_branch = true;
    Program p;
    const int root = now.claims.lower(p, {now.forms[k].residual})[0];
    if (in_numbers(own, motions, p, root) != InNumbers::fails) return;
    const auto shown = counterexample(own, motions, p, root);
    c = {};
    c.reason = say("it fails on the branch of the constraints to which the initial state belongs");
    if (shown) refute(c, *shown);
}

}  // namespace

bool settle_without_states(Comparison& now, std::size_t k, const Motions& motions) {
    Program p;
    const int root = now.claims.lower(p, {now.forms[k].residual})[0];
    if (p.is_zero(root) || is_identity(p, root)) return false;
    const std::optional<bool> holds = holds_by_digits(now, k, motions);
    if (holds == true) prove_by_digits(now.verdicts[k]);
    if (holds == false) {
        Told own = told(now);
        own.on_own_branch = true;
        if (const auto shown = counterexample(own, motions, p, root)) refute(now.verdicts[k], *shown);
    }
    return now.verdicts[k].verdict != Verdict::undecided;
}

void settle_closed_claim(Comparison& now, std::size_t k, ExactStates& states) {
    LetterClaim claim(now, k, states);
    if (!claim.settle()) settle_as_it_stands(now, k, states);
    claim.tell();
    hold_against_own(now, k, states.motions);
}

namespace {

/// Whether the claim is the scene's own equation as it stands, whatever sides its functions have.
bool is_own_equation(Comparison& now, std::size_t k) {
    Program p;
    std::vector<GiNaC::ex> inertia;
    for (int i = 0; i < now.law.size(); ++i)
        for (int j = 0; j <= i; ++j) inertia.push_back(now.law.M(i, j));
    return !depends_on_sides(p, now.claims.lower(p, inertia)) &&
           is_multiple(now.forms[k].residual, now.m, now.law);
}

bool settle_in_cells(Comparison& now, std::size_t k, ExactStates& states) {
    ExactStates* const own = now.on_own_branch;
    InCells sided(now, k, own != nullptr && own->get(0) != nullptr ? *own : states);
    if (!sided.any()) return false;
    if (!is_own_equation(now, k)) return sided.settle();
    CheckedClaim& c = now.verdicts[k];
    c.verdict = Verdict::proved;
    c.normal_form = true;
    return true;
}

void settle_without_value(Comparison& now, std::size_t k, const Motions& motions, const Program& p, int root) {
    CheckedClaim& c = now.verdicts[k];
    if (has_long_numbers(p, {root}))  // a degree that is too high
        if (const auto shown = counterexample(told(now), motions, p, root)) return refute(c, *shown);
    c.reason = say(
        "it could not be evaluated: it divides by something that is zero on every motion, or its degree is too "
        "high");
}

void settle_as_it_stands(Comparison& now, std::size_t k, ExactStates& states) {
    CheckedClaim& c = now.verdicts[k];
    Program p;
    const int root = now.claims.lower(p, {now.forms[k].residual})[0];
    const bool is_of_scene =
        now.at == Claim::At::impact || now.forms[k].third || speaks_of_scene(now.scene.claims[k], now.m);
    if (p.is_zero(root) || (!is_of_scene && is_identity(p, root))) {
        c.verdict = is_of_scene ? Verdict::proved : Verdict::vacuous;
        c.normal_form = true;
        if (now.at != Claim::At::impact)
            c.reason = words_without_forces(now, k, say("it holds identically and says nothing of the motion"));
        return;
    }
    if (settle_in_cells(now, k, states)) return;
    const std::optional<bool> zero = vanishes_at(states, p, root, c.failure);
    if (!zero) return settle_without_value(now, k, states.motions, p, root);
    if (now.on_own_branch != nullptr && !*zero && settle_by_branch(now, k, states, p, root)) return;
    if (!*zero && is_whole_turns(now, k, states.motions, states)) {
        c.verdict = Verdict::proved;
        return;
    }
    const bool has_friction = !states.motions.rows_with_friction().empty();
    const InNumbers seen = *zero ? seen_in_numbers(now, states.motions, p, root) : InNumbers::fails;
    if (seen == InNumbers::unknown) {
        c.reason =
            say("it holds in exact arithmetic, which knows no order and may turn the signs of roots and absolute "
                "values, and too few states in numbers were found with which to compare it");
        return;
    }
    if (seen == InNumbers::holds) {
        if (!states.motions.loose().empty() && !hold_in_numbers(told(now), states.motions, p, {root})[0]) {
            c.reason =
                say("it holds wherever the constraints are constant, and no state was found at which they are "
                    "zero and the equations have one solution");
            return;
        }
        c.verdict = Verdict::proved;
        if (depends_on_shares(states, p, root))
            c.reason =
                say("it holds for the least reactions of constraints that depend on each other; other reactions "
                    "with the same effect would not obey it");
        c.normal_form = (now.at == Claim::At::motion && is_multiple(now.forms[k].residual, now.m, now.law)) ||
                        (now.at == Claim::At::impact && is_identically_zero(now.forms[k].residual, now.m));
        return;
    }
    if (has_friction && holds_with_signs_turned(now, k, states, p, root)) {
        c.verdict = Verdict::proved;
        return;
    }
    if (const auto branch = branch_of(now, k, states)) {
        c.verdict = Verdict::proved;
        assume_branch(c, *branch);
        c.reason = say("on the branch of the initial state");
        return;
    }
    if (!*zero && !depends_on_sides(p, {root}) && holds_on_own_branch(now, states.motions, p, root)) {
        c.reason =
            say("it differs in exact arithmetic, but no state near the initial one was found at which it fails");
        return;
    }
    Told of = told(now);  // |a| = |3 b| may fail on another branch, without signs that exact arithmetic knows
    of.on_own_branch = of.on_own_branch || (depends_on_sides(p, {root}) && has_branches(now));
    const auto shown = counterexample(of, states.motions, p, root);
    if (!shown) {  // exact arithmetic does not know every identity; nothing is called wrong without a state at
                   // which it fails
        c.reason = say("it differs in exact arithmetic, and no state in numbers was found at which it fails");
        return;
    }
    refute(c, *shown);
    if (!*zero || has_friction)
        explain(now, k, states);  // repairs are compared in the arithmetic that was wrong here
}

}  // namespace

}  // namespace alembert
