// SPDX-License-Identifier: GPL-2.0-or-later
#include "check/open_rows.hpp"

#include <algorithm>

#include "check/vanishing.hpp"
#include "program/reduce_rows.hpp"

namespace alembert {

using GiNaC::ex;

std::vector<std::size_t> group_of(const Scene& scene, const std::vector<ClaimForm>& forms, std::size_t k) {
    std::set<int> names(forms[k].open.begin(), forms[k].open.end());
    std::vector<std::size_t> group;
    for (std::size_t before = 0; before != names.size() || group.empty();) {
        before = names.size();
        group.clear();
        for (std::size_t other = 0; other < forms.size(); ++other) {
            if (scene.claims[other].at != scene.claims[k].at || !forms[other].linear) continue;
            if (std::none_of(forms[other].open.begin(), forms[other].open.end(),
                             [&](int o) { return names.contains(o); }))
                continue;
            group.push_back(other);
            names.insert(forms[other].open.begin(), forms[other].open.end());
        }
        if (group.empty()) break;
    }
    return group;
}

std::vector<int> OpenRows::roots() const {
    std::vector<int> result;
    for (const Row& row : list) {
        result.push_back(row.rest);
        result.insert(result.end(), row.slope.begin(), row.slope.end());
    }
    return result;
}

OpenRows open_rows(const Claims& claims, const std::vector<ClaimForm>& forms,
                   const std::vector<std::size_t>& group) {
    OpenRows rows;
    const std::vector<GiNaC::symbol> symbols = claims.open_symbols();
    std::vector<ex> list;
    for (const std::size_t k : group) {
        std::vector<ex> parts{forms[k].residual};
        parts.insert(parts.end(), forms[k].derivatives.begin(), forms[k].derivatives.end());
        for (std::size_t r = 0; r < parts.size(); ++r) {
            rows.list.push_back(
                {.claim = k, .rest = 0, .slope = {}, .derived = r > 0, .last = r + 1 == parts.size()});
            const std::vector<ex> slopes = claims.mechanism().z->pull_back({{parts[r], 1}}, symbols);
            GiNaC::exvector rest{parts[r]};
            for (std::size_t j = 0; j < symbols.size(); ++j) rest.push_back(-slopes[j] * symbols[j]);
            list.push_back(GiNaC::add(std::move(rest)));
            list.insert(list.end(), slopes.begin(), slopes.end());
        }
    }
    const std::vector<int> nodes = claims.lower(rows.program, list);
    std::size_t next = 0;
    for (OpenRows::Row& row : rows.list) {
        row.rest = nodes[next++];
        for (std::size_t j = 0; j < symbols.size(); ++j) row.slope.push_back(nodes[next++]);
    }
    return rows;
}

std::optional<OpenMatrix> open_matrix(const OpenRows& rows, const ExactState& state) {
    const std::vector<int> roots = rows.roots();
    const auto at = evaluate_mod(rows.program, state.point, roots);
    if (!at) return std::nullopt;
    OpenMatrix result;
    double degree = 1;
    for (const int id : roots) degree = std::max(degree, at->degree[id]);
    degree = (static_cast<double>(rows.list.size()) * degree + 1) * std::max(1.0, state.degree);
    result.chance = chance_at(state, degree, *at);
    for (const OpenRows::Row& row : rows.list) {
        result.rows.emplace_back();
        for (const int id : row.slope) result.rows.back().push_back(at->value[id]);
        result.rows.back().push_back(-at->value[row.rest]);
    }
    return result;
}

bool consistent(const std::vector<std::vector<Prime>>& rows) {
    if (rows.empty()) return true;
    const std::size_t columns = rows[0].size() - 1;
    return rank_of(rows, columns) == rank_of(rows, columns + 1);
}

std::optional<OpenMatrix> open_matrix(const OpenRows& rows, ExactStates& states, std::size_t number) {
    const ExactState* const state = states.get(number);
    return state == nullptr ? std::nullopt : open_matrix(rows, *state);
}

int rank_of(std::vector<std::vector<Prime>> rows, std::size_t columns) {
    return reduce_rows(rows, columns);
}

bool pins(const OpenRows& rows, const OpenMatrix& at, const std::set<std::size_t>& without, std::size_t k) {
    std::vector<std::vector<Prime>> all, others;
    for (std::size_t r = 0; r < rows.list.size(); ++r) {
        if (without.contains(rows.list[r].claim)) continue;
        all.push_back(at.rows[r]);
        if (rows.list[r].claim != k || !rows.list[r].last) others.push_back(at.rows[r]);
    }
    if (all.empty()) return false;
    const std::size_t columns = all[0].size() - 1;
    return rank_of(all, columns) > (others.empty() ? 0 : rank_of(others, columns));
}

std::set<std::size_t> culprits(const OpenRows& rows, const OpenMatrix& at, const std::vector<std::size_t>& group) {
    const auto rest = [&](const std::set<std::size_t>& without) {
        std::vector<std::vector<Prime>> result;
        for (std::size_t r = 0; r < rows.list.size(); ++r)
            if (!without.contains(rows.list[r].claim)) result.push_back(at.rows[r]);
        return result;
    };
    std::set<std::size_t> found;
    for (const std::size_t a : group)
        if (consistent(rest({a}))) found.insert(a);
    if (found.size() > 1) {  // a claim that holds by itself is not to blame for what others say of its names
        std::set<std::size_t> others = found;
        std::erase_if(others, [&](std::size_t a) {
            std::set<std::size_t> without(group.begin(), group.end());
            without.erase(a);
            return consistent(rest(without)) && !pins(rows, at, without, a);
        });
        if (!others.empty()) found = std::move(others);
    }
    if (!found.empty()) return found;
    for (const std::size_t a : group) {
        std::set<std::size_t> without(group.begin(), group.end());
        without.erase(a);
        if (!consistent(rest(without))) found.insert(a);  // it is wrong by itself
    }
    if (!found.empty() && consistent(rest(found))) return found;
    found.clear();
    for (std::size_t i = 0; i < group.size(); ++i)
        for (std::size_t j = i + 1; j < group.size(); ++j)
            if (consistent(rest({group[i], group[j]}))) {
                if (!found.empty()) return {group.begin(), group.end()};
                found = {group[i], group[j]};
            }
    return found.empty() ? std::set<std::size_t>(group.begin(), group.end()) : found;
}

namespace {

/// Without the rows of these claims. The program is not needed any more.
std::pair<OpenRows, OpenMatrix> without(const OpenRows& rows, const OpenMatrix& at,
                                        const std::set<std::size_t>& wrong) {
    std::pair<OpenRows, OpenMatrix> result{{}, {.rows = {}, .chance = at.chance}};
    for (std::size_t r = 0; r < rows.list.size(); ++r)
        if (!wrong.contains(rows.list[r].claim)) {
            result.first.list.push_back(rows.list[r]);
            result.second.rows.push_back(at.rows[r]);
        }
    return result;
}

}  // namespace

std::optional<OpenJudgement> judge(const OpenRows& rows, const std::vector<std::size_t>& group,
                                   ExactStates& states) {
    LeftToChance left;
    const int least = states_needed(rows.program, rows.roots(), states);
    std::optional<OpenMatrix> first;
    std::set<std::size_t> wrong;
    const auto is_enough = [&] { return left.is_small() && left.states >= least; };
    for (std::size_t s = 0; s < most_states && !is_enough() && wrong.size() < group.size(); ++s) {
        auto at = open_matrix(rows, states, s);
        if (!at) {
            if (states.get(s) == nullptr) break;
            continue;
        }
        left.add(at->chance, *states.get(s));
        if (!first) first = *at;
        // What is left when a claim is wrong has to hold at all states as well: another claim may fail on another
        // side.
        const auto [part, here] = without(rows, *at, wrong);
        if (consistent(here.rows)) continue;
        std::vector<std::size_t> others = group;
        std::erase_if(others, [&](std::size_t k) { return wrong.contains(k); });
        wrong.merge(culprits(part, here, others));
        left = {};
    }
    if (!first || (!is_enough() && wrong.empty())) return std::nullopt;
    return OpenJudgement{.wrong = wrong,
                         .failure = left.failure,
                         .first = *first,
                         .is_complete = is_enough() || wrong.size() == group.size()};
}

}  // namespace alembert
