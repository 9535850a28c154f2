// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// Time against error as an SVG picture, both logarithmic. More digits are to the right, less time is further
/// down.
///
///     const Curve curve{.name = "dop853", .points = {{1e-6, 2e-4}, {1e-9, 4e-4}}};
///     const std::string svg = work_precision({curve}, "Pleiades");
///
/// Curves differ by colour, dashes and marks, and are named at their ends. Those that are the fastest for an error
/// of 0.1, 0.01 … are drawn strongly, the others pale. Points without positive error and time, and errors above 1,
/// are left out.

#include <string>
#include <utility>
#include <vector>

namespace alembert {

struct Curve {
    std::string name;
    std::vector<std::pair<double, double>> points;  ///< error, seconds
};

std::string work_precision(std::vector<Curve> series, const std::string& title);

}  // namespace alembert
