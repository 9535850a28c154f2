// SPDX-License-Identifier: GPL-2.0-or-later
#include "analysis/exact/motions.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "alembert/base/error.hpp"
#include "analysis/exact/cells.hpp"
#include "analysis/exact/counted_angle.hpp"
#include "analysis/exact/reduced_sums.hpp"
#include "analysis/exact/solve_condition.hpp"
#include "base/language/say.hpp"
#include "model/formalism/rest.hpp"
#include "model/held_functions.hpp"
#include "program/lower/lower.hpp"

namespace alembert {

using GiNaC::ex;

namespace {

/// f(q, 0) + Σ λ_k A_k, the equations of the rates and the rates of the states, with q' = q'' = 0: all of them
/// vanish at rest.
std::vector<ex> balance_at_rest(const Mechanism& m, const Equations& e) {
    GiNaC::exmap still;
    for (const GiNaC::symbol& rate : m.qdot) still[rate] = 0;
    const auto at_rest = [&](const ex& value) {
        return m.z->expand(value).subs(still, GiNaC::subs_options::no_pattern);
    };
    std::vector<ex> balance;
    for (int i = 0; i < e.size(); ++i) {
        GiNaC::exvector terms{at_rest(e.forcing(i))};
        for (std::size_t k = 0; k < e.A.size(); ++k) terms.push_back(at_rest(e.A[k][i]) * e.lambda[k]);
        balance.push_back(GiNaC::add(std::move(terms)));
    }
    for (std::size_t k = 0; k < e.A.size(); ++k) {
        balance.push_back(at_rest(m.constraints[k].offset));
        balance.push_back(at_rest(e.gamma[k]));
    }
    for (const Mechanism::State& state : m.states) balance.push_back(at_rest(state.rate));
    return balance;
}

/// Friction follows the reaction, which constraints that depend on each other do not determine.
void need_determined_reactions(const Mechanism& m) {
    if (m.redundant.empty()) return;
    for (const Mechanism::Friction& f : m.frictions)
        if (f.multiplier)
            throw ModelError(say(
                "claims are not decided where friction, as '{}', is on a constraint while constraints depend on "
                "each other: '{}' follows from the others, so that the equations do not say which part of the "
                "reaction each of them bears; leave '{}' out of the scene",
                f.name, m.redundant[0].name, m.redundant[0].name));
}

/// The rows on which friction acts whose normal force is their reaction.
std::vector<int> find_rows_with_friction(const Mechanism& m, const Equations& e) {
    std::vector<int> rows;
    for (std::size_t k = 0; k < e.lambda.size(); ++k) {
        const auto rubs = [&](const Mechanism::Friction& f) {
            return f.multiplier && f.multiplier->is_equal(e.lambda[k]);
        };
        if (std::any_of(m.frictions.begin(), m.frictions.end(), rubs)) rows.push_back(static_cast<int>(k));
    }
    return rows;
}

}  // namespace

Motions::Motions(const Mechanism& mechanism, const Equations& e) : Motions(mechanism, e, Sampling()) {}

Motions::Motions(const Mechanism& mechanism, const Equations& e, Sampling sampling)
    : own_(std::move(sampling.own)),
      at_(sampling.at),
      n_(e.size()),
      m_(static_cast<int>(e.A.size())),
      halves_(sampling.halves) {
    const Mechanism m = in_terms_of(e, mechanism);
    rows_with_friction_ = find_rows_with_friction(m, e);
    if (!rows_with_friction_.empty()) need_determined_reactions(m);
    for (const Mechanism::Parameter& p : m.parameters)
        if (p.independent) own_values_.push_back(p.number());
    std::vector<ex> list;
    for (int i = 0; i < n_; ++i)
        for (int j = 0; j < n_; ++j) list.push_back(e.M(i, j));
    for (int i = 0; i < n_; ++i) list.push_back(e.forcing(i));
    for (const auto& row : e.A) list.insert(list.end(), row.begin(), row.end());
    for (int k = 0; k < m_; ++k) list.push_back(m.constraints[k].offset);
    list.insert(list.end(), e.gamma.begin(), e.gamma.end());
    for (int k = 0; k < m_; ++k)
        if (m.constraints[k].position) list.push_back(*m.constraints[k].position);
    for (const Mechanism::Constraint& c : m.redundant) list.insert(list.end(), c.row.begin(), c.row.end());
    const std::size_t implied = list.size();
    for (const Mechanism::Constraint& c : m.redundant)
        if (c.position) list.push_back(*c.position);
    // The multiplier of a contact may have any value, so it is a variable like any other.
    std::vector<std::pair<GiNaC::symbol, int>> given;
    int next_unknown = m_;
    for (const Mechanism::Constraint* c : m.undetermined())
        given.emplace_back(c->multiplier, program_.variable({Variable::Kind::unknown, next_unknown++}));
    if (at_ != At::rest)
        for (const int k : rows_with_friction_)
            given.emplace_back(e.lambda[static_cast<std::size_t>(k)],
                               program_.variable({Variable::Kind::unknown, k}));
    for (const auto& [call, value] : held_functions(m))
        given.emplace_back(call, lower_expressions(program_, m, {value})[0]);
    const std::vector<int> nodes = lower_expressions(program_, m, list, given);
    auto next = nodes.begin();
    const auto take = [&](int count) {
        std::vector<int> part(next, next + count);
        next += count;
        return part;
    };
    system_.M = take(n_ * n_);
    system_.f = take(n_);
    system_.A = take(m_ * n_);
    system_.offset = take(m_);
    system_.gamma = take(m_);
    const auto redundant = static_cast<std::ptrdiff_t>(m.redundant.size() * m.q.size());
    gaps_ = static_cast<int>(m.unilateral.size());
    std::vector<int> conditions(next, nodes.begin() + static_cast<std::ptrdiff_t>(implied) - redundant);
    system_.redundant.assign(nodes.begin() + static_cast<std::ptrdiff_t>(implied) - redundant,
                             nodes.begin() + static_cast<std::ptrdiff_t>(implied));
    std::erase_if(conditions, [&](int node) { return program_.is_zero(node); });
    implied_.assign(nodes.begin() + static_cast<std::ptrdiff_t>(implied), nodes.end());

    if (at_ == At::rest) {
        for (int k = 0; k < m_; ++k)
            given.emplace_back(e.lambda[k], program_.variable({Variable::Kind::unknown, k}));
        order_rest(conditions, balance_at_rest(m, e), m, given);
    } else if (sampling.positions == Positions::free)
        loose_ = conditions;
    else
        order(conditions);
    has_sides_ = !Cells(program_, nodes).empty();
    find_usable_points(nodes, sampling.halvings);
    find_branches();
    find_open_unknowns();
    if (own_ && !steps_.empty() && loose_.empty() && at_ == At::motion)
        own_points_.emplace(program_, steps_, *own_, halves_);
}

void Motions::find_usable_points(std::vector<int> nodes, int halvings) {
    std::set<QuadraticResiduePoints::Key> solved;
    for (const SolvingStep& step : steps_) {
        nodes.push_back(step.node);
        solved.insert({step.variable.kind, step.variable.index});
        if (!step.second) continue;
        nodes.push_back(step.second->node);
        solved.insert({step.second->variable.kind, step.second->variable.index});
    }
    nodes.insert(nodes.end(), loose_.begin(), loose_.end());
    finer_ = std::max(0, std::max(halvings, alembert::halvings(program_, nodes)) - halves_);
    usable_.emplace(std::vector{QuadraticResiduePoints::Part{&program_, std::move(nodes)}}, solved);
}

void Motions::order(const std::vector<int>& conditions) {
    std::optional<OwnSlopes> slopes;
    if (own_) slopes.emplace(program_, *own_);
    SolvingOrder found = solving_order(program_, conditions, {}, slopes ? &*slopes : nullptr);
    steps_ = std::move(found.steps);
    loose_ = std::move(found.left);
}

void Motions::order_rest(const std::vector<int>& positions, const std::vector<ex>& balance, const Mechanism& m,
                         const std::vector<std::pair<GiNaC::symbol, int>>& given) {
    std::map<int, ex> sum_of;  // of a condition
    const auto ordered = [&](const std::vector<ex>& sums) {
        std::vector<int> conditions = positions;
        std::set<int> irreducible;
        const std::vector<int> nodes = lower_expressions(program_, m, sums, given);
        for (std::size_t i = 0; i < sums.size(); ++i) {
            if (program_.is_zero(nodes[i])) continue;
            conditions.push_back(nodes[i]);
            sum_of[nodes[i]] = sums[i];
            if (!holds_parameters_alone(program_, nodes[i])) continue;
            const TrigonometricProduct product = product_of(sums[i].expand(), m);
            if (product.bases.size() != 1) continue;
            const ex factor = product.bases[0].subs(product.functions, GiNaC::subs_options::no_pattern);
            conditions.back() = lower_expressions(program_, m, {factor}, given)[0];
            irreducible.insert(conditions.back());
        }
        return solving_order(program_, conditions, irreducible);
    };
    const auto is_simple = [](const SolvingOrder& order) {
        return order.left.empty() && std::none_of(order.steps.begin(), order.steps.end(),
                                                  [](const SolvingStep& step) { return step.second.has_value(); });
    };
    SolvingOrder found = ordered(balance);
    for (const Singled first : {Singled::plain_terms, Singled::turned_terms}) {
        if (is_simple(found)) break;
        SolvingOrder other = ordered(reduced_sums(balance, first));
        if (is_simple(other) || (other.left.empty() && !found.left.empty())) found = std::move(other);
    }
    steps_ = std::move(found.steps);
    loose_ = std::move(found.left);
    if (!loose_.empty() || !find_other_factors(sum_of, m, given))
        obstacle_ = say("the equations of rest cannot be solved one after the other");
}

bool Motions::find_other_factors(const std::map<int, ex>& sums, const Mechanism& m,
                                 const std::vector<std::pair<GiNaC::symbol, int>>& given) {
    constexpr std::size_t most_choices = 32;
    bool has_factors = false;
    std::vector<std::vector<int>> choices{{}};  // of one factor for each condition
    const auto add = [&](const SolvedUnknown& unknown) {
        std::vector<int> factors;
        bool is_repeated = false;
        if (const auto sum = sums.find(unknown.node); sum != sums.end()) {
            const TrigonometricProduct product = product_of(sum->second.expand(), m);
            is_repeated = product.is_repeated;
            for (const ex& base : product.bases) {
                const ex factor = base.subs(product.functions, GiNaC::subs_options::no_pattern);
                const int node = lower_expressions(program_, m, {factor}, given)[0];
                if (!holds_parameters_alone(program_, node)) factors.push_back(node);
            }
        }
        if (factors.empty() || (factors.size() < 2 && !is_repeated)) factors = {unknown.node};
        has_factors = has_factors || factors.size() > 1 || is_repeated;
        is_lost_ = is_lost_ || !std::all_of(factors.begin(), factors.end(),
                                            [&](int factor) { return holds(program_, factor, unknown); });
        std::vector<std::vector<int>> longer;
        for (const std::vector<int>& before : choices)
            for (const int factor : factors) {
                longer.push_back(before);
                longer.back().push_back(factor);
            }
        choices = std::move(longer);
    };
    for (const SolvingStep& step : steps_) {
        add(step);
        if (step.second) add(*step.second);
        if (choices.size() > most_choices) return false;
    }
    if (!has_factors && !is_lost_) return true;
    for (const std::vector<int>& choice : choices) {
        SolvingOrder other = solving_order(program_, choice);
        if (!other.left.empty() && !is_lost_) continue;
        if (!other.left.empty() && !contradict(other)) return false;
        (other.left.empty() ? other_orders_ : contradicted_).push_back(std::move(other));
    }
    return true;
}

bool Motions::contradict(const SolvingOrder& order) const {
    constexpr std::uint64_t most_seeds = 40, other_seeds = 2000000;
    constexpr int enough = 3;
    int found = 0;
    for (std::uint64_t seed = 1; seed <= most_seeds && found < enough; ++seed) {
        ExactState state{.point = {.seed = other_seeds + seed, .given = {}, .halves = halves_, .finer = finer_}};
        const bool is_solved = std::all_of(order.steps.begin(), order.steps.end(), [&](const SolvingStep& step) {
            return solve_condition(program_, step, state).found;
        });
        const auto at = is_solved ? evaluate_mod(program_, state.point, order.left) : std::nullopt;
        if (!at) continue;
        if (std::all_of(order.left.begin(), order.left.end(),
                        [&](int node) { return at->value[static_cast<std::size_t>(node)].is_zero(); }))
            return false;
        ++found;
    }
    return found == enough;
}

void Motions::find_branches() {
    irreducible_.assign(steps_.size(), false);
    has_branches_ = false;
    constexpr std::uint64_t most_tries = 40, other_seeds = 1000000;
    std::vector<bool> known(steps_.size(), false);
    std::vector<std::size_t> highest(steps_.size(), 1);
    for (std::uint64_t seed = 1;
         seed < most_tries && obstacle_.empty() && std::find(known.begin(), known.end(), false) != known.end();
         ++seed) {
        ExactState state{.point = {.seed = other_seeds + seed, .given = {}, .halves = halves_, .finer = finer_}};
        for (std::size_t k = 0; k < steps_.size(); ++k) {
            const Solved outcome = solve_condition(program_, steps_[k], state);
            if (outcome.found) {
                known[k] = known[k] || outcome.degree == 1;
                highest[k] = std::max(highest[k], outcome.degree);
                continue;
            }
            if (outcome.degree == 2) known[k] = irreducible_[k] = true;
            break;
        }
    }
    for (std::size_t k = 0; k < steps_.size(); ++k)
        has_branches_ = has_branches_ || (!irreducible_[k] && highest[k] > 1);
}

std::optional<ExactState> Motions::at(std::uint64_t seed, const Given& given, unsigned turned) const {
    if (!obstacle_.empty()) return std::nullopt;
    ExactState state{.point = {.seed = seed,
                               .given = given.values,
                               .given_angles = given.angles,
                               .halves = halves_,
                               .finer = finer_}};
    return solved(std::move(state), nullptr, turned);
}

std::optional<ExactState> Motions::on_own_branch(std::uint64_t seed) const {
    if (!obstacle_.empty() || !own_points_) return std::nullopt;
    const std::optional<OwnPoint> own = own_points_->at(seed);
    if (!own) return std::nullopt;
    ExactState state{.point = {.seed = seed, .given = {}, .halves = halves_, .finer = finer_},
                     .field = OwnPoints::field};
    for (const auto& [key, value] : own->values) state.point.given[key] = value;
    for (const auto& [key, x] : own->angles) {
        const Prime plain = state.point.variable({key.first, key.second});
        state.point.given[key] = plain;
        state.point.given_angles[plain] = counted_angle::turn_at(x);
    }
    return solved(std::move(state), &*own, 0);
}

Motions::Outcome Motions::solve_steps(ExactState& state, const OwnPoint* own, std::size_t step,
                                      KnownRows* known) const {
    const std::size_t before = known != nullptr ? known->rows.size() : 0;
    const auto forget = [&] {
        known->rows.resize(before);
        known->pivots.resize(before);
    };
    if (known != nullptr && !add_known_rows(state, step, *known)) {
        forget();
        return Outcome::dependent_rows;
    }
    const std::vector<SolvingStep>& list = exact_steps(state.point.seed);
    if (step == list.size()) return Outcome::solved;
    const int most_draws = 8 * static_cast<int>(list.size()) + 8;
    const OwnRoot* const root = own == nullptr ? nullptr : &own->roots[step];
    for (std::size_t after = 0;; ++after) {
        ExactState next = state;
        const Solved outcome = solve_condition(program_, list[step], next, root, after);
        if (!outcome.found) return Outcome::no_root;
        if (root == nullptr && (&list != &steps_ || !irreducible_[step]))
            next.branches *= static_cast<double>(std::max<std::size_t>(outcome.degree, 1));
        const Outcome rest = solve_steps(next, own, step + 1, known);
        if (rest == Outcome::solved) state = std::move(next);
        if (rest != Outcome::dependent_rows) return rest;
        if (after + 1 >= outcome.roots || ++known->draws >= most_draws) break;
    }
    forget();
    return Outcome::dependent_rows;
}

std::optional<ExactState> Motions::solved(ExactState state, const OwnPoint* own, unsigned turned) const {
    if (at_ == At::rest)
        for (int i = 0; i < n_; ++i)
            for (const Variable::Kind kind : {Variable::Kind::rate, Variable::Kind::acceleration})
                state.point.given[{kind, i}] = 0;
    for (std::size_t i = 0; i < own_values_.size(); ++i) {
        const Prime drawn = state.point.random(901, i), square = drawn * drawn;
        const int parameter = static_cast<int>(i), sign = sign_of_parameter(parameter);
        state.point.given.try_emplace({Variable::Kind::parameter, parameter}, sign == 0  ? drawn
                                                                              : sign < 0 ? -square
                                                                                         : square);
    }
    auto point = usable_->at(std::move(state.point));
    if (!point) return std::nullopt;
    state.point = std::move(*point);
    const bool has_independent_rows = at_ == At::motion && open_unknowns_.empty();
    KnownRows known;
    if (solve_steps(state, own, 0, has_independent_rows ? &known : nullptr) != Outcome::solved)
        return std::nullopt;
    if (at_ == At::motion && !move(state, turned)) return std::nullopt;
    if (!system_.redundant.empty() && !share_out(state)) return std::nullopt;
    return state;
}

}  // namespace alembert
