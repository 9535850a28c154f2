// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// Writes polynomials as phrases: factored, with factors and terms in the order in which books write them.
///
///     number · (sums of parameters) · parameters · (sums with the state) · coordinates · inputs · rates ·
///     functions (m1+m2)·l1·θ1″,   m·(l+x)·x′·θ′,   m2·g·l·sin φ
///
/// Among parameters masses and moments of inertia come first, then g, then the others as declared.

#include <map>

#include "algebra/notation/factor.hpp"
#include "algebra/notation/phrase.hpp"

namespace alembert {

struct FactorPiece;  // one factor and where it stands in a product

class Composer {
public:
    /// With `decimals`, all fractions that are finite decimals are written as decimals: 0.4·x + 9.81, not 2/5·x +
    /// 9.81.
    /// Shorter forms are searched for until the polynomials composed have `most_effort` terms together.
    explicit Composer(bool decimals = false, std::size_t most_effort = usual_effort)
        : decimals_(decimals), most_effort_(most_effort) {}

    /// This takes a few tenths of a second. A free rigid body takes 2900.
    static constexpr std::size_t usual_effort = 6000;

    /// Sines and cosines count as variables here. Sums are grouped where that is shorter.
    const Phrase& operator()(const Polynomial& polynomial);
    /// cost((*this)(polynomial)), or an estimate from the number of symbols once the search for shorter forms has
    /// ended.
    int cost(const Polynomial& polynomial);
    /// The same for a normal form; multiple angles are written as products where that is shorter.
    Phrase formula(const Polynomial& normal_form);

    /// Begins another formula, with effort of its own. What is composed is kept, unless the effort was used up.
    void begin();

    /// Whether so much has been composed that shorter forms are no longer searched for and further polynomials
    /// stay as they are.
    bool is_exhausted() const;

    Factorizer& factorizer() { return factorizer_; }

private:
    /// The best form of a normal form; multiple angles are written as products where that is shorter.
    const Polynomial& unfolded(const Polynomial& normal_form);
    Phrase compose(const Polynomial& polynomial);
    /// The pieces of a monomial and of a sum to a power. What is no part of them goes into `unit`.
    std::vector<FactorPiece> pieces_of(const Monomial& monomial, Rational& unit);
    FactorPiece piece_of(const Factor& factor, Rational& unit);
    FactorPiece sum_piece(Polynomial sum, int exponent, Rational& unit);
    /// The product of pieces and unit as a quotient.
    Phrase fraction(std::vector<FactorPiece> pieces, const Rational& unit) const;
    Phrase compose_sum(const Polynomial& polynomial);
    Phrase flat(const std::vector<Polynomial>& parts);

    /// Whether the polynomial is kept without a common denominator: 0.5·x + 9.81 is not written as (50·x +
    /// 981)/100, nor m + J/r² as (J + m·r²)/r².
    bool stays_apart(const Polynomial& polynomial) const;

    bool decimals_;
    std::size_t most_effort_;
    std::size_t effort_ = 0;  ///< number of terms of all polynomials composed so far
    Factorizer factorizer_;
    struct Entry {
        Phrase phrase;
        int cost;
    };
    const Entry& entry(const Polynomial& polynomial);
    std::map<Polynomial, Entry, PolynomialLess> memo_;
    std::map<Polynomial, Polynomial, PolynomialLess> unfolded_;
};

/// Whether some terms have denominators that not all terms share: m + J/r².
bool has_own_denominators(const Polynomial& polynomial);

/// Whether the monomial contains more than parameters and numbers.
bool has_state(const Monomial& monomial);

}  // namespace alembert
