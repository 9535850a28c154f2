// SPDX-License-Identifier: GPL-2.0-or-later
#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "algebra/notation/readable.hpp"
#include "algebra/notation/text.hpp"
#include "algebra/symbolic/fourier.hpp"
#include "base/language/say.hpp"
#include "check/arithmetic_error.hpp"
#include "check/claim_arithmetic.hpp"
#include "check/jump.hpp"
#include "check/missing_terms.hpp"
#include "check/nearest.hpp"
#include "check/open_rows.hpp"
#include "check/phrase_tree.hpp"
#include "check/quantities.hpp"
#include "check/slip.hpp"
#include "check/speaks_of_scene.hpp"
#include "check/vanishing.hpp"
#include "check/ways.hpp"
#include "model/formalism/rest.hpp"
#include "scene/dimensions.hpp"

namespace alembert {

using GiNaC::ex;
using GiNaC::numeric;

namespace {

bool has_primes(const Tree& tree) {
    return tree.primes > 0 ||
           std::any_of(tree.args.begin(), tree.args.end(), [](const TreePtr& arg) { return has_primes(*arg); });
}

class Diagnostician {
public:
    /// What is right up to a constant is explained at states of any motion.
    explicit Diagnostician(Question& q)
        : q_(q),
          now_(q.now),
          claim_(now_.scene.claims[q.claim]),
          form_(now_.forms[q.claim]),
          claims_(now_.claims),
          m_(now_.m),
          is_in_motion_(now_.at == Claim::At::motion),
          is_at_impact_(now_.at == Claim::At::impact),
          any_(is_in_motion_ && letters_in(claim_, claims_).constant
                   ? std::make_unique<AnyStates>(m_, now_.e, halvings_in(now_, {q.claim}))
                   : nullptr),
          is_up_to_constant_(any_ && any_->get() != nullptr),
          states_(is_up_to_constant_ ? *any_->get() : *q.explained_at) {}

    CheckedClaim diagnosis() {
        CheckedClaim result;
        if (const std::string names = names_of_shared_constants(); !names.empty()) {
            result.reason =
                say("it holds by itself, but in another claim {} has another value: what has another "
                    "value needs another name",
                    names);
            return result;
        }
        if (states_.motions.where() == Motions::At::rest)
            result.reason = name_branch();
        else if (holds_at_scene_values())
            result.reason = say("it holds at the scene's values of the parameters only");
        std::optional<ClaimArithmetic> arithmetic = arithmetic_of_claim();
        const std::optional<Repair> repair =
            likely_slip(claim_, form_.residual, m_, now_.law,
                        {.is_right = [this](const Claim& claim) { return is_right(claim); },
                         .vanishes = [this](const Expression& value) { return vanishes(value); },
                         .terms = [this]() -> const EquationTerms& { return terms(); },
                         .missing = [this] { return missing(); },
                         .arithmetic = arithmetic ? &*arithmetic : nullptr});
        if (repair)
            tell(*repair, result);
        else
            tell_nearest(result);
        if (!result.likely)
            if (const auto term = term_of_wrong_unit(claim_, now_.scene))
                result.likely = Slip{.kind = "wrong_unit", .term = *term};
        return result;
    }

    /// Into what the claim was corrected.
    const std::optional<ClaimForm>& repaired() const { return repaired_; }

private:
    /// What the claim has beyond the equation into which it was corrected.
    void tell(const Repair& repair, CheckedClaim& result) {
        constexpr double largest_tree = 3000;
        constexpr std::size_t most_terms = 8;
        result.likely = repair.slip;
        result.nearest = repair.slip.repair;
        Claim repaired = claim_;
        repaired.equation = repair.equation;
        try {
            repaired_ = claims_.read(repaired);
            const ex beyond = form_.residual - repaired_->residual;
            if (m_.z->tree_size(beyond) > largest_tree) return;
            const auto f = fourier(m_.z->expand(beyond), *m_.symbols, most_terms);
            if (f && f->size() > 0) result.difference = text(readable(*f));
        } catch (const SceneMistake&) {
        } catch (const std::runtime_error&) {
        }
    }

    void tell_nearest(CheckedClaim& result) {
        if (!form_.open.empty() || !is_in_motion_) return;
        if (const auto nearest = nearest_equation(form_.residual, m_, now_.law)) {
            result.nearest = nearest->equation;
            result.difference = nearest->difference;
        }
    }

    bool is_right(const Claim& repaired) {
        // What speaks of rates says nothing at rest.
        const bool is_at_rest = !is_in_motion_ && !is_at_impact_;
        if (is_at_rest && (has_primes(*repaired.equation.lhs.tree) || has_primes(*repaired.equation.rhs.tree)))
            return false;
        try {
            const bool may_be_identity =
                is_at_impact_ || speaks_of_scene(repaired, m_) || differentiates(repaired);
            return holds_quickly(claims_.read(repaired), may_be_identity);
        } catch (const SceneMistake&) {
            return false;
        } catch (const std::exception&) {  // it divides by zero, for instance
            return false;
        }
    }

    /// Whether it says what the derivative of something is that changes.
    bool differentiates(const Claim& claim) {
        for (const Expression* side : {&claim.equation.lhs, &claim.equation.rhs})
            if (has_derivative(*side->tree) && !m_.z->expand(claims_.read(*side)).is_zero()) return true;
        return false;
    }

    bool vanishes(const Expression& value) {
        Program p;
        const std::optional<int> root = node_of(p, value);
        return root && (p.is_zero(*root) || vanishes_at_two(states_, p, *root));
    }

    const EquationTerms& terms() {
        if (!*now_.known) *now_.known = equation_terms(m_, now_.law);
        return **now_.known;
    }

    /// Which time derivative of the claim is free of what it leaves open; nothing if none is.
    std::optional<int> free_derivative() {
        if (is_up_to_constant_) return 1;
        if (form_.open.empty()) return 0;
        for (std::size_t k = 0; k < form_.derivatives.size(); ++k)
            if (!m_.z->depends(form_.derivatives[k], claims_.open_symbols())) return static_cast<int>(k) + 1;
        return std::nullopt;
    }

    /// States at which the claim can be evaluated; 3 or, of several branches, 8 are enough.
    std::vector<ModularPoint> points(std::size_t wanted) {
        std::vector<ModularPoint> result;
        Program p;
        const std::vector<int> root = claims_.lower(p, {form_.residual});
        for (std::size_t s = 0; s < 40 && result.size() < wanted && states_.get(s) != nullptr; ++s)
            if (evaluate_mod(p, states_.get(s)->point, root)) result.push_back(states_.get(s)->point);
        return result;
    }

    /// With changed claims, of which each name needs a value: the v of v² = … may have none where v² has one.
    std::optional<ClaimArithmetic> arithmetic_of_claim() {
        const std::optional<int> derivative = free_derivative();
        if (form_.third || !derivative) return std::nullopt;
        const bool many = states_.motions.where() == Motions::At::rest ||
                          (states_.get(0) != nullptr && states_.get(0)->branches > 1);
        const std::size_t wanted = many ? 8 : 3;
        std::vector<ModularPoint> usable;
        for (const std::size_t tried : {wanted, 5 * wanted}) {
            const std::vector<ModularPoint> all = points(tried);
            std::optional<ClaimArithmetic> result(std::in_place, claims_, claim_, all, *derivative,
                                                  form_.open.empty());
            usable.clear();
            for (std::size_t k = 0; k < all.size() && usable.size() < wanted; ++k)
                if (result->residual(*claim_.equation.lhs.tree, *claim_.equation.rhs.tree, k))
                    usable.push_back(all[k]);
            if (!all.empty() && usable.size() == all.size()) return result;
            if (usable.size() == wanted) break;
        }
        if (usable.empty()) return std::nullopt;
        return std::optional<ClaimArithmetic>(std::in_place, claims_, claim_, std::move(usable), *derivative,
                                              form_.open.empty());
    }

    /// The node of `value`. Returns nothing if the expression cannot be translated or contains open names.
    std::optional<int> node_of(Program& p, const Expression& value) {
        try {
            const ex e = is_at_impact_ ? claims_.read_at_impact(value) : claims_.read(value);
            if (m_.z->depends(e, claims_.open_symbols())) return std::nullopt;
            return claims_.lower(p, {e})[0];
        } catch (const std::exception&) {
            return std::nullopt;
        } catch (const SceneMistake&) {
            return std::nullopt;
        }
    }

    /// The time derivative of the expression, as often as the claim has to be differentiated to be free of what it
    /// leaves open.
    std::optional<int> node_of_derivative(Program& p, const Expression& value, int times) {
        if (times == 0) return node_of(p, value);
        try {
            ex e = claims_.read(value);
            std::vector<GiNaC::symbol> last = m_.qddot;
            for (const GiNaC::symbol& lambda : claims_.equations().lambda) last.push_back(lambda);
            for (int k = 0; k < times; ++k) {
                if (m_.z->depends(e, last)) return std::nullopt;
                e = m_.time_derivative({e})[0];
            }
            return claims_.lower(p, {e})[0];
        } catch (const std::runtime_error&) {
            return std::nullopt;
        } catch (const SceneMistake&) {
            return std::nullopt;
        }
    }

    /// Terms that the claim may lack.
    std::vector<MissingTerm> missing() {
        const std::optional<int> derivative = free_derivative();
        if (!derivative) return {};
        Program p;
        const ex own = *derivative == 0     ? form_.residual
                       : is_up_to_constant_ ? m_.time_derivative({form_.residual})[0]
                                            : form_.derivatives[static_cast<std::size_t>(*derivative - 1)];
        const int residual = claims_.lower(p, {own})[0];
        std::vector<Factors> terms;
        std::vector<int> nodes;
        for (Factors& term : terms_of_mechanics(claim_, m_, now_.law, this->terms(), *derivative > 0)) {
            const TreePtr tree = product_of(term);
            const std::optional<int> node = node_of_derivative(p, expression_of(*tree), *derivative);
            if (!node || p.is_zero(*node)) continue;
            nodes.push_back(*node);
            terms.push_back(std::move(term));
        }
        std::vector<TreePtr> steady;
        std::vector<int> steady_nodes;
        for (const TreePtr& tree : steady_sums(claim_, m_))
            if (const std::optional<int> node = node_of(p, expression_of(*tree))) {
                steady.push_back(tree);
                steady_nodes.push_back(*node);
            }
        std::vector<ModularPoint> points;
        const std::size_t most = states_.motions.where() == Motions::At::rest ? states_of_rest : 12;
        for (std::size_t s = 0; s < most && states_.get(s) != nullptr; ++s)
            points.push_back(states_.get(s)->point);
        std::vector<MissingTerm> result;
        for (const MissingFactor& found : missing_terms(p, residual, nodes, steady_nodes, points)) {
            // In one pose all rates are multiples of the impulses, which are more often forgotten.
            constexpr int of_rate = 6;
            const Factors& term = terms[found.term];
            const bool is_one = term.size() == 1 && term[0]->kind == Tree::Kind::number && term[0]->text == "1";
            Factors factors = times(found.coefficient, steady, is_one ? Factors() : term);
            const bool has_rate = is_at_impact_ && has_primes(*product_of(term));
            result.push_back({product_of(std::move(factors)), found.effort + (has_rate ? of_rate : 0)});
        }
        std::stable_sort(result.begin(), result.end(),
                         [](const MissingTerm& a, const MissingTerm& b) { return a.effort < b.effort; });
        return result;
    }

    /// An identity is no repair, unless it says something: how a vector of the scene is composed.
    bool holds_quickly(const ClaimForm& given, bool may_be_identity) {
        ClaimForm form = given;
        if (is_up_to_constant_) {
            if (given.order > 1) return false;
            form.residual = m_.time_derivative({given.residual})[0];
        }
        if (!form.open.empty()) {
            // The claim is tested with the right claims of its group; if these do not determine the open names, it
            // is tested with all claims of the group.
            std::vector<ClaimForm> forms = now_.forms;
            forms[q_.claim] = form;
            if (!form.derivatives.empty() &&
                std::all_of(form.derivatives.begin(), form.derivatives.end(),
                            [](const ex& derivative) { return derivative.is_zero(); }))
                return false;  // it says nothing of the motion
            std::vector<std::size_t> group = group_of(now_.scene, forms, q_.claim), right = group;
            std::erase_if(right,
                          [&](std::size_t other) { return other != q_.claim && now_.wrong.contains(other); });
            return agrees(forms, right) || (right.size() < group.size() && agrees(forms, group)) ||
                   (!form.derivatives.empty() && agrees(forms, {q_.claim}));
        }
        Program p;
        const int root = claims_.lower(p, {form.residual})[0];
        if (p.is_zero(root) || is_identity(p, root)) return may_be_identity;
        return vanishes_at_two(states_, p, root);
    }

    /// The constants that the claim leaves open, if it holds by itself.
    std::string names_of_shared_constants() {
        std::string names;
        for (const int open : form_.open) {
            if (!claims_.open()[static_cast<std::size_t>(open)].constant) return {};
            names += (names.empty() ? "" : ", ") + claims_.open()[static_cast<std::size_t>(open)].name;
        }
        return !names.empty() && agrees(now_.forms, {q_.claim}) ? names : std::string();
    }

    bool agrees(const std::vector<ClaimForm>& forms, const std::vector<std::size_t>& group) {
        const OpenRows rows = open_rows(claims_, forms, group);
        const std::size_t wanted = states_needed(rows.program, rows.roots(), states_) == states_of_sides ? 20 : 2;
        for (std::size_t s = 0; s < wanted; ++s) {
            const auto at = open_matrix(rows, states_, s);
            if (!at || !consistent(at->rows) || pins(rows, *at, {}, q_.claim)) return false;
        }
        return true;
    }

    /// The scene's values of the parameters: fractions, constants such as √2, and multiples of π as angles.
    std::optional<Motions::Given> scene_values(std::uint64_t seed) const {
        Program p;
        std::vector<ex> values;
        for (const Mechanism::Parameter& parameter : m_.parameters)
            if (parameter.independent) values.push_back(parameter.value);
        const std::vector<int> nodes = lower_expressions(p, m_, values);
        const auto at = evaluate_mod(p, {.seed = seed}, nodes);
        if (!at) return std::nullopt;
        Motions::Given result;
        for (std::size_t k = 0; k < nodes.size(); ++k) {
            const Prime value = at->value[nodes[k]];
            result.values[{Variable::Kind::parameter, static_cast<int>(k)}] = value;
            const ex half_turns = values[k] / GiNaC::Pi;
            if (values[k].is_zero() || !half_turns.info(GiNaC::info_flags::rational)) continue;
            const Rational part = cln::the<cln::cl_RA>(GiNaC::ex_to<numeric>(half_turns).to_cl_N()) /
                                  cln::ash(1, states_.motions.halves());
            if (const auto turn = PrimeTurn::by_pi(part)) result.angles[value] = *turn;
        }
        return result;
    }

    bool holds_at_scene_values() {
        if (!form_.open.empty() || !states_.motions.steps().empty()) return false;
        Program p;
        const std::array<int, 1> root{claims_.lower(p, {form_.residual})[0]};
        // By chance all signs are right at two states.
        const int wanted = depends_on_sides(p, {root[0]}) || states_.motions.has_sides() ? states_of_sides : 2;
        int usable = 0;
        for (std::uint64_t seed = 1; seed < 300 && usable < wanted; ++seed) {
            const auto values = scene_values(seed);
            if (!values || values->values.empty()) return false;
            const auto state = states_.motions.at(seed, *values);
            if (!state) continue;
            const auto at = evaluate_mod(p, state->point, root);
            if (!at) continue;
            if (!at->value[root[0]].is_zero()) return false;
            ++usable;
        }
        return usable == wanted;
    }

    /// Which factor of an equation of rest vanishes at states where the claim fails and not where it holds? Empty
    /// if the claim holds nowhere.
    std::string name_branch() {
        std::vector<std::size_t> right, wrong;  // positions of states
        Program p;
        const std::array<int, 1> root{claims_.lower(p, {form_.residual})[0]};
        for (std::size_t s = 0; s < states_of_rest && states_.get(s) != nullptr; ++s)
            if (const auto at = evaluate_mod(p, states_.get(s)->point, root))
                (at->value[root[0]].is_zero() ? right : wrong).push_back(s);
        if (right.empty()) return {};
        for (const RestFactor& factor : rest_factors(m_, claims_.equations())) {
            Program q;
            const std::array<int, 1> node{claims_.lower(q, {factor.value})[0]};
            const auto vanishes = [&](std::size_t state) {
                const auto value = evaluate_mod(q, states_.get(state)->point, node);
                return value && value->value[node[0]].is_zero();
            };
            if (std::any_of(wrong.begin(), wrong.end(), vanishes) &&
                std::none_of(right.begin(), right.end(), vanishes))
                return say("rest is possible with {} = 0 too, and there it fails", factor.text);
        }
        return say("it fails at some of the states of rest");
    }

    Question& q_;
    Comparison& now_;
    const Claim& claim_;
    const ClaimForm& form_;
    Claims& claims_;
    const Mechanism& m_;
    const bool is_in_motion_, is_at_impact_;
    const std::unique_ptr<AnyStates> any_;
    const bool is_up_to_constant_;
    ExactStates& states_;
    std::optional<ClaimForm> repaired_;
};

/// Whether the corrected claim stands a look in numbers, where exact arithmetic may err: signs, jumps of what is
/// called constant, multiples of the prime.
bool stands(Question& q, const ClaimForm& repaired) {
    Comparison& now = q.now;
    ExactStates& states = *q.explained_at;
    const Motions& motions = states.motions;
    if (!repaired.open.empty()) {
        std::vector<ClaimForm> forms = now.forms;
        forms[q.claim] = repaired;
        const OpenRows rows = open_rows(now.claims, forms, {q.claim});
        const FoundJump jump =
            find_jump(told(now), motions, rows.program, rows.list[0].rest, is_kept(now, states));
        if (jump.shown || jump.is_unknown) return false;
        if (!depends_on_sides(rows.program, rows.roots()) && !motions.has_sides()) return true;
        constexpr unsigned tries = 40;
        const std::set<std::size_t> wrong = {q.claim};
        return !counterexample(told(now), motions, rows,
                               {.claim = q.claim, .open = repaired.open, .wrong = wrong, .tries = tries});
    }
    Question of_repaired(q.together, q.claim, repaired);
    const auto seen = [&] { return in_numbers(told(now), motions, of_repaired.program(), of_repaired.root()); };
    const std::vector<int> root{of_repaired.root()};
    if (now.at == Claim::At::rest) return seen() != InNumbers::fails;
    if (has_long_numbers(of_repaired.program(), root)) return seen() == InNumbers::holds;
    if (fails_in_a_cell(of_repaired, states)) return false;
    const bool may_err = depends_on_sides(of_repaired.program(), root) || now.on_own_branch != nullptr;
    return !may_err || seen() != InNumbers::fails;
}

}  // namespace

void explain(Question& q) try {
    Diagnostician diagnostician(q);
    CheckedClaim of = diagnostician.diagnosis();
    if (!of.reason.empty()) q.found.reason = of.reason;
    // An acceleration means nothing at an impact; x'' stands for x'(-) there.
    const bool is_beyond_impact = q.now.at == Claim::At::impact && of.nearest.find("''") != std::string::npos;
    if (is_beyond_impact || (diagnostician.repaired() && !stands(q, *diagnostician.repaired()))) return;
    q.found.nearest = std::move(of.nearest);
    q.found.difference = std::move(of.difference);
    q.found.likely = std::move(of.likely);
} catch (const std::exception&) {
    words_of_arithmetic_error();  // the claim is refuted, with a state to see it, even if nothing explains it
}

}  // namespace alembert
