// SPDX-License-Identifier: MIT
#pragma once

/// Linear equations for tests, by Eigen's elimination with complete pivots. It is compiled once, because each file
/// that instantiates it takes long to compile.
///
///     const Eigen::VectorXd x = solved(A, b).value();
///     const auto x = solved(A, b);                     // nothing if A is singular

#include <Eigen/Core>
#include <optional>

namespace alembert::test {

/// X with A X = B; nothing if a pivot is zero within rounding. A: n×n, B: n×k.
std::optional<Eigen::MatrixXd> solved(const Eigen::MatrixXd& A, const Eigen::MatrixXd& B);

/// A: n×n, regular.
Eigen::MatrixXd inverse_of(const Eigen::MatrixXd& A);

}  // namespace alembert::test
