// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// Modes: eigenvectors of x' = A x.
///
///     for (const LinearMode& mode : modes_of(near.matrices.A, near.matrices.eigenvalues))
///         mode.eigenvalue, mode.vector           // x = Re(vector e^(eigenvalue t)) is a motion

#include <Eigen/Core>
#include <complex>
#include <vector>

namespace alembert {

struct LinearMode {
    std::complex<double> eigenvalue;
    Eigen::VectorXcd vector;  ///< A vector = eigenvalue vector; its largest element is 1
};

/// One for each eigenvalue with an imaginary part that is not negative (of a pair the other vector is conjugate),
/// in their order. A multiple eigenvalue has as many as it has eigenvectors, which may be fewer than it counts.
std::vector<LinearMode> modes_of(const Eigen::MatrixXd& A, const std::vector<std::complex<double>>& eigenvalues);

}  // namespace alembert
