// SPDX-License-Identifier: MIT
#include "alembert/base/dense.hpp"

#include <Eigen/Eigenvalues>
#include <Eigen/SVD>
#include <cmath>

namespace alembert {

using Eigen::MatrixXd;
using Eigen::VectorXd;

LeastNorm least_norm(const MatrixXd& A, const MatrixXd& b) {
    if (A.size() == 0) return {MatrixXd::Zero(A.cols(), b.cols()), 0};  // Eigen would read its entries
    const Eigen::CompleteOrthogonalDecomposition<MatrixXd> solver(A);
    return {solver.solve(b), solver.rank()};
}

MatrixXd solve_symmetric(const MatrixXd& M, const MatrixXd& b) {
    return M.ldlt().solve(b);
}

Orthogonal::Orthogonal(const MatrixXd& A, double threshold) {
    columns_ = A.cols();
    is_empty_ = A.size() == 0;  // Eigen would read its entries
    if (is_empty_) return;
    factors_.setThreshold(threshold);
    factors_.compute(A);
}

VectorXd Orthogonal::solve(const VectorXd& b) const {
    if (is_empty_) return VectorXd::Zero(columns_);
    return factors_.solve(b);
}

Eigen::Index Orthogonal::rank() const {
    return is_empty_ ? 0 : factors_.rank();
}

Cholesky::Cholesky(const MatrixXd& M) : factors_(M), diagonal_(M.diagonal()) {}

bool Cholesky::exists() const {
    constexpr double negligible = 1e-12;
    if (factors_.info() != Eigen::Success) return false;
    for (Eigen::Index i = 0; i < diagonal_.size(); ++i) {
        const double root = factors_.matrixLLT()(i, i);
        if (!(root * root > negligible * diagonal_[i])) return false;
    }
    return true;
}

MatrixXd Cholesky::solve_lower(const MatrixXd& b) const {
    if (b.size() == 0) return b;  // Eigen would solve with a null pointer
    return factors_.matrixL().solve(b);
}

VectorXd Cholesky::solve_upper(const VectorXd& b) const {
    return factors_.matrixU().solve(b);
}

VectorXd Cholesky::upper(const VectorXd& x) const {
    return factors_.matrixU() * x;
}

void Elimination::factor(const MatrixXd& A) {
    factors_.compute(A);
}

void Elimination::solve(const VectorXd& b, VectorXd& x) const {
    x = factors_.solve(b);
}

VectorXd unit_scale(const MatrixXd& M) {
    VectorXd scale(M.rows());
    for (Eigen::Index i = 0; i < M.rows(); ++i) {
        const double size = M(i, i) > 0 ? M(i, i) : M.row(i).cwiseAbs().maxCoeff();
        scale[i] = size > 0 ? 1 / std::sqrt(size) : 1;
    }
    return scale;
}

Eigenpairs eigenpairs(const MatrixXd& M) {
    const Eigen::SelfAdjointEigenSolver<MatrixXd> solver(M);
    return {solver.eigenvalues(), solver.eigenvectors()};
}

SingularValues singular_values(const MatrixXd& A) {
    const Eigen::JacobiSVD<MatrixXd> solver(A, Eigen::ComputeFullU);
    return {solver.singularValues(), solver.matrixU()};
}

}  // namespace alembert
