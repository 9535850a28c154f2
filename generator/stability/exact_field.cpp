// SPDX-License-Identifier: GPL-2.0-or-later
#include "stability/exact_field.hpp"

#include <algorithm>
#include <cmath>

#include "program/reduce_rows.hpp"

namespace alembert {

using PrimeRows = std::vector<std::vector<Prime>>;
using Kind = Variable::Kind;

namespace {

std::vector<int> joined(std::initializer_list<const std::vector<int>*> lists) {
    std::vector<int> result;
    for (const std::vector<int>* list : lists) result.insert(result.end(), list->begin(), list->end());
    return result;
}

double by_chance(const ExactField::Rates& a, const ExactField::Rates& b) {
    return std::log2(a.degree + b.degree) + a.conditions + b.conditions - 61;
}

}  // namespace

/// Nodes at a point, with the bounds for what is computed from them by determinants of this size.
struct ExactField::Values {
    Values(const Program& program, const ModularPoint& point, const std::vector<int>& nodes, int size)
        : found(evaluate_mod(program, point, nodes)) {
        if (!found) return;
        for (const int node : nodes) degree = std::max(degree, found->degree[static_cast<std::size_t>(node)]);
        degree = degree * (size + 1) + 1;
    }
    Prime operator[](int node) const { return found->value[static_cast<std::size_t>(node)]; }

    std::optional<ModularValues> found;
    double degree = 1;
};

ExactField::ExactField(const Residuals& r, const Split& split)
    : residuals_(r),
      split_(split),
      usable_({{&r.program, joined({&r.mass, &r.forcing, &r.row, &r.gamma, &r.rate, &r.velocity})}}, {}),
      finer_(std::max(0, halvings(r.program, joined({&r.mass, &r.forcing, &r.row, &r.gamma, &r.rate})) -
                             ModularPoint().halves)) {}

/// The velocity constraints are A u + ν₀ = 0.
bool ExactField::find_dependent_speeds(State& state, double& degree, double& conditions) const {
    const Residuals& r = residuals_;
    const auto dependent = static_cast<std::size_t>(r.kept);
    for (int i = 0; i < r.s; ++i) state.point.given[{Kind::rate, i}] = 0;
    for (std::size_t j = 0; j < split_.u.size(); ++j)
        state.point.given[{Kind::rate, split_.u[j]}] = state.speeds[j];
    if (dependent == 0) return true;
    const Values here(r.program, state.point, joined({&r.row, &r.velocity}), r.kept);
    if (!here.found || split_.u_dependent.size() != dependent) return false;
    degree *= here.degree;
    conditions = std::max(conditions, here.found->conditions);
    PrimeRows rows(dependent, std::vector<Prime>(dependent + 1));
    for (std::size_t k = 0; k < dependent; ++k) {
        for (std::size_t j = 0; j < dependent; ++j)
            rows[k][j] =
                here[r.row[k * static_cast<std::size_t>(r.s) + static_cast<std::size_t>(split_.u_dependent[j])]];
        rows[k][dependent] = -here[r.velocity[k]];
    }
    if (reduce_rows(rows, dependent) < r.kept) return false;
    for (std::size_t j = 0; j < dependent; ++j)
        state.point.given[{Kind::rate, split_.u_dependent[j]}] = rows[j][dependent];
    return true;
}

std::optional<ExactField::Rates> ExactField::at(const State& given) const {
    const Residuals& r = residuals_;
    const auto s = static_cast<std::size_t>(r.s), m = static_cast<std::size_t>(r.kept), size = s + m;
    State state = given;
    double degree = 1, conditions = 0;
    if (!find_dependent_speeds(state, degree, conditions)) return {};
    const Values here(r.program, state.point, joined({&r.mass, &r.forcing, &r.row, &r.gamma, &r.rate}),
                      static_cast<int>(size));
    if (!here.found) return {};
    PrimeRows rows(size, std::vector<Prime>(size + 1));
    for (std::size_t i = 0, next = 0; i < s; ++i) {
        for (std::size_t j = 0; j <= i; ++j) rows[i][j] = rows[j][i] = here[r.mass[next++]];
        rows[i][size] = here[r.forcing[i]];
        for (std::size_t k = 0; k < m; ++k) {
            rows[s + k][i] = here[r.row[k * s + i]];
            rows[i][s + k] = -rows[s + k][i];
        }
    }
    for (std::size_t k = 0; k < m; ++k) rows[s + k][size] = here[r.gamma[k]];
    if (reduce_rows(rows, size) < static_cast<int>(size)) return {};
    Rates result;
    for (const int i : split_.q) result.q.push_back(here[r.rate[i]]);
    for (const int i : split_.u) result.u.push_back(rows[static_cast<std::size_t>(i)][size]);
    result.degree = here.degree * degree;
    result.conditions = std::max(conditions, here.found->conditions);
    return result;
}

std::optional<ExactField::Rates> ExactField::balance_at(const State& given) const {
    const Residuals& r = residuals_;
    const auto s = static_cast<std::size_t>(r.s), m = static_cast<std::size_t>(r.kept);
    State state = given;
    double degree = 1, conditions = 0;
    if (!find_dependent_speeds(state, degree, conditions)) return {};
    const Values here(r.program, state.point, joined({&r.mass, &r.forcing, &r.row, &r.gamma, &r.rate}),
                      2 * static_cast<int>(m) + 2);
    if (!here.found) return {};
    const auto dependent = [&](std::size_t k) { return static_cast<std::size_t>(split_.u_dependent[k]); };
    const auto mass = [&](std::size_t i, std::size_t j) {
        return here[r.mass[std::max(i, j) * (std::max(i, j) + 1) / 2 + std::min(i, j)]];
    };
    // A c = γ with zero rates of the independent speeds; Aᵀλ = M c − f in the rows of the dependent ones.
    PrimeRows rates(m, std::vector<Prime>(m + 1)), reactions = rates;
    for (std::size_t k = 0; k < m; ++k) {
        for (std::size_t j = 0; j < m; ++j) rates[k][j] = reactions[j][k] = here[r.row[k * s + dependent(j)]];
        rates[k][m] = here[r.gamma[k]];
    }
    if (reduce_rows(rates, m) < r.kept) return {};
    const auto unbalanced = [&](std::size_t i) {
        Prime sum = here[r.forcing[i]];
        for (std::size_t k = 0; k < m; ++k) sum -= mass(i, dependent(k)) * rates[k][m];
        return sum;
    };
    for (std::size_t k = 0; k < m; ++k) reactions[k][m] = -unbalanced(dependent(k));
    if (reduce_rows(reactions, m) < r.kept) return {};
    Rates result;
    for (const int i : split_.q) result.q.push_back(here[r.rate[i]]);
    for (const int i : split_.u) {
        Prime sum = unbalanced(static_cast<std::size_t>(i));
        for (std::size_t k = 0; k < m; ++k)
            sum += here[r.row[k * s + static_cast<std::size_t>(i)]] * reactions[k][m];
        result.u.push_back(sum);
    }
    result.degree = here.degree * degree;
    result.conditions = std::max(conditions, here.found->conditions);
    return result;
}

bool ExactField::holds_everywhere(const Comparison& comparison) const {
    constexpr double sure = -60;
    double failure = 0;
    for (std::uint64_t seed = 1; seed < 100 && failure > sure; ++seed) {
        auto point = usable_.at({.seed = seed, .finer = finer_});
        if (!point) continue;
        State state{.point = std::move(*point), .speeds = {}};
        for (std::size_t j = 0; j < split_.u.size(); ++j) state.speeds.push_back(state.point.random(800, j));
        const auto one = comparison(state);
        if (!one) continue;
        if (*one == HUGE_VAL) return false;
        failure += std::min(*one, 0.0);
    }
    return failure <= sure;
}

bool ExactField::is_independent_of(const std::vector<int>& coordinates, const std::vector<int>& left_out) const {
    return holds_everywhere([&](const State& state) -> std::optional<double> {
        State moved = state;
        for (const int i : coordinates)
            moved.point.given[{Kind::coordinate, i}] = state.point.random(900, static_cast<std::uint64_t>(i));
        const auto before = at(state), after = at(moved);
        if (!before || !after) return {};
        bool same = before->u == after->u;
        for (std::size_t r = 0; r < split_.q.size(); ++r)
            if (std::find(left_out.begin(), left_out.end(), static_cast<int>(r)) == left_out.end())
                same = same && before->q[r] == after->q[r];
        return same ? by_chance(*before, *after) : HUGE_VAL;
    });
}

bool ExactField::is_reversed_with(std::size_t speed, const std::vector<int>& left_out) const {
    return holds_everywhere([&](const State& state) -> std::optional<double> {
        State reversed = state;
        reversed.speeds[speed] = -reversed.speeds[speed];
        const auto forth = at(state), back = at(reversed);
        if (!forth || !back) return {};
        bool same = true;
        for (std::size_t r = 0; r < split_.q.size(); ++r)
            if (std::find(left_out.begin(), left_out.end(), static_cast<int>(r)) == left_out.end())
                same = same && back->q[r] == -forth->q[r];
        for (std::size_t j = 0; j < split_.u.size(); ++j)
            same = same && back->u[j] == (j == speed ? forth->u[j] : -forth->u[j]);
        return same ? by_chance(*forth, *back) : HUGE_VAL;
    });
}

std::vector<bool> ExactField::balanced_without(const std::vector<std::size_t>& speeds) const {
    std::vector<bool> result(split_.q.size() + split_.u.size(), false);
    for (std::size_t k = 0; k < result.size(); ++k)
        result[k] = holds_everywhere([&](const State& state) -> std::optional<double> {
            State still = state;
            for (const std::size_t j : speeds) still.speeds[j] = 0;
            const auto here = balance_at(still);
            if (!here) return {};
            const Prime value = k < split_.q.size() ? here->q[k] : here->u[k - split_.q.size()];
            return value.is_zero() ? by_chance(*here, *here) : HUGE_VAL;
        });
    return result;
}

}  // namespace alembert
