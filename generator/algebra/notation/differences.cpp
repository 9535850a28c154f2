// SPDX-License-Identifier: GPL-2.0-or-later
// c·(x + s·y)ⁿ has the coefficients c·binom(n, k)·sᵏ. The coefficients of the mixed products give c and s, because
// powers of x or y alone may also come from other terms. With n = 2 there is one mixed product, and s is 1 or −1.
#include "algebra/notation/differences.hpp"

#include <algorithm>
#include <optional>

#include "algebra/notation/phrase.hpp"

namespace alembert {

namespace {

constexpr std::size_t longest_searched = 30;
constexpr int highest_power = 6;

bool is_whole_symbol(const Factor& factor) {
    return factor.atom->kind == AtomNode::Kind::symbol && factor.exponent >= 1 && is_integer(factor.exponent);
}

/// Two symbols of a product, and its other factors.
struct Pair {
    Factor x, y;
    Monomial rest;

    Monomial product(int power_of_x, int power_of_y) const {
        return rest * power({{x.atom, 1}}, power_of_x) * power({{y.atom, 1}}, power_of_y);
    }
};

std::vector<Pair> pairs_in(const Monomial& monomial) {
    std::vector<Pair> result;
    for (std::size_t i = 0; i < monomial.size(); ++i)
        for (std::size_t j = i + 1; j < monomial.size(); ++j) {
            const Factor &x = monomial[i], &y = monomial[j];
            if (!is_whole_symbol(x) || !is_whole_symbol(y) || (x.atom->steady && y.atom->steady)) continue;
            Monomial rest;
            for (std::size_t k = 0; k < monomial.size(); ++k)
                if (k != i && k != j) rest.push_back(monomial[k]);
            result.push_back({x, y, std::move(rest)});
        }
    return result;
}

Rational coefficient_of(const Polynomial& polynomial, const Monomial& monomial) {
    for (const Term& term : polynomial.terms())
        if (compare(term.monomial, monomial) == 0) return term.coefficient;
    return 0;
}

/// rest·c·(x + s·y)ⁿ
Polynomial power_of_sum(const Pair& pair, int n, const Rational& c, const Rational& s) {
    std::vector<Term> terms;
    Rational factor = c;
    for (int k = 0; k <= n; ++k) {
        terms.push_back({pair.product(n - k, k), factor});
        factor = factor * s * Rational(n - k) / Rational(k + 1);
    }
    return Polynomial::collect(std::move(terms));
}

/// The powers that the term mixed·xⁿ⁻¹·y may come from.
std::vector<Polynomial> candidates(const Polynomial& of, const Pair& pair, int n, const Rational& mixed) {
    if (n == 2) {
        const bool squares = !cln::zerop(coefficient_of(of, pair.product(2, 0))) &&
                             !cln::zerop(coefficient_of(of, pair.product(0, 2)));
        if (!squares) return {};
        return {power_of_sum(pair, 2, -mixed / 2, -1), power_of_sum(pair, 2, mixed / 2, 1)};
    }
    const Rational next = coefficient_of(of, pair.product(n - 2, 2));
    if (cln::zerop(next)) return {};
    const Rational s = 2 * next / (Rational(n - 1) * mixed);  // from the coefficients n·c·s and n·(n−1)/2·c·s²
    return {power_of_sum(pair, n, mixed / (Rational(n) * s), s)};
}

/// rest·c·(x + b/2c)², of which the terms are rest·(c·x² + b·x): distances from a number, as (x − 5)².
std::vector<Polynomial> completed_squares(const Polynomial& of, const Term& term) {
    std::vector<Polynomial> result;
    for (std::size_t i = 0; i < term.monomial.size(); ++i) {
        const Factor& x = term.monomial[i];
        if (!is_whole_symbol(x) || x.exponent != 1 || x.atom->steady) continue;
        Monomial rest = term.monomial;
        rest.erase(rest.begin() + static_cast<std::ptrdiff_t>(i));
        const Monomial square = rest * power({{x.atom, 1}}, 2);
        const Rational c = coefficient_of(of, square), b = term.coefficient;
        if (!cln::zerop(c)) result.push_back(Polynomial::collect({{square, c}, term, {rest, b * b / (4 * c)}}));
    }
    return result;
}

std::optional<Polynomial> best_power(const Polynomial& polynomial) {
    std::optional<Polynomial> best;
    std::size_t least = polynomial.size();  // the number of terms to beat, counting the power as one
    const auto offer = [&](std::vector<Polynomial> powers) {
        for (Polynomial& power : powers)
            if (const std::size_t left = (polynomial - power).size() + 1; left < least) {
                least = left;
                best = std::move(power);
            }
    };
    for (const Term& term : polynomial.terms()) {
        for (const Pair& pair : pairs_in(term.monomial)) {
            const int n = to_int(pair.x.exponent + pair.y.exponent);
            if (pair.y.exponent != 1 || n > highest_power) continue;
            offer(candidates(polynomial, pair, n, term.coefficient));
        }
        offer(completed_squares(polynomial, term));
    }
    return best;
}

}  // namespace

std::vector<Polynomial> powers_of_differences(const Polynomial& polynomial) {
    std::vector<Polynomial> result;
    if (polynomial.size() > longest_searched) return result;
    Polynomial rest = polynomial;
    while (const auto power = best_power(rest)) {
        result.push_back(*power);
        rest = rest - *power;
    }
    if (!result.empty())
        for (const Term& term : rest.terms()) result.push_back(Polynomial::collect({term}));
    return result;
}

bool is_difference_of_waves(const Polynomial& polynomial) {
    if (polynomial.size() != 2) return false;
    const Term &a = polynomial.terms()[0], &b = polynomial.terms()[1];
    const auto is_wave = [](const Monomial& monomial) {
        if (monomial.size() != 1 || !monomial[0].atom->is_circular() || monomial[0].exponent != 1) return false;
        const Polynomial& angle = monomial[0].atom->args[0];
        return angle.size() == 1 && angle.terms()[0].coefficient == 1 && angle.terms()[0].monomial.size() == 1;
    };
    return is_wave(a.monomial) && is_wave(b.monomial) && a.monomial[0].atom->kind == b.monomial[0].atom->kind &&
           cln::abs(a.coefficient) == 1 && a.coefficient == -b.coefficient;
}

std::vector<Polynomial> differences_of_waves(const Polynomial& polynomial) {
    std::vector<Polynomial> result, terms;
    if (polynomial.size() > longest_searched) return result;
    for (const Term& term : polynomial.terms()) terms.push_back(Polynomial::collect({term}));
    for (std::size_t i = 0; i < terms.size(); ++i)
        for (std::size_t j = i + 1; j < terms.size(); ++j) {
            const Term &first = terms[i].terms()[0], &second = terms[j].terms()[0];
            if (first.coefficient != -second.coefficient || is_decimal(first.coefficient) ||
                first.monomial.size() != second.monomial.size())
                continue;
            const Polynomial pair = terms[i] + terms[j];
            const Rational scale = cln::abs(first.coefficient);
            if (!is_difference_of_waves((1 / scale) * divide(pair, common_monomial(pair)))) continue;
            result.push_back(pair);
            terms.erase(terms.begin() + static_cast<std::ptrdiff_t>(j));
            terms.erase(terms.begin() + static_cast<std::ptrdiff_t>(i--));
            break;
        }
    if (!result.empty()) result.insert(result.end(), terms.begin(), terms.end());
    return result;
}

}  // namespace alembert
