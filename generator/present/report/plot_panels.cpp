// SPDX-License-Identifier: GPL-2.0-or-later
#include "present/report/plot_panels.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/language/say.hpp"

namespace alembert {

namespace {

constexpr double left = 84, chart_width = 560, chart_height = 150, gap = 34, bottom_room = 52,
                 longest_heading = 400;
constexpr std::size_t most_lines = 7;  // the most lines in one chart, as many as there are colours
constexpr double small_change = 1e-6;

struct PlotPanel {
    std::vector<PlottedLine> lines;
    double offset = 0;  ///< the number that is subtracted
};

std::vector<PlotPanel> panels_of(const std::vector<PlottedLine>& lines) {
    std::vector<PlotPanel> result;
    for (const PlottedLine& one : lines) {
        const auto place = std::find_if(result.begin(), result.end(), [&](const PlotPanel& panel) {
            const PlottedLine& other = panel.lines.front();
            return panel.lines.size() < most_lines && other.group == one.group && other.unit == one.unit;
        });
        if (place == result.end())
            result.push_back({.lines = {one}});
        else
            place->lines.push_back(one);
    }
    return result;
}

PlotRange range_of(const PlotPanel& panel, double (*part)(const std::pair<double, double>&)) {
    std::vector<double> values;
    for (const PlottedLine& line : panel.lines)
        for (const auto& point : line.points) values.push_back(part(point));
    return plot_range(values);
}
double first(const std::pair<double, double>& point) {
    return point.first;
}
double second(const std::pair<double, double>& point) {
    return point.second;
}

/// Makes a small change of one large quantity visible.
void shift(PlotPanel& panel) {
    if (panel.lines.size() != 1 || panel.lines.front().points.empty()) return;
    const auto [least, most] = range_of(panel, second);
    const double start = panel.lines.front().points.front().second;
    if (!(most > least && most - least < small_change * std::max(std::abs(least), std::abs(most)))) return;
    if (!std::isfinite(start)) return;
    panel.offset = start;
    for (auto& point : panel.lines.front().points) point.second -= start;
}

std::string heading_of(const PlotPanel& panel) {
    std::string names;
    for (const PlottedLine& line : panel.lines) {
        const std::string longer = names + (names.empty() ? "" : ", ") + line.name;
        if (!names.empty() && plot_width(longer) > longest_heading) {
            names += " …";
            break;
        }
        names = longer;
    }
    if (panel.offset != 0)
        names += fmt::format(" {} {:.9g}", panel.offset < 0 ? "+" : "−", std::abs(panel.offset));
    const std::string& unit = panel.lines.front().unit;
    return unit.empty() ? names : say("{} in {}", names, unit);
}

std::string described(const PlotPanel& panel) {
    std::string text;
    for (const PlottedLine& line : panel.lines) {
        if (line.points.empty()) continue;
        const auto [least, most] = range_of({.lines = {line}}, second);
        text += say(" {}: from {:.4g} to {:.4g} {}, between {:.4g} and {:.4g}.", line.name,
                    line.points.front().second + panel.offset, line.points.back().second + panel.offset, line.unit,
                    least + panel.offset, most + panel.offset);
    }
    return text;
}

std::string chart(const PlotPanel& panel, const PlotArea& area, const PlotAxes& axes) {
    std::string svg = plot_text(area.x.begin, area.y.end - 7, heading_of(panel), {.bold = true});
    svg += plot_axes(area, axes);
    std::vector<PlotLabel> labels;
    for (std::size_t k = 0; k < panel.lines.size(); ++k) {
        const PlotPoints& points = panel.lines[k].points;
        const PlotStyle style = plot_style(k);
        svg += plot_line(area, points, style, {.marks = points.size() == 1});
        const auto last = std::find_if(points.rbegin(), points.rend(), [](const auto& point) {
            return std::isfinite(point.first) && std::isfinite(point.second);
        });
        if (last == points.rend()) continue;
        labels.push_back({area.x.at(last->first), area.y.at(last->second), panel.lines[k].name, style});
    }
    return svg + plot_labels(labels, area.x.end + 30, area.y.end + 6, area.y.begin - 6);
}

}  // namespace

PlotRange plot_range(const std::vector<double>& values) {
    constexpr double infinity = std::numeric_limits<double>::infinity();
    PlotRange range{infinity, -infinity};
    for (const double value : values) {
        if (!std::isfinite(value)) continue;
        range.least = std::min(range.least, value);
        range.most = std::max(range.most, value);
    }
    return range;
}

std::string plot_panels(PlotSheet sheet, const std::vector<PlottedLine>& lines, const std::string& x,
                        const std::function<std::string(const PlotArea&)>& behind) {
    std::vector<PlotPanel> panels = panels_of(lines);
    double right = 60;
    for (const PlottedLine& line : lines) right = std::max(right, 44 + plot_width(line.name));
    for (PlotPanel& panel : panels) {
        shift(panel);
        sheet.about += described(panel);
    }
    double top = plot_top(sheet) + gap;
    sheet.width = left + chart_width + right;
    sheet.height = top + static_cast<double>(panels.size()) * (chart_height + gap) - gap + bottom_room;
    const PlotRange wide = range_of({.lines = lines}, first);
    std::string svg = plot_begin(sheet);
    for (const PlotPanel& panel : panels) {
        const auto [least, most] = range_of(panel, second);
        const PlotArea area{linear_scale(wide.least, wide.most, left, left + chart_width),
                            linear_scale(least, most, top + chart_height, top, 0.06)};
        const bool is_last = &panel == &panels.back();
        if (behind) svg += behind(area);
        svg += chart(panel, area, {.x = is_last ? x : "", .x_numbers = is_last});
        top += chart_height + gap;
    }
    return svg + plot_end();
}

}  // namespace alembert
