// SPDX-License-Identifier: GPL-2.0-or-later
#include "check/derivation/motion_rows.hpp"

#include <algorithm>

#include "program/reduce_rows.hpp"

namespace alembert {

using GiNaC::ex;

namespace {

constexpr std::size_t wanted_states = 3, most_tries = 40;

int rank(std::vector<std::vector<Prime>> rows) {
    return rows.empty() ? 0 : reduce_rows(rows, rows[0].size());
}

int rank_of_slopes(std::vector<std::vector<Prime>> rows) {
    return rows.empty() ? 0 : reduce_rows(rows, rows[0].size() - 1);
}

}  // namespace

bool MotionRow::is_known() const {
    return std::any_of(at.begin(), at.end(), [](const auto& values) { return values.has_value(); });
}

MotionRows::MotionRows(const Mechanism& mechanism, const Equations& e, Lower lower)
    : m_(mechanism), lower_(std::move(lower)), unknowns_(mechanism.qddot) {
    unknowns_.insert(unknowns_.end(), e.lambda.begin(), e.lambda.end());
    for (const Mechanism::Constraint* c : m_.undetermined()) unknowns_.push_back(c->multiplier);
    std::vector<ex> entries;
    for (const auto& row : e.A) entries.insert(entries.end(), row.begin(), row.end());
    Program p;
    const std::vector<int> nodes = lower_(p, entries);
    for (const int halves : {1, 0, 2}) {
        ExactStates states(m_, e, {.halves = halves, .halvings = 2});
        for (std::size_t s = 0; s < most_tries && points_.size() < wanted_states; ++s) {
            const ExactState* const state = states.get(s);
            if (state == nullptr) break;
            const auto at = evaluate_mod(p, state->point, nodes);
            if (!at) continue;
            points_.push_back(state->point);
            std::vector<std::vector<Prime>> rows;
            for (std::size_t k = 0; k < e.A.size(); ++k) {
                std::vector<Prime> row(unknowns_.size() + 1, Prime(0));
                for (std::size_t j = 0; j < m_.q.size(); ++j) row[j] = at->value[nodes[k * m_.q.size() + j]];
                rows.push_back(std::move(row));
            }
            bound_.push_back(std::move(rows));
        }
        if (!points_.empty()) return;
    }
}

MotionRow MotionRows::row(const ex& residual) {
    MotionRow result{.residual = m_.z->name(residual), .linear = true, .at = {}};
    const std::vector<ex> slopes = m_.z->pull_back({{result.residual, 1}}, unknowns_);
    result.linear = std::none_of(slopes.begin(), slopes.end(),
                                 [&](const ex& slope) { return m_.z->depends(slope, unknowns_); });
    std::vector<ex> entries = slopes;
    entries.push_back(result.residual);
    Program p;
    const std::vector<int> nodes = lower_(p, entries);
    for (const ModularPoint& point : points_) {
        result.at.emplace_back();
        const auto at = evaluate_mod(p, point, nodes);
        if (!at) continue;
        result.at.back().emplace();
        for (const int node : nodes) result.at.back()->push_back(at->value[node]);
    }
    return result;
}

std::optional<bool> MotionRows::holds(const MotionRow& row) const {
    if (!row.is_known()) return std::nullopt;
    return std::all_of(row.at.begin(), row.at.end(),
                       [](const auto& values) { return !values || values->back().is_zero(); });
}

std::vector<std::vector<Prime>> MotionRows::matrix(std::size_t state, const std::vector<const MotionRow*>& rows,
                                                   bool bound) const {
    std::vector<std::vector<Prime>> result;
    if (bound) result = bound_[state];
    for (const MotionRow* row : rows) result.push_back(*row->at[state]);
    return result;
}

std::optional<bool> MotionRows::is_identity(const MotionRow& row) const {
    if (!row.is_known()) return std::nullopt;
    if (!row.linear) return false;
    return follows(row, {});
}

std::optional<bool> MotionRows::is_bound(const std::vector<ex>& factors) {
    Program p;
    const std::vector<int> nodes = lower_(p, factors);
    std::optional<bool> result;
    for (std::size_t s = 0; s < points_.size(); ++s) {
        const auto at = evaluate_mod(p, points_[s], nodes);
        if (!at) continue;
        std::vector<std::vector<Prime>> rows = bound_[s];
        const int before = rank(rows);
        rows.emplace_back(unknowns_.size() + 1, Prime(0));
        for (std::size_t j = 0; j < factors.size(); ++j) rows.back()[j] = at->value[nodes[j]];
        if (rank(rows) > before) return false;
        result = true;
    }
    return result;
}

bool MotionRows::is_multiple(const MotionRow& row, const MotionRow& of) const {
    std::optional<Prime> ratio;
    int seen = 0;  // at one state any two are
    for (std::size_t s = 0; s < points_.size(); ++s) {
        if (!row.at[s] || !of.at[s] || of.at[s]->back().is_zero()) continue;
        const Prime here = row.at[s]->back() * of.at[s]->back().inverse();
        if (ratio && *ratio != here) return false;
        ratio = here;
        ++seen;
    }
    return seen > 1;
}

bool MotionRows::follows(const MotionRow& row, const std::vector<const MotionRow*>& of, bool bound) const {
    if (!row.linear || !row.is_known()) return false;
    for (const MotionRow* other : of)
        if (!other->linear) return false;
    bool seen = false;
    for (std::size_t s = 0; s < points_.size(); ++s) {
        if (!row.at[s] || std::any_of(of.begin(), of.end(), [&](const MotionRow* other) { return !other->at[s]; }))
            continue;
        std::vector<std::vector<Prime>> rows = matrix(s, of, bound);
        const int before = rank(rows);
        if (!of.empty() && before > rank_of_slopes(rows))  // from a contradiction nothing follows but itself
            return of.size() == 1 && is_multiple(row, *of[0]);
        rows.push_back(*row.at[s]);
        if (rank(rows) > before) return false;
        seen = true;
    }
    return seen;
}

bool MotionRows::determine(const std::vector<const MotionRow*>& rows) const {
    bool seen = false;
    for (std::size_t s = 0; s < points_.size(); ++s) {
        if (std::any_of(rows.begin(), rows.end(),
                        [&](const MotionRow* row) { return !row->linear || !row->at[s]; }))
            continue;
        std::vector<std::vector<Prime>> all = matrix(s, rows, true);
        const int before = rank(all);
        for (std::size_t j = 0; j < m_.q.size(); ++j) {
            all.emplace_back(unknowns_.size() + 1, Prime(0));
            all.back()[j] = 1;
        }
        if (rank(all) > before) return false;
        seen = true;
    }
    return seen;
}

bool MotionRows::agree(const std::vector<const MotionRow*>& rows, bool bound) const {
    for (std::size_t s = 0; s < points_.size(); ++s) {
        if (std::any_of(rows.begin(), rows.end(),
                        [&](const MotionRow* row) { return !row->linear || !row->at[s]; }))
            continue;
        const auto all = matrix(s, rows, bound);
        if (rank(all) > rank_of_slopes(all)) return false;
    }
    return true;
}

}  // namespace alembert
