// SPDX-License-Identifier: GPL-2.0-or-later
#include "report/work_precision.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace alembert {

namespace {

constexpr double width = 860, height = 520, left = 70, right = 200, top = 44, bottom = 56;
constexpr std::array colours{"#1f6fb4", "#d9541e", "#2a9445", "#8a4fb5", "#b8860b", "#c2338a",
                             "#17889b", "#5b5b5b", "#7a9a01", "#a03c3c", "#3a4fb0", "#00a37a"};

struct Axis {
    int from = 0, to = 1;  ///< decades
    double begin = 0, end = 1;
    double at(double x) const { return begin + (std::log10(x) - from) / (to - from) * (end - begin); }
};

std::string escaped(const std::string& text) {
    std::string result;
    for (const char c : text) result += c == '<' ? "&lt;" : c == '&' ? "&amp;" : std::string(1, c);
    return result;
}

std::string mark(std::size_t kind, double x, double y, const char* colour) {
    switch (kind % 4) {
        case 0:
            return fmt::format("<circle cx='{:.1f}' cy='{:.1f}' r='3.2' fill='{}'/>", x, y, colour);
        case 1:
            return fmt::format("<rect x='{:.1f}' y='{:.1f}' width='6' height='6' fill='{}'/>", x - 3, y - 3,
                               colour);
        case 2:
            return fmt::format("<path d='M{:.1f} {:.1f}l4 7h-8z' fill='{}'/>", x, y - 4, colour);
        default:
            return fmt::format("<path d='M{:.1f} {:.1f}l4 4l-4 4l-4 -4z' fill='{}'/>", x, y - 4, colour);
    }
}

std::string power(int decade) {
    return fmt::format("10<tspan dy='-5' font-size='9'>{}</tspan>", decade);
}

}  // namespace

std::string work_precision(std::vector<Curve> series, const std::string& title) {
    double least[2] = {HUGE_VAL, HUGE_VAL}, most[2] = {0, 0};
    for (Curve& one : series) {
        std::erase_if(one.points, [](const auto& p) {
            return !(p.first > 0 && p.second > 0 && std::isfinite(p.first) && p.first < 1e3);
        });
        std::sort(one.points.begin(), one.points.end(),
                  [](const auto& a, const auto& b) { return a.first > b.first; });
        for (const auto& [error, seconds] : one.points)
            for (int k = 0; k < 2; ++k) {
                const double value = k == 0 ? error : seconds;
                least[k] = std::min(least[k], value);
                most[k] = std::max(most[k], value);
            }
    }
    std::erase_if(series, [](const Curve& one) { return one.points.empty(); });
    std::string svg = fmt::format(
        "<svg xmlns='http://www.w3.org/2000/svg' viewBox='0 0 {0} {1}' width='{0}' height='{1}' "
        "font-family='sans-serif' font-size='12'>\n"
        "<rect width='{0}' height='{1}' fill='white'/>\n<text x='{2}' y='24' font-size='15' "
        "font-weight='bold'>{3}</text>\n",
        width, height, left, escaped(title));
    if (series.empty()) return svg + "<text x='70' y='60'>no run reached the end</text>\n</svg>\n";
    const auto decades = [](double low, double high, double begin, double end) {
        Axis axis{static_cast<int>(std::floor(std::log10(low))), static_cast<int>(std::ceil(std::log10(high))),
                  begin, end};
        if (axis.to == axis.from) ++axis.to;
        return axis;
    };
    const Axis x = decades(least[0], most[0], width - right, left),
               y = decades(least[1], most[1], height - bottom, top);

    for (int d = x.from; d <= x.to; ++d) {
        const double at = x.at(std::pow(10.0, d));
        svg += fmt::format("<path d='M{0:.1f} {1}V{2}' stroke='#ddd'/>", at, top, height - bottom);
        if (x.to - x.from < 9 || (d - x.from) % 2 == 0)
            svg += fmt::format("<text x='{:.1f}' y='{}' text-anchor='middle'>{}</text>\n", at,
                               height - bottom + 20, power(d));
    }
    for (int d = y.from; d <= y.to; ++d) {
        const double at = y.at(std::pow(10.0, d));
        svg += fmt::format(
            "<path d='M{} {:.1f}H{}' stroke='#ddd'/><text x='{}' y='{:.1f}' text-anchor='end'>{}</text>\n", left,
            at, width - right, left - 8, at + 4, power(d));
    }
    svg += fmt::format("<rect x='{}' y='{}' width='{}' height='{}' fill='none' stroke='#888'/>\n", left, top,
                       width - left - right, height - top - bottom);
    svg += fmt::format(
        "<text x='{}' y='{}' text-anchor='middle'>error at the end, max |y − ref| / max(1, |ref|)</text>\n",
        (left + width - right) / 2, height - 14);
    svg += fmt::format(
        "<text transform='translate(18 {}) rotate(-90)' text-anchor='middle'>processor time of the integration, "
        "s</text>\n",
        (top + height - bottom) / 2);

    std::vector<double> errors;
    for (const Curve& one : series)
        for (const auto& p : one.points) errors.push_back(p.first);
    std::nth_element(errors.begin(), errors.begin() + static_cast<std::ptrdiff_t>(errors.size() / 2),
                     errors.end());
    const double middle = errors[errors.size() / 2];
    const auto time_at_middle = [middle](const Curve& one) {
        double best = HUGE_VAL;
        for (const auto& p : one.points)
            if (p.first <= middle) best = std::min(best, p.second);
        return best;
    };
    std::stable_sort(series.begin(), series.end(),
                     [&](const Curve& a, const Curve& b) { return time_at_middle(a) < time_at_middle(b); });

    for (std::size_t k = 0; k < series.size(); ++k) {
        const char* const colour = colours[k % colours.size()];
        const char* const dash = series[k].dashed ? " stroke-dasharray='6 4'" : "";
        std::string line, marks;
        for (const auto& [error, seconds] : series[k].points) {
            line += fmt::format("{}{:.1f} {:.1f}", line.empty() ? "M" : "L", x.at(error), y.at(seconds));
            marks += mark(k, x.at(error), y.at(seconds), colour);
        }
        const double row = top + 12 + 19 * static_cast<double>(k), legend = width - right + 14;
        svg += fmt::format("<path d='{}' fill='none' stroke='{}' stroke-width='1.6'{}/>{}\n", line, colour, dash,
                           marks);
        svg += fmt::format(
            "<path d='M{0} {1}h26' stroke='{2}' stroke-width='1.6'{3}/>{4}<text x='{5}' y='{6}'>{7}</text>\n",
            legend, row, colour, dash, mark(k, legend + 13, row, colour), legend + 34, row + 4,
            escaped(series[k].name));
    }
    return svg + "</svg>\n";
}

}  // namespace alembert
