// SPDX-License-Identifier: GPL-2.0-or-later
#include "proof/interval_matrix.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

namespace alembert {

double middle_of(const Interval& x) {
    return x.low == x.high ? x.low : x.low / 2 + x.high / 2;
}

std::vector<Interval> inverse_of(const std::vector<Interval>& matrix, std::size_t n) {
    const auto size = static_cast<Eigen::Index>(n);
    Eigen::MatrixXd middle(size, size);
    for (Eigen::Index i = 0; i < size; ++i)
        for (Eigen::Index j = 0; j < size; ++j)
            middle(i, j) = middle_of(matrix[static_cast<std::size_t>(i * size + j)]);
    std::vector<Interval> result(n * n, Interval::whole());
    if (!middle.allFinite()) return result;
    const Eigen::MatrixXd C = middle.partialPivLu().inverse();
    if (!C.allFinite()) return result;
    const auto entry = [&](std::size_t i, std::size_t j) {
        const double c = C(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j));
        return Interval{c, c};
    };
    double q = 0;
    for (std::size_t i = 0; i < n; ++i) {
        Interval row;
        for (std::size_t j = 0; j < n; ++j) {
            Interval defect = i == j ? Interval{1, 1} : Interval{};
            for (std::size_t k = 0; k < n; ++k) defect = defect - entry(i, k) * matrix[k * n + j];
            row = row + Interval{0, defect.size()};
        }
        q = std::max(q, row.high);
    }
    if (!(q < 0.5)) return result;
    const Interval share = Interval{0, q} * inverse(Interval{1, 1} - Interval{q, q});
    for (std::size_t j = 0; j < n; ++j) {
        double largest = 0;
        for (std::size_t k = 0; k < n; ++k) largest = std::max(largest, entry(k, j).size());
        const double more = (share * Interval{0, largest}).high;
        for (std::size_t i = 0; i < n; ++i) result[i * n + j] = entry(i, j) + Interval{-more, more};
    }
    return result;
}

}  // namespace alembert
