// SPDX-License-Identifier: MIT
#pragma once

/// Decompositions of small dense matrices, compiled once: Eigen's are dear in every file that instantiates them.
///
///     const Eigen::VectorXd x = least_norm(A, b).x;           // the shortest of those nearest to A x = b
///     const Eigen::MatrixXd y = solve_symmetric(M, b);        // M y = b
///     const Cholesky factors(M);                              // M = L Lᵀ
///     if (factors.exists()) x = factors.solve_upper(factors.solve_lower(b));
///
/// Columns of b are right-hand sides. Nothing is thrown; where a matrix or b is not finite, neither is the answer.

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <Eigen/QR>

namespace alembert {

struct LeastNorm {
    Eigen::MatrixXd x;
    Eigen::Index rank = 0;
};
/// By the complete orthogonal decomposition, with Eigen's threshold for the rank. A: m×n, b: m×k, x: n×k.
LeastNorm least_norm(const Eigen::MatrixXd& A, const Eigen::MatrixXd& b);

/// By LDLᵀ with pivots. M: n×n, symmetric and semidefinite; b: n×k.
Eigen::MatrixXd solve_symmetric(const Eigen::MatrixXd& M, const Eigen::MatrixXd& b);

/// A's complete orthogonal decomposition, for several b. Pivots below `threshold` of the largest are zero.
class Orthogonal {
public:
    Orthogonal() = default;
    Orthogonal(const Eigen::MatrixXd& A, double threshold);
    Eigen::VectorXd solve(const Eigen::VectorXd& b) const;  ///< the shortest of those nearest to A x = b

private:
    Eigen::CompleteOrthogonalDecomposition<Eigen::MatrixXd> factors_;
};

/// M = L Lᵀ. M: n×n, symmetric.
class Cholesky {
public:
    explicit Cholesky(const Eigen::MatrixXd& M);
    bool exists() const;                                          ///< is M positive definite?
    Eigen::MatrixXd solve_lower(const Eigen::MatrixXd& b) const;  ///< L⁻¹ b
    Eigen::VectorXd solve_upper(const Eigen::VectorXd& b) const;  ///< L⁻ᵀ b
    Eigen::VectorXd upper(const Eigen::VectorXd& x) const;        ///< Lᵀ x

private:
    Eigen::LLT<Eigen::MatrixXd> factors_;
};

/// A by Gaussian elimination with row pivots. A: n×n.
class Elimination {
public:
    void factor(const Eigen::MatrixXd& A);
    void solve(const Eigen::VectorXd& b, Eigen::VectorXd& x) const;  ///< x is not b

private:
    Eigen::PartialPivLU<Eigen::MatrixXd> factors_;
};

struct Eigenpairs {
    Eigen::VectorXd values;   ///< ascending
    Eigen::MatrixXd vectors;  ///< columns of length 1
};
/// M: n×n, symmetric.
Eigenpairs eigenpairs(const Eigen::MatrixXd& M);

struct SingularValues {
    Eigen::VectorXd values;  ///< descending, min(m, n)
    Eigen::MatrixXd left;    ///< m×m, columns of length 1
};
SingularValues singular_values(const Eigen::MatrixXd& A);

}  // namespace alembert
