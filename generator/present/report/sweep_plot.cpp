// SPDX-License-Identifier: GPL-2.0-or-later
#include "present/report/sweep_plot.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "alembert/base/error.hpp"
#include "base/language/say.hpp"
#include "present/report/plot_panels.hpp"
#include "scene/units.hpp"

namespace alembert {

namespace {

constexpr double left = 84, top_gap = 34, map_width = 460, map_height = 360, between = 66, bar_width = 16;
constexpr std::size_t most_cells = 256;  // along each axis of a map
constexpr int levels = 128;              // of colour

/// The positions of the axes that vary.
std::vector<std::size_t> varying(const Grid& grid) {
    std::vector<std::size_t> axes;
    for (std::size_t k = 0; k < grid.axes.size(); ++k)
        if (grid.axes[k].count > 1) axes.push_back(k);
    if (axes.empty()) axes.push_back(0);
    return axes;
}

std::string with_unit(const std::string& name, const std::string& unit) {
    return unit.empty() ? name : say("{} in {}", name, unit);
}

/// The varied quantity in words: "initial theta1 in rad", "l1 in m".
std::string varied(const Axis& axis, const Sweep& s) {
    const std::vector<Mechanism::Parameter>& all = s.mechanism.parameters;
    const bool is_parameter = std::any_of(
        all.begin(), all.end(), [&](const Mechanism::Parameter& p) { return p.symbol.get_name() == axis.name; });
    return with_unit(is_parameter ? axis.name : say("initial {}", axis.name),
                     unit_of_name(s.scene, axis.name).unit);
}

/// In the unit of the picture.
Axis shown(Axis axis, const Sweep& s) {
    const double size = unit_of_name(s.scene, axis.name).size;
    axis.from /= size;
    axis.to /= size;
    return axis;
}

/// The values of one column at the ends of all motions, in the unit of the picture.
std::vector<double> ends(const Sweep& s, const std::string& name) {
    const std::vector<std::string> columns = end_columns(s);
    const auto k = static_cast<std::size_t>(std::find(columns.begin(), columns.end(), name) - columns.begin());
    const double size = unit_of_name(s.scene, name).size;
    std::vector<double> values;
    for (const SweptMotion& m : s.members) values.push_back(m.failed ? std::nan("") : end_values(m)[k] / size);
    return values;
}

/// The colours of the map "viridis": their lightness increases evenly, for readers with any colour vision.
std::string colour(double part) {
    static constexpr std::array<std::array<double, 3>, 9> stops{{{68, 1, 84},
                                                                 {71, 44, 122},
                                                                 {59, 81, 139},
                                                                 {44, 113, 142},
                                                                 {33, 144, 141},
                                                                 {39, 173, 129},
                                                                 {92, 200, 99},
                                                                 {170, 220, 50},
                                                                 {253, 231, 37}}};
    const double place = std::clamp(part, 0.0, 1.0) * (stops.size() - 1);
    const auto low = std::min(static_cast<std::size_t>(place), stops.size() - 2);
    const double rest = place - static_cast<double>(low);
    std::array<int, 3> mixed{};
    for (std::size_t k = 0; k < 3; ++k)
        mixed[k] = static_cast<int>(std::lround(stops[low][k] + rest * (stops[low + 1][k] - stops[low][k])));
    return fmt::format("#{:02x}{:02x}{:02x}", mixed[0], mixed[1], mixed[2]);
}

int level_of(double value, const PlotScale& scale) {
    const double part = (value - scale.low) / (scale.high - scale.low);
    return std::clamp(static_cast<int>(part * levels), 0, levels - 1);
}
std::string colour_of(int level) {
    return colour((level + 0.5) / levels);
}

/// Edges of the cells of an axis, half a step around its values.
PlotScale cells_of(const Axis& axis, double begin, double end) {
    const double half = (axis.to - axis.from) / (2 * static_cast<double>(axis.count - 1));
    return linear_scale(axis.from - half, axis.to + half, begin, end);
}

struct PlotMap {
    const Axis &x, &y;
    std::vector<double> values;  ///< y varies faster
    std::size_t stride(const Axis& axis) const { return (axis.count - 1) / most_cells + 1; }
};

/// One path for each colour, in units of cells.
std::string cells(const PlotMap& map, const PlotArea& area, const PlotScale& scale) {
    const std::size_t across = map.stride(map.x), up = map.stride(map.y);
    std::vector<std::string> paths(levels);
    for (std::size_t i = 0; i < map.x.count; i += across)
        for (std::size_t j = 0; j < map.y.count; j += up) {
            const double value = map.values[i * map.y.count + j];
            if (!std::isfinite(value)) continue;
            paths[static_cast<std::size_t>(level_of(value, scale))] +=
                fmt::format("M{} {}h{}v{}h-{}z", i, j, std::min(across, map.x.count - i),
                            std::min(up, map.y.count - j), std::min(across, map.x.count - i));
        }
    const double width = (area.x.end - area.x.begin) / static_cast<double>(map.x.count),
                 height = (area.y.begin - area.y.end) / static_cast<double>(map.y.count);
    std::string svg = fmt::format(
        "<g transform='translate({:g} {:g}) scale({:.6g} {:.6g})' "
        "shape-rendering='crispEdges'>\n",
        area.x.begin, area.y.begin, width, -height);
    for (int level = 0; level < levels; ++level)
        if (const std::string& path = paths[static_cast<std::size_t>(level)]; !path.empty())
            svg += fmt::format("<path fill='{}' d='{}'/>\n", colour_of(level), path);
    return svg + "</g>\n";
}

std::string colour_bar(double x, const PlotArea& area, PlotScale scale) {
    scale.begin = area.y.begin;
    scale.end = area.y.end;
    std::string svg = "<g shape-rendering='crispEdges'>";
    const double height = (area.y.begin - area.y.end) / levels;
    for (int level = 0; level < levels; ++level)
        svg += fmt::format("<rect x='{:g}' y='{:.2f}' width='{:g}' height='{:.2f}' fill='{}'/>", x,
                           area.y.begin - (level + 1) * height, bar_width, height + (level > 0 ? 1 : 0),
                           colour_of(level));
    svg += fmt::format("</g>\n<rect x='{:g}' y='{:g}' width='{:g}' height='{:g}' fill='none' stroke='#888'/>\n", x,
                       area.y.end, bar_width, area.y.begin - area.y.end);
    for (const PlotTick& tick : scale.ticks(9)) {
        const double y = scale.at(tick.value);
        svg += fmt::format("<path d='M{:g} {:.1f}h4' stroke='#888'/>", x + bar_width, y);
        svg += plot_text(x + bar_width + 8, y + 4, tick.label);
    }
    return svg;
}

std::string map_of(const Sweep& s, const PlotMap& map, const std::string& name, double top) {
    const PlotArea area{cells_of(map.x, left, left + map_width), cells_of(map.y, top + map_height, top)};
    const auto [least, most] = plot_range(map.values);
    const PlotScale scale = linear_scale(least, most, 0, 1);
    std::string svg = plot_text(left, top - 8, with_unit(say("final {}", name), unit_of_name(s.scene, name).unit),
                                {.bold = true});
    svg += fmt::format("<rect x='{:g}' y='{:g}' width='{:g}' height='{:g}' fill='#bbb'/>\n", left, top, map_width,
                       map_height);
    svg += plot_axes(area, {.x = varied(map.x, s), .y = varied(map.y, s)});
    return svg + cells(map, area, scale) + colour_bar(left + map_width + 18, area, scale);
}

std::string maps(const Sweep& s, const std::vector<std::size_t>& axes, const std::vector<std::string>& names,
                 PlotSheet sheet) {
    const Axis x = shown(s.grid.axes[axes[0]], s), y = shown(s.grid.axes[axes[1]], s);
    std::vector<PlotMap> all;
    for (const std::string& name : names) {
        all.push_back({x, y, ends(s, name)});
        const auto [least, most] = plot_range(all.back().values);
        sheet.about +=
            say(" {}: between {:.4g} and {:.4g} {}.", name, least, most, unit_of_name(s.scene, name).unit);
    }
    if (all.front().stride(x) > 1 || all.front().stride(y) > 1)
        sheet.captions.push_back(say("of {} × {} values every {} × {} is drawn", x.count, y.count,
                                     all.front().stride(x), all.front().stride(y)));
    double top = plot_top(sheet) + top_gap;
    sheet.width = left + map_width + 18 + bar_width + 90;
    sheet.height = top + static_cast<double>(all.size()) * (map_height + between);
    std::string svg = plot_begin(sheet);
    for (std::size_t k = 0; k < all.size(); ++k, top += map_height + between)
        svg += map_of(s, all[k], names[k], top);
    return svg + plot_end();
}

std::string lines(const Sweep& s, std::size_t axis, const std::vector<std::string>& names,
                  const PlotSheet& sheet) {
    const double size = unit_of_name(s.scene, s.grid.axes[axis].name).size;
    std::vector<PlottedLine> all;
    for (const std::string& name : names) {
        PlottedLine line{.name = say("final {}", name), .unit = unit_of_name(s.scene, name).unit, .points = {}};
        const std::vector<double> values = ends(s, name);
        for (std::size_t k = 0; k < values.size(); ++k)
            line.points.emplace_back(s.members[k].varied[axis] / size, values[k]);
        if (line.unit.empty()) line.group = static_cast<int>(all.size()) + 1;  // outputs may have any meaning
        all.push_back(std::move(line));
    }
    return plot_panels(sheet, all, varied(s.grid.axes[axis], s), {});
}

}  // namespace

void need_pictured(const Grid& grid) {
    if (grid.is_listed())
        throw ModelError(say("--svg draws grids only; points of a file and samples are in the table"));
    if (varying(grid).size() > 2)
        throw ModelError(say("--svg: a picture shows one or two varied quantities, and this sweep varies {}",
                             fmt::join(grid.names(), ", ")));
}

std::string sweep_plot(const Sweep& s, const std::vector<std::string>& shown) {
    need_pictured(s.grid);
    const std::vector<std::size_t> axes = varying(s.grid);
    const std::string& title = s.mechanism.title.empty() ? s.mechanism.name : s.mechanism.title;
    const std::vector<std::string>& names = shown.empty() ? s.coordinates : shown;
    PlotSheet sheet{.title = title, .about = say("What motions are at their ends."), .captions = {}};
    if (const long failed = totals_of(s).failed; failed > 0)
        sheet.captions.push_back(say("{} of {} motions failed and are left out{}", failed, s.members.size(),
                                     axes.size() > 1 ? " (grey)" : ""));
    return axes.size() == 1 ? lines(s, axes[0], names, sheet) : maps(s, axes, names, sheet);
}

}  // namespace alembert
