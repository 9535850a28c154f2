// SPDX-License-Identifier: GPL-2.0-or-later
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "base/language/say.hpp"
#include "present/report/page.hpp"
#include "present/report/plot.hpp"
#include "present/report/stability_charts.hpp"

namespace alembert {

namespace {

constexpr std::array<SpectrumKind, 6> all_kinds{SpectrumKind::inside,     SpectrumKind::edge,
                                                SpectrumKind::divergence, SpectrumKind::flip,
                                                SpectrumKind::flutter,    SpectrumKind::none};
constexpr double left = 70, right = 190, legend_row = 20;

const char* colour_of_kind(SpectrumKind kind) {
    switch (kind) {
        case SpectrumKind::inside:
            return "#8fc79b";
        case SpectrumKind::edge:
            return "#d3ead7";
        case SpectrumKind::divergence:
            return "#f2c879";
        case SpectrumKind::flip:
            return "#9db9e0";
        case SpectrumKind::flutter:
            return "#e59a7a";
        case SpectrumKind::none:
            break;
    }
    return "#d0d0d0";
}

std::string meaning(SpectrumKind kind, SpectrumOf of) {
    const bool circle = of == SpectrumOf::multipliers;
    switch (kind) {
        case SpectrumKind::inside:
            return say("asymptotically stable");
        case SpectrumKind::edge:
            return circle ? say("critical: on the circle") : say("critical: on the axis");
        case SpectrumKind::divergence:
            return circle ? say("unstable: beyond +1") : say("unstable: divergence");
        case SpectrumKind::flip:
            return say("unstable: beyond -1");
        case SpectrumKind::flutter:
            return circle ? say("unstable: a pair") : say("unstable: flutter");
        case SpectrumKind::none:
            break;
    }
    return say("nothing to judge found");
}

std::string roots_in_words(SpectrumOf of) {
    return of == SpectrumOf::multipliers ? say("Floquet multipliers")
           : of == SpectrumOf::roots     ? say("roots of the polynomial")
                                         : say("eigenvalues of the first approximation");
}

std::size_t count_of(const StabilityChart& chart, SpectrumKind kind) {
    return static_cast<std::size_t>(std::count(chart.kinds.begin(), chart.kinds.end(), kind));
}

double at(const Axis& axis, std::size_t k) {
    return axis.from + (axis.to - axis.from) * static_cast<double>(k) / static_cast<double>(axis.count - 1);
}

bool is_mixed(const StabilityChart& chart, std::size_t i, std::size_t j) {
    const bool first = is_unstable(chart.kind(i, j));
    return is_unstable(chart.kind(i + 1, j)) != first || is_unstable(chart.kind(i, j + 1)) != first ||
           is_unstable(chart.kind(i + 1, j + 1)) != first;
}

/// What a cell is filled with below its unstable piece.
SpectrumKind ground(const StabilityChart& chart, std::size_t i, std::size_t j) {
    SpectrumKind kind = chart.kind(i, j);
    if (!is_mixed(chart, i, j)) return kind;
    for (const std::size_t a : {i, i + 1})
        for (const std::size_t b : {j, j + 1})
            if (!is_unstable(chart.kind(a, b))) kind = chart.kind(a, b);
    return kind;
}

/// One path for each kind, in rows of equal cells.
std::string cells_of_chart(const StabilityChart& chart, const PlotArea& area) {
    std::string svg;
    for (const SpectrumKind kind : all_kinds) {
        std::string path;
        for (std::size_t j = 0; j + 1 < chart.y.count; ++j)
            for (std::size_t i = 0; i + 1 < chart.x.count; ++i) {
                if (ground(chart, i, j) != kind) continue;
                std::size_t end = i + 1;
                while (end + 1 < chart.x.count && ground(chart, end, j) == kind) ++end;
                const double x0 = area.x.at(at(chart.x, i)), x1 = area.x.at(at(chart.x, end)),
                             y0 = area.y.at(at(chart.y, j)), y1 = area.y.at(at(chart.y, j + 1));
                path += fmt::format("M{:.2f} {:.2f}H{:.2f}V{:.2f}H{:.2f}z", x0, y0, x1, y1, x0);
                i = end - 1;
            }
        if (!path.empty())
            put(svg, "<path fill='{0}' stroke='{0}' stroke-width='0.3' d='{1}'/>\n", colour_of_kind(kind), path);
    }
    return svg;
}

std::string path_of(const std::vector<ChartPoint>& points, const PlotArea& area) {
    std::string path;
    for (const ChartPoint& p : points)
        path += fmt::format("{}{:.3f} {:.3f}", path.empty() ? "M" : "L", area.x.at(p.x), area.y.at(p.y));
    return path;
}

}  // namespace

std::string as_svg(const StabilityChart& chart) {
    PlotSheet sheet{.width = left + chart_width + right,
                    .title = chart.title.empty() ? say("Stability") : chart.title,
                    .about = say("Stability over {} and {}.", chart.x.name, chart.y.name),
                    .captions = {say("by {}, in floating point", roots_in_words(chart.of))}};
    const double top = plot_top(sheet) + 10;
    sheet.height = top + chart_height + 56;
    std::string svg = plot_begin(sheet);
    const PlotArea area{linear_scale(chart.x.from, chart.x.to, left, left + chart_width),
                        linear_scale(chart.y.from, chart.y.to, top + chart_height, top)};
    svg += cells_of_chart(chart, area);
    for (const StabilityChart::Piece& piece : chart.pieces)
        put(svg, "<path fill='{}' d='{}z'/>\n", colour_of_kind(piece.kind), path_of(piece.polygon, area));
    const double x_size = chart.x_unit.size, y_size = chart.y_unit.size;
    svg += plot_axes({linear_scale(chart.x.from / x_size, chart.x.to / x_size, left, left + chart_width),
                      linear_scale(chart.y.from / y_size, chart.y.to / y_size, top + chart_height, top)},
                     {.x = chart.x_unit.label(chart.x.name), .y = chart.y_unit.label(chart.y.name)});
    for (const std::vector<ChartPoint>& line : chart.boundaries)
        put(svg, "<path fill='none' stroke='#222' stroke-width='1.2' d='{}'/>\n", path_of(line, area));
    double row = top + 14;
    for (const SpectrumKind kind : all_kinds) {
        if (count_of(chart, kind) == 0) continue;
        put(svg, "<rect x='{}' y='{}' width='14' height='14' fill='{}'/>\n", left + chart_width + 14, row - 11,
            colour_of_kind(kind));
        svg += plot_text(left + chart_width + 34, row, meaning(kind, chart.of));
        row += legend_row;
    }
    return svg + plot_end();
}

std::string as_csv(const StabilityChart& chart) {
    std::string csv = fmt::format("part,{},{},kind,beyond\n", chart.x.name, chart.y.name);
    for (std::size_t i = 0; i < chart.x.count; ++i)
        for (std::size_t j = 0; j < chart.y.count; ++j)
            put(csv, "node,{},{},{},{}\n", at(chart.x, i), at(chart.y, j), name_of(chart.kind(i, j)),
                chart.beyond[i * chart.y.count + j]);
    for (std::size_t k = 0; k < chart.boundaries.size(); ++k)
        for (const ChartPoint& p : chart.boundaries[k]) put(csv, "boundary {},{},{},,\n", k + 1, p.x, p.y);
    return csv;
}

Json as_json(const StabilityChart& chart) {
    Json result;
    result["of"] = roots_in_words(chart.of);
    result["over"] = Json::array();
    for (const Axis* axis : {&chart.x, &chart.y})
        result["over"].push_back(
            {{"name", axis->name}, {"from", axis->from}, {"to", axis->to}, {"count", axis->count}});
    result["kinds"] = Json::object();
    for (const SpectrumKind kind : all_kinds)
        if (const std::size_t count = count_of(chart, kind); count > 0) result["kinds"][name_of(kind)] = count;
    result["evaluations"] = chart.evaluations;
    result["boundaries"] = Json::array();
    for (const std::vector<ChartPoint>& line : chart.boundaries) {
        result["boundaries"].push_back(Json::array());
        for (const ChartPoint& p : line) result["boundaries"].back().push_back({p.x, p.y});
    }
    return result;
}

std::string as_text(const StabilityChart& chart) {
    std::string page;
    if (!chart.title.empty()) put(page, "{}\n\n", chart.title);
    say_on(page, "Stability over {} and {}, by {} in floating point at {} x {} values:\n", chart.x.name,
           chart.y.name, roots_in_words(chart.of), chart.x.count, chart.y.count);
    for (const SpectrumKind kind : all_kinds)
        if (const std::size_t count = count_of(chart, kind); count > 0)
            put(page, "  {:<26}{:>6.2f} %\n", meaning(kind, chart.of),
                100.0 * static_cast<double>(count) / static_cast<double>(chart.kinds.size()));
    std::size_t points = 0;
    for (const std::vector<ChartPoint>& line : chart.boundaries) points += line.size();
    say_on(page, "{} boundary line{}, {} points to a hundredth of a pixel; {} evaluations\n",
           chart.boundaries.size(), chart.boundaries.size() == 1 ? "" : "s", points, chart.evaluations);
    return page;
}

}  // namespace alembert
