// SPDX-License-Identifier: MIT
#include "alembert/least_squares.hpp"

#include <Eigen/Cholesky>
#include <Eigen/QR>

namespace alembert {

LeastNorm least_norm(const Eigen::MatrixXd& A, const Eigen::MatrixXd& b) {
    const Eigen::CompleteOrthogonalDecomposition<Eigen::MatrixXd> solver(A);
    return {solver.solve(b), solver.rank()};
}

Eigen::MatrixXd solve_symmetric(const Eigen::MatrixXd& M, const Eigen::MatrixXd& b) {
    return M.ldlt().solve(b);
}

}  // namespace alembert
