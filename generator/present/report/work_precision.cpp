// SPDX-License-Identifier: GPL-2.0-or-later
#include "present/report/work_precision.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/language/say.hpp"
#include "present/report/plot.hpp"

namespace alembert {

namespace {

constexpr double width = 900, height = 560, left = 84, bottom_room = 56, least_right = 120;
constexpr double largest_error = 1, largest_useful = 0.1;  // with a larger error no digit is right

void clean(std::vector<Curve>& curves) {
    for (Curve& one : curves) {
        std::erase_if(one.points, [](const auto& p) {
            return !(p.first > 0 && p.second > 0 && std::isfinite(p.second) && p.first <= largest_error);
        });
        std::sort(one.points.begin(), one.points.end(),
                  [](const auto& a, const auto& b) { return a.first > b.first; });
    }
    std::erase_if(curves, [](const Curve& one) { return one.points.empty(); });
}

/// The least time at which a curve reaches an error.
double time_to(const Curve& curve, double error) {
    double best = std::numeric_limits<double>::infinity();
    for (const auto& p : curve.points)
        if (p.first <= error) best = std::min(best, p.second);
    return best;
}

/// Which curves are the fastest for one of the errors 10⁻ᵏ in the picture?
std::vector<bool> fastest(const std::vector<Curve>& curves, const PlotScale& errors) {
    std::vector<bool> result(curves.size(), false);
    for (double error = errors.low; error <= 1.01 * largest_useful; error *= 10) {
        const auto best = std::min_element(curves.begin(), curves.end(), [error](const Curve& a, const Curve& b) {
            return time_to(a, error) < time_to(b, error);
        });
        if (std::isfinite(time_to(*best, error))) result[static_cast<std::size_t>(best - curves.begin())] = true;
    }
    return result;
}

PlotArea area_of(const std::vector<Curve>& curves, double top, double right) {
    double least[2] = {HUGE_VAL, HUGE_VAL}, most[2] = {0, 0};
    for (const Curve& one : curves)
        for (const auto& [error, seconds] : one.points)
            for (int k = 0; k < 2; ++k) {
                const double value = k == 0 ? error : seconds;
                least[k] = std::min(least[k], value);
                most[k] = std::max(most[k], value);
            }
    return {decade_scale(least[0], most[0], width - right, left),
            decade_scale(least[1], most[1], height - bottom_room, top)};
}

}  // namespace

std::string work_precision(std::vector<Curve> curves, const std::string& title) {
    clean(curves);
    PlotSheet sheet{.width = width, .height = height, .title = title, .captions = {}};
    if (curves.empty()) {
        sheet.captions.emplace_back(say("no run reached the end"));
        return plot_begin(sheet) + plot_end();
    }
    double right = least_right;
    for (const Curve& one : curves) right = std::max(right, 52 + plot_width(one.name));
    const PlotArea area = area_of(curves, plot_top(sheet) + 16, right);
    const std::vector<bool> wins = fastest(curves, area.x);
    sheet.about = say("Processor time over the error, both logarithmic. Fastest at some error:");
    for (std::size_t k = 0; k < curves.size(); ++k)
        if (wins[k]) sheet.about += " " + curves[k].name;
    std::string svg = plot_begin(sheet);
    svg += plot_axes(area, {.x = say("error at the end, max |y − ref| / max(1, |ref|)"),
                            .y = say("processor time of the integration, s")});
    std::vector<PlotLabel> labels;
    std::size_t style = 0;
    std::string pale, strong;
    for (const bool is_strong :
         {true, false})  // the strong ones have the plainest styles and are drawn above the others
        for (std::size_t k = 0; k < curves.size(); ++k) {
            if (wins[k] != is_strong) continue;
            const PlotStyle drawn = plot_style(style++);
            const double opacity = is_strong ? 1 : 0.45;
            (is_strong ? strong : pale) +=
                plot_line(area, curves[k].points, drawn,
                          {.width = is_strong ? 2.4 : 1.2, .opacity = opacity, .marks = true});
            const auto& [error, seconds] = curves[k].points.back();
            labels.push_back({area.x.at(error), area.y.at(seconds), curves[k].name, drawn, opacity, is_strong});
        }
    svg += pale + plot_labels(labels, width - right + 44, area.y.end + 4, area.y.begin - 4) + strong;
    return svg + plot_end();
}

}  // namespace alembert
