// SPDX-License-Identifier: GPL-2.0-or-later
// The vectors span what the right singular vectors of A − λ do that belong to its vanishing singular values. Of an
// eigenvalue that is there k times, they are those of which each has a 1 where the others have zeros, at the first
// k states that allow it: no rounding decides which vectors are shown.
#include "stability/linear/modes.hpp"

#include <algorithm>
#include <cmath>

#include "stability/linear/dense_long.hpp"

namespace alembert {

namespace {

constexpr double equal = 1e-7, vanishing = 1e-9;  // of the largest eigenvalue, of the largest singular value
// Of the largest eigenvalue: how far roundings move two eigenvalues that are one with one vector, such as the
// zeros of a body that nothing holds, apart.
constexpr double moved_apart = 1e-8;
constexpr long double nothing_there = 1e-6L, as_large = 1e-9L;

/// Gauss's and Jordan's elimination of columns of length 1 that are orthogonal.
LongComplexMatrix reduced(LongComplexMatrix columns) {
    const Eigen::Index k = columns.cols();
    for (Eigen::Index row = 0, done = 0; row < columns.rows() && done < k; ++row) {
        Eigen::Index best = 0;
        if (columns.row(row).tail(k - done).cwiseAbs().maxCoeff(&best) < nothing_there) continue;
        columns.col(done).swap(columns.col(done + best));
        columns.col(done) /= std::complex<long double>(columns(row, done));
        for (Eigen::Index j = 0; j < k; ++j)
            if (j != done) columns.col(j) -= std::complex<long double>(columns(row, j)) * columns.col(done);
        ++done;
    }
    return columns;
}

/// The first of the elements that are the largest but for rounding is 1.
Eigen::VectorXcd shown(const LongComplexMatrix& column) {
    const long double largest = column.cwiseAbs().maxCoeff();
    Eigen::Index leading = 0;
    while (!(std::abs(column(leading, 0)) >= (1 - as_large) * largest) && leading + 1 < column.rows()) ++leading;
    Eigen::VectorXcd vector =
        (column / std::complex<long double>(column(leading, 0))).cast<std::complex<double>>();
    for (std::complex<double>& x : vector)
        x = {std::abs(x.real()) < 1e-15 ? 0.0 : x.real(), std::abs(x.imag()) < 1e-15 ? 0.0 : x.imag()};
    return vector;
}

}  // namespace

std::vector<LinearMode> modes_of(const Eigen::MatrixXd& A, const std::vector<std::complex<double>>& eigenvalues) {
    const Eigen::Index n = A.rows();
    double largest = 0;
    for (const auto& value : eigenvalues) largest = std::max(largest, std::abs(value));
    std::vector<LinearMode> result;
    for (std::size_t k = 0; k < eigenvalues.size() && n > 0; ++k) {
        if (eigenvalues[k].imag() < -moved_apart * largest) continue;
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
        Eigen::Index vectors = 1;
        while (vectors < n && svd.values[n - 1 - vectors] <= vanishing * size) ++vectors;
        const LongComplexMatrix all = reduced(svd.right.rightCols(std::max(vectors, before + 1)));
        result.push_back({eigenvalues[k], shown(all.col(before))});
    }
    return result;
}

}  // namespace alembert
