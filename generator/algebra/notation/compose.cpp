// SPDX-License-Identifier: GPL-2.0-or-later
#include "algebra/notation/compose.hpp"

#include <algorithm>
#include <array>
#include <utility>

#include <cln/integer.h>

#include "algebra/notation/angles.hpp"
#include "algebra/notation/differences.hpp"
#include "algebra/notation/text.hpp"

namespace alembert {

using namespace phrases;

struct FactorPiece {
    enum class Standing { number, pi, sum, parameter, constant, state_sum, state, function, circular };
    Standing place;
    std::array<int, 3> order{};
    Polynomial tie;  ///< decides between pieces of the same place and order
    Phrase base;
    Rational exponent = 1;
    int last = 0;  ///< decides after `tie`: sin θ before cos θ

    friend bool operator<(const FactorPiece& a, const FactorPiece& b) {
        const auto key = [](const FactorPiece& piece) { return std::pair(piece.place, piece.order); };
        if (key(a) != key(b)) return key(a) < key(b);
        const int order = compare(a.tie, b.tie);
        return order != 0 ? order < 0 : a.last < b.last;
    }
};

namespace {

using Kind = AtomNode::Kind;
using Standing = FactorPiece::Standing;
using Symbol = SymbolInfo::Kind;

/// Whether the name looks like a mass or a moment of inertia: m, m1, mc, M_cart, J, I2, Ix …
bool is_inertia(const std::string& name) {
    if (name.empty() || std::string("mMJI").find(name[0]) == std::string::npos || name == "mu") return false;
    const std::string rest = name.substr(1);
    return rest.size() <= 1 || rest[0] == '_' || rest.find_first_not_of("0123456789") == std::string::npos;
}

FactorPiece symbol_piece(const Factor& factor) {
    const SymbolInfo& info = factor.atom->info;
    FactorPiece piece{.place = Standing::parameter,
                      .tie = {},
                      .base = symbol(factor.atom->symbol, info),
                      .exponent = factor.exponent};
    if (factor.atom->steady) {
        piece.order = {is_inertia(info.name) ? 0 : info.name == "g" ? 1 : 2, info.rank, 0};
        return piece;
    }
    piece.place = Standing::state;
    const bool rate = info.kind == Symbol::coordinate && info.order > 0;
    const int level = info.kind == Symbol::time         ? 0
                      : rate                            ? 3 + info.order
                      : info.kind == Symbol::coordinate ? 1
                      : info.kind == Symbol::input      ? 3
                                                        : 2;
    piece.order = {level, info.rank, 0};
    return piece;
}

/// A sum that stands above and below the fraction line is left out: the factorizer may find above what is one atom
/// below.
void cancel(std::vector<FactorPiece>& pieces) {
    for (FactorPiece& above : pieces)
        for (FactorPiece& below : pieces) {
            if (above.exponent <= 0 || below.exponent >= 0 || above.base.kind != Phrase::Kind::sum ||
                text(above.base) != text(below.base))
                continue;
            const Rational both = above.exponent + below.exponent;
            above.exponent = both > 0 ? both : Rational(0);
            below.exponent = both < 0 ? both : Rational(0);
        }
    std::erase_if(pieces, [](const FactorPiece& piece) { return cln::zerop(piece.exponent); });
}

/// Steady terms first, then by degree, then in canonical order.
bool stands_before(const Term& a, const Term& b) {
    const auto degree = [](const Monomial& monomial) {
        Rational result = 0;
        for (const Factor& factor : monomial) result = result + factor.exponent;
        return result;
    };
    if (has_state(a.monomial) != has_state(b.monomial)) return has_state(b.monomial);
    const auto order = cln::compare(degree(a.monomial), degree(b.monomial));
    return order != 0 ? order < 0 : compare(a.monomial, b.monomial) < 0;
}

/// Whether a difference may be written with the opposite sign: A−C or x1−x2, in which the terms are of the same
/// kind, and cos θ−1, but not r−l0.
bool may_turn(const Polynomial& sum) {
    const bool state = has_state(sum.terms()[0].monomial);
    bool has_minus = false;
    for (const Term& term : sum.terms()) {
        if (has_state(term.monomial) != state && !term.monomial.empty()) return false;
        has_minus = has_minus || term.coefficient < 0;
    }
    return has_minus;
}

bool has_coordinate(const Polynomial& polynomial) {
    for (const Term& term : polynomial.terms())
        for (const Factor& factor : term.monomial)
            if (factor.atom->info.kind == Symbol::coordinate ||
                std::any_of(factor.atom->args.begin(), factor.atom->args.end(), has_coordinate))
                return true;
    return false;
}

const Term& first_term(const Polynomial& polynomial) {
    return *std::min_element(polynomial.terms().begin(), polynomial.terms().end(), stands_before);
}

}  // namespace

bool has_own_denominators(const Polynomial& polynomial) {
    return compare(common_monomial(polynomial), shared_monomial(polynomial)) != 0;
}

bool has_state(const Monomial& monomial) {
    return std::any_of(monomial.begin(), monomial.end(),
                       [](const Factor& factor) { return !factor.atom->steady; });
}

bool Composer::stays_apart(const Polynomial& polynomial) const {
    const bool has_decimal =
        decimals_ && std::any_of(polynomial.terms().begin(), polynomial.terms().end(),
                                 [](const Term& term) { return reads_as_decimal(term.coefficient); });
    return polynomial.size() > 1 && (has_decimal || has_own_denominators(polynomial));
}

const Composer::Entry& Composer::entry(const Polynomial& polynomial) {
    const auto found = memo_.find(polynomial);
    if (found != memo_.end()) return found->second;
    effort_ += polynomial.size();
    Phrase phrase = compose(polynomial);
    const int measured = alembert::cost(phrase);
    return memo_.emplace(polynomial, Entry{std::move(phrase), measured}).first->second;
}

const Phrase& Composer::operator()(const Polynomial& polynomial) {
    return entry(polynomial).phrase;
}

int Composer::cost(const Polynomial& polynomial) {
    if (!is_exhausted()) return entry(polynomial).cost;
    int symbols = 0;
    for (const Term& term : polynomial.terms()) symbols += 2 + 2 * static_cast<int>(term.monomial.size());
    return symbols;
}

void Composer::begin() {
    if (is_exhausted()) {
        memo_.clear();
        unfolded_.clear();
    }
    effort_ = 0;
}

bool Composer::is_exhausted() const {
    return effort_ > most_effort_;
}

const Polynomial& Composer::unfolded(const Polynomial& normal_form) {
    const auto found = unfolded_.find(normal_form);
    if (found != unfolded_.end()) return found->second;
    if (is_exhausted()) return normal_form;
    return unfolded_
        .emplace(normal_form, unfold(normal_form, [this](const Polynomial& form) { return cost(form); }))
        .first->second;
}

Phrase Composer::formula(const Polynomial& normal_form) {
    return (*this)(unfolded(normal_form));
}

Phrase Composer::compose(const Polynomial& polynomial) {
    if (polynomial.is_zero()) return number(0);
    Factorization factors;
    if (stays_apart(polynomial)) {
        factors.monomial = shared_monomial(polynomial);
        factors.sums.emplace_back(divide(polynomial, factors.monomial), 1);
    } else {
        factors = factorizer_(polynomial);
    }
    const bool is_lone_sum = factors.monomial.empty() && factors.sums.size() == 1 && factors.sums[0].second == 1;
    if (is_lone_sum && is_integer(factors.unit)) return compose_sum(polynomial);

    Rational unit = factors.unit;
    std::vector<FactorPiece> pieces = pieces_of(factors.monomial, unit);
    for (const auto& [sum, exponent] : factors.sums) pieces.push_back(sum_piece(sum, exponent, unit));
    return fraction(std::move(pieces), unit);
}

std::vector<FactorPiece> Composer::pieces_of(const Monomial& monomial, Rational& unit) {
    std::vector<FactorPiece> pieces;
    Polynomial exponential;
    for (const Factor& factor : monomial) {
        if (factor.atom->kind == Kind::function && factor.atom->name == "exp")
            exponential = exponential + factor.exponent * factor.atom->args[0];
        else
            pieces.push_back(piece_of(factor, unit));
    }
    if (!exponential.is_zero())
        pieces.push_back(
            {.place = Standing::function, .tie = exponential, .base = call("exp", {formula(exponential)})});
    return pieces;
}

FactorPiece Composer::piece_of(const Factor& factor, Rational& unit) {
    const AtomNode& atom = *factor.atom;
    if (atom.kind == Kind::symbol) return symbol_piece(factor);
    if (atom.kind == Kind::pi)
        return {.place = Standing::pi, .tie = {}, .base = pi(), .exponent = factor.exponent};
    if (atom.is_circular()) {
        std::vector<Phrase> terms;
        for (const Term& term : atom.args[0].terms()) terms.push_back((*this)(Polynomial::collect({term})));
        const bool is_sine = atom.kind == Kind::sine;
        // cos(Ω·t)·cos θ
        return {.place = Standing::circular,
                .order = {has_coordinate(atom.args[0]) ? 1 : 0, 0, 0},
                .tie = atom.args[0],
                .base = call(is_sine ? "sin" : "cos", {sum(std::move(terms))}),
                .exponent = factor.exponent,
                .last = is_sine ? 0 : 1};
    }
    if (atom.kind == Kind::base) {
        const Polynomial& inside = unfolded(atom.args[0]);
        const Rational scale = is_integer(factor.exponent) && !stays_apart(inside) ? content(inside) : Rational(1);
        if (scale != 1) unit = unit * cln::expt(scale, cln::numerator(factor.exponent));
        return {.place = atom.steady ? Standing::sum : Standing::function,
                .tie = Polynomial(factor.atom),
                .base = (*this)((1 / scale) * inside),
                .exponent = factor.exponent};
    }
    FactorPiece piece{.place = atom.steady ? Standing::constant : Standing::function,
                      .tie = Polynomial(factor.atom),
                      .base = {},
                      .exponent = factor.exponent};
    if (atom.name == "pow") {
        const Rational size = cln::abs(factor.exponent);
        piece.base = power(formula(atom.args[0]), formula(size * atom.args[1]));
        piece.exponent = factor.exponent / size;
    } else {
        std::vector<Phrase> args;
        for (const Polynomial& arg : atom.args) args.push_back(formula(arg));
        piece.base = call(atom.name, std::move(args));
    }
    return piece;
}

FactorPiece Composer::sum_piece(Polynomial sum, int exponent, Rational& unit) {
    // (C−A)·x, not −(A−C)·x
    if (unit < 0 && exponent % 2 == 1 && may_turn(sum)) {
        sum = -sum;
        unit = -unit;
    }
    const bool steady = std::none_of(sum.terms().begin(), sum.terms().end(),
                                     [](const Term& term) { return has_state(term.monomial); });
    return {.place = steady ? Standing::sum : Standing::state_sum,
            .tie = sum,
            .base = compose_sum(sum),
            .exponent = Rational(exponent)};
}

Phrase Composer::fraction(std::vector<FactorPiece> pieces, const Rational& unit) const {
    std::stable_sort(pieces.begin(), pieces.end());
    cancel(pieces);
    std::vector<Phrase> above, below;
    const Rational size = cln::abs(unit);
    const bool decimal = decimals_ && reads_as_decimal(size);
    if (decimal)
        above.push_back(number(size, true));
    else if (cln::numerator(size) != 1)
        above.push_back(number(Rational(cln::numerator(size))));
    if (!decimal && cln::denominator(size) != 1) below.push_back(number(Rational(cln::denominator(size))));
    for (FactorPiece& piece : pieces) {
        const bool is_above = piece.exponent > 0;
        (is_above ? above : below).push_back(power(std::move(piece.base), cln::abs(piece.exponent)));
    }
    Phrase result = quotient(product(std::move(above)), product(std::move(below)));
    return unit < 0 ? negative(std::move(result)) : result;
}

Phrase Composer::flat(const std::vector<Polynomial>& parts) {
    std::vector<Polynomial> sorted = parts;
    std::sort(sorted.begin(), sorted.end(), [](const Polynomial& a, const Polynomial& b) {
        return stands_before(first_term(a), first_term(b));
    });
    std::vector<Phrase> terms;
    for (const Polynomial& part : sorted) terms.push_back((*this)(part));
    // r − l, not −l + r
    const auto is_positive = [](const Phrase& term) { return term.kind != Phrase::Kind::negative; };
    if (!is_positive(terms[0])) std::stable_partition(terms.begin(), terms.end(), is_positive);
    return sum(std::move(terms));
}

Phrase Composer::compose_sum(const Polynomial& polynomial) {
    Phrase best = flat(partition(polynomial, [](const AtomNode&) { return true; }));
    if (polynomial.size() < 3 || polynomial.size() > 60 || is_exhausted()) return best;
    int least = alembert::cost(best);
    const auto offer = [&](const std::vector<Polynomial>& parts) {
        if (parts.size() < 2 || parts.size() == polynomial.size()) return;
        Phrase candidate = flat(parts);
        const int offered = alembert::cost(candidate);
        if (offered >= least) return;
        best = std::move(candidate);
        least = offered;
    };
    const auto is_mass = [](const AtomNode& atom) {
        return atom.kind == Kind::symbol && is_inertia(atom.info.name);
    };
    offer(partition(polynomial, [](const AtomNode& atom) { return !atom.steady; }));
    offer(partition(polynomial, [](const AtomNode& atom) { return atom.is_circular(); }));
    offer(partition(polynomial, [&](const AtomNode& atom) { return !is_mass(atom); }));
    offer(partition(polynomial, is_mass));
    offer(powers_of_differences(polynomial));
    if (polynomial.size() > 12) return best;
    const auto less = [](const Atom& a, const Atom& b) { return compare(a, b) < 0; };
    std::map<Atom, int, decltype(less)> occurrences(less);
    for (const Term& term : polynomial.terms())
        for (const Factor& factor : term.monomial) ++occurrences[factor.atom];
    for (const auto& [chosen, count] : occurrences)
        if (count > 1)
            offer(partition(polynomial,
                            [&chosen = chosen](const AtomNode& atom) { return compare(atom, *chosen) == 0; }));
    return best;
}

}  // namespace alembert
