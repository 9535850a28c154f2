// SPDX-License-Identifier: MIT
#pragma once

/// Whether five points of a function, with its slopes there, describe it.
///
///     const FivePoints points({0, 0.23, 0.52, 0.76, 1});
///     const InterpolationError error = points.interpolation_error(values, slopes);     // slopes: dg/dθ
///     error.value;  // how far the function is from what the other points say of it
///
/// Each of the three inner points is left out in turn. The Hermite polynomial of degree 7 through the other four
/// predicts its value and slope; the interpolation error is the largest difference. It falls with the eighth power
/// of the distance of the points, and is many times the error of a polynomial through all five. A function that
/// turns several times between the points has slopes that contradict its values there, so that the error is large
/// even where the values themselves look harmless. The places should not be equidistant: a wave could meet all of
/// them with one phase.

#include <array>

namespace alembert {

using FiveNumbers = std::array<double, 5>;

struct InterpolationError {
    double value = 0, slope = 0;
};

class FivePoints {
public:
    explicit FivePoints(const FiveNumbers& theta);

    const FiveNumbers& places() const { return theta_; }
    InterpolationError interpolation_error(const FiveNumbers& value, const FiveNumbers& slope) const;
    /// The factors of the five values in the slope, at the point `i`, of the polynomial through them.
    const FiveNumbers& slope_factors(int i) const { return differences_[static_cast<std::size_t>(i)]; }

private:
    /// The prediction at an inner point is Σ_j of (value_j, slope_j) times these.
    struct Prediction {
        FiveNumbers value_by_value, value_by_slope, slope_by_value, slope_by_slope;
    };

    Prediction left_out(std::size_t i) const;

    FiveNumbers theta_;
    std::array<Prediction, 3> inner_;
    std::array<FiveNumbers, 5> differences_;
};

}  // namespace alembert
