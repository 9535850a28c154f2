// SPDX-License-Identifier: MIT
// The Hermite polynomial through (θ_j, g_j, g'_j) with Lagrange's l_j (Davis, Interpolation and Approximation,
// 1975, §2.5):
//     p(θ) = Σ_j (1 − 2 l_j'(θ_j)(θ − θ_j)) l_j(θ)² g_j + (θ − θ_j) l_j(θ)² g'_j
#include "alembert/ode/five_points.hpp"

#include <algorithm>
#include <cmath>

namespace alembert {

FivePoints::FivePoints(const FiveNumbers& theta) : theta_(theta) {
    for (std::size_t i = 0; i < 3; ++i) inner_[i] = left_out(i + 1);
    FiveNumbers weight;
    for (std::size_t j = 0; j < 5; ++j) {
        weight[j] = 1;
        for (std::size_t k = 0; k < 5; ++k)
            if (k != j) weight[j] /= theta_[j] - theta_[k];
    }
    for (std::size_t i = 0; i < 5; ++i) {
        double sum = 0;
        for (std::size_t j = 0; j < 5; ++j)
            if (j != i) sum += differences_[i][j] = weight[j] / weight[i] / (theta_[i] - theta_[j]);
        differences_[i][i] = -sum;
    }
}

FivePoints::Prediction FivePoints::left_out(std::size_t i) const {
    Prediction result{};
    const double x = theta_[i];
    for (std::size_t j = 0; j < 5; ++j) {
        if (j == i) continue;
        double l = 1, relative = 0, own = 0;  // l_j(x), l_j'(x)/l_j(x) and l_j'(θ_j)
        for (std::size_t k = 0; k < 5; ++k) {
            if (k == j || k == i) continue;
            l *= (x - theta_[k]) / (theta_[j] - theta_[k]);
            relative += 1 / (x - theta_[k]);
            own += 1 / (theta_[j] - theta_[k]);
        }
        const double away = x - theta_[j], square = l * l, change = 2 * square * relative;
        result.value_by_value[j] = (1 - 2 * own * away) * square;
        result.value_by_slope[j] = away * square;
        result.slope_by_value[j] = -2 * own * square + (1 - 2 * own * away) * change;
        result.slope_by_slope[j] = square + away * change;
    }
    return result;
}

InterpolationError FivePoints::interpolation_error(const FiveNumbers& value, const FiveNumbers& slope) const {
    InterpolationError largest;
    for (std::size_t i = 0; i < 3; ++i) {
        double v = -value[i + 1], s = -slope[i + 1];
        for (std::size_t j = 0; j < 5; ++j) {
            v += inner_[i].value_by_value[j] * value[j] + inner_[i].value_by_slope[j] * slope[j];
            s += inner_[i].slope_by_value[j] * value[j] + inner_[i].slope_by_slope[j] * slope[j];
        }
        largest.value = std::max(largest.value, std::abs(v));
        largest.slope = std::max(largest.slope, std::abs(s));
    }
    return largest;
}

}  // namespace alembert
