// SPDX-License-Identifier: MIT
#pragma once

/// Radau IIA of s stages as numbers: nodes, the inverse of A, its eigenvectors, and the weights of the error estimate.
///
///     const RadauTable& table = radau_table(5);      // order 9
///     table.c[4] == 1;
///
/// Nothing is copied from a table: the nodes are the zeros of P_s − P_{s−1} (Legendre polynomials, on [0, 1]), found by Newton's
/// method with the known zeros divided out; A integrates the polynomials through the nodes, Σ_j a_ij c_j^k = c_i^{k+1}/(k+1). All in
/// long double, once a process, and then rounded.
///
/// A⁻¹ has one real eigenvalue for odd s, λ, and pairs of complex ones, μ_k: with W = V⁻¹Z the implicit equations of a step fall apart.
/// Eigenvectors are scaled to 1 in the last stage. γ₀ = 1/λ; Σ e_i Z_i + γ₀ h f(t, y) is the difference to the quadrature formula
/// with the additional node 0 of weight γ₀ that integrates polynomials of degree s − 1.
///
/// Source: Hairer & Wanner, Solving Ordinary Differential Equations II, 2nd ed. 1996, §IV.5 and §IV.8; Stiff differential
/// equations solved by Radau methods, J. Comput. Appl. Math. 111 (1999) 93-111.

#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <vector>

namespace alembert {

struct RadauTable {
    int stages = 0;
    Eigen::VectorXd c, e;
    Eigen::MatrixXd inverse;                       ///< A⁻¹
    Eigen::MatrixXd to_polynomial;                 ///< of p₀ + p₁θ + … in Z = θ(p₀ + p₁θ + …), from the Z_i
    double lambda = 0;
    Eigen::VectorXd v_real, back_real;             ///< eigenvector, and row of V⁻¹, of λ
    std::vector<std::complex<double>> mu;          ///< one of each pair
    std::vector<Eigen::VectorXcd> v_complex, back_complex;
};

namespace radau {

using Real = long double;
using Matrix = Eigen::Matrix<Real, Eigen::Dynamic, Eigen::Dynamic>;
using Vector = Eigen::Matrix<Real, Eigen::Dynamic, 1>;

/// P_s − P_{s−1} and its derivative at x in [−1, 1].
inline std::pair<Real, Real> legendre_difference(int s, Real x) {
    Real before = 1, value = x, slope_before = 0, slope = 1;  // P₀ and P₁
    for (int k = 1; k < s; ++k) {
        const Real next = ((2 * k + 1) * x * value - k * before) / (k + 1);
        const Real slope_next = slope_before + (2 * k + 1) * value;
        before = std::exchange(value, next);
        slope_before = std::exchange(slope, slope_next);
    }
    return {value - before, slope - slope_before};
}

/// The nodes in ]0, 1], ascending.
inline Vector nodes(int s) {
    std::vector<Real> known{1};
    for (int k = 1; k < s; ++k) {
        Real x = -1 + Real(0.01);
        for (int round = 0; round < 200; ++round) {
            const auto [value, slope] = legendre_difference(s, x);
            Real poles = 0;
            for (const Real zero : known) poles += 1 / (x - zero);
            const Real step = value / (slope - value * poles);
            x -= step;
            if (std::abs(step) < 1e-19L) break;
        }
        known.push_back(x);
    }
    std::sort(known.begin(), known.end());
    Vector c(s);
    for (int i = 0; i < s; ++i) c[i] = (1 + known[static_cast<std::size_t>(i)]) / 2;
    return c;
}

inline RadauTable made(int s) {
    const Vector c = nodes(s);
    Matrix powers(s, s), integrals(s, s);
    Vector moments(s);
    for (int k = 0; k < s; ++k) {
        for (int i = 0; i < s; ++i) {
            powers(i, k) = std::pow(c[i], static_cast<Real>(k));
            integrals(i, k) = std::pow(c[i], static_cast<Real>(k + 1)) / (k + 1);
        }
        moments[k] = 1 / static_cast<Real>(k + 1);
    }
    const Matrix inverse = powers * integrals.inverse();
    const Eigen::EigenSolver<Matrix> eigen(inverse);
    using Complex = std::complex<Real>;
    Eigen::Matrix<Complex, Eigen::Dynamic, Eigen::Dynamic> V = eigen.eigenvectors();
    for (int k = 0; k < s; ++k) V.col(k) /= Complex(V(s - 1, k));
    const Eigen::Matrix<Complex, Eigen::Dynamic, Eigen::Dynamic> back = V.inverse();
    int real = 0;
    for (int k = 1; k < s; ++k)
        if (std::abs(eigen.eigenvalues()[k].imag()) < std::abs(eigen.eigenvalues()[real].imag())) real = k;

    RadauTable table;
    table.stages = s;
    table.c = c.cast<double>();
    table.c[s - 1] = 1;
    table.inverse = inverse.cast<double>();
    table.to_polynomial = (Matrix(c.asDiagonal()) * powers).inverse().cast<double>();
    table.lambda = static_cast<double>(eigen.eigenvalues()[real].real());
    table.v_real = V.col(real).real().cast<double>();
    table.back_real = back.row(real).transpose().real().cast<double>();
    for (int k = 0; k < s; ++k)
        if (k != real && eigen.eigenvalues()[k].imag() > 0) {
            table.mu.emplace_back(eigen.eigenvalues()[k]);
            table.v_complex.emplace_back(V.col(k).cast<std::complex<double>>());
            table.back_complex.emplace_back(back.row(k).transpose().cast<std::complex<double>>());
        }
    // Σ b̂_i c_i^k = 1/(k+1), less γ₀ for k = 0; h f_i = Σ (A⁻¹)_ij Z_j; and the end is Z_s.
    moments[0] -= 1 / eigen.eigenvalues()[real].real();
    Vector e = inverse.transpose() * powers.transpose().inverse() * moments;
    e[s - 1] -= 1;
    table.e = e.cast<double>();
    return table;
}

}  // namespace radau

/// Of 3, 5 or 7 stages.
inline const RadauTable& radau_table(int stages) {
    static const std::array<RadauTable, 3> tables = {radau::made(3), radau::made(5), radau::made(7)};
    return tables[static_cast<std::size_t>((stages - 3) / 2)];
}

}  // namespace alembert
