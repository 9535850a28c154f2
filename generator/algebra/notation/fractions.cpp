// SPDX-License-Identifier: GPL-2.0-or-later
#include "algebra/notation/fractions.hpp"

#include <algorithm>

#include "algebra/notation/quotient.hpp"
#include "algebra/symbolic/exact_solve.hpp"

namespace alembert {

using GiNaC::ex;

namespace {

constexpr std::size_t most_fraction_terms = 40;  // the most terms of a numerator

bool is_momentum(const AtomNode& atom) {
    return atom.kind == AtomNode::Kind::symbol && atom.info.kind == SymbolInfo::Kind::other;
}

Rational degree_in_momenta(const Term& term) {
    Rational degree = 0;
    for (const Factor& factor : part(term.monomial, is_momentum)) degree = degree + factor.exponent;
    return degree;
}

bool is_divided(const Term& term) {
    return std::any_of(term.monomial.begin(), term.monomial.end(),
                       [](const Factor& factor) { return !factor.atom->steady && factor.exponent < 0; });
}

bool has_rates(const Term& term) {
    return std::any_of(term.monomial.begin(), term.monomial.end(), [](const Factor& factor) {
        return factor.atom->kind == AtomNode::Kind::symbol && factor.atom->info.order > 0;
    });
}

/// The value of an expression for fixed values of its symbols. A denominator that is definite has its sign there.
double number(const ex& e) {
    GiNaC::exmap values;
    const auto gather = [&](const auto& self, const ex& part) -> void {
        if (GiNaC::is_a<GiNaC::symbol>(part)) values.emplace(part, 0);
        for (const ex& inner : part) self(self, inner);
    };
    gather(gather, e);
    // The order of symbols changes from run to run, so all have the same value.
    for (auto& [symbol, value] : values) value = GiNaC::numeric(7, 10);
    const ex value = e.subs(values, GiNaC::subs_options::no_pattern).evalf();
    return GiNaC::is_a<GiNaC::numeric>(value) ? GiNaC::ex_to<GiNaC::numeric>(value).to_double() : 1;
}

/// One quotient, or nothing if the sum of quotients is not longer.
std::optional<Phrase> one_quotient(const Fourier& f, const Symbols& symbols) {
    if (f.size() < 2 || f.size() > most_fraction_terms) return std::nullopt;
    const auto quotient = readable_quotient(in_single_angles(expression(f)), symbols, most_fraction_terms, number);
    return quotient && cost(*quotient) < cost(readable(f)) ? quotient : std::nullopt;
}

/// Writes the terms of one degree in the momenta.
Phrase of_one_degree(const std::vector<Term>& terms, const Symbols& symbols) {
    std::vector<Term> divided, others;
    for (const Term& term : terms) (is_divided(term) ? divided : others).push_back(term);
    const Fourier all = Fourier::collect(terms);
    const Fourier above = Fourier::collect(std::move(divided)), beside = Fourier::collect(std::move(others));
    std::vector<Phrase> forms{readable(all)};
    if (const auto quotient = one_quotient(above, symbols))
        forms.push_back(beside.size() == 0 ? *quotient : phrases::sum({readable(beside), *quotient}));
    if (above.size() > 1 && beside.size() > 0)
        if (const auto quotient = one_quotient(all, symbols)) forms.push_back(*quotient);
    return *std::min_element(forms.begin(), forms.end(),
                             [](const Phrase& a, const Phrase& b) { return cost(a) < cost(b); });
}

}  // namespace

Phrase in_fractions(const Fourier& f, const Symbols& symbols) {
    std::vector<Term> moving, resting;
    std::map<Rational, std::vector<Term>, std::greater<>> by_degree;
    for (const Term& term : f.terms()) {
        const Rational degree = degree_in_momenta(term);
        if (degree != 0)
            by_degree[degree].push_back(term);
        else
            (has_rates(term) ? moving : resting).push_back(term);
    }
    if (by_degree.empty()) return readable(f);
    std::vector<Phrase> parts;
    if (!moving.empty()) parts.push_back(readable(Fourier::collect(std::move(moving))));
    for (const auto& [degree, terms] : by_degree) parts.push_back(of_one_degree(terms, symbols));
    if (!resting.empty()) parts.push_back(readable(Fourier::collect(std::move(resting))));
    const auto positive = std::find_if(parts.begin(), parts.end(), [](const Phrase& p) {
        return (p.kind == Phrase::Kind::sum ? p.args[0] : p).kind != Phrase::Kind::negative;
    });
    if (positive != parts.end()) std::rotate(parts.begin(), positive, positive + 1);
    return phrases::sum(std::move(parts));
}

ReadableEquation equation_in_fractions(const Fourier& lhs, const Fourier& rhs, const Symbols& symbols) {
    ReadableEquation cleared = readable_equation(lhs, rhs);
    ReadableEquation divided{in_fractions(lhs, symbols), in_fractions(rhs, symbols), {}};
    const int lines = cost(divided.lhs) + cost(divided.rhs);
    return 4 * (cost(cleared.lhs) + cost(cleared.rhs)) < 3 * lines ? cleared : divided;
}

}  // namespace alembert
