// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// If the rows of constraints depend on each other, their multipliers are not determined; the program takes those
/// of least norm that give the same forces Σ rowᵀ λ (docs/scene-language.md). With A all rows, K the rows that are
/// kept and B = A Kᵀ, they are λ̂ = B w with BᵀB w = Bᵀ λ, for any λ that gives the forces.
///
///     const auto least = least_shares(rows, kept, lambda, solve);   // rows: kept ones first
///
/// `solve` takes the rows of a square system, with the right-hand side as the last column, and returns the
/// solution, if there is one.

#include <optional>
#include <vector>

namespace alembert {

template <typename Number, typename Solve>
std::optional<std::vector<Number>> least_shares(const std::vector<std::vector<Number>>& rows, std::size_t kept,
                                                const std::vector<Number>& lambda, const Solve& solve) {
    const std::size_t all = rows.size();
    std::vector<std::vector<Number>> B(all, std::vector<Number>(kept, Number(0)));
    for (std::size_t r = 0; r < all; ++r)
        for (std::size_t k = 0; k < kept; ++k)
            for (std::size_t i = 0; i < rows[r].size(); ++i) B[r][k] += rows[r][i] * rows[k][i];
    std::vector<std::vector<Number>> equations(kept, std::vector<Number>(kept + 1, Number(0)));
    for (std::size_t j = 0; j < kept; ++j)
        for (std::size_t r = 0; r < all; ++r) {
            for (std::size_t k = 0; k < kept; ++k) equations[j][k] += B[r][j] * B[r][k];
            equations[j][kept] += B[r][j] * lambda[r];
        }
    const std::optional<std::vector<Number>> w = solve(std::move(equations));
    if (!w) return std::nullopt;
    std::vector<Number> result(all, Number(0));
    for (std::size_t r = 0; r < all; ++r)
        for (std::size_t k = 0; k < kept; ++k) result[r] += B[r][k] * (*w)[k];
    return result;
}

}  // namespace alembert
