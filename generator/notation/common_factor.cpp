// SPDX-License-Identifier: GPL-2.0-or-later
#include "notation/common_factor.hpp"

#include <algorithm>
#include <optional>

#include "notation/compose.hpp"

namespace alembert {

namespace {

bool is_parameter(const AtomNode& atom) {
    return atom.steady && !atom.is_circular();
}
bool is_rest(const AtomNode& atom) {
    return !is_parameter(atom);
}

/// A coefficient: polynomial in parameters; `rest` is what it stands before.
struct Coefficient {
    Monomial rest;
    Polynomial value;
};

std::vector<Coefficient> coefficients(const Fourier& f) {
    std::vector<Coefficient> result;
    for (const Polynomial& group : partition(f.polynomial(), is_rest)) {
        const Monomial rest = part(group.terms()[0].monomial, is_rest);
        result.push_back({rest, divide(group, rest)});
    }
    return result;
}

void intersect(std::vector<std::pair<Polynomial, int>>& sums, const Factorization& factors) {
    for (auto& [sum, exponent] : sums) {
        const auto found = std::find_if(factors.sums.begin(), factors.sums.end(),
                                        [&sum = sum](const auto& other) { return other.first == sum; });
        exponent = found == factors.sums.end() ? 0 : std::min(exponent, found->second);
    }
    std::erase_if(sums, [](const auto& entry) { return entry.second == 0; });
}

}  // namespace

CommonFactor common_factor(const Fourier& lhs, const Fourier& rhs, Factorizer& factorizer) {
    CommonFactor result;
    bool is_first = true;
    std::vector<Term> all;
    for (const Fourier* side : {&lhs, &rhs}) {
        for (const Coefficient& coefficient : coefficients(*side)) {
            for (const Term& term : coefficient.value.terms()) all.push_back({term.monomial, 1});
            if (!is_first && result.sums.empty()) continue;
            const Factorization factors = factorizer(coefficient.value);
            if (is_first)
                result.sums = factors.sums;
            else
                intersect(result.sums, factors);
            is_first = false;
        }
    }
    const Polynomial terms = Polynomial::collect(std::move(all));
    result.monomial = common_monomial(terms);
    // k/m·x is worth a multiplication by m; a sum below a fraction line only if it stands there everywhere.
    std::erase_if(result.monomial, [&](const Factor& factor) {
        return factor.atom->kind != AtomNode::Kind::symbol &&
               !std::all_of(terms.terms().begin(), terms.terms().end(), [&](const Term& term) {
                   return !part(term.monomial, [&](const AtomNode& atom) {
                               return compare(atom, *factor.atom) == 0;
                           }).empty();
               });
    });
    return result;
}

Fourier divide(const Fourier& f, const CommonFactor& common, Factorizer& factorizer) {
    std::vector<Term> terms;
    for (const Coefficient& coefficient : coefficients(f)) {
        Polynomial value = divide(coefficient.value, common.monomial);
        if (!common.sums.empty()) {
            const Factorization factors = factorizer(value);
            value = Polynomial::collect({{factors.monomial, factors.unit}});
            for (const auto& [sum, exponent] : factors.sums) {
                const auto taken = std::find_if(common.sums.begin(), common.sums.end(),
                                                [&sum = sum](const auto& entry) { return entry.first == sum; });
                value = value * power(sum, exponent - (taken == common.sums.end() ? 0 : taken->second));
            }
        }
        for (const Term& term : value.terms())
            terms.push_back({coefficient.rest * term.monomial, term.coefficient});
    }
    return Fourier::collect(std::move(terms));
}

Polynomial polynomial(const CommonFactor& factor) {
    Polynomial result = Polynomial::collect({{factor.monomial, 1}});
    for (const auto& [sum, exponent] : factor.sums) result = result * power(sum, exponent);
    return result;
}

}  // namespace alembert
