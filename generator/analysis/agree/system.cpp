// SPDX-License-Identifier: GPL-2.0-or-later
#include "analysis/agree/system.hpp"

#include <algorithm>
#include "program/reduce_rows.hpp"

namespace alembert {

EquationSystem system_of(const Equations& e, const Mechanism& m, const std::vector<int>& somewhere_eliminated) {
    Energy none;
    none.kinetic = none.potential = none.energy = none.jacobi = none.power = 0;
    none.z = m.z;
    EquationSystem s;
    s.formalism = e.formalism;
    s.program = lower(m, e, none, {.states_are_given = true});
    s.n = m.size();
    s.speeds = e.size();
    s.states = static_cast<int>(m.states.size());
    s.mass = s.program.nodes_of(Group::mass);
    s.forcing = s.program.nodes_of(Group::forcing);
    s.gamma = s.program.nodes_of(Group::gamma);
    s.rates = s.program.nodes_of(Group::rate);
    s.second = s.program.nodes_of(Group::second_rate);
    const std::vector<int> kept = e.kept(m),
                           row = s.program.nodes_of(s.is_plain() ? Group::row : Group::speed_row);
    for (const int k : kept) {
        const auto begin = row.begin() + static_cast<std::ptrdiff_t>(k) * s.speeds;
        s.A.emplace_back(begin, begin + s.speeds);
    }
    const auto is_hidden = [&](int k) {
        return std::find(somewhere_eliminated.begin(), somewhere_eliminated.end(), k) !=
               somewhere_eliminated.end();
    };
    s.hidden = s.is_plain() ? 0 : s.speeds;
    for (const int k : kept) s.hidden += is_hidden(k) ? 1 : 0;
    int hidden = s.is_plain() ? 0 : s.speeds, shown = s.hidden;
    for (const int k : kept) s.columns.push_back(is_hidden(k) ? hidden++ : shown++);
    s.common = shown - s.hidden + s.n;
    s.wanted = s.mass;
    const auto want = [&](const std::vector<int>& nodes) {
        s.wanted.insert(s.wanted.end(), nodes.begin(), nodes.end());
    };
    for (const auto* nodes : {&s.forcing, &s.gamma, &s.rates, &s.second}) want(*nodes);
    for (const std::vector<int>& entries : s.A) want(entries);
    return s;
}

std::optional<ModularRates> rates_at(const EquationSystem& s, const ModularPoint& point) {
    ModularRates result;
    if (s.is_plain()) return result;
    const auto at = evaluate_mod(s.program, point, s.rates);
    if (!at) return std::nullopt;
    for (std::size_t i = 0; i < s.rates.size(); ++i) {
        result.rates[{Variable::Kind::rate, static_cast<int>(i)}] = at->value[s.rates[i]];
        result.degree = std::max(result.degree, at->degree[s.rates[i]]);
    }
    return result;
}

std::optional<Echelon> echelon(const EquationSystem& s, ModularPoint point, const ModularRates& rates) {
    if (s.is_plain())
        for (const auto& [key, value] : rates.rates) point.given[key] = value;
    Echelon result;
    double entry = 0, right = 0;
    bool usable = true;
    const auto evaluate = [&](const std::vector<Prime>& udot) -> std::vector<Prime> {
        if (!s.is_plain())
            for (int k = 0; k < s.speeds; ++k) point.given[{Variable::Kind::acceleration, k}] = udot[k];
        const auto at = evaluate_mod(s.program, point, s.wanted);
        usable = usable && at;
        if (!at) return std::vector<Prime>(static_cast<std::size_t>(s.program.size()));
        result.conditions = at->conditions;
        for (const auto* nodes : {&s.forcing, &s.gamma})
            for (const int id : *nodes) right = std::max(right, at->degree[id]);
        for (const auto* nodes : {&s.mass, &s.second})
            for (const int id : *nodes) entry = std::max(entry, at->degree[id]);
        for (const std::vector<int>& row : s.A)
            for (const int id : row) entry = std::max(entry, at->degree[id]);
        return at->value;
    };
    const SystemValues<Prime> values = values_of<Prime>(s, evaluate);
    if (!usable) return std::nullopt;
    result.rows = rows_of(s, values);
    result.degree =
        (static_cast<double>(result.rows.size()) * entry + right + 1) * (s.is_plain() ? rates.degree : 1);
    reduce_rows(result.rows, static_cast<std::size_t>(s.unknowns()));
    if (s.hidden == 0) return result;
    const auto hidden = static_cast<std::ptrdiff_t>(s.hidden);
    std::erase_if(result.rows, [&](const std::vector<Prime>& row) {
        return std::any_of(row.begin(), row.begin() + hidden, [](Prime x) { return !x.is_zero(); });
    });
    for (std::vector<Prime>& row : result.rows) row.erase(row.begin(), row.begin() + hidden);
    // Redundant rows of the system have become rows of zeros.
    std::erase_if(result.rows, [](const std::vector<Prime>& row) {
        return std::all_of(row.begin(), row.end(), [](Prime x) { return x.is_zero(); });
    });
    return result;
}

}  // namespace alembert
