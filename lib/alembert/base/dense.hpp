// SPDX-License-Identifier: MIT
#pragma once

/// Decompositions of small dense matrices, compiled once, because each file that instantiates Eigen's takes long
/// to compile.
///
///     const Eigen::VectorXd x = least_norm(A, b).x;           // the shortest of those nearest to A x = b
///     const Eigen::MatrixXd y = solve_symmetric(M, b);        // M y = b
///     const Cholesky factors(M);                              // M = L Lᵀ
///     if (factors.exists()) x = factors.solve_upper(factors.solve_lower(b));
///
/// Columns of b are right-hand sides. The functions throw nothing; if a matrix or b is not finite, the result is
/// not finite either.

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <Eigen/QR>

namespace alembert {

struct LeastNorm {
    Eigen::MatrixXd x;
    Eigen::Index rank = 0;
};
/// The solution by the complete orthogonal decomposition, with Eigen's threshold for the rank. A: m×n, b: m×k, x:
/// n×k.
LeastNorm least_norm(const Eigen::MatrixXd& A, const Eigen::MatrixXd& b);

/// The solution by LDLᵀ with pivots. M: n×n, symmetric and semidefinite; b: n×k.
Eigen::MatrixXd solve_symmetric(const Eigen::MatrixXd& M, const Eigen::MatrixXd& b);

/// The complete orthogonal decomposition of A, for several b. Pivots smaller than `threshold` times the largest
/// count as zero.
class Orthogonal {
public:
    Orthogonal() = default;
    Orthogonal(const Eigen::MatrixXd& A, double threshold);
    Eigen::VectorXd solve(const Eigen::VectorXd& b) const;  ///< the shortest of those nearest to A x = b
    Eigen::Index rank() const;

private:
    Eigen::CompleteOrthogonalDecomposition<Eigen::MatrixXd> factors_;
    Eigen::Index columns_ = 0;
    bool is_empty_ = true;
};

/// The factorization M = L Lᵀ. M: n×n, symmetric.
class Cholesky {
public:
    explicit Cholesky(const Eigen::MatrixXd& M);
    /// Whether M is positive definite, with no pivot below 1e-12 of its diagonal entry.
    bool exists() const;
    Eigen::MatrixXd solve_lower(const Eigen::MatrixXd& b) const;  ///< L⁻¹ b
    Eigen::VectorXd solve_upper(const Eigen::VectorXd& b) const;  ///< L⁻ᵀ b
    Eigen::VectorXd upper(const Eigen::VectorXd& x) const;        ///< Lᵀ x

private:
    Eigen::LLT<Eigen::MatrixXd> factors_;
    Eigen::VectorXd diagonal_;
};

/// Gaussian elimination of A with row pivots. A: n×n.
class Elimination {
public:
    void factor(const Eigen::MatrixXd& A);
    void solve(const Eigen::VectorXd& b, Eigen::VectorXd& x) const;  ///< x must not be b itself

private:
    Eigen::PartialPivLU<Eigen::MatrixXd> factors_;
};

/// Factors cᵢ that give cᵢ Mᵢⱼ cⱼ a size near 1 in any units: 1/√Mᵢᵢ where Mᵢᵢ is positive, otherwise 1/√ of the
/// largest entry of the row, or 1 in an empty row. M: n×n, symmetric.
Eigen::VectorXd unit_scale(const Eigen::MatrixXd& M);

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
