// SPDX-License-Identifier: GPL-2.0-or-later
// The linear systems of a state whose positions are known: A q' + b = 0, then M q'' − Aᵀλ = f with A q'' = γ, and
// the shares of multipliers of constraints that depend on each other.
#include <algorithm>
#include <map>

#include "analysis/exact/least_shares.hpp"
#include "analysis/exact/motions.hpp"
#include "analysis/exact/solve_condition.hpp"
#include "program/reduce_rows.hpp"

namespace alembert {

std::vector<std::vector<Prime>> Motions::matrix_of_system(const ModularValues& at) const {
    const auto n = static_cast<std::size_t>(n_), m = static_cast<std::size_t>(m_);
    std::vector<std::vector<Prime>> rows(n + m, std::vector<Prime>(n + m + 1));
    for (std::size_t i = 0; i < n; ++i) {
        for (std::size_t j = 0; j < n; ++j) rows[i][j] = at.value[system_.M[i * n + j]];
        for (std::size_t k = 0; k < m; ++k) {
            rows[n + k][i] = at.value[system_.A[k * n + i]];
            rows[i][n + k] = -rows[n + k][i];
        }
    }
    return rows;
}

void Motions::find_known_rows() {
    known_rows_.assign(steps_.size() + 1, {});
    using Key = std::pair<Variable::Kind, int>;
    std::map<Key, std::size_t> known_after;
    for (std::size_t k = 0; k < steps_.size(); ++k) {
        known_after[{steps_[k].variable.kind, steps_[k].variable.index}] = k + 1;
        if (const auto& second = steps_[k].second)
            known_after[{second->variable.kind, second->variable.index}] = k + 1;
    }
    const auto n = static_cast<std::size_t>(n_), m = static_cast<std::size_t>(m_);
    for (std::size_t r = 0; r < m; ++r) {
        const auto row = system_.A.begin() + static_cast<std::ptrdiff_t>(r * n);
        std::size_t last = 0;
        for (const int id : program_.needed(std::vector<int>(row, row + n_))) {
            if (program_[id].op != Op::variable) continue;
            const Variable& variable = program_[id].variable;
            if (const auto found = known_after.find({variable.kind, variable.index}); found != known_after.end())
                last = std::max(last, found->second);
        }
        known_rows_[last].push_back(r);
    }
}

bool Motions::add_known_rows(const ExactState& state, std::size_t step, KnownRows& known) const {
    if (known_rows_[step].empty()) return true;
    const auto n = static_cast<std::size_t>(n_);
    std::vector<int> wanted;
    for (const std::size_t r : known_rows_[step])
        for (std::size_t i = 0; i < n; ++i) wanted.push_back(system_.A[r * n + i]);
    const auto at = evaluate_mod(program_, state.point, wanted);
    if (!at) return true;
    for (std::size_t first = 0; first < wanted.size(); first += n) {
        std::vector<Prime> row;
        for (std::size_t i = 0; i < n; ++i) row.push_back(at->value[wanted[first + i]]);
        for (std::size_t k = 0; k < known.rows.size(); ++k)
            if (const Prime factor = row[known.pivots[k]]; !factor.is_zero())
                for (std::size_t i = known.pivots[k]; i < n; ++i) row[i] -= factor * known.rows[k][i];
        const auto pivot = std::find_if(row.begin(), row.end(), [](Prime x) { return !x.is_zero(); });
        if (pivot == row.end()) return false;
        const Prime by = pivot->inverse();
        known.pivots.push_back(static_cast<std::size_t>(pivot - row.begin()));
        for (Prime& x : row) x *= by;
        known.rows.push_back(std::move(row));
    }
    return true;
}

bool Motions::solve_any(ExactState& state) const {
    KnownRows known;
    const Outcome outcome = solve_steps(state, nullptr, 0, &known);
    return outcome == Outcome::solved ||
           (outcome == Outcome::dependent_rows && solve_steps(state, nullptr, 0, nullptr) == Outcome::solved);
}

void Motions::find_open_unknowns() {
    find_known_rows();
    if (at_ != At::motion || !rows_with_friction_.empty() || !obstacle_.empty()) return;
    const auto size = static_cast<std::size_t>(n_ + m_);
    std::vector<int> wanted = system_.M;
    wanted.insert(wanted.end(), system_.A.begin(), system_.A.end());
    constexpr std::uint64_t tries = 40, other_seeds = 2000000;
    constexpr int enough = 2;
    std::vector<bool> is_open(size, true);
    int found = 0;
    for (std::uint64_t seed = 1; seed < tries && found < enough; ++seed) {
        ExactState state{.point = {.seed = other_seeds + seed, .given = {}, .halves = halves_, .finer = finer_}};
        auto point = usable_->at(std::move(state.point));
        if (!point) continue;
        state.point = *std::move(point);
        const auto at = solve_any(state) ? evaluate_mod(program_, state.point, wanted) : std::nullopt;
        if (!at) continue;
        ++found;
        std::vector<std::vector<Prime>> rows = matrix_of_system(*at);
        if (reduce_rows(rows, size) == n_ + m_) return;
        for (const std::vector<Prime>& row : rows)
            if (const auto pivot = std::find_if(row.begin(), row.end(), [](Prime x) { return !x.is_zero(); });
                pivot != row.end())
                is_open[static_cast<std::size_t>(pivot - row.begin())] = false;
    }
    if (found < enough) return;
    for (std::size_t k = 0; k < size; ++k)
        if (is_open[k]) open_unknowns_.push_back(k);
}

bool Motions::share_out(ExactState& state) const {
    const auto n = static_cast<std::size_t>(n_), m = static_cast<std::size_t>(m_);
    std::vector<int> wanted = system_.A;
    wanted.insert(wanted.end(), system_.redundant.begin(), system_.redundant.end());
    const auto at = evaluate_mod(program_, state.point, wanted);
    if (!at) return false;
    std::vector<std::vector<Prime>> rows(wanted.size() / n);
    std::vector<Prime> lambda;
    double entry = 0;
    for (std::size_t r = 0; r < rows.size(); ++r) {
        for (std::size_t i = 0; i < n; ++i) {
            rows[r].push_back(at->value[wanted[r * n + i]]);
            entry = std::max(entry, at->degree[wanted[r * n + i]]);
        }
        lambda.push_back(state.point.variable({Variable::Kind::unknown, multiplier(static_cast<int>(r))}));
    }
    const auto least = least_shares(
        rows, m, lambda, [m](std::vector<std::vector<Prime>> system) -> std::optional<std::vector<Prime>> {
            if (reduce_rows(system, m) < static_cast<int>(m)) return std::nullopt;
            std::vector<Prime> w;
            for (const auto& row : system) w.push_back(row[m]);
            return w;
        });
    if (!least) return false;
    state.other_shares = state.point;
    for (std::size_t r = 0; r < rows.size(); ++r)
        state.point.given[{Variable::Kind::unknown, multiplier(static_cast<int>(r))}] = (*least)[r];
    state.degree = state.degree * 2 + (4 * static_cast<double>(m) + 4) * entry;
    return true;
}

bool Motions::move(ExactState& state, unsigned turned) const {
    const auto n = static_cast<std::size_t>(n_), m = static_cast<std::size_t>(m_);
    const auto note = [&](const ModularValues& at) {
        state.conditions = std::max(state.conditions, at.conditions);
        state.exact = state.exact && at.exact;
    };
    std::vector<int> wanted = system_.A;
    wanted.insert(wanted.end(), system_.offset.begin(), system_.offset.end());
    const auto geometry = evaluate_mod(program_, state.point, wanted);
    if (!geometry) return false;
    note(*geometry);
    std::vector<std::vector<Prime>> rows;
    for (std::size_t k = 0; k < m; ++k) {
        rows.emplace_back();
        for (std::size_t i = 0; i < n; ++i) rows.back().push_back(geometry->value[system_.A[k * n + i]]);
        rows.back().push_back(-geometry->value[system_.offset[k]]);
    }
    reduce_rows(rows, n);
    for (std::size_t i = 0; i < n; ++i)
        state.point.given[{Variable::Kind::rate, static_cast<int>(i)}] = state.point.random(800, i);
    for (std::size_t k = rows.size(); k-- > 0;) {
        const auto pivot = std::find_if(rows[k].begin(), rows[k].end(), [](Prime p) { return !p.is_zero(); });
        if (pivot == rows[k].end()) continue;
        const auto column = static_cast<std::size_t>(pivot - rows[k].begin());
        if (column == n) return false;  // 0 = 1
        Prime value = rows[k][n];
        for (std::size_t i = column + 1; i < n; ++i)
            value -= rows[k][i] * state.point.given[{Variable::Kind::rate, static_cast<int>(i)}];
        state.point.given[{Variable::Kind::rate, static_cast<int>(column)}] = value;
    }

    return accelerate(state, turned);
}

bool Motions::accelerate(ExactState& state, unsigned turned) const {
    const auto n = static_cast<std::size_t>(n_), m = static_cast<std::size_t>(m_);
    const auto press = [&](Prime size) {
        for (const int k : rows_with_friction_) state.point.given[{Variable::Kind::unknown, k}] = size;
    };
    press(0);
    std::vector<int> wanted = system_.M;
    for (const auto* part : {&system_.f, &system_.A, &system_.gamma})
        wanted.insert(wanted.end(), part->begin(), part->end());
    const auto at = evaluate_mod(program_, state.point, wanted);
    if (!at) return false;
    state.conditions = std::max(state.conditions, at->conditions);
    state.exact = state.exact && at->exact;
    std::vector<std::vector<Prime>> rows = matrix_of_system(*at);
    double entry = 0, right = 0;
    for (const auto* part : {&system_.M, &system_.A})
        for (const int node : *part) entry = std::max(entry, at->degree[node]);
    for (std::size_t i = 0; i < n; ++i) {
        rows[i][n + m] = at->value[system_.f[i]];
        right = std::max(right, at->degree[system_.f[i]]);
    }
    for (std::size_t k = 0; k < m; ++k) {
        rows[n + k][n + m] = at->value[system_.gamma[k]];
        right = std::max(right, at->degree[system_.gamma[k]]);
    }
    // What friction adds to f for |λ| = 1.
    std::vector<std::vector<Prime>> friction;
    for (const int k : rows_with_friction_) {
        press(0);
        state.point.given[{Variable::Kind::unknown, k}] = 1;
        const auto pressed = evaluate_mod(program_, state.point, system_.f);
        if (!pressed) return false;
        state.conditions = std::max(state.conditions, pressed->conditions);
        friction.emplace_back();
        for (std::size_t i = 0; i < n; ++i) {
            friction.back().push_back(pressed->value[system_.f[i]] - at->value[system_.f[i]]);
            entry = std::max(entry, pressed->degree[system_.f[i]]);
        }
    }
    const std::uint64_t choices = std::uint64_t{1} << rows_with_friction_.size(),
                        first = state.point.random(900, 0).bits();
    for (std::uint64_t choice = 0; choice < choices; ++choice) {
        const auto is_negative = [&](std::size_t r) { return (((first ^ choice) >> r) & 1U) != 0; };
        std::vector<std::vector<Prime>> system = rows;
        for (std::size_t r = 0; r < rows_with_friction_.size(); ++r)
            for (std::size_t i = 0; i < n; ++i) {
                Prime& entry_of_lambda = system[i][n + static_cast<std::size_t>(rows_with_friction_[r])];
                entry_of_lambda =
                    is_negative(r) ? entry_of_lambda + friction[r][i] : entry_of_lambda - friction[r][i];
            }
        for (const std::size_t k : open_unknowns_) {
            system.emplace_back(n + m + 1);
            system.back()[k] = 1;
            system.back()[n + m] = state.point.random(902, k);
        }
        if (reduce_rows(system, n + m) < static_cast<int>(n + m)) return false;
        for (std::size_t r = n + m; r < system.size(); ++r)
            if (!system[r][n + m].is_zero()) return false;
        const auto has_sign = [&](std::size_t r) {
            const Prime lambda = system[n + static_cast<std::size_t>(rows_with_friction_[r])][n + m];
            const bool is_positive = lambda.is_square() != (((turned >> r) & 1U) != 0);
            return !lambda.is_zero() && lambda.is_plain() && is_positive != is_negative(r);
        };
        bool fits = true;
        for (std::size_t r = 0; r < rows_with_friction_.size(); ++r) fits = fits && has_sign(r);
        if (!fits) continue;
        for (std::size_t i = 0; i < n; ++i)
            state.point.given[{Variable::Kind::acceleration, static_cast<int>(i)}] = system[i][n + m];
        for (std::size_t k = 0; k < m; ++k)
            state.point.given[{Variable::Kind::unknown, static_cast<int>(k)}] = system[n + k][n + m];
        state.degree *= static_cast<double>(n + m) * entry + right + 1;
        for (std::size_t r = 0; r < rows_with_friction_.size(); ++r)
            if (((turned >> r) & 1U) != 0)
                state.point.turned.push_back(system[n + static_cast<std::size_t>(rows_with_friction_[r])][n + m]);
        state.conditions +=
            static_cast<double>(rows_with_friction_.size()) + 1;  // and squares have twice the degree
        return true;
    }
    return false;
}

}  // namespace alembert
