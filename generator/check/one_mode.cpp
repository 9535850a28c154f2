// SPDX-License-Identifier: GPL-2.0-or-later
// A claim r(q, q', q'', λ, t) = 0 is right if r vanishes on every motion (check/vanishing.hpp).
#include "check/one_mode.hpp"

#include <algorithm>

#include "analysis/derive/derive.hpp"
#include "analysis/state/force_balance.hpp"
#include "base/language/say.hpp"
#include "check/any_motion.hpp"
#include "check/arithmetic_error.hpp"
#include "check/claim_tree.hpp"
#include "check/closed_claim.hpp"
#include "check/combinations.hpp"
#include "check/completeness.hpp"
#include "check/constants.hpp"
#include "check/first_order.hpp"
#include "check/in_print.hpp"
#include "check/kinematic.hpp"
#include "check/open_claims.hpp"
#include "check/solution.hpp"
#include "model/energy.hpp"
#include "model/formalism/driven.hpp"
#include "model/formalism/needs.hpp"

namespace alembert {

using GiNaC::ex;
using GiNaC::numeric;

Scene with_some_claims(Scene scene, const std::vector<std::size_t>& claims) {
    std::vector<Claim> some;
    for (const std::size_t k : claims) some.push_back(std::move(scene.claims[k]));
    scene.claims = std::move(some);
    return scene;
}

namespace {

/// The e of √e², of which arithmetic leaves e: its value has a meaning only where e ≥ 0.
void collect_squared_roots(const Tree& tree, std::vector<const Tree*>& to) {
    const auto is_root = [](const Tree& one) { return one.kind == Tree::Kind::call && one.text == "sqrt"; };
    if (tree.kind == Tree::Kind::power && is_root(*tree.args[0])) to.push_back(tree.args[0]->args[0].get());
    if (tree.kind == Tree::Kind::product)
        for (std::size_t i = 0; i < tree.args.size(); ++i)
            for (std::size_t k = 0; k < i; ++k)
                if (is_root(*tree.args[i]) && is_root(*tree.args[k]))
                    to.push_back(tree.args[i]->args[0].get()), to.push_back(tree.args[k]->args[0].get());
    for (const TreePtr& arg : tree.args) collect_squared_roots(*arg, to);
}

/// The claims of a scene that are compared with one basis.
class Judging {
public:
    Judging(const Scene& scene, Basis& basis, const std::shared_ptr<RootSheets>& sheets, const PrintedNames& names)
        : claims_(scene, basis.mechanism, basis.equations, sheets, names),
          sheets_(sheets),
          now_{.scene = scene, .basis = basis, .m = basis.mechanism, .e = basis.equations, .claims = claims_} {
        claims_.count_rates_from(basis.driven);
    }

    Checked run() {
        now_.verdicts.resize(now_.scene.claims.size());
        read();
        for (const Claim::At at : {Claim::At::motion, Claim::At::rest, Claim::At::impact}) {
            now_.at = at;
            std::vector<std::size_t> here;
            for (std::size_t k = 0; k < now_.forms.size(); ++k)
                if (now_.scene.claims[k].at == at && !has_no_value(k)) here.push_back(k);
            if (here.empty()) continue;
            if (at == Claim::At::impact && !claims_.after_impact())
                for (const std::size_t k : here) now_.verdicts[k].reason = claims_.impact_obstacle();
            else  // the rates after an impact have become expressions in the variables of any state of motion
                while (!here.empty()) {
                    const std::vector<std::size_t> spoken = undetermined_in(here.front());
                    std::vector<std::size_t> part = here;
                    std::erase_if(part, [&](std::size_t k) { return undetermined_in(k) != spoken; });
                    std::erase_if(here, [&](std::size_t k) { return undetermined_in(k) == spoken; });
                    now_.is_any_motion = !has_masses() && spoken.empty();
                    now_.law =
                        now_.is_any_motion ? any_motion(now_.e, now_.m) : now_.basis.with_multipliers(spoken);
                    now_.spoken = spoken;
                    now_.known = &now_.basis.terms(spoken, now_.is_any_motion);
                    settle(part, at == Claim::At::rest ? Motions::At::rest : Motions::At::motion);
                }
        }
        constants_->withdraw(now_.scene, now_.verdicts);
        tell_kinematics(now_);
        settle_apart();
        for (std::size_t k = 0; k < now_.verdicts.size(); ++k) {
            std::vector<Assumption> assumed = assumptions(k);
            std::vector<Assumption>& list = now_.verdicts[k].assumed;
            list.insert(list.begin(), assumed.begin(), assumed.end());
        }
        const auto [is_complete, missing, freedom] = of_right_claims();
        return {
            .claims = std::move(now_.verdicts), .complete = is_complete, .missing = missing, .freedom = freedom};
    }

private:
    void read() {
        std::vector<Diagnostic> mistakes;
        const std::vector<ex> of_scene = sheets_ ? sheets_->positive() : std::vector<ex>();
        positive_.assign(now_.scene.claims.size(), of_scene);
        domain_.resize(now_.scene.claims.size());
        assume();
        for (const Claim& claim : now_.scene.claims) try {
                now_.forms.emplace_back();
                if (sheets_) sheets_->take_needed();
                now_.forms.back() = claims_.read(claim);
                if (sheets_)
                    for (ex& needed : sheets_->take_needed())
                        add_positive(now_.forms.size() - 1, std::move(needed));
                read_domain(claim);
                Program p;
                claims_.lower(p, {now_.forms.back().residual});
            } catch (const SceneMistake& mistake) {
                mistakes.push_back(mistake.diagnostic);
            } catch (const std::exception&) {
                now_.verdicts[now_.forms.size() - 1].reason = words_of_arithmetic_error();
                now_.forms.back() = {};
            }
        if (!mistakes.empty()) fail(now_.scene, mistakes);
        constants_.emplace(now_.scene, claims_, now_.forms);
    }

    void read_domain(const Claim& claim) {
        std::vector<const Tree*> arguments;
        for (const Expression* const side : {&claim.equation.lhs, &claim.equation.rhs})
            collect_squared_roots(*side->tree, arguments);
        std::vector<ex>& domain = domain_[now_.forms.size() - 1];
        for (const Tree* const argument : arguments)
            if (claim.at != Claim::At::impact) domain.push_back(claims_.read(expression_of(*argument)));
        if (sheets_) sheets_->take_needed();
    }

    /// Reads what the claims assume, which is the same for all of one mode.
    void assume() {
        if (now_.scene.claims.empty()) return;
        if (sheets_) sheets_->take_needed();
        for (const Inequality& assumed : now_.scene.claims[0].where)
            now_.assumed.push_back(claims_.read(assumed.greater) - claims_.read(assumed.less));
        if (!sheets_) return;
        for (const ex& needed : sheets_->take_needed())
            for (std::size_t k = 0; k < positive_.size(); ++k) add_positive(k, needed);
        std::vector<ex> supposed;
        for (const ex& assumed : now_.assumed) supposed.push_back(now_.m.z->expand(assumed));
        sheets_->suppose(std::move(supposed));
    }

    /// What the verdict on a claim rests on, but for branches that were found on the way.
    std::vector<Assumption> assumptions(std::size_t claim) const {
        using Kind = Assumption::Kind;
        std::vector<Assumption> result;
        std::vector<GiNaC::symbol> moving = now_.m.moving();
        moving.push_back(now_.m.t);
        for (const ex& positive : positive_[claim])
            result.push_back({now_.m.z->depends(positive, moving) ? Kind::side : Kind::parameter,
                              inequality(positive, now_.m)});
        for (const Inequality& stated : now_.scene.claims[claim].where)
            result.push_back({Kind::stated, text_of(stated)});
        if (now_.verdicts[claim].other_branch)
            result.push_back(
                {Kind::branch, say("the branch of the constraints on which the scene starts"), false});
        if (now_.scene.claims[claim].at == Claim::At::impact)
            for (std::size_t i = 0; i < now_.m.q.size(); ++i)
                result.push_back(
                    {Kind::pose,
                     now_.m.q[i].get_name() + " = " + in_print(now_.m.z->expand(now_.m.q_start[i]), now_.m),
                     false});
        return result;
    }

    void add_positive(std::size_t claim, ex needed) {
        std::vector<ex>& list = positive_[claim];
        if (std::none_of(list.begin(), list.end(),
                         [&](const ex& known) { return (known - needed).expand().is_zero(); }))
            list.push_back(std::move(needed));
    }

    /// From now on the sheet is that of these claims: a claim alone is not judged by what another one needs.
    void compare_on_sheet_of(const std::vector<std::size_t>& claims) {
        now_.positive = now_.assumed;
        for (const std::size_t k : claims)
            for (const std::vector<ex>* const list : {&positive_[k], &domain_[k]})
                for (const ex& positive : *list)
                    if (std::none_of(now_.positive.begin(), now_.positive.end(),
                                     [&](const ex& known) { return (known - positive).expand().is_zero(); }))
                        now_.positive.push_back(positive);
    }

    /// Whether the claim's own arithmetic fails, so that there is nothing to compare.
    bool has_no_value(std::size_t claim) const { return !now_.verdicts[claim].reason.empty(); }

    /// Claims that need no states: motions in closed form, first approximations.
    void settle_apart() {
        std::vector<std::size_t> solution;
        for (std::size_t k = 0; k < now_.forms.size(); ++k) {
            if (has_no_value(k)) continue;
            if (now_.scene.claims[k].at == Claim::At::solution) solution.push_back(k);
            if (now_.scene.claims[k].at == Claim::At::near)
                check_first_order(now_.scene.claims[k], claims_, now_.verdicts[k]);
        }
        if (!solution.empty()) check_solution(now_.scene, claims_, solution, now_.verdicts);
    }

    /// The constraints of Mechanism::undetermined() whose multipliers the claim contains. A claim with a contact's
    /// multiplier must hold for any value of it; a claim without it is about the motion while the gap is open.
    /// Constraints that follow from others have their shares of least norm.
    std::vector<std::size_t> undetermined_in(std::size_t claim) const {
        std::vector<std::size_t> result;
        const auto all = now_.m.undetermined();
        for (std::size_t k = 0; k < all.size(); ++k)
            if (k >= now_.m.unilateral.size() ||
                now_.m.z->depends(now_.forms[claim].residual, {all[k]->multiplier}))
                result.push_back(k);
        return result;
    }

    bool has_masses() const { return !now_.m.kinetic.empty() || now_.m.given_lagrangian; }

    /// With holonomic constraints as they are at the pose where the scene starts: what of it is known in numbers
    /// only obeys them.
    Mechanism struck() {
        Mechanism result = now_.m;
        const GiNaC::exmap& pose = claims_.after_impact()->pose;
        for (auto* constraints : {&result.constraints, &result.redundant})
            for (Mechanism::Constraint& c : *constraints) {
                if (!c.position) continue;
                const ex here = now_.m.z->expand(*c.position).subs(pose, GiNaC::subs_options::no_pattern).expand();
                const bool holds = GiNaC::is_a<numeric>(here) || is_identically_zero(here, now_.m);
                c.position = holds ? std::nullopt : std::optional(now_.m.z->name(here));
            }
        return result;
    }

    /// Whether the constraints have branches, and the claims are about the motion on the scene's own.
    bool knows_own_branch() const { return now_.at == Claim::At::motion && now_.basis.own_branch().has_value(); }

    /// The states of that kind, shared by all claims unless the claims assume something, or are about an impact,
    /// which has a mechanism of its own; `made` then keeps them.
    ExactStates& states_for(const Basis::Wanted& wanted, std::unique_ptr<ExactStates>& made) {
        if (now_.at != Claim::At::impact && now_.assumed.empty()) return now_.basis.states(wanted);
        made = now_.basis.own_states(wanted, now_.at == Claim::At::impact ? struck() : now_.m);
        if (!now_.assumed.empty()) keep_assumed(*made);
        return *made;
    }

    /// Whether each of the claims has a value at one of the first states.
    bool can_be_evaluated(const std::vector<std::size_t>& claims, ExactStates& states) const {
        constexpr std::size_t tries = 24;
        return std::all_of(claims.begin(), claims.end(), [&](std::size_t k) {
            Program p;
            const std::vector<int> root = claims_.lower(p, {now_.forms[k].residual});
            for (std::size_t s = 0; s < tries && states.get(s) != nullptr; ++s)
                if (evaluate_mod(p, states.get(s)->point, root)) return true;
            return false;
        });
    }

    void settle(const std::vector<std::size_t>& asked, Motions::At at) {
        const bool is_bound = std::any_of(now_.m.constraints.begin(), now_.m.constraints.end(),
                                          [](const Mechanism::Constraint& c) { return c.position.has_value(); });
        const bool may_combine = at == Motions::At::rest || (now_.at == Claim::At::motion && is_bound);
        compare_on_sheet_of(asked);
        std::vector<std::size_t> here = may_combine ? without_combinations(now_, asked, at) : asked;
        if (here.empty()) return;
        const bool knows_own = knows_own_branch();
        std::unique_ptr<ExactStates> made, made_on_own_branch;
        // Angles in halves only where they occur: every halving doubles the degrees.
        const int halvings = halvings_in(now_, here);
        const auto usable = [&](bool stays, int most_halves, std::unique_ptr<ExactStates>& kept) {
            ExactStates* found = nullptr;
            for (int halves = 0; halves <= most_halves; ++halves) {
                found = &states_for({.spoken = now_.spoken,
                                     .is_any_motion = now_.is_any_motion,
                                     .at = at,
                                     .halves = halves,
                                     .halvings = halvings,
                                     .knows_own_branch = knows_own,
                                     .stays_on_own_branch = stays},
                                    kept);
                if (halves < most_halves && found->get(0) != nullptr && can_be_evaluated(here, *found)) break;
            }
            return found;
        };
        constexpr int most_halves = 2;
        ExactStates* const states = usable(false, most_halves, made);
        if (states->get(0) == nullptr) {
            for (const std::size_t k : here) {
                CheckedClaim& c = now_.verdicts[k];
                if (at == Motions::At::rest && fails_in_numbers(k, states->motions)) continue;
                if (at == Motions::At::motion && settle_without_states(now_, k, states->motions)) continue;
                c.reason = !states->motions.obstacle().empty() ? states->motions.obstacle()
                           : at == Motions::At::rest
                               ? say("no state was found in which the equations allow rest")
                               : say("no state was found that obeys the constraints and has one acceleration");
            }
            return;
        }
        now_.on_own_branch = nullptr;
        if (knows_own && (states->motions.has_branches() || !states->motions.loose().empty()))
            now_.on_own_branch = usable(true, std::min(most_halves, std::max(halvings, states->motions.halves())),
                                        made_on_own_branch);
        std::erase_if(here, [&](std::size_t k) { return assumes_what_cannot_be(k, states->motions); });
        std::vector<std::size_t> open;
        for (const std::size_t k : here)
            if (now_.forms[k].open.empty())
                settle_alone(k, *states);
            else if (!states->motions.rows_with_friction().empty())
                now_.verdicts[k].reason =
                    say("it leaves names open, and the side that a constraint with friction presses is known in "
                        "numbers only");
            else if (states->motions.loose().empty())
                open.push_back(k);
            else
                now_.verdicts[k].reason =
                    say("the constraints cannot be solved one after the other, and it leaves names open");
        compare_on_sheet_of(open);
        settle_open_claims(now_, open, *states);
        now_.on_own_branch = nullptr;
    }

    /// What is assumed to be positive is a square in exact arithmetic, whose signs are Legendre's symbols.
    void keep_assumed(ExactStates& states) const {
        Program p;
        const std::vector<int> roots = claims_.lower(p, now_.assumed);
        states.keep_where(
            [p = std::move(p), roots](const ModularPoint& point) {
                const auto at = evaluate_mod(p, point, roots);
                return at && std::all_of(roots.begin(), roots.end(), [&](int root) {
                           return !at->value[root].is_zero() && at->value[root].is_square();
                       });
            },
            static_cast<double>(roots.size()));
    }

    /// Whether no state was found where all that the claim assumes is so; then it is not judged.
    bool assumes_what_cannot_be(std::size_t k, const Motions& motions) {
        if (now_.assumed.empty()) return false;
        compare_on_sheet_of({k});
        if (is_possible(told(now_), motions)) return false;
        now_.verdicts[k].reason = say("no state was found at which all that it assumes is so");
        return true;
    }

    /// Refutes a claim about rest by a state in numbers, where there are no exact states.
    bool fails_in_numbers(std::size_t k, const Motions& motions) {
        if (!now_.forms[k].open.empty()) return false;
        Program p;
        const int root = claims_.lower(p, {now_.forms[k].residual})[0];
        const auto shown = counterexample(told(now_), motions, p, root);
        if (shown) refute(now_.verdicts[k], *shown);
        return shown.has_value();
    }

    void settle_alone(std::size_t k, ExactStates& states) try {
        compare_on_sheet_of({k});
        settle_closed_claim(now_, k, states);
    } catch (const std::exception&) {
        now_.verdicts[k] = {};
        now_.verdicts[k].reason = words_of_arithmetic_error();
    }

    /// Do the claims of the motion that are right fix every acceleration?
    Completeness of_right_claims() const {
        std::vector<const ClaimForm*> right;
        for (std::size_t k = 0; k < now_.forms.size(); ++k) {
            const Verdict verdict = now_.verdicts[k].verdict;
            if (now_.scene.claims[k].at == Claim::At::motion &&
                (verdict == Verdict::proved || verdict == Verdict::vacuous))
                right.push_back(&now_.forms[k]);
        }
        return completeness(now_.basis, claims_, right);
    }

    Claims claims_;
    std::shared_ptr<RootSheets> sheets_;
    std::optional<GivenConstants> constants_;
    Comparison now_;
    std::vector<std::vector<ex>> positive_;  ///< what is positive on the sheet of each claim
    std::vector<std::vector<ex>> domain_;    ///< and where each has a meaning
};

}  // namespace

namespace {

/// The claims of a scene at rest, or all others.
std::vector<std::size_t> claims_at_rest(const Scene& scene, bool at_rest) {
    std::vector<std::size_t> result;
    for (std::size_t k = 0; k < scene.claims.size(); ++k)
        if ((scene.claims[k].at == Claim::At::rest) == at_rest) result.push_back(k);
    return result;
}

}  // namespace

OneMode::OneMode(Prepared mode, const std::string& by, std::optional<Equations> shown)
    : mode_(std::move(mode)), by_(by), shown_(std::move(shown)) {
    const Formalism& formalism = formalism_for(Need::multipliers);
    const bool is_known = shown_ && serves(*shown_, Need::multipliers, mode_.mechanism);
    Balanced bound =
        with_force_balances(mode_.mechanism, formalism.derive, is_known ? shown_ : std::optional<Equations>());
    moving_.emplace(bound.mechanism, std::move(bound.equations));
}

Basis& OneMode::resting() {
    if (!std::exchange(has_looked_for_driven_, true))
        if (const GiNaC::exmap driven = driven_rates(moving_->mechanism); !driven.empty()) {
            Equations equations = moving_->equations;
            equations.z = moving_->mechanism.z;
            resting_.emplace(counted_from(moving_->mechanism, driven), counted_from(std::move(equations), driven),
                             driven);
        }
    return resting_ ? *resting_ : *moving_;
}

const PrintedNames& OneMode::printed() {
    if (printed_) return *printed_;
    Derived derived{mode_};
    derived.by = by_;
    if (shown_)
        derived.equations = *shown_;
    else
        derived = derived_again(derived, mode_.mechanism, by_);
    printed_ = printed_names(explained(std::move(derived)).shown);
    return *printed_;
}

Checked OneMode::check(const Scene& scene, const std::shared_ptr<RootSheets>& sheets) {
    const std::vector<std::size_t> resting_ones = claims_at_rest(scene, true),
                                   others = claims_at_rest(scene, false);
    PrintedNames names = speaks_of_printed_names(scene) ? printed() : PrintedNames();
    for (auto& reaction : reaction_names(scene)) names.push_back(std::move(reaction));
    if (resting_ones.empty() || &resting() == &*moving_) return Judging(scene, *moving_, sheets, names).run();
    Checked result{.claims = std::vector<CheckedClaim>(scene.claims.size())};
    const auto take = [&](const std::vector<std::size_t>& which, Checked checked) {
        for (std::size_t i = 0; i < which.size(); ++i) result.claims[which[i]] = std::move(checked.claims[i]);
        if (result.complete) return;
        result.complete = checked.complete;
        if (result.freedom == 0 || checked.complete)
            result.missing = checked.missing, result.freedom = checked.freedom;
    };
    const Scene moving = with_some_claims(scene, others), at_rest = with_some_claims(scene, resting_ones);
    if (!others.empty()) take(others, Judging(moving, *moving_, sheets, names).run());
    take(resting_ones, Judging(at_rest, resting(), sheets, names).run());
    return result;
}

}  // namespace alembert
