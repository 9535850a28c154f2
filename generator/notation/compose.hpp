// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// Polynomials as phrases: factored, with factors and terms in the order in which books write them.
///
///     number · (sums of parameters) · parameters · (sums with the state) · coordinates · inputs · rates ·
///     functions (m1+m2)·l1·θ1″,   m·(l+x)·x′·θ′,   m2·g·l·sin φ
///
/// Among parameters masses and moments of inertia come first, then g, then the others as declared.

#include <map>

#include "notation/factor.hpp"
#include "notation/phrase.hpp"

namespace alembert {

class Composer {
public:
    /// With `decimals` all fractions that end as decimals are written so: 0.4·x + 9.81, not 2/5·x + 9.81.
    explicit Composer(bool decimals = false) : decimals_(decimals) {}

    /// Sines and cosines are variables like others here. Sums are grouped where that is shorter.
    const Phrase& operator()(const Polynomial& polynomial);
    /// cost((*this)(polynomial)), or a guess by the number of symbols once nothing shorter is searched for.
    int cost(const Polynomial& polynomial);
    /// The same for a normal form, with multiple angles undone where that is shorter.
    Phrase formula(const Polynomial& normal_form);

    /// So much has been composed that no more shorter forms are searched for: what comes now stays as it is.
    bool is_exhausted() const;

    Factorizer& factorizer() { return factorizer_; }

private:
    /// The best form of a normal form, with multiple angles undone where that is shorter.
    const Polynomial& unfolded(const Polynomial& normal_form);
    Phrase compose(const Polynomial& polynomial);
    Phrase compose_sum(const Polynomial& polynomial);
    Phrase flat(const std::vector<Polynomial>& parts);

    /// 0.5·x + 9.81 is not (50·x + 981)/100, nor m + J/r² = (J + m·r²)/r².
    bool stays_apart(const Polynomial& polynomial) const;

    bool decimals_;
    std::size_t effort_ = 0;  ///< terms of all polynomials that have been composed
    Factorizer factorizer_;
    struct Entry {
        Phrase phrase;
        int cost;
    };
    const Entry& entry(const Polynomial& polynomial);
    std::map<Polynomial, Entry, PolynomialLess> memo_;
    std::map<Polynomial, Polynomial, PolynomialLess> unfolded_;
};

/// Some terms, but not all alike, are divided by something: m + J/r².
bool has_own_denominators(const Polynomial& polynomial);

/// Not made of parameters and numbers alone.
bool has_state(const Monomial& monomial);

}  // namespace alembert
