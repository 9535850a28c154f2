// SPDX-License-Identifier: GPL-2.0-or-later
#include "check/diagnosis.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "check/dimensions.hpp"
#include "check/nearest.hpp"
#include "check/open_rows.hpp"
#include "check/vanishing.hpp"
#include "formalism/rest.hpp"
#include "language/say.hpp"
#include "scene/functions.hpp"

namespace alembert {

using GiNaC::ex;
using GiNaC::numeric;

namespace {

bool has_vectors(const Tree& tree) {
    const Function* const function = tree.kind == Tree::Kind::call ? find_function(tree.text) : nullptr;
    return (function != nullptr && function->takes == Function::Takes::vectors) ||
           std::any_of(tree.args.begin(), tree.args.end(), [](const TreePtr& arg) { return has_vectors(*arg); });
}

bool has_vectors(const Claim& claim) {
    return has_vectors(*claim.equation.lhs.tree) || has_vectors(*claim.equation.rhs.tree);
}

class Diagnostician {
public:
    Diagnostician(const WrongClaim& asked, ExactStates& states)
        : asked_(asked),
          claim_(asked.scene.claims[asked.claim]),
          form_(asked.forms[asked.claim]),
          claims_(asked.claims),
          m_(asked.claims.mechanism()),
          states_(states) {}

    Diagnosis diagnosis() {
        Diagnosis result;
        if (states_.motions.where() == Motions::At::rest)
            result.reason = name_branch();
        else if (holds_at_scene_values())
            result.reason = say("it holds at the scene's values of the parameters only");
        if (form_.open.empty() && asked_.in_motion)
            if (const auto nearest = nearest_equation(form_.residual, m_, asked_.law)) {
                result.nearest = nearest->equation;
                result.difference = nearest->difference;
            }
        const auto right = [&](const Claim& repaired) {
            try {
                return holds_quickly(claims_.read(repaired), asked_.at_impact || has_vectors(repaired));
            } catch (const SceneMistake&) {
                return false;
            } catch (const std::exception&) {  // it divides by zero, for instance
                return false;
            }
        };
        const auto vanishes = [&](const Expression& value) {
            Program p;
            const std::optional<int> root = node_of(p, value);
            return root && (p.is_zero(*root) || vanishes_at_two(states_, p, *root));
        };
        result.likely = likely_slip(claim_, form_.residual, m_, asked_.law,
                                    {.is_right = right,
                                     .vanishes = vanishes,
                                     .absent = [&](const Claim& claim, std::vector<std::string> terms) {
                                         return absent(claim, std::move(terms));
                                     }});
        if (!result.likely)
            if (const auto term = term_of_wrong_unit(claim_, m_))
                result.likely = Slip{.kind = "wrong_unit", .term = *term, .repair = {}};
        return result;
    }

private:
    /// The node of `value`. Returns nothing if the expression cannot be translated or contains open names.
    std::optional<int> node_of(Program& p, const Expression& value) {
        try {
            const ex e = claims_.read(value);
            if (m_.z->depends(e, claims_.open_symbols())) return std::nullopt;
            return claims_.lower(p, {e})[0];
        } catch (const std::exception&) {
            return std::nullopt;
        } catch (const SceneMistake&) {
            return std::nullopt;
        }
    }

    /// Terms that the claim may lack, each with its coefficient.
    std::vector<std::pair<std::string, std::string>> absent(const Claim& claim, std::vector<std::string> terms) {
        const ClaimForm form = claims_.read(claim);
        if (!form.open.empty()) return {};
        Program p;
        const int residual = claims_.lower(p, {form.residual})[0];
        std::vector<std::string> texts;
        std::vector<int> nodes;
        std::vector<Diagnostic> mistakes;
        if (terms.empty()) {
            if (!asked_.known) asked_.known = equation_terms(m_, asked_.law);
            terms = terms_of_mechanics(claim, m_, asked_.law, *asked_.known);
        }
        for (std::string& text : terms) {
            const Expression value = parse_expression(text, {}, mistakes);
            const std::optional<int> node = value.tree ? node_of(p, value) : std::nullopt;
            if (!node || p.is_zero(*node)) continue;
            nodes.push_back(*node);
            texts.push_back(std::move(text));
        }
        std::vector<Steady> steady;
        for (const std::string& text : steady_sums(claim, m_)) {
            const Expression value = parse_expression(text, {}, mistakes);
            if (const std::optional<int> node = value.tree ? node_of(p, value) : std::nullopt)
                steady.push_back({text, *node});
        }
        std::vector<ModularPoint> points;
        const std::size_t most = states_.motions.where() == Motions::At::rest ? states_of_rest : 12;
        for (std::size_t s = 0; s < most && states_.get(s) != nullptr; ++s)
            points.push_back(states_.get(s)->point);
        std::vector<std::pair<std::string, std::string>> result;
        for (const Absent& term : absent_terms(p, residual, nodes, steady, points))
            result.emplace_back(term.coefficient, texts[term.term]);
        return result;
    }

    /// An identity is no repair, unless it says something: how a vector of the scene is composed.
    bool holds_quickly(const ClaimForm& form, bool may_be_identity) {
        if (!form.open.empty()) {
            // The claim is tested with the right claims of its group; if these do not determine the open names, it
            // is tested with all claims of the group.
            std::vector<ClaimForm> forms = asked_.forms;
            forms[asked_.claim] = form;
            std::vector<std::size_t> group = group_of(asked_.scene, forms, asked_.claim), right = group;
            std::erase_if(
                right, [&](std::size_t other) { return other != asked_.claim && asked_.wrong.contains(other); });
            return agrees(forms, right) || (right.size() < group.size() && agrees(forms, group));
        }
        Program p;
        const int root = claims_.lower(p, {form.residual})[0];
        if (p.is_zero(root)) return may_be_identity;
        return vanishes_at_two(states_, p, root);
    }

    bool agrees(const std::vector<ClaimForm>& forms, const std::vector<std::size_t>& group) {
        const OpenRows rows = open_rows(claims_, forms, group);
        for (std::size_t s = 0; s < 2; ++s) {
            const auto at = open_matrix(rows, states_, s);
            if (!at || !consistent(at->rows) || pins(rows, *at, {}, asked_.claim)) return false;
        }
        return true;
    }

    bool holds_at_scene_values() {
        if (!form_.open.empty() || !states_.motions.steps().empty()) return false;
        ModularPoint point;
        int independent = 0;
        std::map<std::pair<Variable::Kind, int>, Prime> values;
        for (const Mechanism::Parameter& p : m_.parameters) {
            if (!p.independent) continue;
            const auto value = Prime::from(cln::the<cln::cl_RA>(GiNaC::ex_to<numeric>(p.value).to_cl_N()));
            if (!value) return false;
            values[{Variable::Kind::parameter, independent++}] = *value;
        }
        if (independent == 0) return false;
        Program p;
        const std::array<int, 1> root{claims_.lower(p, {form_.residual})[0]};
        int usable = 0;
        for (std::uint64_t seed = 1; seed < 40 && usable < 2; ++seed) {
            const auto state = states_.motions.at(seed, values);
            if (!state) continue;
            const auto at = evaluate_mod(p, state->point, root);
            if (!at) continue;
            if (!at->value[root[0]].is_zero()) return false;
            ++usable;
        }
        return usable == 2;
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

    const WrongClaim& asked_;
    const Claim& claim_;
    const ClaimForm& form_;
    Claims& claims_;
    const Mechanism& m_;
    ExactStates& states_;
};

}  // namespace

Diagnosis diagnose(const WrongClaim& asked, ExactStates& states) {
    return Diagnostician(asked, states).diagnosis();
}

}  // namespace alembert
