// SPDX-License-Identifier: MIT
#pragma once

/// Solves K [x; −λ] = [force; r] with K = [M Aᵀ; A 0], the matrix of M x = force + Aᵀλ, A x = r, near a pose in
/// which A loses rank and M is singular, as with massless cranks.
///
///     SaddlePoint saddle(speeds, constraints);
///     saddle.measure(M, A);                                     // along the motion, away from the pose
///     const Eigen::VectorXd x = saddle.solve(M, A, force, r);   // near the pose
///
/// Where M is singular there is no M = LLᵀ to measure the rows of A with, and no inertia that carries massless
/// parts through the pose. K, with its rows and columns scaled to a size of 1, is inverted with λ/(λ² + τ²) for
/// 1/λ along each eigenvector, λ being its eigenvalue (Tikhonov): massless parts go on with their rates where
/// nothing determines their accelerations, and a projection brings them back to the constraints after the pose.
/// Each pass changes the motion by about τ² then, and by rounding divided by τ: with τ = 2e-5 three cranks with
/// one redundant constraint, which pass the pose seven times, end within 3e-8.

#include <Eigen/Dense>
#include <vector>

namespace alembert {

class SaddlePoint {
public:
    SaddlePoint(int speeds, int constraints);

    /// Scales the matrix by the largest lengths of the rows of A (in the metric of M, or by their largest entry if
    /// they hold massless speeds alone) and of its columns for massless speeds that have been measured so far. M:
    /// speeds × speeds; A: constraints × speeds.
    void measure(const Eigen::MatrixXd& M, const Eigen::MatrixXd& A);
    /// Forgets these lengths, before another run.
    void forget();

    /// x; not finite if K or the right side is not.
    Eigen::VectorXd solve(const Eigen::MatrixXd& M, const Eigen::MatrixXd& A, const Eigen::VectorXd& force,
                          const Eigen::VectorXd& r) const;

private:
    Eigen::VectorXd lengths_, widths_;  ///< of rows of A, and of its columns beside rows of length 1
};

}  // namespace alembert
