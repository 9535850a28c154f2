// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// The values of a function on a short path that starts at a point (its germ there), as a Puiseux series.
/// `interpret` over such series gives one-sided derivatives.
///
///     State<PuiseuxSeries> state = …;
///     state.q[0] = PuiseuxSeries::path(0, 1e-13L, {1, 0});  // x = 0 + 1·ε, ε → 0 from above; 0 is known to 1e-13
///     interpret(program, state)[node]                 // |x| is 1·ε;  sqrt(x) is 1·ε^(1/2);  x/|x| is 1
///
/// It is Σ c_k ε^(e_k) with ascending real exponents, known up to a power of ε. The sign of a series is that of
/// its first coefficient, so that abs, sign, min, max, roots and atan2 are decided by the side on which the path
/// lies, where a number would be just zero. Each coefficient has a bound on its error (running error analysis:
/// Higham, Accuracy and Stability of Numerical Algorithms (2002), §3.3) and counts as zero if it is within that
/// bound. `defined` is false if a value is not real or not finite on the path: sqrt of a negative series, division
/// by zero.

#include <limits>
#include <vector>

#include "program/interpret.hpp"

namespace alembert {

class PuiseuxSeries {
public:
    using Real = long double;
    struct Term {
        double exponent;
        Real value, error;
    };
    static constexpr double exact = std::numeric_limits<double>::infinity();

    PuiseuxSeries() = default;
    PuiseuxSeries(int n) : PuiseuxSeries(static_cast<Real>(n)) {}    // NOLINT: a number is a number
    PuiseuxSeries(bool b) : PuiseuxSeries(b ? Real(1) : Real(0)) {}  // NOLINT
    explicit PuiseuxSeries(Real x, Real error = 0) : terms_{{0, x, error}} { tidy(); }

    static PuiseuxSeries of_double(double x) { return PuiseuxSeries(static_cast<Real>(x)); }
    /// Of a path that starts at a knot of a table, on its side of it.
    friend double place_of(const PuiseuxSeries& a) { return a.place(); }

    /// x + steps[0] ε + steps[1] ε² …; x is known to `error`.
    static PuiseuxSeries path(Real x, Real error, const std::vector<Real>& steps);

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

    PuiseuxSeries& operator+=(const PuiseuxSeries& b);
    PuiseuxSeries& operator*=(const PuiseuxSeries& b);
    friend PuiseuxSeries operator+(PuiseuxSeries a, const PuiseuxSeries& b) { return a += b; }
    friend PuiseuxSeries operator*(PuiseuxSeries a, const PuiseuxSeries& b) { return a *= b; }
    friend PuiseuxSeries operator-(const PuiseuxSeries& a, const PuiseuxSeries& b);
    friend PuiseuxSeries operator/(const PuiseuxSeries& a, const PuiseuxSeries& b);
    friend bool operator<(const PuiseuxSeries& a, const PuiseuxSeries& b) { return (a - b).side() < 0; }
    friend bool operator>(const PuiseuxSeries& a, const PuiseuxSeries& b) { return b < a; }
    /// Like a NaN, an undefined series differs from every series, itself included.
    friend bool operator!=(const PuiseuxSeries& a, const PuiseuxSeries& b) {
        return !a.defined_ || !b.defined_ || (a - b).side() != 0;
    }

    friend PuiseuxSeries sin(const PuiseuxSeries& a);
    friend PuiseuxSeries cos(const PuiseuxSeries& a);
    friend PuiseuxSeries tan(const PuiseuxSeries& a);
    friend PuiseuxSeries asin(const PuiseuxSeries& a);
    friend PuiseuxSeries acos(const PuiseuxSeries& a);
    friend PuiseuxSeries atan(const PuiseuxSeries& a);
    friend PuiseuxSeries sinh(const PuiseuxSeries& a);
    friend PuiseuxSeries cosh(const PuiseuxSeries& a);
    friend PuiseuxSeries tanh(const PuiseuxSeries& a);
    friend PuiseuxSeries exp(const PuiseuxSeries& a);
    friend PuiseuxSeries log(const PuiseuxSeries& a);
    friend PuiseuxSeries sqrt(const PuiseuxSeries& a);
    friend PuiseuxSeries abs(const PuiseuxSeries& a);
    friend PuiseuxSeries pow(const PuiseuxSeries& a, const PuiseuxSeries& b);
    friend PuiseuxSeries atan2(const PuiseuxSeries& y, const PuiseuxSeries& x);

private:
    double place() const;
    static PuiseuxSeries undefined();
    double valuation() const;
    bool is_number() const;
    void tidy();
    PuiseuxSeries shifted(double exponent) const;
    /// f(c + δ) from f's Taylor coefficients at c, if this series is c + δ with constant coefficient c.
    PuiseuxSeries through(const std::vector<Real>& taylor) const;
    PuiseuxSeries to_the(Real exponent) const;

    bool defined_ = true;
    double order_ = exact;
    std::vector<Term> terms_;
};

template <>
inline PuiseuxSeries real_of<PuiseuxSeries>(const Rational& r) {
    return PuiseuxSeries(real_of<long double>(r));
}

}  // namespace alembert
