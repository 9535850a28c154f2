// SPDX-License-Identifier: MIT
#pragma once

/// The linear systems (σ − J) x = b with real and complex shifts σ that implicit Runge-Kutta methods solve at each
/// step.
///
///     ShiftedLinearSolver<std::complex<double>> shifted(size);
///     shifted.factor(J, second_order(J), mu / h);
///     shifted.solve(b, x);                        // lists of `size` numbers
///
/// Equations of motion are of second order, y = (q, u) or (q, u, W) with q' = u and nothing depends on W. Then q
/// and W are eliminated, and Gaussian elimination with row pivots is done on a system of half the size:
///
///     (σ − J_u − J_q/σ) u = b_u + J_q b_q/σ,    q = (b_q + u)/σ,    W = (b_W + J_Wq q + J_Wu u)/σ.
///
/// J must live as long as systems with it are solved. Nothing is thrown; a singular system gives values that are
/// not finite.

#include <Eigen/Core>
#include <cmath>
#include <complex>
#include <type_traits>
#include <utility>
#include <vector>

namespace alembert {

/// The number of coordinates if J has exactly the form of a system of second order; otherwise 0.
inline int second_order(const Eigen::MatrixXd& J) {
    const Eigen::Index n = J.rows() / 2;
    for (Eigen::Index j = 0; j < J.cols(); ++j) {
        for (Eigen::Index i = 0; i < n; ++i)
            if (J(i, j) != (j == n + i ? 1 : 0)) return 0;
        if (j >= 2 * n && J.col(j).cwiseAbs().maxCoeff() != 0) return 0;
    }
    return static_cast<int>(n);
}

template <class Scalar>
class ShiftedLinearSolver {
public:
    explicit ShiftedLinearSolver(int size)
        : size_(size),
          entries_(static_cast<std::size_t>(size) * static_cast<std::size_t>(size)),
          reciprocal_(size),
          order_(size),
          side_(size) {}

    /// `pairs`: second_order(J), or 0.
    void factor(const Eigen::MatrixXd& J, int pairs, Scalar sigma) {
        J_ = &J;
        n_ = pairs;
        over_ = inverse(sigma);
        m_ = pairs > 0 ? pairs : size_;
        with_size([&](auto m) { factor_of(m, sigma); });
    }

    /// x must not be b itself.
    void solve(const Scalar* b, Scalar* x) {
        with_size([&](auto m) { solve_of(m, b, x + n_); });
        for (int i = 0; i < n_; ++i) x[i] = product(b[i] + x[n_ + i], over_);
        for (int i = 2 * n_; n_ > 0 && i < size_; ++i) {
            Scalar sum = b[i];
            for (int j = 0; j < 2 * n_; ++j) sum += (*J_)(i, j) * x[j];
            x[i] = product(sum, over_);
        }
    }

private:
    /// Calls `function` with the size of the eliminated system; up to four it is a constant, so that loops are
    /// unrolled.
    template <class Function>
    void with_size(Function function) {
        switch (m_) {
            case 1:
                return function(std::integral_constant<int, 1>());
            case 2:
                return function(std::integral_constant<int, 2>());
            case 3:
                return function(std::integral_constant<int, 3>());
            case 4:
                return function(std::integral_constant<int, 4>());
            default:
                return function(m_);
        }
    }

    void factor_of(auto m, Scalar sigma) {
        const auto at = [&](int i, int j) -> Scalar& { return entries_[static_cast<std::size_t>(i * m + j)]; };
        for (int i = 0; i < m; ++i) {
            for (int j = 0; j < m; ++j)
                at(i, j) = Scalar(-(*J_)(n_ + i, n_ + j)) - (n_ > 0 ? (*J_)(n_ + i, j) * over_ : Scalar(0));
            at(i, i) += sigma;
            order_[i] = i;
        }
        for (int k = 0; k < m; ++k) {
            int pivot = k;
            for (int i = k + 1; i < m; ++i)
                if (size_of(at(i, k)) > size_of(at(pivot, k))) pivot = i;
            if (pivot != k) {
                for (int j = 0; j < m; ++j) std::swap(at(k, j), at(pivot, j));
                std::swap(order_[k], order_[pivot]);
            }
            reciprocal_[k] = inverse(at(k, k));
            for (int i = k + 1; i < m; ++i) {
                const Scalar factor = product(at(i, k), reciprocal_[k]);
                at(i, k) = factor;
                for (int j = k + 1; j < m; ++j) at(i, j) -= product(factor, at(k, j));
            }
        }
    }

    void solve_of(auto m, const Scalar* b, Scalar* u) {
        const auto at = [&](int i, int j) { return entries_[static_cast<std::size_t>(i * m + j)]; };
        for (int i = 0; i < m; ++i) side_[i] = b[n_ + i];
        for (int j = 0; j < n_; ++j) {
            const Scalar q = product(b[j], over_);
            for (int i = 0; i < m; ++i) side_[i] += (*J_)(n_ + i, j) * q;
        }
        for (int i = 0; i < m; ++i) {
            Scalar sum = side_[order_[i]];
            for (int j = 0; j < i; ++j) sum -= product(at(i, j), u[j]);
            u[i] = sum;
        }
        for (int i = m; i-- > 0;) {
            Scalar sum = u[i];
            for (int j = i + 1; j < m; ++j) sum -= product(at(i, j), u[j]);
            u[i] = product(sum, reciprocal_[i]);
        }
    }

    static double size_of(double a) { return std::abs(a); }
    static double size_of(const std::complex<double>& a) { return std::abs(a.real()) + std::abs(a.imag()); }
    static double product(double a, double b) { return a * b; }
    static double inverse(double a) { return 1 / a; }
    static std::complex<double> inverse(const std::complex<double>& a) {
        const double square = a.real() * a.real() + a.imag() * a.imag();
        return {a.real() / square, -a.imag() / square};
    }
    /// The product without the special treatment of infinite factors in operator*.
    static std::complex<double> product(const std::complex<double>& a, const std::complex<double>& b) {
        return {a.real() * b.real() - a.imag() * b.imag(), a.real() * b.imag() + a.imag() * b.real()};
    }

    int size_, n_ = 0, m_ = 0;
    const Eigen::MatrixXd* J_ = nullptr;
    Scalar over_{};
    std::vector<Scalar> entries_;  ///< m × m, by rows: L below, U above
    std::vector<Scalar> reciprocal_;
    std::vector<int> order_;
    std::vector<Scalar> side_;
};

}  // namespace alembert
