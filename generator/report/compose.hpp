// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// Polynomials as phrases: factored, with factors and terms in the order in which books write them.
///
///     number · (sums of parameters) · parameters · (sums with the state) · coordinates · inputs · rates · functions
///     (m1+m2)·l1·θ1″,   m·(l+x)·x′·θ′,   m2·g·l·sin φ
///
/// Among parameters masses and moments of inertia come first, then g, then the others as declared.

#include <map>

#include "report/factor.hpp"
#include "report/phrase.hpp"

namespace alembert {

class Composer {
public:
    /// Sines and cosines are variables like others here. Sums are grouped where that is shorter.
    Phrase operator()(const Polynomial& polynomial);
    /// The same for a normal form, with multiple angles undone where that is shorter.
    Phrase formula(const Polynomial& normal_form);

    Factorizer& factorizer() { return factorizer_; }

private:
    Phrase compose(const Polynomial& polynomial);
    Phrase compose_sum(const Polynomial& polynomial);
    Phrase flat(const std::vector<Polynomial>& parts);

    Factorizer factorizer_;
    std::map<Polynomial, Phrase, PolynomialLess> memo_;
};

/// Not made of parameters and numbers alone.
bool has_state(const Monomial& monomial);

/// The factors of a monomial that satisfy `is_in`.
template <typename Predicate>
Monomial part(const Monomial& monomial, Predicate is_in) {
    Monomial result;
    for (const Factor& factor : monomial)
        if (is_in(*factor.atom)) result.push_back(factor);
    return result;
}

/// Sorts the terms of a polynomial into polynomials with equal `part(…, is_in)`, in the order of these parts.
template <typename Predicate>
std::vector<Polynomial> partition(const Polynomial& polynomial, Predicate is_in) {
    const auto less = [](const Monomial& a, const Monomial& b) { return compare(a, b) < 0; };
    std::map<Monomial, std::vector<Term>, decltype(less)> groups(less);
    for (const Term& term : polynomial.terms()) groups[part(term.monomial, is_in)].push_back(term);
    std::vector<Polynomial> result;
    for (auto& [key, terms] : groups) result.push_back(Polynomial::collect(std::move(terms)));
    return result;
}

}  // namespace alembert
