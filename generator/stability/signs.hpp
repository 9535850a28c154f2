// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// The sign of a function near a point at which it is zero, from its Taylor series.
///
///     const SignNear sign = sign_near(V, monomials);       // of v²/2 + x⁴: positive, definite
///
/// The form of lowest degree decides if it is definite or takes both signs: a quadratic one by the pivots of
/// L D Lᵀ (Sylvester's criterion), one in two variables by its real roots, any other by a Gram matrix, whose
/// positive definiteness makes it a sum of squares. A semidefinite quadratic form is split off: with V_y = 0 on
/// y(z), V is Σ ± y² + W(z) in other coordinates, W(z) = V(z, y(z)) (the splitting lemma), and W decides.

#include "stability/interval/expansion.hpp"
#include "stability/interval/matrix.hpp"

namespace alembert {

/// What is proved about the sign.
struct SignNear {
    bool positive = false;  ///< it takes positive values arbitrarily near the point
    bool negative = false;  ///< it takes negative values arbitrarily near the point
    bool definite = false;  ///< it has one sign near the point and is zero at the point alone
    bool is(int sign) const { return definite && (sign > 0 ? positive : negative); }
};

/// The constant term of `f` is taken as zero. `monomials`: the monomials of `f`.
SignNear sign_near(const Expansion& f, const Monomials& monomials);

/// The sign of the form Σ c_k x^(d−k) y^k.
SignNear sign_of_binary_form(const RealBallVector& c);

/// The matrix of second derivatives.
RealBallMatrix hessian(const Expansion& f, const Monomials& monomials);

/// Numbers s such that Q0 + Σ s_k Q_k is positive definite in floating point; nothing if none are found.
std::optional<std::vector<double>> definite_combination(const RealBallMatrix& Q0,
                                                        const std::vector<RealBallMatrix>& more);

}  // namespace alembert
