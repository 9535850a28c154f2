// SPDX-License-Identifier: GPL-2.0-or-later
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/language/say.hpp"
#include "present/report/page.hpp"
#include "present/report/plot.hpp"
#include "present/report/stability_charts.hpp"

namespace alembert {

namespace {

constexpr double locus_width = 560, locus_height = 460, locus_left = 70;

std::size_t most_roots(const RootLocus& locus) {
    std::size_t most = 0;
    for (const Spectra::Roots& roots : locus.roots) most = std::max(most, roots.size());
    return most;
}

std::string edge_in_words(SpectrumOf of) {
    return of == SpectrumOf::multipliers ? say("the unit circle") : say("the imaginary axis");
}

std::string shown_root(std::complex<double> root) {
    return root.imag() == 0 ? fmt::format("{:.10g}", root.real())
                            : fmt::format("{:.6g} +- {:.10g}i", root.real() + 0.0, std::abs(root.imag()));
}

/// The imaginary axis, or the unit circle.
std::string edge_of_locus(const RootLocus& locus, const PlotArea& area) {
    std::string path;
    if (locus.of == SpectrumOf::multipliers) {
        for (int k = 0; k <= 180; ++k)
            path += fmt::format("{}{:.2f} {:.2f}", k == 0 ? "M" : "L", area.x.at(std::cos(M_PI * k / 90)),
                                area.y.at(std::sin(M_PI * k / 90)));
    } else {
        path = fmt::format("M{:.2f} {:.2f}V{:.2f}", area.x.at(0), area.y.begin, area.y.end);
    }
    return fmt::format("<path fill='none' stroke='#222' stroke-width='1.1' d='{}'/>\n", path);
}

}  // namespace

std::string as_svg(const RootLocus& locus) {
    double low_x = HUGE_VAL, high_x = -HUGE_VAL, high_y = 0;
    const bool circle = locus.of == SpectrumOf::multipliers;
    for (const Spectra::Roots& roots : locus.roots)
        for (const auto& root : roots) {
            low_x = std::min(low_x, root.real());
            high_x = std::max(high_x, root.real());
            high_y = std::max(high_y, std::abs(root.imag()));
        }
    if (circle) low_x = std::min(low_x, -1.0), high_x = std::max(high_x, 1.0), high_y = std::max(high_y, 1.0);
    low_x = std::min(low_x, 0.0), high_x = std::max(high_x, 0.0);
    PlotSheet sheet{.width = locus_left + locus_width + 130,
                    .title = locus.title.empty() ? say("Root locus") : locus.title,
                    .about = say("Roots in the complex plane over {}.", locus.name),
                    .captions = {say("{} from {:g} (circles) to {:g} (crosses)", locus.unit.label(locus.name),
                                     locus.from / locus.unit.size, locus.to / locus.unit.size)}};
    const double top = plot_top(sheet) + 10;
    sheet.height = top + locus_height + 56;
    std::string svg = plot_begin(sheet);
    const PlotArea area{linear_scale(low_x, high_x, locus_left, locus_left + locus_width, 0.06),
                        linear_scale(-high_y, high_y, top + locus_height, top, 0.06)};
    svg += plot_axes(area, {.x = say("real part"), .y = say("imaginary part")}) + edge_of_locus(locus, area);
    for (std::size_t k = 0; k < most_roots(locus); ++k) {
        PlotPoints points;
        for (const Spectra::Roots& roots : locus.roots)
            points.emplace_back(k < roots.size() ? roots[k].real() : std::nan(""),
                                k < roots.size() ? roots[k].imag() : std::nan(""));
        const PlotStyle style = plot_style(k);
        std::string path;
        for (const auto& [x, y] : points)
            if (std::isfinite(x))
                path += fmt::format("{}{:.2f} {:.2f}", path.empty() ? "M" : "L", area.x.at(x), area.y.at(y));
        put(svg, "<path fill='none' stroke='{}' stroke-width='1.6' d='{}'/>\n", style.colour, path);
        if (std::isfinite(points.front().first))
            put(svg, "<circle cx='{:.2f}' cy='{:.2f}' r='3.5' fill='none' stroke='{}'/>\n",
                area.x.at(points.front().first), area.y.at(points.front().second), style.colour);
        if (std::isfinite(points.back().first))
            put(svg, "<path d='M{0:.2f} {1:.2f}m-3.5 -3.5l7 7m0 -7l-7 7' stroke='{2}'/>\n",
                area.x.at(points.back().first), area.y.at(points.back().second), style.colour);
    }
    for (const RootLocus::Crossing& one : locus.crossings) {
        const double x = area.x.at(one.root.real()), y = area.y.at(one.root.imag());
        put(svg, "<circle cx='{:.2f}' cy='{:.2f}' r='3' fill='#222'/>\n", x, y);
        svg += plot_text(x + 7, y - 6,
                         fmt::format("{} = {:.6g}", locus.unit.label(locus.name), one.value / locus.unit.size),
                         {.halo = true});
    }
    return svg + plot_end();
}

std::string as_csv(const RootLocus& locus) {
    std::string csv = locus.name;
    const std::size_t count = most_roots(locus);
    for (std::size_t k = 1; k <= count; ++k) put(csv, ",re_{0},im_{0}", k);
    csv += "\n";
    for (std::size_t row = 0; row < locus.values.size(); ++row) {
        put(csv, "{}", locus.values[row]);
        for (std::size_t k = 0; k < count; ++k)
            if (k < locus.roots[row].size())
                put(csv, ",{},{}", locus.roots[row][k].real() + 0.0, locus.roots[row][k].imag() + 0.0);
            else
                csv += ",nan,nan";
        csv += "\n";
    }
    return csv;
}

Json as_json(const RootLocus& locus) {
    Json result;
    result["locus"] = {{"name", locus.name}, {"from", locus.from}, {"to", locus.to}};
    result["values"] = locus.values;
    result["roots"] = Json::array();
    for (const Spectra::Roots& roots : locus.roots) {
        result["roots"].push_back(Json::array());
        for (const auto& root : roots) result["roots"].back().push_back({root.real() + 0.0, root.imag() + 0.0});
    }
    result["without_roots"] = locus.without_roots();
    result["gaps"] = locus.gaps();
    result["jumps"] = locus.jumps;
    result["crossings"] = Json::array();
    for (const RootLocus::Crossing& one : locus.crossings)
        result["crossings"].push_back({{"value", one.value},
                                       {"root", {one.root.real() + 0.0, one.root.imag() + 0.0}},
                                       {"before", one.before},
                                       {"after", one.after},
                                       {"kind", name_of(one.kind)}});
    return result;
}

std::string as_text(const RootLocus& locus) {
    std::string page;
    if (!locus.title.empty()) put(page, "{}\n\n", locus.title);
    say_on(page, "Roots over {} from {:g} to {:g}, in floating point, at {} values.\n",
           locus.unit.label(locus.name), locus.from / locus.unit.size, locus.to / locus.unit.size,
           locus.values.size());
    const std::size_t without = locus.without_roots();
    if (locus.crossings.empty() && without < locus.values.size())
        say_on(page, "None crosses {}.\n", edge_in_words(locus.of));
    if (without > 0)
        say_on(
            page,
            "At {} of {} values no state was found or it has no first approximation; nothing is said of them.\n",
            without, locus.values.size());
    for (const auto& [from, to] : locus.gaps())
        say_on(page, "    {} from {:.6g} to {:.6g}\n", locus.unit.label(locus.name), from / locus.unit.size,
               to / locus.unit.size);
    for (const double jump : locus.jumps)
        say_on(
            page,
            "The roots jump at {} = {:.9g}, as another state is reached there; whether one crosses is unknown.\n",
            locus.unit.label(locus.name), jump / locus.unit.size);
    for (const RootLocus::Crossing& one : locus.crossings)
        say_on(page, "{} = {:.15g}: {} cross{} {} ({}), beyond it are {} before and {} after\n",
               locus.unit.label(locus.name), one.value / locus.unit.size, shown_root(one.root),
               one.root.imag() == 0 ? "es" : "", edge_in_words(locus.of), translated(name_of(one.kind)),
               one.before, one.after);
    return page;
}

}  // namespace alembert
