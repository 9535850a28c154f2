// SPDX-License-Identifier: GPL-2.0-or-later
#include "stability/linear/dense_long.hpp"

#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <Eigen/SVD>

namespace alembert {

namespace {

std::vector<std::complex<long double>> values_of(const Eigen::EigenSolver<LongMatrix>& solver) {
    const auto& values = solver.eigenvalues();
    return {values.data(), values.data() + values.size()};
}

/// Makes A an upper triangle by row operations, which b takes part in, with the largest pivot of each column. The
/// result is the sign of the exchanges. Eigen's elimination is made for large matrices and takes long to compile.
template <typename Matrix>
int eliminate(Matrix& A, Matrix& b) {
    int sign = 1;
    for (Eigen::Index k = 0; k < A.cols(); ++k) {
        Eigen::Index pivot = k;
        for (Eigen::Index i = k + 1; i < A.rows(); ++i)
            if (std::abs(A(i, k)) > std::abs(A(pivot, k))) pivot = i;
        if (pivot != k) {
            A.row(k).swap(A.row(pivot));
            b.row(k).swap(b.row(pivot));
            sign = -sign;
        }
        if (A(k, k) == typename Matrix::Scalar(0)) continue;  // nothing below it either
        for (Eigen::Index i = k + 1; i < A.rows(); ++i) A(i, k) /= A(k, k);
        for (Eigen::Index j = k + 1; j < A.cols(); ++j)
            for (Eigen::Index i = k + 1; i < A.rows(); ++i) A(i, j) -= A(i, k) * A(k, j);
        for (Eigen::Index j = 0; j < b.cols(); ++j)
            for (Eigen::Index i = k + 1; i < A.rows(); ++i) b(i, j) -= A(i, k) * b(k, j);
    }
    return sign;
}

template <typename Matrix>
Matrix by_elimination(Matrix A, Matrix b) {
    eliminate(A, b);
    for (Eigen::Index j = 0; j < b.cols(); ++j)
        for (Eigen::Index k = A.cols() - 1; k >= 0; --k) {
            b(k, j) /= A(k, k);
            for (Eigen::Index i = 0; i < k; ++i) b(i, j) -= A(i, k) * b(k, j);
        }
    return b;
}

/// The solution, where all singular values surely count: the least is at least 1/|A^-1| and the largest at most
/// |A|, in Frobenius's norm. One elimination with n + 1 right-hand sides takes the place of the singular values.
std::optional<LongColumn> surely_regular(const LongMatrix& A, const LongColumn& b, long double threshold) {
    const Eigen::Index n = A.rows();
    LongMatrix right(n, n + 1);
    right << b, LongMatrix::Identity(n, n);
    const LongMatrix solved = by_elimination(A, right);
    const long double inverse = solved.rightCols(n).norm();
    if (!(inverse * A.norm() * threshold < 1)) return {};
    return solved.col(0);
}

}  // namespace

std::optional<std::vector<std::complex<long double>>> eigenvalues(const LongMatrix& A) {
    const Eigen::EigenSolver<LongMatrix> solver(A, false);
    if (solver.info() != Eigen::Success) return {};
    return values_of(solver);
}

std::optional<LongEigenpairs> eigenpairs_of(const LongMatrix& A) {
    const Eigen::EigenSolver<LongMatrix> solver(A, true);
    if (solver.info() != Eigen::Success) return {};
    return LongEigenpairs{values_of(solver), solver.eigenvectors()};
}

long double least_eigenvalue(const LongMatrix& M) {
    return Eigen::SelfAdjointEigenSolver<LongMatrix>(M, Eigen::EigenvaluesOnly).eigenvalues().minCoeff();
}

LongSingularValues singular_values(const LongMatrix& A) {
    if (A.size() == 0)  // Eigen needs a row and a column
        return {{}, LongMatrix::Identity(A.rows(), A.rows()), LongMatrix::Identity(A.cols(), A.cols())};
    const Eigen::JacobiSVD<LongMatrix> svd(A, Eigen::ComputeFullU | Eigen::ComputeFullV);
    return {svd.singularValues(), svd.matrixU(), svd.matrixV()};
}

LongRightVectors right_vectors(const LongComplexMatrix& A) {
    const Eigen::JacobiSVD<LongComplexMatrix, Eigen::NoQRPreconditioner> svd(A, Eigen::ComputeFullV);
    return {svd.singularValues(), svd.matrixV()};
}

LongLeastNorm least_norm(const LongMatrix& A, const LongColumn& b, long double threshold) {
    constexpr Eigen::Index large = 8;
    if (A.rows() == A.cols() && A.rows() >= large)
        if (std::optional<LongColumn> x = surely_regular(A, b, threshold)) return {std::move(*x), A.rows()};
    Eigen::JacobiSVD<LongMatrix> svd(A, Eigen::ComputeThinU | Eigen::ComputeThinV);
    svd.setThreshold(threshold);
    return {svd.solve(b), svd.rank()};
}

Eigen::MatrixXd solve(const Eigen::MatrixXd& A, const Eigen::MatrixXd& b) {
    return by_elimination(A, b);
}

LongMatrix solve(const LongMatrix& A, const LongMatrix& b) {
    return by_elimination(A, b);
}

LongComplexMatrix solve(const LongComplexMatrix& A, const LongComplexMatrix& b) {
    return by_elimination(A, b);
}

long double determinant(const LongMatrix& A) {
    LongMatrix triangle = A, nothing(A.rows(), 0);
    const int sign = eliminate(triangle, nothing);
    return sign * triangle.diagonal().prod();
}

LongMatrix kernel_of(const LongMatrix& A, std::optional<long double> threshold) {
    Eigen::FullPivLU<LongMatrix> lu(A);
    if (threshold) lu.setThreshold(*threshold);
    if (lu.dimensionOfKernel() == 0) return LongMatrix(A.cols(), 0);
    return lu.kernel();
}

}  // namespace alembert
