// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// Decompositions of small dense matrices, most of long double, compiled once, because each file that instantiates
/// Eigen's takes long to compile; the others of double are in alembert/base/dense.hpp.
///
///     const auto roots = eigenvalues(A);                          // none if the iteration does not converge
///     const LongColumn x = least_norm(J, r, 1e-11L).x;            // the shortest of those nearest to J x = r
///     const LongColumn free = singular_values(F).right.col(n - 1);
///
/// Columns of b are right-hand sides. The functions throw nothing; if a matrix is not finite, neither is the
/// result.

#include <Eigen/Core>
#include <complex>
#include <optional>
#include <vector>

namespace alembert {

using LongMatrix = Eigen::Matrix<long double, Eigen::Dynamic, Eigen::Dynamic>;
using LongColumn = Eigen::Matrix<long double, Eigen::Dynamic, 1>;
using LongComplexMatrix = Eigen::Matrix<std::complex<long double>, Eigen::Dynamic, Eigen::Dynamic>;

/// A: n×n.
std::optional<std::vector<std::complex<long double>>> eigenvalues(const LongMatrix& A);

struct LongEigenpairs {
    std::vector<std::complex<long double>> values;
    LongComplexMatrix vectors;  ///< columns, in the order of the values
};
/// A: n×n, with n different eigenvectors.
std::optional<LongEigenpairs> eigenpairs_of(const LongMatrix& A);

/// M: n×n, symmetric, n > 0.
long double least_eigenvalue(const LongMatrix& M);

struct LongSingularValues {
    LongColumn values;       ///< descending, min(m, n)
    LongMatrix left, right;  ///< m×m and n×n, columns of length 1
};
LongSingularValues singular_values(const LongMatrix& A);

struct LongRightVectors {
    LongColumn values;        ///< descending
    LongComplexMatrix right;  ///< n×n, columns of length 1
};
/// The singular values of a complex matrix and the vectors on its right. The last of them spans its kernel if A is
/// singular. A: n×n.
LongRightVectors right_vectors(const LongComplexMatrix& A);

struct LongLeastNorm {
    LongColumn x;
    Eigen::Index rank = 0;
};
/// The shortest of the vectors that are nearest to a solution. Singular values below `threshold` times the largest
/// count as zero. A: m×n, b: m.
LongLeastNorm least_norm(const LongMatrix& A, const LongColumn& b, long double threshold);

/// A x = b by elimination with row pivots. A: n×n, regular; b: n×k.
Eigen::MatrixXd solve(const Eigen::MatrixXd& A, const Eigen::MatrixXd& b);
LongMatrix solve(const LongMatrix& A, const LongMatrix& b);
LongComplexMatrix solve(const LongComplexMatrix& A, const LongComplexMatrix& b);

/// A: n×n.
long double determinant(const LongMatrix& A);

/// Directions x with A x = 0 as columns, by elimination with complete pivots. Pivots below `threshold` times the
/// largest count as zero; without it they do below n times the precision.
LongMatrix kernel_of(const LongMatrix& A, std::optional<long double> threshold = {});

}  // namespace alembert
