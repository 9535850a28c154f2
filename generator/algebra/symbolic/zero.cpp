// SPDX-License-Identifier: GPL-2.0-or-later
//
// f = 0 for a sum of quotients: multiply by every denominator; the result is a polynomial in independent
// functions.
#include <algorithm>
#include <optional>
#include <utility>

#include "algebra/symbolic/fourier.hpp"

namespace alembert {

namespace {

using Kind = AtomNode::Kind;

/// tan x = sin x/cos x; cos(x + π/4) = (cos x − sin x)/√2 and similarly for thirds of a right angle. The zero test
/// needs these forms; readers prefer not to see them.
Fourier resolve(const Factor& factor, Budget& budget) {
    const AtomNode& atom = *factor.atom;
    if (atom.kind == Kind::function && atom.name == "tan" && is_integer(factor.exponent)) {
        const Fourier arg = Fourier::collect(atom.args[0].terms());
        return multiply(power(sine(arg), factor.exponent, budget), power(cosine(arg), -factor.exponent, budget),
                        budget);
    }
    const Rational half_turns = atom.is_circular() ? coefficient_of_pi(atom.args[0]) : Rational(0);
    if (atom.is_circular() && (cln::abs(6 * half_turns) == 1 || 4 * half_turns == 1)) {
        const Fourier phase = Fourier::collect({{{{pi_atom(), 1}}, half_turns}});
        const Fourier rest = Fourier::collect(atom.args[0].terms()) - phase;
        return atom.kind == Kind::sine ? sine(rest) * cosine(phase) + cosine(rest) * sine(phase)
                                       : cosine(rest) * cosine(phase) - sine(rest) * sine(phase);
    }
    return Fourier::collect({{{factor}, 1}});
}

Fourier resolve(const Fourier& f, Budget& budget) {
    std::vector<Term> terms;
    for (const Term& term : f.terms()) {
        Fourier product = Rational(term.coefficient);
        for (const Factor& factor : term.monomial) product = multiply(product, resolve(factor, budget), budget);
        terms.insert(terms.end(), product.terms().begin(), product.terms().end());
    }
    return Fourier::collect(std::move(terms));
}

/// The lowest negative power of the first base in order; none if there is no denominator.
std::optional<Factor> denominator(const Fourier& f) {
    std::optional<Factor> result;
    for (const Term& term : f.terms()) {
        for (const Factor& factor : term.monomial) {
            if (factor.atom->kind != Kind::base || factor.exponent >= 0) continue;
            const int order = result ? compare(factor.atom, result->atom) : -1;
            if (order < 0 || (order == 0 && factor.exponent < result->exponent)) result = factor;
        }
    }
    return result;
}

}  // namespace

bool is_zero(const Fourier& f) {
    Budget budget{.terms = 200000, .work = 2000000};
    Fourier rest = resolve(f, budget);
    // Each round clears one base. Bases inside it may appear instead, but only finitely often.
    for (int round = 0; round < 64 && rest.size() != 0; ++round) {
        const std::optional<Factor> below = denominator(rest);
        if (!below) return false;
        rest = multiply(Fourier::collect({{{{below->atom, -below->exponent}}, 1}}), rest, budget);
        if (budget.spent) return false;
    }
    return rest.size() == 0;
}

}  // namespace alembert
