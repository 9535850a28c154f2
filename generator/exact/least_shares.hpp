// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// Constraints whose rows depend on each other leave their multipliers open; the program takes the least ones that
/// give the same forces, Σ rowᵀ λ (docs/scene-language.md). With A all rows, K those that are kept, B = A Kᵀ, the
/// least are λ̂ = B w with BᵀB w = Bᵀ λ, for any λ that gives the forces.
///
///     const auto least = least_shares(rows, kept, lambda, solve);   // rows: kept ones first
///
/// `solve` takes the rows of a square system with its right sides last, and gives its solution, if there is one.

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
