// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// Functions that all charts in SVG share. A chart is a text to which parts are added:
///
///     std::string svg = plot_begin({.width = 600, .height = 300, .title = "A pendulum", .about = "theta over
///     t"}); const PlotArea area{linear_scale(0, 10, 60, 560), linear_scale(-1, 1, 260, 40, 0.05)}; svg +=
///     plot_axes(area, {.x = "t in s", .y = "theta in rad"}); svg += plot_line(area, points, plot_style(0), {});
///     svg += plot_end();
///
/// Colours are those of Okabe and Ito, which people with any colour vision can distinguish; more than seven lines
/// also differ by dashes and marks. Text that is passed to these functions is plain: it is escaped, and characters
/// that XML does not allow become U+FFFD.

#include <string>
#include <utility>
#include <vector>

#include "present/report/plot_scale.hpp"

namespace alembert {

struct PlotSheet {
    double width = 800, height = 500;
    std::string title = {};                  ///< drawn at the top, and read by a screen reader
    std::string about = {};                  ///< read by a screen reader: what the chart shows
    std::vector<std::string> captions = {};  ///< lines below the title
};

/// `<svg …>` with title and description.
std::string plot_begin(const PlotSheet& sheet);
std::string plot_end();

/// The height below title and captions at which the first chart may begin.
double plot_top(const PlotSheet& sheet);

/// Escaped for XML.
std::string plot_escaped(std::string_view text);

enum class PlotAnchor { start, middle, end };
struct PlotFont {
    PlotAnchor anchor = PlotAnchor::start;
    double size = 12;
    const char* colour = "#222";
    bool bold = false;
    bool halo = false;  ///< whether to draw a white edge, over lines
};
std::string plot_text(double x, double y, std::string_view text, const PlotFont& font = {});

/// The approximate width of a text, without knowledge of its font.
double plot_width(std::string_view text, double size = 12);

/// The area for numbers: x.begin is the left end, y.begin the lower one.
struct PlotArea {
    PlotScale x, y;
};

struct PlotAxes {
    std::string x = {}, y = {};  ///< the quantity and its unit; if empty, nothing is written
    bool x_numbers = true;
};
/// Grid, numbers, frame and names of the axes.
std::string plot_axes(const PlotArea& area, const PlotAxes& axes);

/// The style of a line. All styles from 0 to `plot_styles` − 1 differ.
struct PlotStyle {
    const char* colour;
    const char* dashes;  ///< the value of stroke-dasharray; empty for none
    int mark;            ///< shape of points, 0 to 4
};
inline constexpr std::size_t plot_styles = 35;
PlotStyle plot_style(std::size_t k);

struct PlotPen {
    double width = 1.6, opacity = 1;
    bool marks = false;
};
using PlotPoints = std::vector<std::pair<double, double>>;

/// A line through the points. It is broken at points that are not finite, and where two successive points have the
/// same x. If there are more points than can be seen, only the outermost of each column are drawn.
std::string plot_line(const PlotArea& area, const PlotPoints& points, const PlotStyle& style, const PlotPen& pen);

/// A name beside the end of a line, moved so that names do not overlap.
struct PlotLabel {
    double x, y;  ///< the end of the line
    std::string text;
    PlotStyle style;
    double opacity = 1;
    bool bold = false;
};
/// Names in a column at `x`, between `top` and `bottom`, each with a piece of its line that leads to it.
std::string plot_labels(std::vector<PlotLabel> labels, double x, double top, double bottom);

}  // namespace alembert
