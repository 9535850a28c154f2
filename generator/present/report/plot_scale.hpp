// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// The scale of an axis: the place of a number in a picture, and the round numbers at its ticks.
///
///     const PlotScale x = linear_scale(0, 9.7, 60, 660);      // 60 and 660: coordinates of the picture
///     x.at(4.85);                                             // 360
///     x.ticks(6);                                             // 0, 2, 4, 6, 8
///     decade_scale(3e-7, 0.2, 0, 100).ticks(9);               // 10⁻⁷ … 10⁰

#include <string>
#include <vector>

namespace alembert {

struct PlotTick {
    double value;
    std::string label;  ///< plain UTF-8
};

struct PlotScale {
    double low = 0, high = 1;   ///< numbers at the two ends
    double begin = 0, end = 1;  ///< places of the two ends
    bool decades = false;       ///< logarithmic, base 10

    double at(double value) const;
    /// Round numbers from `low` to `high`, at most `most` of them (at most 2 if that is smaller).
    std::vector<PlotTick> ticks(int most) const;
};

/// A scale from `least` to `most`; if these are equal or not finite, a range around them. `margin`, as a part of
/// the range, is added at both ends.
PlotScale linear_scale(double least, double most, double begin, double end, double margin = 0);

/// A scale from the power of ten below `least` to the one above `most`; both must be positive.
PlotScale decade_scale(double least, double most, double begin, double end);

/// A number with as many digits as are needed to distinguish it from its neighbour at a distance of `step`:
/// "0.25", "−3", "2·10⁻⁹".
std::string plot_number(double value, double step);

}  // namespace alembert
