// SPDX-License-Identifier: GPL-2.0-or-later
#include "check/nearest.hpp"

#include <algorithm>

#include "algebra/notation/readable.hpp"
#include "algebra/notation/text.hpp"

namespace alembert {

using GiNaC::ex;

namespace {

constexpr std::size_t most_nearest_terms = 200;

std::optional<Fourier> normal(const ex& e, const Mechanism& m) {
    if (m.z->tree_size(e) > 10000) return std::nullopt;
    auto f = fourier(m.z->expand(e), *m.symbols, 10 * most_nearest_terms);
    if (f && f->size() > most_nearest_terms) return std::nullopt;
    return f;
}

}  // namespace

std::optional<Fourier> steady_ratio(const Term& a, const Term& b) {
    const Monomial ratio = b.monomial * power(a.monomial, Rational(-1));
    for (const Factor& factor : ratio)
        if (!factor.atom->steady || factor.atom->is_circular()) return std::nullopt;
    return Fourier::collect({{ratio, b.coefficient / a.coefficient}});
}

std::vector<Fourier> parts_of(const Fourier& f) {
    std::vector<std::vector<Term>> groups;
    for (const Term& term : f.terms()) {
        const auto group = std::find_if(groups.begin(), groups.end(),
                                        [&](const auto& g) { return steady_ratio(g[0], term).has_value(); });
        if (group == groups.end())
            groups.push_back({term});
        else
            group->push_back(term);
    }
    std::vector<Fourier> result;
    for (std::vector<Term>& group : groups) result.push_back(Fourier::collect(std::move(group)));
    return result;
}

std::vector<std::optional<Fourier>> rows_of(const Mechanism& m, const Equations& e) {
    std::vector<std::optional<Fourier>> rows;
    for (int i = 0; i < e.size(); ++i) {
        GiNaC::exvector terms{-e.forcing(i)};
        for (int j = 0; j < e.size(); ++j) terms.push_back(e.M(i, j) * e.udot[j]);
        for (std::size_t k = 0; k < e.A.size(); ++k)
            if (!m.constraints[k].balance) terms.push_back(-e.A[k][i] * e.lambda[k]);
        rows.push_back(normal(GiNaC::add(std::move(terms)), m));
    }
    for (std::size_t k = 0; k < e.A.size(); ++k) {
        GiNaC::exvector terms{-e.gamma[k]};
        for (int j = 0; j < e.size(); ++j) terms.push_back(e.A[k][j] * e.udot[j]);
        rows.push_back(normal(GiNaC::add(std::move(terms)), m));
    }
    return rows;
}

std::optional<Nearest> nearest_equation(const ex& residual, const Mechanism& m, const Equations& e) {
    const auto claim = normal(residual, m);
    if (!claim || claim->size() == 0) return std::nullopt;
    const auto rows = rows_of(m, e);
    std::optional<Nearest> best;
    for (std::size_t i = 0; i < rows.size(); ++i) {
        if (!rows[i]) continue;
        std::vector<Fourier> tried;
        for (const Term& a : rows[i]->terms())
            for (const Term& b : claim->terms()) {
                const auto scale = steady_ratio(a, b);
                if (!scale || std::any_of(tried.begin(), tried.end(),
                                          [&](const Fourier& t) { return t.polynomial() == scale->polynomial(); }))
                    continue;
                tried.push_back(*scale);
                const Fourier difference = *claim - *scale * *rows[i];
                if (difference.size() == 0 || 2 * difference.size() > claim->size() + rows[i]->size()) continue;
                // Of two rows that differ in the same number of terms, the one that agrees in more is better.
                const auto worth = [](const Fourier& d, const Fourier& row) {
                    return std::pair(d.size(), -static_cast<long>(row.size()));
                };
                if (!best ||
                    worth(difference, *rows[i]) < worth(best->wrong, *rows[static_cast<std::size_t>(best->row)]))
                    best = Nearest{.row = static_cast<int>(i),
                                   .scale = *scale,
                                   .wrong = difference,
                                   .equation = {},
                                   .difference = {}};
            }
    }
    if (!best) return std::nullopt;
    best->equation = text(readable(best->scale * *rows[static_cast<std::size_t>(best->row)])) + " = 0";
    best->difference = text(readable(best->wrong));
    return best;
}

}  // namespace alembert
