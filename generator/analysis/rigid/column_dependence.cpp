// SPDX-License-Identifier: GPL-2.0-or-later
#include "analysis/rigid/column_dependence.hpp"

#include <algorithm>
#include <set>

#include "alembert/base/error.hpp"
#include "analysis/exact/motions.hpp"
#include "analysis/exact/quadratic_residue_points.hpp"
#include "base/language/say.hpp"
#include "model/formalism/routh.hpp"
#include "program/lower/lower.hpp"
#include "program/reduce_rows.hpp"

namespace alembert {

namespace {

constexpr int most_tries = 20;  // of random points, a few of which are unusable

/// Whether a sine or cosine of a constant occurs that is random here, and different at each point.
bool has_random_constants(const Program& p, const std::vector<int>& roots) {
    for (const int id : p.needed(roots))
        if ((p[id].op == Op::sin || p[id].op == Op::cos) && p[id].is_constant()) {
            const Node& angle = p[p[id].args[0]];
            const bool is_part_of_pi = angle.op == Op::pi || (angle.op == Op::sum && angle.args.size() == 1 &&
                                                              p[angle.args[0]].op == Op::pi);
            if (!is_part_of_pi) return true;
        }
    return false;
}

}  // namespace

std::vector<DependentEntry> entries_of(const ColumnDependence& d) {
    std::vector<DependentEntry> entries;
    for (std::size_t r = 0; r < d.rows.size(); ++r)
        for (std::size_t c = d.pivots[r] + 1; c < d.rows[r].size(); ++c)
            if (!d.rows[r][c].is_zero()) entries.push_back({r, c});
    return entries;
}

RegressorColumns::RegressorColumns(const Regressor& y, std::vector<std::size_t> order, const Mechanism& m)
    : p_(y.function.program),
      nodes_(p_.nodes_of(Group::function)),
      order_(std::move(order)),
      halves_(std::max(2, halvings(p_, nodes_))),
      c_{begun(m), {}, {}, {}, {}, {}} {
    if (m.constraints.empty()) return;
    std::vector<GiNaC::ex> list;
    for (const Mechanism::Constraint& c : m.constraints) {
        list.push_back(c.position.value_or(0));
        list.insert(list.end(), c.row.begin(), c.row.end());
        list.insert(list.end(), {c.offset, c.acceleration});
    }
    const std::vector<int> nodes = lower_expressions(c_.program, with_own_intermediates(m), list);
    for (std::size_t k = 0, next = 0; k < m.constraints.size(); ++k) {
        if (m.constraints[k].position) {
            c_.positions.push_back(nodes[next]);
            c_.row_of.push_back(static_cast<Eigen::Index>(k));
        }
        ++next;
        for (int i = 0; i < m.size(); ++i) c_.rows.push_back(nodes[next++]);
        c_.offset.push_back(nodes[next++]);
        c_.gamma.push_back(nodes[next++]);
    }
    const int halves = std::max(halvings(p_, nodes_), halvings(c_.program, nodes));
    motions_ = std::make_shared<Motions>(m, routh(m), Motions::Sampling{.halves = halves, .halvings = halves});
    const std::vector<SolvingStep>& steps = motions_->steps();
    const auto is_parameter = [](const SolvedUnknown& one) {
        return one.variable.kind == Variable::Kind::parameter;
    };
    if (!motions_->obstacle().empty() || !motions_->loose().empty() ||
        std::any_of(steps.begin(), steps.end(), [&](const SolvingStep& step) {
            return is_parameter(step) || (step.second && is_parameter(*step.second));
        }))
        throw ModelError(
            say("no exact states of this mechanism are known, because its constraints cannot be solved one "
                "after the other for coordinates, so that the combinations are not told; numbers in place "
                "of parameters may help"));
    if (has_random_constants(p_, nodes_) || has_random_constants(c_.program, nodes))
        throw ModelError(
            say("the scene has constraints and constant angles that are no parts of pi, at which no exact "
                "states are known; expected parts such as pi/3, or vectors in place of angles"));
}

std::vector<int> RegressorColumns::used_parameters() const {
    std::set<int> used;
    for (const Program* p : {&p_, &c_.program})
        for (const int id : p == &p_ ? p->needed(nodes_) : p->needed(c_.rows))
            if ((*p)[id].op == Op::variable && (*p)[id].variable.kind == Variable::Kind::parameter)
                used.insert((*p)[id].variable.index);
    return {used.begin(), used.end()};
}

/// Random rates and accelerations that obey the rows, and a basis of the motions that these allow.
bool RegressorColumns::move(ModularPoint& point, Rows& free_motions) const {
    const std::size_t n = p_.coordinates.size(), m = c_.offset.size();
    const auto solve = [&](Variable::Kind kind, const std::vector<int>& right, int sign, Rows* basis) {
        std::vector<int> wanted = c_.rows;
        wanted.insert(wanted.end(), right.begin(), right.end());
        const auto at = evaluate_mod(c_.program, point, wanted);
        if (!at) return false;
        Rows rows;
        for (std::size_t k = 0; k < m; ++k) {
            rows.emplace_back();
            for (std::size_t i = 0; i < n; ++i)
                rows.back().push_back(at->value[static_cast<std::size_t>(c_.rows[k * n + i])]);
            const Prime value = at->value[static_cast<std::size_t>(right[k])];
            rows.back().push_back(sign < 0 ? -value : value);
        }
        const auto rank = static_cast<std::size_t>(reduce_rows(rows, n));
        for (std::size_t k = rank; k < m; ++k)
            if (!rows[k][n].is_zero()) return false;
        rows.resize(rank);
        std::vector<std::size_t> pivots;
        for (const auto& row : rows)
            pivots.push_back(static_cast<std::size_t>(
                std::find_if(row.begin(), row.end(), [](Prime x) { return !x.is_zero(); }) - row.begin()));
        std::vector<Prime> values(n);
        for (std::size_t i = 0; i < n; ++i) {
            if (std::find(pivots.begin(), pivots.end(), i) != pivots.end()) continue;
            values[i] = point.random(900 + static_cast<std::uint64_t>(kind), i);
            if (basis == nullptr) continue;
            basis->emplace_back(n);
            basis->back()[i] = 1;
            for (std::size_t k = 0; k < rank; ++k) basis->back()[pivots[k]] = -rows[k][i];
        }
        for (std::size_t k = 0; k < rank; ++k) {
            values[pivots[k]] = rows[k][n];
            for (std::size_t i = pivots[k] + 1; i < n; ++i)
                if (std::find(pivots.begin(), pivots.end(), i) == pivots.end())
                    values[pivots[k]] -= rows[k][i] * values[i];
        }
        for (std::size_t i = 0; i < n; ++i) point.given[{kind, static_cast<int>(i)}] = values[i];
        return true;
    };
    return solve(Variable::Kind::rate, c_.offset, -1, &free_motions) &&
           solve(Variable::Kind::acceleration, c_.gamma, 1, nullptr);
}

/// One seed, so that constant angles are the same at all states; only what moves is different.
ModularPoint RegressorColumns::free_point(const Given& parameters, std::uint64_t state) const {
    ModularPoint result{.seed = 20261123, .given = parameters, .halves = halves_};
    const ModularPoint random{.seed = state};
    const auto give = [&](Variable::Kind kind, int index) {
        result.given[{kind, index}] = random.variable({kind, index});
    };
    give(Variable::Kind::time, 0);
    for (int i = 0; i < static_cast<int>(p_.coordinates.size()); ++i)
        for (const auto kind : {Variable::Kind::coordinate, Variable::Kind::rate, Variable::Kind::acceleration})
            give(kind, i);
    return result;
}

/// Positions that obey the constraints, if there are any.
std::vector<ModularPoint> RegressorColumns::states(const Given& parameters, std::size_t count) const {
    std::vector<ModularPoint> result;
    if (c_.offset.empty()) {
        for (std::uint64_t seed = 1; seed <= count; ++seed) result.push_back(free_point(parameters, seed));
        return result;
    }
    constexpr std::size_t most_unusable = 400;
    for (std::uint64_t seed = 1; result.size() < count && seed <= count + most_unusable; ++seed)
        if (const auto state = motions_->at(seed, {.values = parameters, .angles = {}}))
            result.push_back(state->point);
    return result;
}

std::optional<ColumnDependence> RegressorColumns::dependence(const std::vector<Prime>& parameters) const {
    const std::size_t width = order_.size(), n = nodes_.size() / width;
    Given given;
    for (std::size_t k = 0; k < parameters.size(); ++k)
        given[{Variable::Kind::parameter, static_cast<int>(k)}] = parameters[k];
    const std::size_t free = std::max<std::size_t>(1, n > c_.offset.size() ? n - c_.offset.size() : 1),
                      wanted = width / free + 4;
    Rows rows;
    std::size_t used = 0;
    for (ModularPoint& state : states(given, wanted + most_tries)) {
        if (used == wanted) break;
        Rows motions;
        if (!c_.offset.empty() && !move(state, motions)) continue;
        const auto at = evaluate_mod(p_, state, nodes_);
        if (!at) continue;
        ++used;
        const auto entry = [&](std::size_t i, std::size_t k) {
            return at->value[static_cast<std::size_t>(nodes_[i * width + k])];
        };
        for (std::size_t i = 0; i < (c_.offset.empty() ? n : motions.size()); ++i) {
            rows.emplace_back();
            for (const std::size_t k : order_) {
                Prime sum = 0;
                if (c_.offset.empty())
                    sum = entry(i, k);
                else
                    for (std::size_t j = 0; j < n; ++j) sum += motions[i][j] * entry(j, k);
                rows.back().push_back(sum);
            }
        }
    }
    if (used < wanted) return std::nullopt;
    ColumnDependence result;
    rows.resize(static_cast<std::size_t>(reduce_rows(rows, width)));
    for (const auto& row : rows)
        result.pivots.push_back(static_cast<std::size_t>(
            std::find_if(row.begin(), row.end(), [](Prime x) { return !x.is_zero(); }) - row.begin()));
    result.rows = std::move(rows);
    return result;
}

}  // namespace alembert
