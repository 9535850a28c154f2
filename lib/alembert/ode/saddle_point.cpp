// SPDX-License-Identifier: MIT
#include "alembert/ode/saddle_point.hpp"

#include <cmath>

#include "alembert/base/dense.hpp"

namespace alembert {

SaddlePoint::SaddlePoint(int speeds, int constraints)
    : lengths_(Eigen::VectorXd::Zero(constraints)), widths_(Eigen::VectorXd::Zero(speeds)) {}

void SaddlePoint::measure(const Eigen::MatrixXd& M, const Eigen::MatrixXd& A) {
    for (Eigen::Index k = 0; k < A.rows(); ++k) {
        double heavy = 0, all = 0;
        for (Eigen::Index i = 0; i < A.cols(); ++i) {
            if (M(i, i) > 0) heavy += A(k, i) * A(k, i) / M(i, i);
            all = std::max(all, std::abs(A(k, i)));
        }
        lengths_[k] = std::max(lengths_[k], heavy > 0 ? std::sqrt(heavy) : all);
    }
    for (Eigen::Index i = 0; i < A.cols(); ++i) {
        if (M(i, i) > 0) continue;
        for (Eigen::Index k = 0; k < A.rows(); ++k)
            if (lengths_[k] > 0) widths_[i] = std::max(widths_[i], std::abs(A(k, i)) / lengths_[k]);
    }
}

void SaddlePoint::forget() {
    lengths_.setZero();
    widths_.setZero();
}

Eigen::VectorXd SaddlePoint::solve(const Eigen::MatrixXd& M, const Eigen::MatrixXd& A,
                                   const Eigen::VectorXd& force, const Eigen::VectorXd& r) const {
    constexpr double tau = 2e-5, square = tau * tau;
    const Eigen::Index s = M.rows(), m = A.rows(), all = s + m;
    Eigen::VectorXd scale(all), right(all);
    for (Eigen::Index i = 0; i < s; ++i)
        scale[i] = M(i, i) > 0 ? 1 / std::sqrt(M(i, i)) : widths_[i] > 0 ? 1 / widths_[i] : 1;
    for (Eigen::Index k = 0; k < m; ++k) scale[s + k] = lengths_[k] > 0 ? 1 / lengths_[k] : 1;
    Eigen::MatrixXd K = Eigen::MatrixXd::Zero(all, all);
    K.topLeftCorner(s, s) = M;
    K.bottomLeftCorner(m, s) = A;
    K.topRightCorner(s, m) = A.transpose();
    K = scale.asDiagonal() * K * scale.asDiagonal();
    right << force, r;
    right = scale.cwiseProduct(right);
    if (!K.allFinite() || !right.allFinite()) return Eigen::VectorXd::Constant(s, HUGE_VAL);
    const Eigenpairs found = eigenpairs(K);
    Eigen::VectorXd along = found.vectors.transpose() * right;
    for (Eigen::Index i = 0; i < all; ++i) {
        const double value = found.values[i], below = value * value + square;
        along[i] *= value / below * (1 + square / below);  // the correction leaves τ⁴ in directions held well
    }
    return scale.head(s).cwiseProduct((found.vectors * along).head(s));
}

}  // namespace alembert
