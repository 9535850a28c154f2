// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// Time against error as an SVG picture, both logarithmic: to the right more digits, further down less time.
///
///     const Curve curve{.name = "dop853", .points = {{1e-6, 2e-4}, {1e-9, 4e-4}}};
///     const std::string svg = work_precision({curve}, "Pleiades");
///
/// Curves are told apart by colour and mark, and named in a legend that is sorted by the time at the median error;
/// peers are dashed. Points without finite positive error and time are left out.

#include <string>
#include <utility>
#include <vector>

namespace alembert {

struct Curve {
    std::string name;
    bool dashed = false;
    std::vector<std::pair<double, double>> points;  ///< error, seconds
};

std::string work_precision(std::vector<Curve> series, const std::string& title);

}  // namespace alembert
