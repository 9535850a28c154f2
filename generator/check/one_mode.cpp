// SPDX-License-Identifier: GPL-2.0-or-later
// A claim r(q, q', q'', λ, t) = 0 is right if r vanishes on every motion (check/decide.hpp).
#include "check/one_mode.hpp"

#include <algorithm>

#include "analysis/derive/derive.hpp"
#include "analysis/state/force_balance.hpp"
#include "base/language/say.hpp"
#include "check/arithmetic_error.hpp"
#include "check/claim_tree.hpp"
#include "check/completeness.hpp"
#include "check/constants.hpp"
#include "check/decide.hpp"
#include "check/in_print.hpp"
#include "check/kinematic.hpp"
#include "model/energy.hpp"
#include "model/formalism/driven.hpp"
#include "model/formalism/needs.hpp"

namespace alembert {

using GiNaC::ex;

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
        using At = Claim::At;
        for (const At at : {At::motion, At::rest, At::impact, At::near, At::solution}) {
            now_.at = at;
            std::vector<std::size_t> here;
            for (std::size_t k = 0; k < now_.forms.size(); ++k)
                if (now_.scene.claims[k].at == at && !has_no_value(k)) here.push_back(k);
            if (here.empty()) continue;
            if (at == At::impact && !claims_.after_impact())
                for (const std::size_t k : here) now_.verdicts[k].reason = claims_.impact_obstacle();
            else if (at == At::near || at == At::solution)
                decide(now_, here);
            else  // the rates after an impact have become expressions in the variables of any state of motion
                while (!here.empty()) decide(now_, with_one_law(here));
        }
        constants_->withdraw(now_.scene, now_.verdicts);
        tell_kinematics(now_);
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
        now_.sheets.assign(now_.scene.claims.size(), of_scene);
        now_.domains.resize(now_.scene.claims.size());
        assume();
        for (const Claim& claim : now_.scene.claims) try {
                now_.forms.emplace_back();
                if (sheets_) sheets_->take_needed();
                now_.forms.back() = claims_.read(claim);
                if (sheets_)
                    for (const ex& needed : sheets_->take_needed())
                        add_positive(now_.sheets[now_.forms.size() - 1], needed);
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
        std::vector<ex>& domain = now_.domains[now_.forms.size() - 1];
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
            for (std::vector<ex>& sheet : now_.sheets) add_positive(sheet, needed);
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
        for (const ex& positive : now_.sheets[claim])
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

    /// Whether the claim's own arithmetic fails, so that there is nothing to compare.
    bool has_no_value(std::size_t claim) const { return !now_.verdicts[claim].reason.empty(); }

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

    /// Takes those of the claims that hold the same multipliers as the first from them, and the law for these.
    std::vector<std::size_t> with_one_law(std::vector<std::size_t>& claims) {
        const std::vector<std::size_t> spoken = undetermined_in(claims.front());
        const auto others = std::stable_partition(claims.begin(), claims.end(),
                                                  [&](std::size_t k) { return undetermined_in(k) == spoken; });
        std::vector<std::size_t> part(claims.begin(), others);
        claims.erase(claims.begin(), others);
        now_.is_any_motion = !has_masses() && spoken.empty();
        now_.law = now_.is_any_motion ? any_motion(now_.e, now_.m) : now_.basis.with_multipliers(spoken);
        now_.spoken = spoken;
        now_.known = &now_.basis.terms(spoken, now_.is_any_motion);
        return part;
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
