// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// The values of a function on a short path that starts at a point. `interpret` over germs gives one-sided
/// derivatives.
///
///     State<Germ> state = …;
///     state.q[0] = Germ::path(0, 1e-13L, {1, 0});     // x = 0 + 1·ε, ε → 0 from above; 0 is known to 1e-13
///     interpret(program, state)[node]                 // |x| is 1·ε;  sqrt(x) is 1·ε^(1/2);  x/|x| is 1
///
/// A germ is a series Σ c_k ε^(e_k) with ascending real exponents, known up to a power of ε. The sign of a germ is
/// that of its first coefficient, so that abs, sign, min, max, roots and atan2 are decided by the side on which
/// the path lies, where a number would be just zero. Each coefficient has a bound on its error (running error
/// analysis: Higham, Accuracy and Stability of Numerical Algorithms (2002), §3.3) and counts as zero if it is
/// within that bound. `defined` is false if a value is not real or not finite on the path: sqrt of a negative
/// germ, division by zero.

#include <limits>
#include <vector>

#include "program/interpret.hpp"

namespace alembert {

class Germ {
public:
    using Real = long double;
    struct Term {
        double exponent;
        Real value, error;
    };
    static constexpr double exact = std::numeric_limits<double>::infinity();

    Germ() = default;
    Germ(int n) : Germ(static_cast<Real>(n)) {}    // NOLINT: a number is a number
    Germ(bool b) : Germ(b ? Real(1) : Real(0)) {}  // NOLINT
    explicit Germ(Real x, Real error = 0) : terms_{{0, x, error}} { tidy(); }

    /// x + steps[0] ε + steps[1] ε² …; x is known to `error`.
    static Germ path(Real x, Real error, const std::vector<Real>& steps);

    bool defined() const { return defined_; }
    /// The power of ε from which on nothing is known.
    double order() const { return order_; }
    const std::vector<Term>& terms() const { return terms_; }
    /// The coefficient of ε^exponent and its error; both are zero if there is no such term.
    Term at(double exponent) const;
    /// The first term that is not zero; null if there is none.
    const Term* leading() const;
    /// The sign on the path: −1, 0 or 1.
    int side() const;

    Germ& operator+=(const Germ& b);
    Germ& operator*=(const Germ& b);
    friend Germ operator+(Germ a, const Germ& b) { return a += b; }
    friend Germ operator*(Germ a, const Germ& b) { return a *= b; }
    friend Germ operator-(const Germ& a, const Germ& b);
    friend Germ operator/(const Germ& a, const Germ& b);
    friend bool operator<(const Germ& a, const Germ& b) { return (a - b).side() < 0; }
    friend bool operator>(const Germ& a, const Germ& b) { return b < a; }
    /// Like a NaN, an undefined germ differs from every germ, itself included.
    friend bool operator!=(const Germ& a, const Germ& b) {
        return !a.defined_ || !b.defined_ || (a - b).side() != 0;
    }

    friend Germ sin(const Germ& a);
    friend Germ cos(const Germ& a);
    friend Germ tan(const Germ& a);
    friend Germ asin(const Germ& a);
    friend Germ acos(const Germ& a);
    friend Germ atan(const Germ& a);
    friend Germ sinh(const Germ& a);
    friend Germ cosh(const Germ& a);
    friend Germ tanh(const Germ& a);
    friend Germ exp(const Germ& a);
    friend Germ log(const Germ& a);
    friend Germ sqrt(const Germ& a);
    friend Germ abs(const Germ& a);
    friend Germ pow(const Germ& a, const Germ& b);
    friend Germ atan2(const Germ& y, const Germ& x);

private:
    static Germ undefined();
    double valuation() const;
    bool is_number() const;
    void tidy();
    Germ shifted(double exponent) const;
    /// f(c + δ) from f's Taylor coefficients at c, if this germ is c + δ with constant coefficient c.
    Germ through(const std::vector<Real>& taylor) const;
    Germ to_the(Real exponent) const;

    bool defined_ = true;
    double order_ = exact;
    std::vector<Term> terms_;
};

template <>
inline Germ real_of<Germ>(const Rational& r) {
    return Germ(real_of<long double>(r));
}

}  // namespace alembert
