// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// Small charts above each other with a common axis. Lines of the same group and unit are in the same chart, each
/// named at its end.
///
///     const std::vector<PlottedLine> lines{{"theta1", "rad", 0, points}, {"energy", "J", 1, others}};
///     const std::string svg = plot_panels(sheet, lines, "t in s", {});
///
/// If a chart has a single line that changes by less than a millionth of itself, its difference from the start is
/// drawn.

#include <functional>
#include <string>
#include <vector>

#include "present/report/plot.hpp"

namespace alembert {

struct PlottedLine {
    std::string name, unit;
    int group = 0;  ///< lines of different groups have charts of their own
    PlotPoints points;
};

/// `sheet` has title, description and captions; its size is set here, and the range of each line is added to the
/// description. `behind` draws the background of each chart; it may be empty.
std::string plot_panels(PlotSheet sheet, const std::vector<PlottedLine>& lines, const std::string& x,
                        const std::function<std::string(const PlotArea&)>& behind);

/// The least and the largest finite number; two infinities if there is none.
struct PlotRange {
    double least, most;
};
PlotRange plot_range(const std::vector<double>& values);

}  // namespace alembert
