// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// Charts as SVG: what all of them share. A chart is a text that grows:
///
///     std::string svg = plot_begin({.width = 600, .height = 300, .title = "A pendulum", .about = "theta over
///     t"}); const PlotArea area{linear_scale(0, 10, 60, 560), linear_scale(-1, 1, 260, 40, 0.05)}; svg +=
///     plot_axes(area, {.x = "t in s", .y = "theta in rad"}); svg += plot_line(area, points, plot_style(0), {});
///     svg += plot_end();
///
/// Colours are those of Okabe and Ito, which people with any colour vision tell apart; what needs more than seven
/// is told apart by dashes and marks too. Text that is given here is plain: it is escaped, and characters that XML
/// does not allow become U+FFFD.

#include <string>
#include <utility>
#include <vector>

#include "report/plot_scale.hpp"

namespace alembert {

struct PlotSheet {
    double width = 800, height = 500;
    std::string title = {};                  ///< drawn at the top, and read by a screen reader
    std::string about = {};                  ///< read by a screen reader: what is to be seen
    std::vector<std::string> captions = {};  ///< lines below the title
};

/// `<svg …>` with title and description.
std::string plot_begin(const PlotSheet& sheet);
std::string plot_end();

/// Where the first chart may begin below title and captions.
double plot_top(const PlotSheet& sheet);

/// Escaped for XML.
std::string plot_escaped(std::string_view text);

enum class PlotAnchor { start, middle, end };
struct PlotFont {
    PlotAnchor anchor = PlotAnchor::start;
    double size = 12;
    const char* colour = "#222";
    bool bold = false;
    bool halo = false;  ///< a white edge, over lines
};
std::string plot_text(double x, double y, std::string_view text, const PlotFont& font = {});

/// The width of a text, as far as it can be told without its font.
double plot_width(std::string_view text, double size = 12);

/// Where numbers are drawn: x.begin is the left end, y.begin the lower one.
struct PlotArea {
    PlotScale x, y;
};

struct PlotAxes {
    std::string x = {}, y = {};  ///< what the numbers are, with the unit; empty: nothing is written
    bool x_numbers = true;
};
/// Grid, numbers, frame and names of the axes.
std::string plot_axes(const PlotArea& area, const PlotAxes& axes);

/// How a line is drawn. All styles from 0 to `plot_styles` − 1 differ.
struct PlotStyle {
    const char* colour;
    const char* dashes;  ///< as stroke-dasharray; empty: none
    int mark;            ///< shape of points, 0 to 4
};
inline constexpr std::size_t plot_styles = 35;
PlotStyle plot_style(std::size_t k);

struct PlotPen {
    double width = 1.6, opacity = 1;
    bool marks = false;
};
using PlotPoints = std::vector<std::pair<double, double>>;

/// A line through the points. It is broken at points that are not finite, and where two follow each other at one
/// x. Of more points than can be seen the outermost of each column are drawn.
std::string plot_line(const PlotArea& area, const PlotPoints& points, const PlotStyle& style, const PlotPen& pen);

/// A name that is written beside the end of a line, moved so that no two lie on each other.
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
