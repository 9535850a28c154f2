// SPDX-License-Identifier: GPL-2.0-or-later
#include "linear/dense_long.hpp"

#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <Eigen/SVD>

namespace alembert {

namespace {

std::vector<std::complex<long double>> values_of(const Eigen::EigenSolver<LongMatrix>& solver) {
    const auto& values = solver.eigenvalues();
    return {values.data(), values.data() + values.size()};
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
    const Eigen::JacobiSVD<LongMatrix> svd(A, Eigen::ComputeFullU | Eigen::ComputeFullV);
    return {svd.singularValues(), svd.matrixU(), svd.matrixV()};
}

LongRightVectors right_vectors(const LongComplexMatrix& A) {
    const Eigen::JacobiSVD<LongComplexMatrix> svd(A, Eigen::ComputeFullV);
    return {svd.singularValues(), svd.matrixV()};
}

LongLeastNorm least_norm(const LongMatrix& A, const LongColumn& b, long double threshold) {
    Eigen::JacobiSVD<LongMatrix> svd(A, Eigen::ComputeThinU | Eigen::ComputeThinV);
    svd.setThreshold(threshold);
    return {svd.solve(b), svd.rank()};
}

Eigen::MatrixXd solve(const Eigen::MatrixXd& A, const Eigen::MatrixXd& b) {
    return A.partialPivLu().solve(b);
}

LongMatrix solve(const LongMatrix& A, const LongMatrix& b) {
    return A.partialPivLu().solve(b);
}

LongComplexMatrix solve(const LongComplexMatrix& A, const LongComplexMatrix& b) {
    return A.partialPivLu().solve(b);
}

long double determinant(const LongMatrix& A) {
    return A.determinant();
}

LongMatrix kernel_of(const LongMatrix& A, std::optional<long double> threshold) {
    Eigen::FullPivLU<LongMatrix> lu(A);
    if (threshold) lu.setThreshold(*threshold);
    if (lu.dimensionOfKernel() == 0) return LongMatrix(A.cols(), 0);
    return lu.kernel();
}

}  // namespace alembert
