// SPDX-License-Identifier: MIT
#pragma once

/// The numbers of the Radau IIA method with s stages: nodes, the inverse of A, its eigenvectors, and the weights
/// of the error estimate.
///
///     const RadauTable& table = radau_table(5);      // order 9
///     table.c[4] == 1;
///
/// Nothing is copied from a table: the nodes are the zeros of P_s − P_{s−1} (Legendre polynomials, on [0, 1]),
/// found by Newton's method with the known zeros divided out; A integrates the polynomials through the nodes, Σ_j
/// a_ij c_j^k = c_i^{k+1}/(k+1). All numbers are computed in long double, once in each process, and then rounded.
///
/// A⁻¹ has one real eigenvalue for odd s, λ, and pairs of complex ones, μ_k: with W = V⁻¹Z the implicit equations
/// of a step decouple. The eigenvalues are the zeros of the denominator of the Padé approximation of e^z of
/// degrees s − 1 over s. A v = v/μ says that the integral u of the polynomial v has u' − μu = 0 at the nodes, so
/// u' − μu = const · M with M = Π (τ − c_i), u = −const · Σ_j M^(j)/μ^(j+1), and v at the nodes is Σ_j
/// M^(j)(c_i)/μ^j up to a factor. Eigenvectors are scaled to 1 in the last stage. γ₀ = 1/λ; Σ e_i Z_i + γ₀ h f(t,
/// y) is the difference from the quadrature formula with the additional node 0 of weight γ₀ that integrates
/// polynomials of degree s − 1.
///
/// Source: Hairer & Wanner, Solving Ordinary Differential Equations II, 2nd ed. 1996, §IV.5 and §IV.8; Stiff
/// differential equations solved by Radau methods, J. Comput. Appl. Math. 111 (1999) 93-111.

#include <Eigen/Core>
#include <complex>
#include <vector>

namespace alembert {

struct RadauTable {
    int stages = 0;
    Eigen::VectorXd c, e;
    Eigen::MatrixXd inverse;        ///< A⁻¹
    Eigen::MatrixXd to_polynomial;  ///< gives p₀, p₁ … of Z = θ(p₀ + p₁θ + …) from the Z_i
    double lambda = 0;
    std::vector<std::complex<double>> mu;  ///< one eigenvalue of each complex pair
    /// V⁻¹: its row of λ, then those of each μ_k, real and imaginary part, those of the conjugates being known
    /// from them.
    Eigen::MatrixXd decoupling;
    /// V: the eigenvector of λ, then for each μ_k twice the real part of its eigenvector and minus twice the
    /// imaginary part, so that Z = coupling · W with real and imaginary parts of W one after the other.
    Eigen::MatrixXd coupling;
};

/// The table for 3, 5 or 7 stages.
const RadauTable& radau_table(int stages);

}  // namespace alembert
