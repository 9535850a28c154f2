// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// Power series of several variables about a point, up to a degree. `interpret` over them expands every value of a
/// Program, exactly if the numbers are exact (real_ball.hpp).
///
///     const Monomials monomials(2, 4);                                   // x, y up to degree 4
///     State<Expansion> state = …;
///     state.q[0] = Expansion::variable(monomials, 0, theta0);            // θ₀ + x
///     interpret(program, state)[node].coefficient({1, 1})                // of x·y
///
/// Functions are composed with their own series at the value of the argument (Griewank & Walther, Evaluating
/// Derivatives (2008), chapter 13). Throws NotAnalytic if a function has no such series at the point (abs at 0) or
/// if this is not known.

#include <map>
#include <stdexcept>
#include <vector>

#include "program/interpret.hpp"
#include "stability/interval/real_ball.hpp"

namespace alembert {

struct NotAnalytic : std::runtime_error {
    using std::runtime_error::runtime_error;
};

/// All monomials up to a degree, the lower degrees first: 1, x, y, x², xy, y² …
class Monomials {
public:
    using Exponents = std::vector<int>;
    Monomials(int variables, int degree);
    int variables() const { return variables_; }
    int degree() const { return degree_; }
    int size() const { return static_cast<int>(exponents_.size()); }
    const Exponents& exponents(int k) const { return exponents_[k]; }
    int degree_of(int k) const { return total_[k]; }
    int index(const Exponents& exponents) const { return position_.at(exponents); }
    /// The product of two monomials; −1 if it exceeds the degree.
    int product(int i, int j) const { return total_[i] + total_[j] > degree_ ? -1 : product_[i][j]; }

private:
    int variables_, degree_;
    std::vector<Exponents> exponents_;
    std::vector<int> total_;
    std::map<Exponents, int> position_;
    std::vector<std::vector<int>> product_;
};

class Expansion {
public:
    static Expansion of_double(double x) { return Expansion(RealBall(cln::rational(cln::cl_DF(x)))); }
    Expansion() : c_{RealBall(0)} {}
    Expansion(int n) : c_{RealBall(n)} {}           // NOLINT: a number is a number
    Expansion(bool b) : c_{RealBall(b ? 1 : 0)} {}  // NOLINT
    explicit Expansion(RealBall value) : c_{std::move(value)} {}
    /// value + the variable. `monomials` must outlive it.
    static Expansion variable(const Monomials& monomials, int variable, const RealBall& value);

    const RealBall& value() const { return c_[0]; }
    RealBall coefficient(const Monomials::Exponents& exponents) const;
    RealBall coefficient(int k) const { return k < static_cast<int>(c_.size()) ? c_[k] : RealBall(0); }
    /// Other operations, such as scaling an argument, are composed of these.
    Expansion& operator+=(const Expansion& b);
    Expansion& operator*=(const Expansion& b) { return *this = *this * b; }
    friend Expansion operator+(Expansion a, const Expansion& b) { return a += b; }
    friend Expansion operator-(const Expansion& a, const Expansion& b) { return a + Expansion(-1) * b; }
    friend Expansion operator*(const Expansion& a, const Expansion& b);
    friend Expansion operator/(const Expansion& a, const Expansion& b);
    friend bool operator<(const Expansion& a, const Expansion& b);
    friend bool operator>(const Expansion& a, const Expansion& b) { return b < a; }
    friend bool operator!=(const Expansion&, const Expansion&) { return false; }  ///< used only to test for NaN

    friend Expansion sin(const Expansion& a);
    friend Expansion cos(const Expansion& a);
    friend Expansion tan(const Expansion& a) { return sin(a) / cos(a); }
    friend Expansion asin(const Expansion& a);
    friend Expansion acos(const Expansion& a);
    friend Expansion atan(const Expansion& a);
    friend Expansion sinh(const Expansion& a) { return (exp(a) - exp(Expansion(-1) * a)) * half(); }
    friend Expansion cosh(const Expansion& a) { return (exp(a) + exp(Expansion(-1) * a)) * half(); }
    friend Expansion tanh(const Expansion& a) { return sinh(a) / cosh(a); }
    friend Expansion exp(const Expansion& a);
    friend Expansion log(const Expansion& a);
    friend Expansion sqrt(const Expansion& a) { return pow(a, half()); }
    friend Expansion abs(const Expansion& a);
    friend Expansion pow(const Expansion& a, const Expansion& b);
    friend Expansion atan2(const Expansion& y, const Expansion& x);
    /// ∂a/∂variable; the terms of highest degree of `a` give those of the degree below, and none of the highest.
    friend Expansion derivative(const Expansion& a, int variable);
    friend Expansion without_constant(Expansion a) {
        a.c_[0] = 0;
        return a;
    }
    /// a, a polynomial of the deviations, where these are `at`.
    friend Expansion put_into(const Expansion& a, const std::vector<Expansion>& at);

private:
    static Expansion half() { return Expansion(RealBall(Rational(1) / 2)); }
    int degree() const { return monomials_ ? monomials_->degree() : 0; }
    /// Σ series[k]·(a − a₀)^k
    static Expansion composed(const Expansion& a, const std::vector<RealBall>& series);

    const Monomials* monomials_ = nullptr;
    std::vector<RealBall> c_;  ///< by monomial; a single one for a constant
};

/// A table is made of pieces, and it is not certain that a neighbourhood lies in one of them.
inline double place_of(const Expansion&) {
    throw NotAnalytic(say("a table is made of pieces"));
}

template <>
inline Expansion real_of<Expansion>(const Rational& r) {
    return Expansion(RealBall(r));
}

}  // namespace alembert
