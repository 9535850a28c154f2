// SPDX-License-Identifier: GPL-2.0-or-later
//
//     cos a cos b = ½(cos(a−b) + cos(a+b))
//     sin a sin b = ½(cos(a−b) − cos(a+b))
//     sin a cos b = ½(sin(a−b) + sin(a+b))
//
// The functions 1, cos(k·θ), sin(k·θ), with the first nonzero entry of the integer vector k positive, are linearly
// independent, which makes the form unique (Bronshtein & Semendyayev, Handbook of Mathematics, §7.4.1).
#include "algebra/symbolic/fourier.hpp"

#include <algorithm>
#include <stdexcept>
#include <utility>

#include <cln/integer.h>

#include "base/language/say.hpp"

namespace alembert {

namespace {

using Kind = AtomNode::Kind;

/// A term, and the powers of polynomials that were taken out of it and must be multiplied out.
struct Product {
    Term term;
    std::vector<std::pair<Polynomial, int>> powers;
};

bool is_absolute(const Factor& factor) {
    return factor.atom->kind == Kind::function && factor.atom->name == "abs";
}

/// The whole power of a factor that has to be multiplied out: P^(3/2) = P·P^(1/2), |a|³ = a²·|a|, 2^(−1/2) =
/// ½·2^(1/2); and (2P)^(−1/2) squared is ½·P^(−1). 0 for none.
cln::cl_I whole_power(const Factor& factor) {
    const AtomNode& atom = *factor.atom;
    const cln::cl_I whole = cln::floor1(factor.exponent);
    if (is_absolute(factor)) return whole >= 2 ? whole - cln::mod(whole, 2) : cln::cl_I(0);
    if (atom.kind != Kind::base) return 0;
    if (whole >= 1 || atom.args[0].is_constant()) return whole;
    return whole == factor.exponent && !atom.primitive ? whole : cln::cl_I(0);
}

void take_powers(Product& product) {
    Monomial rest;
    for (Factor& factor : product.term.monomial) {
        const cln::cl_I whole = whole_power(factor);
        if (!cln::zerop(whole)) {
            product.powers.emplace_back(factor.atom->args[0], cln::cl_I_to_int(whole));
            factor.exponent = factor.exponent - whole;
        }
        if (!cln::zerop(factor.exponent)) rest.push_back(std::move(factor));
    }
    product.term.monomial = std::move(rest);
}

bool has_powers(const Monomial& monomial) {
    return std::any_of(monomial.begin(), monomial.end(),
                       [](const Factor& factor) { return !cln::zerop(whole_power(factor)); });
}

bool has_negative_lead(const Polynomial& arg) {
    return !arg.is_zero() && arg.terms()[0].coefficient < 0;
}

/// sin or cos of `arg` with canonical sign, shifted by multiples of π/2 until π has a coefficient in (−¼, ¼].
Term circular_term(bool is_sine, Polynomial arg) {
    Rational sign = 1;
    if (has_negative_lead(arg)) {
        arg = -arg;
        if (is_sine) sign = -1;
    }
    const Rational half_turns = coefficient_of_pi(arg);
    if (!cln::zerop(half_turns)) {
        const cln::cl_I quarters = cln::ceiling1(2 * half_turns - Rational(1) / 2);
        arg = arg - Polynomial(pi_atom()) * Polynomial(Rational(quarters) / 2);
        const int quarter = cln::cl_I_to_int(cln::mod(quarters, 4));
        // cos(x + π/2) = −sin x, sin(x + π/2) = cos x
        if (is_sine ? quarter >= 2 : (quarter == 1 || quarter == 2)) sign = -sign;
        if (quarter % 2 == 1) is_sine = !is_sine;
        if (has_negative_lead(arg)) {
            arg = -arg;
            if (is_sine) sign = -sign;
        }
    }
    if (arg.is_zero()) return {{}, is_sine ? Rational(0) : sign};
    const bool only_pi = arg.size() == 1 && !cln::zerop(coefficient_of_pi(arg));
    const auto root = [](int number) {
        return Monomial{{compound_atom(Kind::base, {Polynomial(Rational(number))}), Rational(1) / 2}};
    };
    if (only_pi && 6 * coefficient_of_pi(arg) == 1) return {is_sine ? Monomial{} : root(3), sign / 2};
    if (only_pi && 4 * coefficient_of_pi(arg) == 1) return {root(2), sign / 2};
    return {{{compound_atom(is_sine ? Kind::sine : Kind::cosine, {std::move(arg)}), 1}}, sign};
}

/// A term split into its sine or cosine and the rest.
struct Split {
    Monomial rest;
    const AtomNode* wave;
    const Rational* coefficient;
};

std::vector<Split> split(const Fourier& f) {
    std::vector<Split> result;
    result.reserve(f.size());
    for (const Term& term : f.terms()) {
        const AtomNode* wave = circular(term.monomial);
        Monomial rest = term.monomial;
        if (wave) rest.pop_back();
        result.push_back({std::move(rest), wave, &term.coefficient});
    }
    return result;
}

Monomial with_wave(Monomial rest, const Monomial& original) {
    rest.push_back(original.back());
    return rest;
}

Fourier raise(const Fourier& base, int exponent, Budget& budget) {
    Fourier result = Rational(1);
    for (int i = 0; i < exponent && !budget.spent; ++i) result = multiply(result, base, budget);
    return result;
}

bool charge(Budget& budget, std::size_t terms) {
    if (terms > budget.terms || terms > budget.work) budget.spent = true;
    if (!budget.spent) budget.work -= terms;
    return !budget.spent;
}

/// c = s^(1/e)·r with r as small as trial division makes it: the rational part of a root, and the part that
/// remains under it.
std::pair<Rational, Rational> take_root(const Rational& c, const Rational& e) {
    const cln::cl_I q = cln::denominator(e);
    // n/d = n·d^(q−1)/d^q
    cln::cl_I left = cln::numerator(c) * cln::expt_pos(cln::denominator(c), q - 1);
    Rational taken = Rational(1) / Rational(cln::denominator(c));
    if (q > 8) return {1, c};
    for (int prime = 2; prime < 1000; ++prime) {
        const cln::cl_I unit = cln::expt_pos(cln::cl_I(prime), q);
        while (cln::zerop(cln::mod(left, unit))) {
            left = cln::exquo(left, unit);
            taken = taken * prime;
        }
    }
    cln::cl_I root;
    if (cln::rootp(left, q, &root)) return {taken * root, 1};
    return {taken, left};
}

Fourier power_of_term(const Term& term, const Rational& exponent) {
    const bool whole = is_integer(exponent);
    Monomial monomial;
    Rational coefficient = 1;
    if (whole) {
        coefficient = cln::expt(term.coefficient, cln::numerator(exponent));
        for (const Factor& factor : term.monomial)
            if (factor.atom->is_circular())
                monomial = monomial * Monomial{{compound_atom(Kind::base, {Polynomial(factor.atom)}), exponent}};
            else
                monomial = monomial * Monomial{{factor.atom, factor.exponent * exponent}};
        return Fourier::collect({{monomial, coefficient}});
    }
    Rational left = term.coefficient;
    if (left > 0) {
        const auto [taken, rest] = take_root(left, exponent);
        coefficient = cln::expt(taken, cln::numerator(exponent));
        left = rest;
    }
    Monomial inside;
    bool is_one_symbol = term.monomial.size() == 1 && left == 1;
    for (const Factor& factor : term.monomial) {
        // √(x²) is |x|, but exp(x)² and x³ may share their exponents with the root
        const bool positive = factor.atom->kind == Kind::function && factor.atom->name == "exp";
        const bool odd = cln::oddp(cln::numerator(factor.exponent)) && !factor.atom->is_circular();
        if (positive || (is_one_symbol && odd))
            monomial = monomial * Monomial{{factor.atom, factor.exponent * exponent}};
        else
            inside.push_back(factor);
    }
    if (!inside.empty() || left != 1) {
        const Polynomial base = Polynomial::collect({{inside, left}});
        monomial = monomial * Monomial{{compound_atom(Kind::base, {base}), exponent}};
    }
    return Fourier::collect({{monomial, coefficient}});
}

Fourier power_of_sum(const Polynomial& sum, const Rational& exponent, Budget& budget) {
    Rational c = content(sum);
    if (!is_integer(exponent)) {
        const auto [taken, left] = take_root(c, exponent);
        const Atom base = compound_atom(Kind::base, {(left / c) * sum});
        return Fourier::collect({{{{base, exponent}}, cln::expt(taken, cln::numerator(exponent))}});
    }
    if (has_negative_lead(sum)) c = -c;
    Monomial common = common_monomial(sum);
    if (circular(common)) common.pop_back();
    const Monomial monomial = power(common, exponent);
    const Polynomial primitive = divide(sum, common, c);
    const bool had_denominator = std::any_of(common.begin(), common.end(), [](const Factor& factor) {
        return factor.atom->kind == Kind::base && factor.exponent < 0;
    });
    const Fourier outside = Fourier::collect({{monomial, cln::expt(c, cln::numerator(exponent))}});
    // 1/(a + b/P): once P is cleared, its powers have to be multiplied out.
    if (had_denominator)
        return multiply(
            outside, power(multiply(Fourier::collect(primitive.terms()), Rational(1), budget), exponent, budget),
            budget);
    return multiply(outside, Fourier::collect({{{{compound_atom(Kind::base, {primitive}), exponent}}, 1}}),
                    budget);
}

}  // namespace

Rational coefficient_of_pi(const Polynomial& arg) {
    for (const Term& term : arg.terms())
        if (term.monomial.size() == 1 && term.monomial[0].atom->kind == Kind::pi && term.monomial[0].exponent == 1)
            return term.coefficient;
    return 0;
}

const AtomNode* circular(const Monomial& monomial) {
    return !monomial.empty() && monomial.back().atom->is_circular() ? monomial.back().atom.get() : nullptr;
}

Fourier operator+(const Fourier& a, const Fourier& b) {
    return Fourier(a.polynomial_ + b.polynomial_);
}
Fourier operator-(const Fourier& a, const Fourier& b) {
    return Fourier(a.polynomial_ - b.polynomial_);
}

Fourier operator*(const Rational& a, const Fourier& b) {
    std::vector<Term> terms = b.terms();
    for (Term& term : terms) term.coefficient = a * term.coefficient;
    return Fourier::collect(std::move(terms));
}

Fourier operator*(const Fourier& a, const Fourier& b) {
    Budget unlimited;
    return multiply(a, b, unlimited);
}

Fourier multiply(const Fourier& a, const Fourier& b, Budget& budget) {
    if (!charge(budget, 2 * a.size() * b.size())) return {};
    const std::vector<Split> left = split(a);
    const std::vector<Split> right = split(b);
    std::vector<Term> terms;
    const auto add = [&](Term term) {
        if (cln::zerop(term.coefficient)) return;
        if (!has_powers(term.monomial)) {
            terms.push_back(std::move(term));
            return;
        }
        Product product{std::move(term), {}};
        take_powers(product);
        Fourier value = Fourier::collect({product.term});
        for (const auto& [base, exponent] : product.powers)
            value = multiply(value, power(Fourier::collect(base.terms()), exponent, budget), budget);
        terms.insert(terms.end(), value.terms().begin(), value.terms().end());
    };
    for (std::size_t i = 0; i < left.size(); ++i) {
        for (std::size_t j = 0; j < right.size(); ++j) {
            const Split& x = left[i];
            const Split& y = right[j];
            Monomial rest = x.rest * y.rest;
            const Rational c = *x.coefficient * *y.coefficient;
            if (!x.wave || !y.wave) {
                if (x.wave) rest = with_wave(std::move(rest), a.terms()[i].monomial);
                if (y.wave) rest = with_wave(std::move(rest), b.terms()[j].monomial);
                add({std::move(rest), c});
                continue;
            }
            const bool sine_x = x.wave->kind == Kind::sine;
            const bool sine_y = y.wave->kind == Kind::sine;
            const bool is_sine = sine_x != sine_y;
            Term difference = circular_term(is_sine, x.wave->args[0] - y.wave->args[0]);
            Term sum = circular_term(is_sine, x.wave->args[0] + y.wave->args[0]);
            // cos a sin b = ½(sin(a+b) − sin(a−b))
            const bool minus_difference = is_sine && sine_y;
            const bool minus_sum = sine_x && sine_y;
            difference.coefficient = (minus_difference ? -c : c) * difference.coefficient / 2;
            sum.coefficient = (minus_sum ? -c : c) * sum.coefficient / 2;
            add({rest * difference.monomial, difference.coefficient});
            add({rest * sum.monomial, sum.coefficient});
        }
    }
    return Fourier::collect(std::move(terms));
}

Fourier sine(const Fourier& arg) {
    return Fourier::collect({circular_term(true, arg.polynomial())});
}
Fourier cosine(const Fourier& arg) {
    return Fourier::collect({circular_term(false, arg.polynomial())});
}

Fourier power(const Fourier& base, const Rational& exponent, Budget& budget) {
    if (budget.spent) return {};  // `base` may be a product that was abandoned, which looks like zero
    if (is_integer(exponent) && exponent >= 0) return raise(base, to_int(exponent), budget);
    if (base.size() == 0) {
        if (exponent > 0) return {};
        throw std::domain_error(say("division by an expression that is identically zero"));
    }
    const Fourier result = base.size() == 1 ? power_of_term(base.terms()[0], exponent)
                                            : power_of_sum(base.polynomial(), exponent, budget);
    return multiply(result, Rational(1), budget);  // takes whole powers out of the bases
}

Fourier coefficient(const Fourier& f, const GiNaC::symbol& symbol, int exponent) {
    std::vector<Term> terms;
    for (const Term& term : f.terms()) {
        Monomial rest;
        Rational found = 0;
        for (const Factor& factor : term.monomial)
            if (factor.atom->kind == Kind::symbol && factor.atom->symbol.is_equal(symbol))
                found = factor.exponent;
            else
                rest.push_back(factor);
        if (found == exponent) terms.push_back({std::move(rest), term.coefficient});
    }
    return Fourier::collect(std::move(terms));
}

GiNaC::ex expression(const Fourier& f) {
    return expression(f.polynomial());
}

}  // namespace alembert
