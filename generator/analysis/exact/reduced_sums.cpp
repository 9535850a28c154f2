// SPDX-License-Identifier: GPL-2.0-or-later
// Gauss and Jordan's elimination in the terms, each of which counts as an unknown.
#include "analysis/exact/reduced_sums.hpp"

#include <algorithm>
#include <map>

namespace alembert {

using GiNaC::ex;
using GiNaC::numeric;

namespace {

using Row = std::map<ex, numeric, GiNaC::ex_is_less>;  ///< term → coefficient

void add_term(Row& row, const ex& term) {
    numeric coefficient = 1;
    if (GiNaC::is_a<numeric>(term))
        coefficient = GiNaC::ex_to<numeric>(term);
    else if (GiNaC::is_a<GiNaC::mul>(term))
        for (const ex& factor : term)
            if (GiNaC::is_a<numeric>(factor)) coefficient = GiNaC::ex_to<numeric>(factor);
    row[term / coefficient] = coefficient;
}

Row terms_of(const ex& sum) {
    Row row;
    const ex plain = sum.expand();
    if (GiNaC::is_a<GiNaC::add>(plain))
        for (const ex& term : plain) add_term(row, term);
    else if (!plain.is_zero())
        add_term(row, plain);
    return row;
}

void subtract(Row& from, const Row& row, const numeric& factor) {
    for (const auto& [term, coefficient] : row) {
        numeric& left = from[term];
        left -= factor * coefficient;
        if (left.is_zero()) from.erase(term);
    }
}

bool is_turned(const ex& term) {
    return GiNaC::is_a<GiNaC::function>(term) ||
           std::any_of(term.begin(), term.end(), [](const ex& part) { return is_turned(part); });
}

}  // namespace

std::vector<ex> reduced_sums(const std::vector<ex>& sums, Singled first) {
    std::vector<Row> rows;
    GiNaC::exset terms;
    for (const ex& sum : sums) {
        rows.push_back(terms_of(sum));
        for (const auto& [term, coefficient] : rows.back()) terms.insert(term);
    }
    std::vector<ex> order(terms.begin(), terms.end());
    std::stable_partition(order.begin(), order.end(),
                          [first](const ex& term) { return is_turned(term) == (first == Singled::turned_terms); });
    std::size_t done = 0;
    for (const ex& term : order) {
        const auto pivot = std::find_if(rows.begin() + static_cast<std::ptrdiff_t>(done), rows.end(),
                                        [&](const Row& row) { return row.contains(term); });
        if (pivot == rows.end()) continue;
        std::iter_swap(pivot, rows.begin() + static_cast<std::ptrdiff_t>(done));
        for (std::size_t r = 0; r < rows.size(); ++r)
            if (r != done && rows[r].contains(term))
                subtract(rows[r], rows[done], rows[r].at(term) / rows[done].at(term));
        ++done;
    }
    std::vector<ex> result;
    for (std::size_t r = 0; r < done; ++r) {
        GiNaC::exvector parts;
        for (const auto& [term, coefficient] : rows[r]) parts.push_back(coefficient * term);
        result.push_back(GiNaC::add(std::move(parts)));
    }
    return result;
}

}  // namespace alembert
