// SPDX-License-Identifier: GPL-2.0-or-later
#include "algebra/notation/common_factor.hpp"

#include <algorithm>
#include <array>

#include "algebra/notation/compose.hpp"

namespace alembert {

namespace {

bool is_parameter(const AtomNode& atom) {
    return atom.steady && !atom.is_circular();
}
bool is_rest(const AtomNode& atom) {
    return !is_parameter(atom);
}

/// Whether an atom does not belong to the coefficient of accelerations, rates, forces, sines and cosines.
/// Parameters, coordinates and tangents belong to it.
bool is_outside_place(const AtomNode& atom) {
    const bool coordinate = atom.kind == AtomNode::Kind::symbol && atom.info.order == 0 &&
                            atom.info.kind == SymbolInfo::Kind::coordinate;
    const bool tangent = atom.kind == AtomNode::Kind::function && atom.name == "tan";
    return !is_parameter(atom) && !coordinate && !tangent;
}

/// Whether this is a sum of even powers, one of them of parameters only, and therefore zero at no real pose.
bool is_positive(const Polynomial& sum) {
    bool has_steady = false;
    for (const Term& term : sum.terms()) {
        const auto is_even = [](const Factor& factor) {
            return is_integer(factor.exponent) && cln::evenp(cln::numerator(factor.exponent));
        };
        if (term.coefficient < 0 || !std::all_of(term.monomial.begin(), term.monomial.end(), is_even))
            return false;
        has_steady = has_steady || part(term.monomial, is_rest).empty();
    }
    return has_steady;
}

/// A coefficient, which is a polynomial in parameters, and `rest`, the factor that it multiplies.
struct Coefficient {
    Monomial rest;
    Polynomial value;
};

template <typename Predicate>
std::vector<Coefficient> coefficients(const Fourier& f, Predicate is_rest) {
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

/// `value` without the sums of `common`, which divide it.
Polynomial without(const Polynomial& value, const CommonFactor& common, Factorizer& factorizer) {
    const Factorization factors = factorizer(value);
    Polynomial result = Polynomial::collect({{factors.monomial, factors.unit}});
    for (const auto& [sum, exponent] : factors.sums) {
        const auto taken = std::find_if(common.sums.begin(), common.sums.end(),
                                        [&sum = sum](const auto& entry) { return entry.first == sum; });
        result = result * power(sum, exponent - (taken == common.sums.end() ? 0 : taken->second));
    }
    return result;
}

}  // namespace

CommonFactor common_factor(const Fourier& lhs, const Fourier& rhs, Factorizer& factorizer) {
    CommonFactor result;
    bool is_first = true;
    std::vector<Term> all;
    for (const Fourier* side : {&lhs, &rhs}) {
        for (const Coefficient& coefficient : coefficients(*side, is_rest)) {
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
    // An equation with k/m·x is multiplied by m; it is multiplied by a sum in a denominator only if all terms have
    // that denominator.
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
    for (const Coefficient& coefficient : coefficients(f, is_rest)) {
        Polynomial value = divide(coefficient.value, common.monomial);
        if (!common.sums.empty()) value = without(value, common, factorizer);
        for (const Term& term : value.terms())
            terms.push_back({coefficient.rest * term.monomial, term.coefficient});
    }
    return Fourier::collect(std::move(terms));
}

Polynomial divide_by_positive(Fourier& lhs, Fourier& rhs, Factorizer& factorizer) {
    const std::array<std::vector<Coefficient>, 2> sides{coefficients(lhs, is_outside_place),
                                                        coefficients(rhs, is_outside_place)};
    CommonFactor common;
    bool is_first = true;
    for (const std::vector<Coefficient>& side : sides)
        for (const Coefficient& coefficient : side) {
            if (!is_first && common.sums.empty()) break;
            const Factorization factors = factorizer(coefficient.value);
            if (is_first)
                common.sums = factors.sums;
            else
                intersect(common.sums, factors);
            std::erase_if(common.sums, [](const auto& entry) { return !is_positive(entry.first); });
            is_first = false;
        }
    if (common.sums.empty()) return Rational(1);
    for (std::size_t k = 0; k < 2; ++k) {
        std::vector<Term> terms;
        for (const Coefficient& coefficient : sides[k]) {
            const Polynomial value = without(coefficient.value, common, factorizer);
            for (const Term& term : value.terms())
                terms.push_back({coefficient.rest * term.monomial, term.coefficient});
        }
        (k == 0 ? lhs : rhs) = Fourier::collect(std::move(terms));
    }
    return polynomial(common);
}

Polynomial polynomial(const CommonFactor& factor) {
    Polynomial result = Polynomial::collect({{factor.monomial, 1}});
    for (const auto& [sum, exponent] : factor.sums) result = result * power(sum, exponent);
    return result;
}

}  // namespace alembert
