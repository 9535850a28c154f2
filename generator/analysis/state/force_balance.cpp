// SPDX-License-Identifier: GPL-2.0-or-later
#include "analysis/state/force_balance.hpp"

#include <algorithm>

#include "algebra/notation/readable.hpp"
#include "algebra/notation/text.hpp"
#include "algebra/symbolic/fourier.hpp"
#include "analysis/exact/null_fields.hpp"
#include "base/language/say.hpp"
#include "model/constraint.hpp"
#include "model/energy.hpp"
#include "model/translate.hpp"
#include "program/lower/lower.hpp"
#include "program/reduce_rows.hpp"

namespace alembert {

using GiNaC::ex;

namespace {

constexpr std::size_t enough_points = 3;

/// The rows of M and A, with a last column of zeros, and their values at random points.
struct Rows {
    std::vector<std::vector<ex>> rows;
    std::vector<std::vector<std::vector<Prime>>> values;  ///< by point, row and column

    Rows(const Mechanism& m, const Equations& e) {
        const auto n = static_cast<std::size_t>(e.size());
        for (int i = 0; i < e.size(); ++i) {
            rows.emplace_back();
            for (int j = 0; j < e.size(); ++j) rows.back().push_back(e.M(i, j));
        }
        rows.insert(rows.end(), e.A.begin(), e.A.end());
        std::vector<ex> all;
        for (std::vector<ex>& row : rows) {
            all.insert(all.end(), row.begin(), row.end());
            row.emplace_back(0);
        }
        Program p;
        const std::vector<int> nodes = lower_expressions(p, m, all);
        constexpr std::uint64_t tries = 40;
        for (std::uint64_t seed = 1; seed < tries && values.size() < enough_points; ++seed) {
            const auto at = evaluate_mod(p, {.seed = seed}, nodes);
            if (!at) continue;
            values.emplace_back();
            for (std::size_t r = 0; r < rows.size(); ++r) {
                values.back().emplace_back();
                for (std::size_t i = 0; i < n; ++i) values.back().back().push_back(at->value[nodes[r * n + i]]);
                values.back().back().emplace_back(0);
            }
        }
    }

    int rank() const {
        int result = 0;
        for (std::vector<std::vector<Prime>> at : values) result = std::max(result, reduce_rows(at, at[0].size()));
        return result;
    }

    /// Only rows that are independent at the first point.
    void keep_independent() {
        std::vector<std::vector<Prime>> kept;
        std::vector<std::size_t> dependent;
        for (std::size_t r = 0; r < rows.size(); ++r) {
            std::vector<std::vector<Prime>> with = kept;
            with.push_back(values[0][r]);
            std::vector<std::vector<Prime>> reduced = with;
            if (reduce_rows(reduced, rows[r].size()) == static_cast<int>(with.size()))
                kept = std::move(with);
            else
                dependent.push_back(r);
        }
        for (auto r = dependent.rbegin(); r != dependent.rend(); ++r) {
            rows.erase(rows.begin() + static_cast<std::ptrdiff_t>(*r));
            for (auto& at : values) at.erase(at.begin() + static_cast<std::ptrdiff_t>(*r));
        }
    }
};

ex sum_of_rates(const Unresisted& u, const Equations& e) {
    GiNaC::exvector terms;
    for (std::size_t i = 0; i < u.direction.size(); ++i) terms.push_back(u.direction[i] * e.u[i]);
    return GiNaC::add(std::move(terms));
}

std::string words(const ex& value, const Mechanism& m) {
    const auto f = fourier(value, *m.symbols);
    return f ? text(readable(*f)) : say("a force");
}

bool is_of_state(const Unresisted& u, const Mechanism& m, const Equations& e) {
    std::vector<GiNaC::symbol> unknowns = e.lambda;
    for (const Mechanism::Constraint* c : m.undetermined()) unknowns.push_back(c->multiplier);
    unknowns.insert(unknowns.end(), e.udot.begin(), e.udot.end());
    return !m.z->depends(u.balance, unknowns);
}

}  // namespace

std::vector<Unresisted> unresisted_rates(const Mechanism& mechanism, const Equations& e) {
    const int n = e.size();
    if (n == 0 || static_cast<int>(e.M.rows()) != n) return {};
    const Mechanism m = in_terms_of(e, mechanism);
    Rows all(m, e);
    if (all.values.size() < enough_points || all.rank() == n) return {};
    all.keep_independent();
    std::vector<Unresisted> result;
    const auto add = [&](std::vector<ex> direction) {
        for (ex& entry : direction) entry = m.z->expand(entry);
        Unresisted u{.direction = std::move(direction), .balance = {}};
        GiNaC::exvector terms;
        for (int i = 0; i < n; ++i) terms.push_back(u.direction[static_cast<std::size_t>(i)] * e.forcing(i));
        u.balance = m.z->expand(GiNaC::add(std::move(terms)));
        u.is_balanced = vanishes(u.balance, m) == true;
        result.push_back(std::move(u));
    };
    if (all.rows.empty()) {
        for (int i = 0; i < n; ++i) {
            std::vector<ex> direction(static_cast<std::size_t>(n), 0);
            direction[static_cast<std::size_t>(i)] = 1;
            add(std::move(direction));
        }
        return result;
    }
    const std::optional<NullFields> null = null_fields(all.rows, all.values, *m.z);
    if (!null) return {};
    for (const std::vector<ex>& field : null->fields)
        if (field.back().is_zero()) add({field.begin(), field.end() - 1});  // the last one is the column of zeros
    return result;
}

std::vector<Diagnostic> warnings_of_unresisted(const Scene& scene, const Mechanism& m, const Equations& e) {
    std::vector<Diagnostic> found;
    for (const Unresisted& u : unresisted_rates(m, e)) {
        Place place;
        for (std::size_t i = 0; i < u.direction.size(); ++i) {
            if (u.direction[i].is_zero()) continue;
            if (e.speeds_are_rates() && i < scene.coordinates.size()) place = scene.coordinates[i].name.place;
            if (!e.speeds_are_rates() && i < scene.speeds.size()) place = scene.speeds[i].name.place;
        }
        const std::string rates = words(sum_of_rates(u, e), m);
        found.push_back({place,
                         u.is_balanced
                             ? say("no inertia resists {}, and no force acts along it: its acceleration may be "
                                   "anything; give a body a mass or a moment of inertia, or remove a coordinate",
                                   rates)
                             : say("no inertia resists {}: the equations say there that forces are in balance, {} "
                                   "= 0; give a body a mass or a moment of inertia, or make this a constraint",
                                   rates, words(u.balance, m)),
                         Severity::warning, "no_inertia", rates});
    }
    return found;
}

Balanced with_force_balances(Mechanism mechanism, const std::function<Equations(const Mechanism&)>& formalism,
                             std::optional<Equations> known) {
    const std::size_t most = mechanism.constraints.size() + mechanism.q.size();
    Equations e = known ? *std::move(known) : formalism(mechanism);
    while (mechanism.constraints.size() < most && e.speeds_are_rates()) {
        bool added = false;
        for (const Unresisted& u : unresisted_rates(mechanism, e)) {
            if (u.is_balanced || !is_of_state(u, mechanism, e)) continue;
            const bool moves = mechanism.z->depends(u.balance, mechanism.qdot);
            const int index = static_cast<int>(mechanism.constraints.size());
            try {
                mechanism.constraints.push_back(
                    constraint_of({.name = say("balance along {}", words(sum_of_rates(u, e), mechanism)),
                                   .holonomic = !moves,
                                   .value = mechanism.z->name(u.balance),
                                   .multiplier = mechanism.symbols->declare(
                                       fmt::format("lambda of balance {}", index), SymbolInfo::Kind::other, index),
                                   .place = {},
                                   .at = {}},
                                  mechanism));
                mechanism.constraints.back().balance = true;
                added = true;
            } catch (const SceneMistake&) {  // not linear in the rates
            }
        }
        if (!added) break;
        e = formalism(mechanism);
    }
    return {std::move(mechanism), std::move(e)};
}

}  // namespace alembert
