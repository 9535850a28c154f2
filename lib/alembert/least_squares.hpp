// SPDX-License-Identifier: MIT
#pragma once

/// Solutions of small dense systems, compiled once: Eigen's decompositions are dear in every file that instantiates them.
///
///     const Eigen::VectorXd x = least_norm(A, b).x;           // the shortest of those nearest to A x = b
///     const Eigen::MatrixXd y = solve_symmetric(M, b);        // M y = b
///
/// Columns of b are right-hand sides. Nothing is thrown; where A or b is not finite, neither is the answer.

#include <Eigen/Core>

namespace alembert {

struct LeastNorm {
    Eigen::MatrixXd x;
    Eigen::Index rank = 0;
};
/// By the complete orthogonal decomposition, with Eigen's threshold for the rank. A: m×n, b: m×k, x: n×k.
LeastNorm least_norm(const Eigen::MatrixXd& A, const Eigen::MatrixXd& b);

/// By LDLᵀ with pivots. M: n×n, symmetric and semidefinite; b: n×k.
Eigen::MatrixXd solve_symmetric(const Eigen::MatrixXd& M, const Eigen::MatrixXd& b);

}  // namespace alembert
