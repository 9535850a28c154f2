// SPDX-License-Identifier: GPL-2.0-or-later
#include "check/decide.hpp"

#include "base/language/say.hpp"
#include "check/arithmetic_error.hpp"
#include "check/multiple.hpp"
#include "check/quantities.hpp"
#include "check/speaks_of_scene.hpp"
#include "check/vanishing.hpp"
#include "check/ways.hpp"
#include "model/energy.hpp"

namespace alembert {

Question::Question(AskedTogether& of, std::size_t k, const ClaimForm& form)
    : now(of.now), together(of), claim(k), form_(form) {
    now.compare_on_sheet_of({k});
    lower();
}

void Question::lower() {
    program_ = {};
    root_ = now.claims.lower(program_, {form_.residual})[0];
    is_asked_ = false;
}

std::optional<bool> Question::is_zero() {
    if (!std::exchange(is_asked_, true)) zero_ = vanishes_at(*together.states, program_, root_, failure_);
    return zero_;
}

ExactStates& Question::here() {
    const bool has_own = is_of_own_branch() && now.on_own_branch->get(0) != nullptr;
    return has_own ? *now.on_own_branch : *together.states;
}

CheckedClaim proved(double failure) {
    CheckedClaim c;
    c.verdict = Verdict::proved;
    c.failure = failure;
    return c;
}

CheckedClaim refuted(const Counterexample& shown) {
    CheckedClaim c;
    c.verdict = Verdict::refuted;
    c.counterexample = shown.values;
    c.residual = shown.residual;
    c.residual_value = shown.residual_value;
    return c;
}

CheckedClaim undecided(std::string reason) {
    CheckedClaim c;
    c.reason = std::move(reason);
    return c;
}

namespace {

/// What numbers say of a claim that vanishes in exact arithmetic, if they are asked: where signs decide in the
/// claim, or in the equations, with which it can be compared if states are found.
InNumbers seen_in_numbers(const Question& q) {
    const Motions& motions = q.together.states->motions;
    const Told seen = told(q.now);
    const auto look = [&] { return in_numbers(seen, motions, q.program(), q.root()); };
    if (!motions.rows_with_friction().empty())
        return hold_in_numbers(seen, motions, q.program(), {q.root()})[0] ? InNumbers::holds : InNumbers::fails;
    if (depends_on_sides(q.program(), {q.root()}) || has_long_numbers(q.program(), {q.root()})) return look();
    std::vector<int> entries = motions.entries().M;
    for (const auto* part :
         {&motions.entries().f, &motions.entries().A, &motions.entries().offset, &motions.entries().gamma})
        entries.insert(entries.end(), part->begin(), part->end());
    // The prime field lacks some roots of the equations of rest, as √3.
    const bool may_fail = motions.where() == Motions::At::rest || depends_on_sides(motions.program(), entries) ||
                          has_long_numbers(motions.program(), entries);
    return may_fail && look() == InNumbers::fails ? InNumbers::fails : InNumbers::holds;
}

std::optional<CheckedClaim> as_a_combination(Question& q) {
    const auto known = q.together.combinations.find(q.claim);
    return known == q.together.combinations.end() ? std::nullopt : std::optional(known->second);
}

/// Where no exact states were found: a state in numbers refutes a claim about rest, and digits decide on the
/// scene's own branch.
std::optional<CheckedClaim> without_exact_states(Question& q) {
    if (q.together.states->get(0) != nullptr) return std::nullopt;
    const Motions& motions = q.together.states->motions;
    const bool is_rest = q.now.at == Claim::At::rest;
    if (is_rest && q.form().open.empty())
        if (const auto shown = counterexample(told(q.now), motions, q.program(), q.root())) return refuted(*shown);
    const bool says_nothing = q.program().is_zero(q.root()) || is_identity(q.program(), q.root());
    const std::optional<bool> holds = is_rest || says_nothing ? std::nullopt : holds_by_digits(q);
    if (holds == true) return proved(failure_of_digits);
    Told own = told(q.now);
    own.on_own_branch = true;
    if (holds == false)
        if (const auto shown = counterexample(own, motions, q.program(), q.root())) return refuted(*shown);
    if (!motions.obstacle().empty()) return undecided(motions.obstacle());
    return undecided(is_rest ? say("no state was found in which the equations allow rest")
                             : say("no state was found that obeys the constraints and has one acceleration"));
}

std::optional<CheckedClaim> beyond_what_can_be(Question& q) {
    if (q.now.assumed.empty() || is_possible(told(q.now), q.together.states->motions)) return std::nullopt;
    return undecided(say("no state was found at which all that it assumes is so"));
}

std::optional<CheckedClaim> as_an_identity(Question& q) {
    const bool is_of_scene =
        q.now.at == Claim::At::impact || q.form().third || speaks_of_scene(q.now.scene.claims[q.claim], q.now.m);
    const bool is_void = q.program().is_zero(q.root()) || (!is_of_scene && is_identity(q.program(), q.root()));
    if (!is_void) return std::nullopt;
    CheckedClaim c;
    c.verdict = is_of_scene ? Verdict::proved : Verdict::vacuous;
    c.normal_form = true;
    if (q.now.at != Claim::At::impact)
        c.reason =
            words_without_forces(q.now, q.claim, say("it holds identically and says nothing of the motion"));
    return c;
}

std::optional<CheckedClaim> without_value(Question& q) {
    if (q.is_zero()) return std::nullopt;
    if (has_long_numbers(q.program(), {q.root()}))  // a degree that is too high
        if (const auto shown = counterexample(told(q.now), q.together.states->motions, q.program(), q.root()))
            return refuted(*shown);
    return undecided(say(
        "it could not be evaluated: it divides by something that is zero on every motion, or its degree is too "
        "high"));
}

/// What vanishes in exact arithmetic, and in numbers where exact arithmetic may err.
std::optional<CheckedClaim> in_exact_arithmetic(Question& q) {
    if (q.is_zero() == false) return std::nullopt;
    Comparison& now = q.now;
    const Motions& motions = q.together.states->motions;
    const InNumbers seen = seen_in_numbers(q);
    if (seen == InNumbers::fails) return std::nullopt;
    if (seen == InNumbers::unknown)
        return undecided(
            say("it holds in exact arithmetic, which knows no order and may turn the signs of roots and absolute "
                "values, and too few states in numbers were found with which to compare it"));
    if (!motions.loose().empty() && !hold_in_numbers(told(now), motions, q.program(), {q.root()})[0])
        return undecided(
            say("it holds wherever the constraints are constant, and no state was found at which they are zero "
                "and the equations have one solution"));
    CheckedClaim c = proved(q.failure());
    if (depends_on_shares(*q.together.states, q.program(), q.root()))
        c.reason =
            say("it holds for the least reactions of constraints that depend on each other; other reactions "
                "with the same effect would not obey it");
    c.normal_form = (now.at == Claim::At::motion && is_multiple(q.form().residual, now.m, now.law)) ||
                    (now.at == Claim::At::impact && is_identically_zero(q.form().residual, now.m));
    return c;
}

/// A claim that holds with other signs of the multipliers of friction, and in numbers, has the right ones.
std::optional<CheckedClaim> with_signs_turned(Question& q) {
    const Motions& motions = q.together.states->motions;
    const unsigned choices = 1U << motions.rows_with_friction().size();
    for (unsigned turned = 1; turned < choices; ++turned) {
        ExactStates others(
            q.now.m, q.now.law,
            {.at = motions.where(), .halves = motions.halves(), .halvings = halvings_in(q.now, {q.claim})},
            turned);
        double failure = 0;
        if (vanishes_at(others, q.program(), q.root(), failure) == true &&
            hold_in_numbers(told(q.now), motions, q.program(), {q.root()})[0])
            return proved(failure);
    }
    return std::nullopt;
}

// Those before the states are for claims that need none; those after in_cells ask what exact arithmetic says.
constexpr Way ways[] = {
    to_first_order,
    along_a_solution,
    as_a_combination,
    without_exact_states,
    beyond_what_can_be,
    with_open_names,
    by_its_letters,
    as_an_identity,
    in_cells,
    without_value,
    in_exact_arithmetic,
    by_whole_turns,
    at_states_of_own_branch,
    by_digits,
    with_signs_turned,
    on_own_sheet,
    by_a_state,
};

/// Each finds that what is proved fails, or is not sure; nothing if it has no doubt.
constexpr Way doubts[] = {at_jumps, along_own_motion, in_numbers_on_own_branch};

CheckedClaim answer(AskedTogether& together, std::size_t claim) try {
    Question q(together, claim);
    for (const Way way : ways)
        if (auto found = way(q)) {
            q.found = std::move(*found);
            break;
        }
    if (q.explained_at != nullptr) explain(q);
    if (q.tell_last) q.tell_last();
    for (const Way doubt : doubts)
        if (q.found.verdict == Verdict::proved)
            if (auto found = doubt(q)) q.found = std::move(*found);
    return std::move(q.found);
} catch (const std::exception&) {
    return undecided(words_of_arithmetic_error());
}

}  // namespace

void decide(Comparison& now, const std::vector<std::size_t>& claims) {
    AskedTogether together(now, claims);
    for (const bool is_open : {false, true})  // what is left open is read with what the others say
        for (const std::size_t k : claims)
            if (now.forms[k].open.empty() != is_open) now.verdicts[k] = answer(together, k);
}

}  // namespace alembert
