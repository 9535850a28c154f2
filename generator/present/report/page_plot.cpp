// SPDX-License-Identifier: GPL-2.0-or-later
#include "present/report/page_plot.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/language/say.hpp"
#include "present/report/figure_shapes.hpp"
#include "present/report/html.hpp"
#include "present/report/page.hpp"

namespace alembert {

std::vector<double> page_ticks(double low, double high, int count) {
    const double raw = (high - low) / count, decade = std::pow(10, std::floor(std::log10(raw)));
    double step = 10 * decade;
    for (const double nice : {1.0, 2.0, 5.0})
        if (nice * decade >= raw) {
            step = nice * decade;
            break;
        }
    std::vector<double> ticks;
    for (double k = std::ceil(low / step - 1e-9); k * step <= high + 1e-9 * step; ++k) ticks.push_back(k * step);
    return ticks;
}

namespace {

constexpr double width = 420, height = 250, left = 70, right = 22, top = 12, bottom = 40;

struct Range {
    double low, high;
};

Range range_of(const std::vector<const std::vector<double>*>& lists) {
    Range range{INFINITY, -INFINITY};
    for (const auto* list : lists)
        for (const double v : *list)
            if (std::isfinite(v)) range = {std::min(range.low, v), std::max(range.high, v)};
    if (!(range.low <= range.high)) return {0, 1};
    const double size = std::max(std::abs(range.low), std::abs(range.high));
    if (range.high - range.low <= 1e-12 * size || size == 0) {
        const double half = size > 0 ? 0.05 * size : 1;
        return {range.low - half, range.high + half};
    }
    const double room = 0.06 * (range.high - range.low);
    return {range.low - room, range.high + room};
}

std::string power_of_ten(const std::string& number) {
    const std::size_t e = number.find('e');
    if (e == std::string::npos) return number;
    const int power = std::stoi(number.substr(e + 1));
    return number.substr(0, e) + "·10<tspan class=\"power\" dy=\"-4\">" + std::to_string(power) + "</tspan>";
}

std::string tick_text(double value, double step) {
    if (std::abs(value) < 1e-9 * step) return "0";
    if (std::abs(value) >= 1e5 || std::abs(value) < 1e-3) return power_of_ten(fmt::format("{:.3g}", value));
    const int digits = std::clamp(static_cast<int>(-std::floor(std::log10(step) + 1e-9)), 0, 6);
    return fmt::format("{:.{}f}", value, digits);
}

/// The numbers along an axis. Where they differ only after many digits, they count from a round number that the
/// axis's name shows, as in "E + 3.6478 in J".
struct Ticks {
    std::vector<double> at;
    double step = 1;
    std::string base = "0";  ///< a decimal

    Ticks(const Range& range, int count) : at(page_ticks(range.low, range.high, count)) {
        if (at.size() > 1) step = at[1] - at[0];
        const double size = std::max(std::abs(range.low), std::abs(range.high));
        constexpr double readable = 1e-4;
        if (step >= readable * size || !std::isfinite(range.high - range.low)) return;
        const double middle = (range.low + range.high) / 2;
        const int digits = static_cast<int>(std::log10(size / (range.high - range.low)));
        base = fmt::format("{:.{}g}", middle, digits + 1);
    }

    std::string text(double value) const {
        // The base is a multiple of a fifth of the step; what is less is rounding of values that are hardly apart.
        const double part = std::round((value - std::stod(base)) / step * 100) / 100;
        return tick_text(part * step, step);
    }
    /// "+ 3.6478" after the name of what is shown.
    std::string shift() const {
        if (base == "0") return "";
        return base.starts_with("-") ? " + " + power_of_ten(base.substr(1)) : " − " + power_of_ten(base);
    }
};

std::string axis_label(const std::string& name, const std::string& shift, const std::string& unit) {
    const std::string in = (name.empty() && shift.empty()) || unit.empty() ? "" : say(" in ");
    return "<tspan class=\"letters\">" + svg_letters(name) + "</tspan>" + "<tspan" +
           (name.find_first_of("_0123456789") == std::string::npos ? "" : " dy=\"-4\"") + ">" + shift + in +
           html(unit) + "</tspan>";
}

std::string path(const std::vector<double>& x, const std::vector<double>& y, const Range& xs, const Range& ys,
                 bool points) {
    std::string d;
    bool pen_down = false;
    for (std::size_t k = 0; k < x.size(); ++k) {
        if (!std::isfinite(x[k]) || !std::isfinite(y[k])) {
            pen_down = false;
            continue;
        }
        put(d, "{}{:.1f} {:.1f}", pen_down ? "L" : "M",
            left + (x[k] - xs.low) / (xs.high - xs.low) * (width - left - right),
            height - bottom - (y[k] - ys.low) / (ys.high - ys.low) * (height - top - bottom));
        if (points) d += "h0";
        pen_down = !points;
    }
    return d;
}

}  // namespace

std::string page_plot(const PagePlotLabels& labels, const std::vector<double>& x,
                      const std::vector<PagePlotLine>& lines, int x_column) {
    std::vector<const std::vector<double>*> all;
    std::vector<const std::vector<double>*> all_x{&x};
    for (const PagePlotLine& line : lines) {
        all.push_back(&line.y);
        all_x.push_back(&line.x);
    }
    const bool over_time = x_column < 0 && !labels.points;
    Range xs = range_of(all_x);
    if (over_time && !x.empty() && x.front() < x.back()) xs = {x.front(), x.back()};
    const Range ys = range_of(all);
    std::string columns;
    for (const PagePlotLine& line : lines) columns += fmt::format("{}{}", columns.empty() ? "" : ",", line.column);
    std::string page;
    put(page, "<figure class=\"plot\">\n<svg viewBox=\"0 0 {} {}\" role=\"img\" aria-label=\"{}\"", width, height,
        html(say("{} over {}", labels.title + (labels.points ? ": " + labels.y_name : ""), labels.x_name)));
    if (!labels.points)
        put(page,
            " data-columns=\"{}\" data-x-column=\"{}\" data-x=\"{:.17g},{:.17g}\" data-y=\"{:.17g},{:.17g}\"",
            columns, x_column, xs.low, xs.high, ys.low, ys.high);
    put(page, ">\n");
    const auto to_x = [&](double v) { return left + (v - xs.low) / (xs.high - xs.low) * (width - left - right); };
    const auto to_y = [&](double v) {
        return height - bottom - (v - ys.low) / (ys.high - ys.low) * (height - top - bottom);
    };
    const Ticks x_ticks(xs, 6), y_ticks(ys, 5);
    for (const double v : x_ticks.at)
        put(page,
            "<path class=\"grid\" d=\"M{0:.1f} {1}V{2}\"/><text class=\"tick\" x=\"{0:.1f}\" y=\"{3}\" "
            "text-anchor=\"middle\">{4}</text>\n",
            to_x(v), top, height - bottom, height - bottom + 15, x_ticks.text(v));
    for (const double v : y_ticks.at)
        put(page,
            "<path class=\"grid\" d=\"M{} {:.1f}H{}\"/><text class=\"tick\" x=\"{}\" y=\"{:.1f}\" "
            "text-anchor=\"end\">{}</text>\n",
            left, to_y(v), width - right, left - 5, to_y(v) + 4, y_ticks.text(v));
    if (labels.axes && xs.low < 0 && xs.high > 0)
        put(page, "<path class=\"frame\" d=\"M{:.1f} {}V{}\"/>\n", to_x(0), top, height - bottom);
    if (labels.axes && ys.low < 0 && ys.high > 0)
        put(page, "<path class=\"frame\" d=\"M{} {:.1f}H{}\"/>\n", left, to_y(0), width - right);
    put(page, "<path class=\"frame\" d=\"M{0} {1}V{2}H{3}\"/>\n", left, top, height - bottom, width - right);
    put(page, "<text class=\"axis-label\" x=\"{}\" y=\"{}\" text-anchor=\"middle\">{}</text>\n",
        (left + width - right) / 2, height - 6, axis_label(labels.x_name, x_ticks.shift(), labels.x_unit));
    put(page,
        "<text class=\"axis-label\" transform=\"translate(12 {}) rotate(-90)\" text-anchor=\"middle\">{}</text>\n",
        (top + height - bottom) / 2, axis_label(labels.y_name, y_ticks.shift(), labels.y_unit));
    for (std::size_t k = 0; k < lines.size(); ++k)
        put(page, "<path class=\"line c{}{}\" d=\"{}\"/>\n", k % 7,
            labels.points ? lines[k].y.size() > 40 ? " points small" : " points"
            : k >= 7      ? " dashed"
                          : "",
            path(lines[k].x.empty() ? x : lines[k].x, lines[k].y, xs, ys, labels.points));
    put(page, "</svg>\n<figcaption><span class=\"plot-title\">{}</span>", html(labels.title));
    for (std::size_t k = 0; k < lines.size() && labels.points && lines.size() > 1; ++k)
        put(page,
            " <span class=\"key\"><svg class=\"swatch\" viewBox=\"0 0 22 8\" aria-hidden=\"true\"><path "
            "class=\"line c{} points\" d=\"M11 4h0\"/></svg>{}</span>",
            k % 7, html(lines[k].name));
    for (std::size_t k = 0; k < lines.size() && over_time; ++k)
        put(page,
            " <span class=\"key\"><svg class=\"swatch\" viewBox=\"0 0 22 8\" aria-hidden=\"true\"><path "
            "class=\"line c{}{}\" d=\"M1 4H21\"/></svg><span class=\"letters\">{}</span> <output "
            "data-column=\"{}\"></output></span>",
            k % 7, k >= 7 ? " dashed" : "", html_letters(lines[k].name), lines[k].column);
    return page + "</figcaption>\n</figure>\n";
}

}  // namespace alembert
