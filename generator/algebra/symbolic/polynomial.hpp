// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// Sparse polynomials over the rationals in ordered atoms. The normal form and the readable form consist of them.
///
///     Σ coefficient · Π atomᵉˣᵖᵒⁿᵉⁿᵗ        e.g.  1/2·m·x'² − g·m·(x²+y²)^(−1/2)
///
/// An atom is a symbol, π, a base (a polynomial with a negative or fractional exponent) or a function of
/// polynomials. Exponents are rational and may be negative. Terms are ordered by the ranks of their symbols
/// (coordinates first), never by address or by GiNaC's order, so that equal values give equal texts in every run.

#include <cln/rational.h>
#include <ginac/ginac.h>

#include <cstddef>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "algebra/symbolic/symbols.hpp"

namespace alembert {

using Rational = cln::cl_RA;

struct AtomNode;
using Atom = std::shared_ptr<const AtomNode>;

struct Factor {
    Atom atom;
    Rational exponent;
};
using Monomial = std::vector<Factor>;  ///< ascending by atom; no exponent is zero

struct Term {
    Monomial monomial;
    Rational coefficient;
};

class Polynomial {
public:
    Polynomial() = default;                ///< zero
    Polynomial(const Rational& constant);  // NOLINT: a number is a polynomial
    explicit Polynomial(Atom atom, const Rational& exponent = 1);
    /// Sorts the terms, adds those with equal monomials and drops zeros.
    static Polynomial collect(std::vector<Term> terms);

    const std::vector<Term>& terms() const { return terms_; }
    std::size_t size() const { return terms_.size(); }
    bool is_zero() const { return terms_.empty(); }
    bool is_one() const;
    bool is_constant() const { return terms_.empty() || (terms_.size() == 1 && terms_[0].monomial.empty()); }

private:
    std::vector<Term> terms_;
};

struct AtomNode {
    /// The order of the kinds is the order of atoms in a monomial: a sine or cosine comes last.
    enum class Kind { symbol, pi, base, function, cosine, sine };
    Kind kind = Kind::symbol;
    SymbolInfo info;               ///< if the atom is a symbol
    GiNaC::ex symbol;              ///< the symbol itself
    std::string name;              ///< GiNaC's name of a function
    std::vector<Polynomial> args;  ///< the arguments of a function, sine or cosine; the one polynomial of a base
    bool steady = true;            ///< whether it consists of numbers and parameters only
    /// For a base: whether it has no content, sign or monomial that could be taken out of whole powers.
    bool primitive = true;

    bool is_circular() const { return kind == Kind::cosine || kind == Kind::sine; }
};

Atom symbol_atom(const GiNaC::symbol& symbol, const SymbolInfo& info);
Atom pi_atom();
Atom compound_atom(AtomNode::Kind kind, std::vector<Polynomial> args, std::string name = {});

/// −1, 0, 1: a total order that depends on ranks and names alone.
int compare(const AtomNode& a, const AtomNode& b);
int compare(const Atom& a, const Atom& b);
int compare(const Monomial& a, const Monomial& b);
int compare(const Polynomial& a, const Polynomial& b);
inline bool operator==(const Polynomial& a, const Polynomial& b) {
    return compare(a, b) == 0;
}
struct PolynomialLess {
    bool operator()(const Polynomial& a, const Polynomial& b) const { return compare(a, b) < 0; }
};

Polynomial operator+(const Polynomial& a, const Polynomial& b);
Polynomial operator-(const Polynomial& a, const Polynomial& b);
Polynomial operator-(const Polynomial& a);
Polynomial operator*(const Polynomial& a, const Polynomial& b);
Polynomial operator*(const Rational& a, const Polynomial& b);
Polynomial power(const Polynomial& base, int exponent);  ///< exponent ≥ 0

Monomial operator*(const Monomial& a, const Monomial& b);
Monomial power(const Monomial& base, const Rational& exponent);

/// The largest monomial that divides all terms (with the lowest exponents, which may be negative).
Monomial common_monomial(const Polynomial& polynomial);
/// The monomial that every term contains: a/r² + b/r³ = r⁻²·(a + b/r), while the terms of a + b/r share nothing.
Monomial shared_monomial(const Polynomial& polynomial);
/// The positive rational c for which the coefficients of polynomial/c are coprime integers; 1 for zero.
Rational content(const Polynomial& polynomial);
Rational common_divisor(const Rational& a, const Rational& b);
/// The quotient by c·monomial.
Polynomial divide(const Polynomial& polynomial, const Monomial& monomial, const Rational& c = 1);

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

bool is_integer(const Rational& value);
/// Throws std::overflow_error if the value is no small integer.
int to_int(const Rational& value);

GiNaC::ex expression(const Rational& value);
GiNaC::ex expression(const Polynomial& polynomial);

}  // namespace alembert
