// SPDX-License-Identifier: GPL-2.0-or-later
#include "check/slip.hpp"

#include <algorithm>

#include "algebra/notation/readable.hpp"
#include "check/alien_force.hpp"
#include "check/claim_arithmetic.hpp"
#include "check/edits.hpp"
#include "check/nearest.hpp"
#include "check/needed_factor.hpp"
#include "check/phrase_tree.hpp"
#include "check/steady_factor.hpp"

namespace alembert {

using GiNaC::ex;

namespace {

/// Sizes of what follows the changes of a part.
constexpr int most_own_terms = 3;
constexpr double of_own_term = 1.72, of_more_terms = 1.3, of_alien_force = 2.95, of_missing_term = 3.05,
                 of_two_signs = 3.3, of_factor_on_rest = 3.2;
/// A correction that gives the scene's own equation, energy or momentum term by term counts as smaller by this.
constexpr double largest_bonus = 0.5, bonus_but_for_a_factor = 0.36;

class Search {
public:
    Search(const Claim& claim, const ex& residual, const Mechanism& m, const Equations& e, const Judge& judge)
        : claim_(claim),
          residual_(residual),
          m_(m),
          e_(e),
          judge_(judge),
          words_(words_of_scene()),
          edits_(claim, words_) {}

    std::optional<Repair> find() {
        if (!edits_.complete) return std::nullopt;
        std::vector<Edit> parts = edits_.list;
        if (judge_.arithmetic != nullptr) {
            const std::vector<Edit> needed = needed_factors(claim_, edits_, words_, m_, *judge_.arithmetic);
            parts.insert(parts.end(), needed.begin(), needed.end());
        }
        add_lost_derivative(parts);
        add_own_terms(parts);
        const std::optional<Found> found = smallest(parts);
        if (found && found->size < of_missing_term) return found->repair;
        std::vector<Edit> rest;
        add_missing_terms(rest);
        add_pairs_of_signs(rest);
        for (Edit& edit : edits_.with_factor_on_rest(of_factor_on_rest)) rest.push_back(std::move(edit));
        const std::optional<Found> other = smallest(rest);
        if (found && (!other || found->size <= other->size)) return found->repair;
        return other ? std::optional(other->repair) : std::nullopt;
    }

private:
    /// The slip that the smallest of these changes sets right.
    struct Found {
        Repair repair;
        double size;
    };
    std::optional<Found> smallest(std::vector<Edit>& edits) {
        std::stable_sort(edits.begin(), edits.end(), [](const Edit& a, const Edit& b) { return a.size < b.size; });
        std::optional<Found> best;
        for (const Edit& edit : edits) {
            if (best && edit.size >= best->size + largest_bonus) break;
            auto repair = after(edit);
            if (!repair) continue;
            const double size = edit.size - bonus(edit);
            if (!best || size < best->size) best = Found{std::move(*repair), size};
        }
        return best;
    }

    // What may stand in an equation

    ClaimWords words_of_scene() const {
        ClaimWords words;
        for (const Mechanism::Parameter& p : m_.parameters) {
            const std::string name = p.symbol.get_name();
            words.parameters.push_back(name);
            bool is_length = p.unit == "m";
            for (const MassElement& body :
                 m_.masses)  // used if units are not given; an angular rate occurs in positions too
                for (const ex& x : body.position)
                    is_length = is_length || (p.unit.empty() && m_.z->depends(x, {p.symbol}));
            const bool without_units = m_.masses.empty() && p.unit.empty();
            if (is_length || (without_units && std::string("lLrRabdhs").find(name[0]) != std::string::npos))
                words.lengths.insert(name);
        }
        for (const GiNaC::symbol& q : m_.q) words.coordinates.push_back(q.get_name());
        for (const Mechanism::Input& input : m_.inputs) words.inputs.push_back(input.derivative[0].get_name());
        for (const Mechanism::State& z : m_.states) words.inputs.push_back(z.derivative[0].get_name());
        for (const GiNaC::symbol& lambda : e_.lambda) words.multipliers.push_back(lambda.get_name());
        const EquationTerms& terms = judge_.terms();
        TreesByText angles = terms.angles;
        for (const Expression* side : {&claim_.equation.lhs, &claim_.equation.rhs}) add_angles(side->tree, angles);
        for (const auto& [text, angle] : angles) words.angles.push_back(angle);
        for (const auto& [text, term] : terms.steady) words.steady.push_back(term);
        return words;
    }

    static void add_angles(const TreePtr& tree, TreesByText& angles) {
        if (tree->kind == Tree::Kind::call && (tree->text == "sin" || tree->text == "cos" || tree->text == "tan"))
            angles.emplace(plain_text_of(*tree->args[0]), detached(tree->args[0]));
        for (const TreePtr& arg : tree->args) add_angles(arg, angles);
    }

    // Asking

    /// The slip that this change sets right.
    std::optional<Repair> after(const Edit& edit) {
        if (judge_.arithmetic != nullptr) {
            if (judge_.arithmetic->effort() > most_effort || !judge_.arithmetic->vanishes(*edit.lhs, *edit.rhs) ||
                only_vanishes(edit))
                return std::nullopt;
        }
        const std::string lhs = text_of(*edit.lhs, claim_.equation.lhs.text),
                          rhs = text_of(*edit.rhs, claim_.equation.rhs.text);
        asked_ += lhs.size() + rhs.size();
        if (asked_ > most_asked) return std::nullopt;
        Claim repaired = claim_;
        repaired.equation = {.lhs = {.text = lhs, .places = {}, .tree = edit.lhs},
                             .rhs = {.text = rhs, .places = {}, .tree = edit.rhs}};
        if (!judge_.is_right(repaired)) return std::nullopt;
        if (judge_.arithmetic == nullptr && only_vanishes(edit)) return std::nullopt;
        Slip slip{.kind = edit.kind,
                  .term = edit.term,
                  .repair = text_of(repaired.equation),
                  .should_be = edit.should_be,
                  .written = edit.written,
                  .meant = edit.meant,
                  .also = edit.also};
        return Repair{std::move(slip), std::move(repaired.equation)};
    }

    /// A change that makes its term vanish on every motion is no correction, unless the term is all that there is.
    bool only_vanishes(const Edit& edit) {
        if (!edit.changed || edit.kind == "sign" || edit.kind == "missing_term") return false;
        const bool alone = std::any_of(edits_.summands.begin(), edits_.summands.end(), [&](const Summand& s) {
            return s.alone && !s.in_angle && !s.in_derivative &&
                   text_of(*s.body, s.left ? claim_.equation.lhs.text : claim_.equation.rhs.text) == edit.term;
        });
        if (alone) return false;
        if (judge_.arithmetic != nullptr) {
            for (std::size_t k = 0; k < judge_.arithmetic->points(); ++k)
                if (const auto value = judge_.arithmetic->value(*edit.changed, k); value && !value->is_zero())
                    return false;
            return true;
        }
        return judge_.vanishes(expression_of(*edit.changed));
    }

    /// How much smaller the change counts because the changed claim's terms are those of the scene's equations,
    /// energies or momenta, but for their signs, or for one factor of parameters too.
    double bonus(const Edit& edit) {
        if (judge_.arithmetic == nullptr || judge_.arithmetic->points() < SteadyFactors::states) return 0;
        if (!known_) know_terms();
        std::vector<Values> terms;
        for (const TreePtr& side : {edit.lhs, edit.rhs})
            for (const TreePtr& term : side->kind == Tree::Kind::sum ? side->args : std::vector<TreePtr>{side}) {
                if (is_constant(*term)) continue;
                auto values = values_of(*term);
                if (!values) return 0;
                if (!is_zero(*values)) terms.push_back(std::move(*values));
            }
        const auto is_known = [&](const Values& term) { return known_->contains(term); };
        if (std::all_of(terms.begin(), terms.end(), is_known)) return largest_bonus;
        const auto fits = [&](const Values& first) {
            const Values scale = quotient(terms[0], first);
            return steady_->of({scale[0], scale[1], scale[2]}) &&
                   std::all_of(terms.begin() + 1, terms.end(),
                               [&](const Values& term) { return is_known(quotient(term, scale)); });
        };
        return std::any_of(known_->begin(), known_->end(), fits) ? bonus_but_for_a_factor : 0;
    }

    using Values = std::vector<Prime>;

    void know_terms() {
        TreesByText trees;
        const auto add = [&](const TreePtr& tree) { trees.emplace(plain_text_of(*tree), tree); };
        for (const TreePtr& term : judge_.terms().of_energies) add(term);
        for (const auto& row : rows_of(m_, e_))
            if (row)
                for (const Fourier& part : parts_of(*row)) add(tree_of(readable(part)));
        known_.emplace();
        for (const auto& [text, tree] : trees)
            if (const auto values = values_of(*tree); values && !any_zero(*values)) {
                known_->insert(negative(*values));
                known_->insert(*values);
            }
        std::vector<SteadyFactors::Values> parameters;
        for (const std::string& name : words_.parameters)
            if (const auto values = values_of(*name_tree(name)); values && !any_zero(*values))
                parameters.push_back({(*values)[0], (*values)[1], (*values)[2]});
        steady_.emplace(std::move(parameters));
    }

    std::optional<Values> values_of(const Tree& tree) {
        Values values;
        for (std::size_t k = 0; k < judge_.arithmetic->points(); ++k)
            if (const auto value = judge_.arithmetic->value(tree, k))
                values.push_back(*value);
            else
                return std::nullopt;
        return values;
    }
    static Values negative(Values values) {
        for (Prime& value : values) value = -value;
        return values;
    }
    static Values quotient(Values values, const Values& by) {
        for (std::size_t k = 0; k < values.size(); ++k) values[k] *= by[k].inverse();
        return values;
    }
    static bool is_zero(const Values& values) {
        return std::all_of(values.begin(), values.end(), [](Prime value) { return value.is_zero(); });
    }
    static bool any_zero(const Values& values) {
        return std::any_of(values.begin(), values.end(), [](Prime value) { return value.is_zero(); });
    }
    bool is_constant(const Tree& term) const {
        return term.kind == Tree::Kind::name &&
               std::any_of(claim_.constants.begin(), claim_.constants.end(),
                           [&](const Name& name) { return name.text == term.text; });
    }

    // Whole terms

    /// (m r² θ')' = m r² θ'': a term of the product rule.
    void add_lost_derivative(std::vector<Edit>& edits) const {
        constexpr std::size_t most_terms = 200;
        if (!has_derivative(*claim_.equation.lhs.tree) && !has_derivative(*claim_.equation.rhs.tree)) return;
        const auto wrong = fourier(m_.z->expand(residual_), *m_.symbols, most_terms);
        if (!wrong || wrong->size() != 1) return;
        const TreePtr term = tree_of(readable(Rational(-1) * *wrong));
        edits.push_back(edits_.with_term(term, is_accelerated(*term), of_own_term - 0.1));
    }

    void add_own_terms(std::vector<Edit>& edits) const {
        if (const auto nearest = nearest_equation(residual_, m_, e_)) {
            const auto rows = rows_of(m_, e_);
            const auto& row = rows[static_cast<std::size_t>(nearest->row)];
            const Fourier missing = Rational(-1) * nearest->wrong;
            Fourier rest = missing;
            int terms = 0;
            for (const Fourier& part : parts_of(nearest->scale * *row))
                if ((rest - part).size() + part.size() == rest.size()) rest = rest - part, ++terms;
            if (alembert::is_zero(rest) && terms > 0 && terms <= most_own_terms) {
                const TreePtr term = tree_of(readable(missing));
                edits.push_back(
                    edits_.with_term(term, is_accelerated(*term), of_own_term + of_more_terms * (terms - 1)));
            }
            for (Edit& edit : alien_forces(*nearest, edits_, m_, e_, of_alien_force))
                edits.push_back(std::move(edit));
        }
    }

    void add_missing_terms(std::vector<Edit>& edits) {
        constexpr std::size_t most_tried = 12;
        const std::vector<MissingTerm> missing = judge_.missing();
        for (std::size_t k = 0; k < std::min(most_tried, missing.size()); ++k)
            if (const TreePtr& term = missing[k].tree; !is_there(*term))
                edits.push_back(edits_.with_term(tidy(term), is_accelerated(*term),
                                                 of_missing_term + 0.1 * missing[k].effort));
    }

    /// With equal factors together.
    TreePtr tidy(const TreePtr& term) const {
        if (term->kind == Tree::Kind::sum) return term;
        return merged(term, [this](const Tree& tree) { return words_.is_steady(tree); });
    }

    /// Whether a second derivative is in it, or the derivative of a speed.
    bool has_acceleration(const Tree& term) const {
        const auto is_speed = [&](const Mechanism::Speed& speed) { return speed.u.get_name() == term.text; };
        return is_accelerated(term) ||
               (term.kind == Tree::Kind::name && term.primes > 0 &&
                std::any_of(m_.speeds.begin(), m_.speeds.end(), is_speed)) ||
               std::any_of(term.args.begin(), term.args.end(),
                           [&](const TreePtr& arg) { return has_acceleration(*arg); });
    }

    /// Whether it is a number times a term that the claim has. On motions an acceleration may be equal to a term
    /// without any, as in I1*w1' = (I2 - I3)*w2*w3; these are not the same.
    bool is_there(const Tree& term) {
        if (judge_.arithmetic == nullptr || claim_.at == Claim::At::impact)
            return false;  // the pose is fixed there
        const auto values = values_of(term);
        return values && std::any_of(edits_.summands.begin(), edits_.summands.end(), [&](const Summand& s) {
                   if (s.in_angle || has_acceleration(*s.body) != has_acceleration(term)) return false;
                   const auto own = values_of(*s.body);
                   if (!own || values->empty()) return false;
                   for (std::size_t k = 1; k < values->size(); ++k)
                       if ((*own)[k] * (*values)[0] != (*own)[0] * (*values)[k]) return false;
                   return !(*own)[0].is_zero();
               });
    }

    /// Two terms whose signs are both wrong, as those of one potential.
    void add_pairs_of_signs(std::vector<Edit>& edits) const {
        constexpr std::size_t most_terms = 12;
        std::vector<const Summand*> terms;
        for (const Summand& s : edits_.summands)
            if (!s.in_angle && !s.in_derivative) terms.push_back(&s);
        if (terms.size() > most_terms || judge_.arithmetic == nullptr) return;
        for (std::size_t i = 0; i < terms.size(); ++i)
            for (std::size_t j = i + 1; j < terms.size(); ++j)
                if (auto edit = edits_.with_two_signs(*terms[i], *terms[j], of_two_signs))
                    edits.push_back(std::move(*edit));
    }

    const Claim& claim_;
    const ex& residual_;
    const Mechanism& m_;
    const Equations& e_;
    const Judge& judge_;
    ClaimWords words_;
    Edits edits_;
    static constexpr std::size_t most_asked = 300000;    // in bytes of claims, which takes some tenths of a second
    static constexpr std::size_t most_effort = 3000000;  // nodes, likewise
    std::size_t asked_ = 0;
    std::optional<std::set<Values>> known_;  ///< values of the terms of the scene's equations, with both signs
    std::optional<SteadyFactors> steady_;    ///< factors of parameters
};

}  // namespace

std::optional<Repair> likely_slip(const Claim& claim, const ex& residual, const Mechanism& mechanism,
                                  const Equations& equations, const Judge& judge) {
    return Search(claim, residual, mechanism, equations, judge).find();
}

}  // namespace alembert
