// SPDX-License-Identifier: GPL-2.0-or-later
#include "present/report/plot.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "algebra/notation/lettering.hpp"
#include "scene/text.hpp"

namespace alembert {

namespace {

constexpr double title_height = 30, line_height = 16;

const char* word(PlotAnchor anchor) {
    return anchor == PlotAnchor::start ? "start" : anchor == PlotAnchor::middle ? "middle" : "end";
}

std::string stroke(const PlotStyle& style, const PlotPen& pen) {
    std::string text = fmt::format("fill='none' stroke='{}' stroke-width='{:g}' stroke-linejoin='round'",
                                   style.colour, pen.width);
    if (*style.dashes != '\0') text += fmt::format(" stroke-dasharray='{}'", style.dashes);
    if (pen.opacity < 1) text += fmt::format(" stroke-opacity='{:g}'", pen.opacity);
    return text;
}

std::string mark(const PlotStyle& style, double x, double y, double opacity) {
    static constexpr std::array shapes{"m-3 0a3 3 0 1 0 6 0a3 3 0 1 0 -6 0z", "m-3 -3h6v6h-6z", "m0 -4l4 7h-8z",
                                       "m0 -4l4 4l-4 4l-4 -4z", "m-3 -3l6 6m0 -6l-6 6"};
    const auto shape = static_cast<std::size_t>(style.mark) % shapes.size();
    std::string text = fmt::format("<path d='M{:.1f} {:.1f}{}' fill='{}'", x, y, shapes[shape], style.colour);
    if (shape == 4) text += fmt::format(" stroke='{}' stroke-width='1.6'", style.colour);
    if (opacity < 1) text += fmt::format(" opacity='{:g}'", opacity);
    return text + "/>";
}

/// If many points fall into one column of the picture, keeps the first, the lowest, the highest and the last of
/// them.
PlotPoints thinned(const PlotPoints& drawn) {
    constexpr double column = 0.5;
    PlotPoints result;
    for (std::size_t begin = 0, end = 0; begin < drawn.size(); begin = end) {
        const double left = drawn[begin].first;
        std::size_t low = begin, high = begin;
        for (end = begin; end < drawn.size() && std::abs(drawn[end].first - left) < column; ++end) {
            if (drawn[end].second < drawn[low].second) low = end;
            if (drawn[end].second > drawn[high].second) high = end;
        }
        std::vector<std::size_t> kept{begin, std::min(low, high), std::max(low, high), end - 1};
        kept.erase(std::unique(kept.begin(), kept.end()), kept.end());
        for (const std::size_t k : kept) result.push_back(drawn[k]);
    }
    return result;
}

std::string path_of(const PlotPoints& drawn) {
    std::string path;
    char command = 'M';
    for (const auto& [x, y] : thinned(drawn)) {
        path += fmt::format("{}{:.2f} {:.2f}", command, x, y);
        command = 'L';
    }
    return path;
}

}  // namespace

std::string plot_escaped(std::string_view text) {
    std::string legal;
    for (std::size_t i = 0; i < text.size();) {
        const char32_t c = decode(text, i);
        const bool is_text = !is_disturbing(c) && c != 0xFFFE && c != 0xFFFF;
        legal += c == U'\n' || c == U'\t' ? " " : is_text ? encode(c) : "\uFFFD";
    }
    return xml_escaped(legal);
}

double plot_width(std::string_view text, double size) {
    double columns = 0;
    for (std::size_t i = 0; i < text.size();) {
        const char32_t c = decode(text, i);
        columns += c == invalid_character ? 1 : width(c);
    }
    return 0.6 * size * columns;
}

double plot_top(const PlotSheet& sheet) {
    return title_height + line_height * static_cast<double>(sheet.captions.size());
}

std::string plot_begin(const PlotSheet& sheet) {
    std::string svg = fmt::format(
        "<svg xmlns='http://www.w3.org/2000/svg' viewBox='0 0 {0:g} {1:g}' width='{0:g}' height='{1:g}' "
        "role='img' "
        "font-family='sans-serif' font-size='12'>\n<title>{2}</title>\n<desc>{3}</desc>\n"
        "<rect width='{0:g}' height='{1:g}' fill='white'/>\n",
        sheet.width, sheet.height, plot_escaped(sheet.title), plot_escaped(sheet.about));
    svg += plot_text(16, 22, sheet.title, {.size = 15, .bold = true});
    for (std::size_t k = 0; k < sheet.captions.size(); ++k)
        svg += plot_text(16, 24 + line_height * static_cast<double>(k + 1), sheet.captions[k], {.colour = "#555"});
    return svg;
}

std::string plot_end() {
    return "</svg>\n";
}

std::string plot_text(double x, double y, std::string_view text, const PlotFont& font) {
    std::string svg = fmt::format("<text x='{:.1f}' y='{:.1f}' fill='{}'", x, y, font.colour);
    if (font.anchor != PlotAnchor::start) svg += fmt::format(" text-anchor='{}'", word(font.anchor));
    if (font.size != 12) svg += fmt::format(" font-size='{:g}'", font.size);
    if (font.bold) svg += " font-weight='bold'";
    if (font.halo) svg += " paint-order='stroke' stroke='white' stroke-width='3'";
    return svg + ">" + plot_escaped(text) + "</text>\n";
}

std::string plot_axes(const PlotArea& area, const PlotAxes& axes) {
    const auto& [x, y] = area;
    const double width = std::abs(x.end - x.begin), height = std::abs(y.begin - y.end);
    std::string svg, grid;
    for (const PlotTick& tick : x.ticks(std::max(2, static_cast<int>(width / 60)))) {
        grid += fmt::format("M{:.1f} {:g}V{:g}", x.at(tick.value), y.begin, y.end);
        if (axes.x_numbers)
            svg += plot_text(x.at(tick.value), y.begin + 16, tick.label, {.anchor = PlotAnchor::middle});
    }
    for (const PlotTick& tick : y.ticks(std::max(3, static_cast<int>(height / 26)))) {
        grid += fmt::format("M{:g} {:.1f}H{:g}", x.begin, y.at(tick.value), x.end);
        svg +=
            plot_text(std::min(x.begin, x.end) - 6, y.at(tick.value) + 4, tick.label, {.anchor = PlotAnchor::end});
    }
    svg += fmt::format("<path d='{}' stroke='#ddd' fill='none'/>\n", grid);
    svg += fmt::format("<rect x='{:g}' y='{:g}' width='{:g}' height='{:g}' fill='none' stroke='#888'/>\n",
                       std::min(x.begin, x.end), y.end, width, height);
    if (!axes.x.empty())
        svg += plot_text((x.begin + x.end) / 2, y.begin + (axes.x_numbers ? 34 : 18), axes.x,
                         {.anchor = PlotAnchor::middle});
    if (!axes.y.empty())
        svg += fmt::format("<text transform='translate({:g} {:g}) rotate(-90)' text-anchor='middle'>{}</text>\n",
                           std::min(x.begin, x.end) - 54, (y.begin + y.end) / 2, plot_escaped(axes.y));
    return svg;
}

PlotStyle plot_style(std::size_t k) {
    static constexpr std::array colours{"#0072B2", "#D55E00", "#009E73", "#CC79A7",
                                        "#56B4E9", "#E69F00", "#000000"};
    static constexpr std::array dashes{"", "7 3", "2 3", "9 3 2 3", "14 4"};
    static_assert(colours.size() * dashes.size() == plot_styles);
    const std::size_t round = k / colours.size();
    return {colours[k % colours.size()], dashes[round % dashes.size()], static_cast<int>(round % 5)};
}

std::string plot_line(const PlotArea& area, const PlotPoints& points, const PlotStyle& style, const PlotPen& pen) {
    std::string path, marks;
    PlotPoints piece;
    for (std::size_t k = 0; k < points.size(); ++k) {
        const auto& [x, y] = points[k];
        const bool is_drawn = std::isfinite(x) && std::isfinite(y);
        if (!is_drawn || (k > 0 && x == points[k - 1].first)) {
            path += path_of(piece);
            piece.clear();
        }
        if (!is_drawn) continue;
        piece.emplace_back(area.x.at(x), area.y.at(y));
        if (pen.marks) marks += mark(style, piece.back().first, piece.back().second, pen.opacity);
    }
    path += path_of(piece);
    return fmt::format("<path d='{}' {}/>{}\n", path, stroke(style, pen), marks);
}

std::string plot_labels(std::vector<PlotLabel> labels, double x, double top, double bottom) {
    std::stable_sort(labels.begin(), labels.end(),
                     [](const PlotLabel& a, const PlotLabel& b) { return a.y < b.y; });
    const auto count = static_cast<double>(labels.size());
    const double gap = std::min(14.0, (bottom - top) / std::max(1.0, count));
    std::vector<double> rows;
    for (const PlotLabel& label : labels)  // downwards, each below the one before …
        rows.push_back(std::max(std::clamp(label.y, top, bottom), rows.empty() ? top : rows.back() + gap));
    for (std::size_t k = rows.size(); k-- > 0;)  // … and back up from the lower end
        rows[k] = std::min(rows[k], k + 1 == rows.size() ? bottom : rows[k + 1] - gap);
    std::string svg;
    for (std::size_t k = 0; k < labels.size(); ++k) {
        const PlotLabel& label = labels[k];
        svg += fmt::format("<path d='M{:.1f} {:.1f}L{:.1f} {:.1f}H{:.1f}' {}/>", label.x, label.y, x - 24, rows[k],
                           x - 4, stroke(label.style, {.width = 1.4, .opacity = label.opacity}));
        svg += plot_text(x, rows[k] + 4, label.text,
                         {.colour = label.opacity < 1 ? "#666" : "#222", .bold = label.bold});
    }
    return svg;
}

}  // namespace alembert
