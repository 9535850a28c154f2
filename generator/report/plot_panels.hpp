// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// Small charts above each other over one axis: lines of one group and unit stand together in a chart, each named
/// at its end.
///
///     const std::vector<PlottedLine> lines{{"theta1", "rad", 0, points}, {"energy", "J", 1, others}};
///     const std::string svg = plot_panels(sheet, lines, "t in s", {});
///
/// A line alone in its chart that changes by less than a millionth of itself is drawn as its difference to the
/// start.

#include <functional>
#include <string>
#include <vector>

#include "report/plot.hpp"

namespace alembert {

struct PlottedLine {
    std::string name, unit;
    int group = 0;  ///< lines of different groups have charts of their own
    PlotPoints points;
};

/// `sheet`: title, description and captions; its size is set here, and the description gets the range of each
/// line. `behind` draws what lies behind the lines of each chart; it may be empty.
std::string plot_panels(PlotSheet sheet, const std::vector<PlottedLine>& lines, const std::string& x,
                        const std::function<std::string(const PlotArea&)>& behind);

/// The least and the largest finite number; two infinities where there is none.
struct PlotRange {
    double least, most;
};
PlotRange plot_range(const std::vector<double>& values);

}  // namespace alembert
