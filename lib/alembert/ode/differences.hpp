// SPDX-License-Identifier: MIT
#pragma once

/// Backward differences of a vector at equal distances in time: the past values that multistep methods keep.
///
///     Differences D(size, rows);          // D.row(j) is ∇^j of the newest value
///     D.stretch(3, 1.5);                  // the same polynomial of degree 3, seen at 1.5 times the distance
///
/// With R_ij(r) = Π_{l=1…i} (l − 1 − r j)/l the polynomial's values at −j r are Σ_i R_ij ∇^i, and R(1) is its own
/// inverse: ∇' = (R(r) R(1))ᵀ ∇ (Shampine & Reichelt, SIAM J. Sci. Comput. 18 (1997) 1-22, §2.1). Row 0 does not
/// change.

#include <array>
#include <cmath>
#include <vector>

namespace alembert {

class Differences {
public:
    static constexpr std::size_t most = 8;  ///< the most rows

    Differences(std::size_t size, std::size_t rows) : size_(size), values_(size * rows) {}

    double* row(std::size_t j) { return values_.data() + j * size_; }
    const double* row(std::size_t j) const { return values_.data() + j * size_; }

    void stretch(std::size_t degree, double factor) {
        const Table R = table(degree, factor), U = table(degree, 1);
        Table change{};
        for (std::size_t i = 1; i <= degree; ++i)
            for (std::size_t j = 1; j <= degree; ++j)
                for (std::size_t l = 1; l <= degree; ++l) change[j][i] += R[i][l] * U[l][j];
        for (std::size_t k = 0; k < size_; ++k) {
            std::array<double, most> old{};
            for (std::size_t j = 1; j <= degree; ++j) old[j] = row(j)[k];
            for (std::size_t j = 1; j <= degree; ++j) {
                double sum = 0;
                for (std::size_t i = 1; i <= degree; ++i) sum += change[j][i] * old[i];
                row(j)[k] = sum;
            }
        }
    }

private:
    using Table = std::array<std::array<double, most>, most>;

    static Table table(std::size_t degree, double factor) {
        Table R{};
        for (std::size_t j = 1; j <= degree; ++j) {
            double product = 1;
            for (std::size_t i = 1; i <= degree; ++i) {
                product *= (static_cast<double>(i) - 1 - factor * static_cast<double>(j)) / static_cast<double>(i);
                R[i][j] = product;
            }
        }
        return R;
    }

    std::size_t size_;
    std::vector<double> values_;
};

}  // namespace alembert
