// SPDX-License-Identifier: MIT
#include "solved.hpp"

#include <Eigen/LU>

namespace alembert::test {

std::optional<Eigen::MatrixXd> solved(const Eigen::MatrixXd& A, const Eigen::MatrixXd& B) {
    const Eigen::FullPivLU<Eigen::MatrixXd> factors(A);
    if (!factors.isInvertible()) return std::nullopt;
    return factors.solve(B);
}

Eigen::MatrixXd inverse_of(const Eigen::MatrixXd& A) {
    return solved(A, Eigen::MatrixXd::Identity(A.rows(), A.cols())).value();
}

}  // namespace alembert::test
