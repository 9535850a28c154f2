// SPDX-License-Identifier: GPL-2.0-or-later
// A claim r(q, q', q'', λ, t) = 0 is right if r vanishes on every motion (check/vanishing.hpp).
#include "check/check.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "check/any_motion.hpp"
#include "check/claims.hpp"
#include "check/completeness.hpp"
#include "check/constants.hpp"
#include "check/counterexample.hpp"
#include "check/diagnosis.hpp"
#include "check/first_order.hpp"
#include "check/multiple.hpp"
#include "check/open_rows.hpp"
#include "check/root_form.hpp"
#include "check/solution.hpp"
#include "check/static_combination.hpp"
#include "check/vanishing.hpp"
#include "formalism/elements.hpp"
#include "formalism/routh.hpp"
#include "language/say.hpp"
#include "notation/readable.hpp"
#include "notation/text.hpp"
#include "scene/sticking.hpp"
#include "symbolic/fourier.hpp"

namespace alembert {

using GiNaC::ex;
using GiNaC::numeric;

namespace {

class Checker {
public:
    Checker(const Scene& scene, const Mechanism& m, const Equations& e, const std::shared_ptr<RootSheets>& sheets,
            const std::string& by)
        : scene_(scene), m_(m), e_(e), claims_(scene, m, e, sheets, by), sheets_(sheets) {}

    Checked run() {
        read();
        result_.claims.resize(forms_.size());
        for (const char* const when : {"motion", "rest", "impact"}) {
            when_ = when;
            std::vector<std::size_t> here;
            for (std::size_t k = 0; k < forms_.size(); ++k)
                if (scene_.claims[k].at == when_) here.push_back(k);
            if (here.empty()) continue;
            if (when_ == "impact" && !claims_.after_impact())
                for (const std::size_t k : here) result_.claims[k].reason = claims_.impact_obstacle();
            else  // the rates after an impact have become expressions in the variables of any state of motion
                while (!here.empty()) {
                    const std::vector<std::size_t> spoken = undetermined_in(here.front());
                    std::vector<std::size_t> part = here;
                    std::erase_if(part, [&](std::size_t k) { return undetermined_in(k) != spoken; });
                    std::erase_if(here, [&](std::size_t k) { return undetermined_in(k) == spoken; });
                    law_ = has_masses() || !spoken.empty() ? with_multipliers(spoken) : any_motion(e_, m_);
                    spoken_ = spoken;
                    known_.reset();
                    settle(part, when_ == "rest" ? Motions::At::rest : Motions::At::motion);
                }
        }
        constants_->withdraw(scene_, result_.claims);
        tell_kinematics();
        settle_apart();
        for (CheckedClaim& c : result_.claims)
            for (const ex& positive : positive_) c.where.insert(c.where.begin(), inequality(positive));
        result_.complete = complete();
        return std::move(result_);
    }

private:
    void read() {
        std::vector<Diagnostic> mistakes;
        for (const Claim& claim : scene_.claims) try {
                forms_.push_back(claims_.read(claim));
            } catch (const SceneMistake& mistake) {
                mistakes.push_back(mistake.diagnostic);
            }
        if (!mistakes.empty()) fail(scene_, mistakes);
        constants_.emplace(scene_, claims_, forms_);
        if (sheets_) positive_ = sheets_->positive();
    }

    /// Claims that need no states: motions in closed form, first approximations.
    void settle_apart() {
        std::vector<std::size_t> solution;
        for (std::size_t k = 0; k < forms_.size(); ++k) {
            if (scene_.claims[k].at == "solution") solution.push_back(k);
            if (scene_.claims[k].at == "near") check_first_order(scene_.claims[k], claims_, result_.claims[k]);
        }
        if (!solution.empty()) check_solution(scene_, claims_, solution, result_.claims);
    }

    /// The constraints of m_.undetermined() whose multipliers the claim contains. A claim with a contact's
    /// multiplier must hold for any value of it; a claim without it is about the motion while the gap is open.
    /// Constraints that follow from others have their shares of least norm.
    std::vector<std::size_t> undetermined_in(std::size_t claim) const {
        std::vector<std::size_t> result;
        const auto all = m_.undetermined();
        for (std::size_t k = 0; k < all.size(); ++k)
            if (k >= m_.unilateral.size() || m_.z->depends(forms_[claim].residual, {all[k]->multiplier}))
                result.push_back(k);
        return result;
    }

    Equations with_multipliers(const std::vector<std::size_t>& undetermined) const {
        Equations law = e_;
        for (const std::size_t k : undetermined) {
            const Mechanism::Constraint& c = *m_.undetermined()[k];
            for (int i = 0; i < law.size(); ++i) law.own[i] += c.row[i] * c.multiplier;
        }
        return law;
    }

    /// Settles claims that are combinations of the equations and constraints. They need no state that obeys the
    /// constraints, which may be hard to find. Returns the other claims.
    std::vector<std::size_t> without_combinations(const std::vector<std::size_t>& here, Motions::At at) {
        if (!m_.redundant.empty()) return here;  // the share of each is determined only on the constraints
        std::vector<std::size_t> left = here;
        if (at == Motions::At::rest) {
            std::erase_if(left, [&](std::size_t k) {
                if (!forms_[k].open.empty()) return false;
                const std::optional<double> failure = static_combination(claims_, law_, forms_[k].residual);
                if (failure) prove(k, *failure);
                return failure.has_value();
            });
            return left;
        }
        std::optional<ExactStates> states;
        Program p;
        std::vector<int> roots;
        std::vector<std::pair<std::size_t, double>> found;
        for (const std::size_t k : here) {
            if (!forms_[k].open.empty()) continue;
            const int root = claims_.lower(p, {forms_[k].residual})[0];
            if (p.is_zero(root)) continue;
            if (!states) states.emplace(m_, law_, at, 0, halvings_in(here), Motions::Positions::free);
            double failure = 0;
            if (vanishes_at(*states, p, root, failure) != std::optional(true)) continue;
            found.emplace_back(k, failure);
            roots.push_back(root);
        }
        if (found.empty()) return left;
        const std::vector<bool> holds = hold_in_numbers(told(), states->motions, p, roots);
        for (std::size_t i = 0; i < found.size(); ++i)
            if (holds[i]) {
                prove(found[i].first, found[i].second);
                std::erase(left, found[i].first);
            }
        return left;
    }

    void prove(std::size_t k, double failure) {
        CheckedClaim& c = result_.claims[k];
        c.verdict = Verdict::proved;
        c.failure = failure;
        c.normal_form = when_ == "motion" && is_multiple(forms_[k].residual, m_, law_);
    }

    bool has_masses() const { return !m_.kinetic.empty() || m_.given_lagrangian; }

    /// Which of the proved claims hold for every motion that the constraints allow?
    void tell_kinematics() {
        std::vector<GiNaC::symbol> multipliers = e_.lambda;
        for (const Mechanism::Constraint* c : m_.undetermined()) multipliers.push_back(c->multiplier);
        std::vector<std::size_t> here;
        for (std::size_t k = 0; k < forms_.size(); ++k) {
            const CheckedClaim& c = result_.claims[k];
            if (scene_.claims[k].at == "motion" && c.verdict == Verdict::proved && c.where.empty() &&
                forms_[k].open.empty() && !forms_[k].third && !m_.z->depends(forms_[k].residual, multipliers))
                here.push_back(k);
        }
        if (here.empty()) return;
        const Equations any = any_motion(e_, m_);
        for (const int halves : {0, 1, 2}) {
            ExactStates states(m_, any, Motions::At::motion, halves, halvings_in(here));
            if (states.get(0) == nullptr) continue;
            for (const std::size_t k : here) tell_kinematic(k, states);
            return;
        }
    }

    void tell_kinematic(std::size_t k, ExactStates& states) {
        CheckedClaim& c = result_.claims[k];
        Program p;
        const int root = claims_.lower(p, {forms_[k].residual})[0];
        double failure = 0;
        c.kinematic = p.is_zero(root) || vanishes_at(states, p, root, failure) == std::optional(true);
        if (c.kinematic && c.reason.empty())
            c.reason = say("a relation of kinematics: it holds for every motion that the constraints allow");
    }

    int halvings_in(const std::vector<std::size_t>& here) const {
        int result = 0;
        for (const std::size_t k : here) {
            Program p;
            result = std::max(result, halvings(p, claims_.lower(p, {forms_[k].residual})));
        }
        return result;
    }

    /// With holonomic constraints as they are at the pose where the scene starts: what of it is known in numbers
    /// only obeys them.
    Mechanism struck() {
        Mechanism result = m_;
        const GiNaC::exmap& pose = claims_.after_impact()->pose;
        for (auto* constraints : {&result.constraints, &result.redundant})
            for (Mechanism::Constraint& c : *constraints) {
                if (!c.position) continue;
                const ex here = m_.z->expand(*c.position).subs(pose, GiNaC::subs_options::no_pattern).expand();
                c.position = GiNaC::is_a<numeric>(here) ? std::nullopt : std::optional(m_.z->name(here));
            }
        return result;
    }

    void settle(const std::vector<std::size_t>& asked, Motions::At at) {
        const bool is_bound = std::any_of(m_.constraints.begin(), m_.constraints.end(),
                                          [](const Mechanism::Constraint& c) { return c.position.has_value(); });
        const bool may_combine = at == Motions::At::rest || (when_ == "motion" && is_bound);
        const std::vector<std::size_t> here = may_combine ? without_combinations(asked, at) : asked;
        if (here.empty()) return;
        // Angles in halves only where they occur: every halving doubles the degrees.
        const Mechanism mechanism = when_ == "impact" ? struck() : m_;
        std::optional<ExactStates> states;
        for (const int halves : {0, 1, 2}) {
            states.emplace(mechanism, law_, at, halves, halvings_in(here));
            const ExactState* const state = states->get(0);
            if (state == nullptr) continue;
            bool all = true;
            for (const std::size_t k : here) {
                Program p;
                const std::vector<int> root = claims_.lower(p, {forms_[k].residual});
                bool usable = false;
                for (std::size_t s = 0; s < 24 && !usable && states->get(s) != nullptr; ++s)
                    usable = evaluate_mod(p, states->get(s)->point, root).has_value();
                all = all && usable;
            }
            if (all) break;
        }
        if (states->get(0) == nullptr) {
            for (const std::size_t k : here) {
                CheckedClaim& c = result_.claims[k];
                c.reason = !states->motions.obstacle().empty() ? states->motions.obstacle()
                           : at == Motions::At::rest
                               ? say("no state was found in which the equations allow rest")
                               : say("no state was found that obeys the constraints and has one acceleration");
            }
            return;
        }
        std::vector<std::size_t> open;
        for (const std::size_t k : here)
            if (forms_[k].open.empty())
                settle_alone(k, *states);
            else if (!states->motions.rubbed().empty())
                result_.claims[k].reason =
                    say("it leaves names open, and the side that a constraint with friction presses is known in "
                        "numbers only");
            else if (states->motions.loose().empty())
                open.push_back(k);
            else
                result_.claims[k].reason =
                    say("the constraints cannot be solved one after the other, and it leaves names open");
        settle_open(open, *states);
    }

    void settle_alone(std::size_t k, ExactStates& states) {
        CheckedClaim& c = result_.claims[k];
        Program p;
        const int root = claims_.lower(p, {forms_[k].residual})[0];
        if (p.is_zero(root)) {
            c.verdict = Verdict::proved;
            c.normal_form = true;
            if (when_ != "impact") c.reason = say("it holds identically and says nothing of the motion");
            return;
        }
        const std::optional<bool> zero = vanishes_at(states, p, root, c.failure);
        if (!zero) {
            c.reason = say(
                "it could not be evaluated: it divides by something that is zero on every motion, or its degree "
                "is too high");
            return;
        }
        const bool is_rubbed = !states.motions.rubbed().empty();
        const InNumbers seen = *zero ? seen_in_numbers(states.motions, p, root) : InNumbers::fails;
        if (seen == InNumbers::unknown) {
            c.reason = say(
                "it holds in exact arithmetic, which knows no order and may turn the signs of roots and absolute "
                "values, and too few states in numbers were found with which to compare it");
            return;
        }
        if (seen == InNumbers::holds) {
            if (!states.motions.loose().empty() && !hold_in_numbers(told(), states.motions, p, {root})[0]) {
                c.reason =
                    say("it holds wherever the constraints are constant, and no state was found at which they are "
                        "zero and the equations have one solution");
                return;
            }
            c.verdict = Verdict::proved;
            if (depends_on_shares(states, p, root))
                c.reason = say(
                    "it holds for the least reactions of constraints that depend on each other; other reactions "
                    "with the same effect would not obey it");
            c.normal_form = (when_ == "motion" && is_multiple(forms_[k].residual, m_, law_)) ||
                            (when_ == "impact" && is_identically_zero(forms_[k].residual, m_));
            return;
        }
        if (is_rubbed && holds_with_signs_turned(k, states, p, root)) {
            c.verdict = Verdict::proved;
            return;
        }
        if (const auto branch = branch_of(k, states)) {
            c.verdict = Verdict::proved;
            c.where = *branch;
            c.reason = say("on the branch of the initial state");
            return;
        }
        const auto shown = counterexample(told(), states.motions, p, root);
        if (!shown) {  // exact arithmetic does not know every identity; nothing is called wrong without a state at
                       // which it fails
            c.reason = say("it differs in exact arithmetic, and no state in numbers was found at which it fails");
            return;
        }
        show(c, *shown);
        if (!*zero || is_rubbed) explain(k, states);  // repairs are compared in the arithmetic that was wrong here
    }

    /// Whether signs decide: Legendre's symbol takes their place in exact arithmetic, and that of 3 is −1, so that
    /// 3 times something positive counts as negative. A root is the one of two that counts as positive: that of 9
    /// is −3.
    static bool depends_on_sides(const Program& p, const std::vector<int>& roots) {
        const std::vector<int> needed = p.needed(roots);
        return std::any_of(needed.begin(), needed.end(), [&](int id) {
            return p[id].op == Op::sign || p[id].op == Op::abs || p[id].op == Op::sqrt;
        });
    }

    /// What numbers say of a claim that vanishes in exact arithmetic, if they are asked: where signs decide in the
    /// claim, or in the equations, with which it can be compared if states are found.
    InNumbers seen_in_numbers(const Motions& motions, const Program& p, int root) {
        if (!motions.rubbed().empty())
            return hold_in_numbers(told(), motions, p, {root})[0] ? InNumbers::holds : InNumbers::fails;
        if (depends_on_sides(p, {root})) return in_numbers(told(), motions, p, root);
        std::vector<int> entries = motions.entries().M;
        for (const auto* part :
             {&motions.entries().f, &motions.entries().A, &motions.entries().drift, &motions.entries().gamma})
            entries.insert(entries.end(), part->begin(), part->end());
        const bool fails = depends_on_sides(motions.program(), entries) &&
                           in_numbers(told(), motions, p, root) == InNumbers::fails;
        return fails ? InNumbers::fails : InNumbers::holds;
    }

    /// A claim that holds with other signs of the multipliers of friction, and in numbers, has the right ones.
    bool holds_with_signs_turned(std::size_t k, const ExactStates& states, const Program& p, int root) {
        const unsigned choices = 1U << states.motions.rubbed().size();
        for (unsigned turned = 1; turned < choices; ++turned) {
            ExactStates others(m_, law_, states.motions.where(), states.motions.halves(), halvings_in({k}),
                               Motions::Positions::solved, turned);
            if (vanishes_at(others, p, root, result_.claims[k].failure) == std::optional(true) &&
                hold_in_numbers(told(), states.motions, p, {root})[0])
                return true;
        }
        return false;
    }

    std::string inequality(const ex& positive) const {
        const auto f = fourier(positive, *m_.symbols);
        return (f ? text(readable(*f)) : say("a root of the claim")) + " > 0";
    }

    /// A claim with a root that holds for one of the root's signs at every state: that of the initial state's
    /// branch.
    std::optional<std::vector<std::string>> branch_of(std::size_t k, ExactStates& states) const {
        if (when_ != "motion") return std::nullopt;
        const std::optional<RootForm> form = root_form(forms_[k].residual, m_);
        if (!form) return std::nullopt;
        Program p;
        const int norm = claims_.lower(p, {form->norm})[0];
        double failure = 0;
        if (!p.is_zero(norm) && vanishes_at(states, p, norm, failure) != std::optional(true)) return std::nullopt;
        if (!is_positive_at_start(form->root, claims_, e_)) return std::nullopt;
        return std::vector<std::string>{inequality(form->root)};
    }

    Told told() {
        return {.mechanism = m_,
                .equations = e_,
                .claims = claims_,
                .spoken = spoken_,
                .positive = positive_,
                .is_impact = when_ == "impact"};
    }

    static void show(CheckedClaim& c, const Counterexample& shown) {
        c.verdict = Verdict::refuted;
        c.counterexample = shown.values;
        c.residual = shown.residual;
        c.residual_value = shown.residual_value;
    }

    void explain(std::size_t k, ExactStates& states) {
        const Diagnosis found = diagnose({.scene = scene_,
                                          .claims = claims_,
                                          .law = law_,
                                          .forms = forms_,
                                          .wrong = wrong_,
                                          .claim = k,
                                          .in_motion = when_ == "motion",
                                          .at_impact = when_ == "impact",
                                          .known = known_},
                                         states);
        CheckedClaim& c = result_.claims[k];
        if (!found.reason.empty()) c.reason = found.reason;
        c.nearest = found.nearest;
        c.difference = found.difference;
        c.likely = found.likely;
    }

    // Claims with open names

    void settle_open(const std::vector<std::size_t>& open, ExactStates& states) {
        std::set<std::size_t> done;
        for (const std::size_t k : open) {
            CheckedClaim& c = result_.claims[k];
            if (!forms_[k].linear) {
                c.reason = say("it is not linear in the names that it leaves open");
                continue;
            }
            if (mixes(k)) {
                c.reason = say(
                    "it holds an unknown function beside a constant of the motion, and the function's derivative "
                    "is not known");
                continue;
            }
            if (done.contains(k)) continue;
            std::vector<std::size_t> group = group_of(scene_, forms_, k);
            std::erase_if(group, [&](std::size_t other) { return mixes(other); });
            done.insert(group.begin(), group.end());
            settle_group(group, states);
        }
    }

    bool mixes(std::size_t k) const {
        bool constant = false, function = false;
        for (const int o : forms_[k].open) (claims_.open()[o].constant ? constant : function) = true;
        return constant && function;
    }

    void settle_group(const std::vector<std::size_t>& group, ExactStates& states) {
        const OpenRows rows = open_rows(claims_, forms_, group);
        const std::optional<OpenJudgement> judged = judge(rows, group, states);
        if (!judged) {
            for (const std::size_t k : group)
                result_.claims[k].reason = say("it could not be evaluated at any state");
            return;
        }
        wrong_ = judged->wrong;
        const std::set<std::size_t> wrong = wrong_;
        for (const std::size_t k : group) {
            CheckedClaim& c = result_.claims[k];
            c.failure = judged->failure;
            if (wrong.contains(k)) {
                c.reason = wrong.size() > 1 && wrong.size() == group.size()
                               ? say("no choice of what is left open satisfies these claims together")
                               : say("the other claims leave no choice with which it holds");
                const auto shown = counterexample(told(), states.motions, rows,
                                                  {.claim = k, .open = forms_[k].open, .wrong = wrong});
                if (!shown) continue;
                show(c, *shown);
                if (shown->of_derivative)
                    c.reason = say("it is not constant: the residual is that of its time derivative");
                explain(k, states);
            } else if (pins(rows, judged->first, wrong, k)) {
                const bool constant = claims_.open()[forms_[k].open[0]].constant;
                c.verdict = constant ? Verdict::undecided : Verdict::vacuous;
                c.reason = constant
                               ? say("a further time derivative would be needed to tell whether what it leaves "
                                     "open is constant")
                               : say("what it leaves open can take up whatever it says: no other claim fixes it");
            } else {
                c.verdict = Verdict::proved;
            }
        }
    }

    /// Do the claims of the motion that are right fix every acceleration?
    bool complete() const {
        std::vector<const ClaimForm*> right;
        for (std::size_t k = 0; k < forms_.size(); ++k) {
            const Verdict verdict = result_.claims[k].verdict;
            if (scene_.claims[k].at == "motion" && (verdict == Verdict::proved || verdict == Verdict::vacuous))
                right.push_back(&forms_[k]);
        }
        return fix_accelerations(claims_, right);
    }

    const Scene& scene_;
    const Mechanism& m_;
    const Equations& e_;
    Equations law_;  // the equations for the current claims
    std::optional<EquationTerms> known_;
    std::vector<std::size_t> spoken_;  // the multipliers of m_.undetermined() in them
    Claims claims_;
    std::shared_ptr<RootSheets> sheets_;
    std::vector<ex> positive_;  // on the sheet of the scene and its claims, not of repairs that are tried
    std::vector<ClaimForm> forms_;
    std::optional<GivenConstants> constants_;
    std::string when_;
    std::set<std::size_t> wrong_;  // the wrong claims of the current group
    Checked result_;
};

}  // namespace

namespace {

Checked check_of_one_mode(const Scene& scene, const Mechanism& mechanism,
                          const std::shared_ptr<RootSheets>& sheets, const std::string& by) {
    const Equations equations = routh(mechanism);
    const Mechanism m = in_terms_of(equations, mechanism);
    return Checker(scene, m, equations, sheets, by).run();
}

/// The scene with these claims only.
Scene with_some_claims(Scene scene, const std::vector<std::size_t>& claims) {
    std::vector<Claim> some;
    for (const std::size_t k : claims) some.push_back(std::move(scene.claims[k]));
    scene.claims = std::move(some);
    return scene;
}

}  // namespace

Checked check(const Scene& scene, const Mechanism& mechanism, const std::shared_ptr<RootSheets>& sheets,
              const std::string& by) {
    std::map<std::vector<std::string>, std::vector<std::size_t>> modes;  // by what sticks
    for (std::size_t k = 0; k < scene.claims.size(); ++k)
        modes[is_sticking(scene.claims[k]) ? sticking_in(scene.claims[k], scene) : std::vector<std::string>()]
            .push_back(k);
    if (modes.size() == 1 && modes.begin()->first.empty()) return check_of_one_mode(scene, mechanism, sheets, by);
    Checked result{.claims = std::vector<CheckedClaim>(scene.claims.size())};
    for (const auto& [sticking, claims] : modes) {
        Scene part = with_some_claims(scene, claims);
        Checked checked;
        if (sticking.empty()) {
            checked = check_of_one_mode(part, mechanism, sheets, by);
            result.complete = checked.complete;
        } else {
            for (Claim& claim : part.claims) claim.at = "motion";
            const Prepared stuck = prepared(with_sticking(std::move(part), sticking), {}, sheets != nullptr);
            checked = check_of_one_mode(stuck.scene, stuck.mechanism, stuck.sheets, by);
        }
        for (std::size_t i = 0; i < claims.size(); ++i) result.claims[claims[i]] = std::move(checked.claims[i]);
    }
    return result;
}

CheckedScene check(Scene scene, const std::string& by) {
    CheckedScene result{derived(std::move(scene), {.by = by, .on_sheets = true})};
    if (result.scene.claims.empty())
        throw ModelError(say(
            "there are no claims: write [[claim]] in the scene, or give a file of claims, one equation a line"));
    result.checked = check(result.scene, result.mechanism, result.sheets, by);
    return result;
}

}  // namespace alembert
