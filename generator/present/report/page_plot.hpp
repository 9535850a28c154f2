// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// Lines over time, or one value over another, as an SVG picture for the page, whose script moves a cursor over
/// it.
///
///     page_plot({.title = "Angles", .x_name = "t", .x_unit = "s", .y_unit = "rad"}, times, {{"theta1", values,
///     1}});

#include <string>
#include <vector>

namespace alembert {

struct PagePlotLabels {
    std::string title;
    std::string x_name, x_unit;  ///< name and unit of a value of the scene; the unit may be empty
    std::string y_name, y_unit;
    bool points = false;  ///< dots without a cursor in place of lines, all with a key
    bool axes = false;    ///< also lines where x = 0 and y = 0
};

struct PagePlotLine {
    std::string name;  ///< the name of a value of the scene
    std::vector<double> y;
    int column = -1;             ///< the column in the page's table of values
    std::vector<double> x = {};  ///< of points; empty for those of the plot
};

/// One <figure> with its caption. `x_column` is −1 for the time. Values that are not finite are left out. Lines
/// have the colours of Okabe and Ito, which colour-blind people can distinguish, and dashes from the eighth line
/// on.
std::string page_plot(const PagePlotLabels& labels, const std::vector<double>& x,
                      const std::vector<PagePlotLine>& lines, int x_column = -1);

/// Round numbers for an axis: about `count` of them, in order, the first and the last inside the range.
std::vector<double> page_ticks(double low, double high, int count);

}  // namespace alembert
