// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// The Fourier normal form of an expression: products of sines and cosines become sums of multiple angles.
///
///     m·l²·cos²θ  ↦  ½·l²·m + ½·l²·m·cos(2θ)
///
/// Every trigonometric polynomial has exactly one such form, so `is_zero` decides equality for these. Divisions
/// and roots are atoms with negative or fractional exponents; for these `is_zero` clears the denominators first,
/// which decides rational expressions too. Other functions (exp, log, atan2 …) are treated as independent, except
/// that odd functions and exp(a)·exp(b) are recognized.
///
///     const std::optional<Fourier> f = fourier(expression, symbols);
///     if (f && is_zero(*f - *g)) …            // proved equal
///
/// A product of k angles has 2ᵏ terms: `fourier` soon gives an empty result if any product on the way would have
/// more than `budget` terms. Throws std::out_of_range for symbols that were not declared and std::domain_error for
/// a division by zero.

#include <ginac/ginac.h>

#include <cstddef>
#include <optional>
#include <vector>

#include "algebra/symbolic/polynomial.hpp"

namespace alembert {

/// How many terms one product may have, and how many all products together; `spent` is true once a limit was
/// exceeded.
struct Budget {
    std::size_t terms = static_cast<std::size_t>(-1);
    std::size_t work = static_cast<std::size_t>(-1);
    bool spent = false;
};

/// A polynomial with at most one sine or cosine, with exponent one, in each term.
class Fourier {
public:
    Fourier() = default;                                           ///< zero
    Fourier(const Rational& constant) : polynomial_(constant) {}   // NOLINT: a number is a normal form
    explicit Fourier(Atom atom) : polynomial_(std::move(atom)) {}  ///< no sine or cosine
    /// From terms that already have at most one sine or cosine each.
    static Fourier collect(std::vector<Term> terms) { return Fourier(Polynomial::collect(std::move(terms))); }

    const Polynomial& polynomial() const { return polynomial_; }
    const std::vector<Term>& terms() const { return polynomial_.terms(); }
    std::size_t size() const { return polynomial_.size(); }

private:
    friend Fourier operator+(const Fourier& a, const Fourier& b);
    friend Fourier operator-(const Fourier& a, const Fourier& b);
    explicit Fourier(Polynomial polynomial) : polynomial_(std::move(polynomial)) {}
    Polynomial polynomial_;
};

std::optional<Fourier> fourier(const GiNaC::ex& expression, const Symbols& symbols, std::size_t budget = 20000);

Fourier operator+(const Fourier& a, const Fourier& b);
Fourier operator-(const Fourier& a, const Fourier& b);
Fourier operator*(const Rational& a, const Fourier& b);
Fourier operator*(const Fourier& a, const Fourier& b);
Fourier multiply(const Fourier& a, const Fourier& b, Budget& budget);

Fourier sine(const Fourier& arg);
Fourier cosine(const Fourier& arg);
Fourier power(const Fourier& base, const Rational& exponent, Budget& budget);

/// Exact for trigonometric polynomials and for quotients of them; for roots and other functions true is a proof
/// and false may be wrong.
bool is_zero(const Fourier& f);

/// The part of f that contains symbol^exponent, divided by that power (for example the coefficient of an
/// acceleration).
Fourier coefficient(const Fourier& f, const GiNaC::symbol& symbol, int exponent = 1);

/// The rational coefficient of π in an argument.
Rational coefficient_of_pi(const Polynomial& arg);

/// The sine or cosine of a term, or null.
const AtomNode* circular(const Monomial& monomial);

GiNaC::ex expression(const Fourier& f);

}  // namespace alembert
