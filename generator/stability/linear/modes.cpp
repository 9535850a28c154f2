// SPDX-License-Identifier: GPL-2.0-or-later
// The vectors are the right singular vectors of A − λ that belong to its vanishing singular values.
#include "stability/linear/modes.hpp"

#include <algorithm>
#include <cmath>

#include "stability/linear/dense_long.hpp"

namespace alembert {

namespace {

constexpr double equal = 1e-7, vanishing = 1e-9;  // of the largest eigenvalue, of the largest singular value

}  // namespace

std::vector<LinearMode> modes_of(const Eigen::MatrixXd& A, const std::vector<std::complex<double>>& eigenvalues) {
    const Eigen::Index n = A.rows();
    double largest = 0;
    for (const auto& value : eigenvalues) largest = std::max(largest, std::abs(value));
    std::vector<LinearMode> result;
    for (std::size_t k = 0; k < eigenvalues.size() && n > 0; ++k) {
        if (eigenvalues[k].imag() < 0) continue;
        Eigen::Index before = 0;  // equal ones, whose vectors are taken
        for (std::size_t j = 0; j < k; ++j)
            before += std::abs(eigenvalues[j] - eigenvalues[k]) <= equal * largest ? 1 : 0;
        LongComplexMatrix shifted = A.cast<std::complex<long double>>();
        shifted.diagonal().array() -= std::complex<long double>(eigenvalues[k]);
        const LongRightVectors svd = right_vectors(shifted);
        const Eigen::Index column = n - 1 - before;
        if (column < 0) continue;
        const long double size = std::max<long double>(svd.values[0], largest);
        if (before > 0 && svd.values[column] > vanishing * size) continue;  // a Jordan block
        Eigen::VectorXcd vector = svd.right.col(column).cast<std::complex<double>>();
        Eigen::Index leading = 0;
        vector.cwiseAbs().maxCoeff(&leading);
        vector /= std::complex<double>(vector[leading]);
        for (std::complex<double>& x : vector)
            x = {std::abs(x.real()) < 1e-15 ? 0.0 : x.real(), std::abs(x.imag()) < 1e-15 ? 0.0 : x.imag()};
        result.push_back({eigenvalues[k], vector});
    }
    return result;
}

}  // namespace alembert
