// SPDX-License-Identifier: GPL-2.0-or-later
#include <algorithm>
#include <cmath>

#include "base/language/say.hpp"
#include "present/report/branches.hpp"
#include "present/report/page.hpp"
#include "scene/units.hpp"

namespace alembert {

namespace {

constexpr double width = 860, left = 78, right = 190, top = 44, bottom = 54, panel = 330, gap = 30;
constexpr std::size_t most_panels = 4;

struct Range {
    double from = HUGE_VAL, to = -HUGE_VAL;
    void take(double x) { from = std::min(from, x), to = std::max(to, x); }
    /// Widens the range a little, so that no line runs along the frame.
    void widen() {
        const double room = to > from ? 0.05 * (to - from) : std::max(0.5, 0.1 * std::abs(from));
        from -= room, to += room;
    }
    double part(double x) const { return (x - from) / (to - from); }
    /// A number, round in a unit of that size, of which five to ten fit into the range.
    double tick(double unit) const {
        const double raw = (to - from) / 6 / unit, power = std::pow(10.0, std::floor(std::log10(raw)));
        const double times = raw / power;
        return unit * power * (times < 1.5 ? 1 : times < 3.5 ? 2 : times < 7.5 ? 5 : 10);
    }
};

std::string escaped(const std::string& text) {
    std::string result;
    for (const char c : text) result += c == '<' ? "&lt;" : c == '&' ? "&amp;" : std::string(1, c);
    return result;
}

const char* dash_of(Stable stable) {
    return stable == Stable::yes  ? ""
           : stable == Stable::no ? " stroke-dasharray='7 5'"
                                  : " stroke-dasharray='1.5 4'";
}

const char* colour_of(PointKind kind) {
    switch (kind) {
        case PointKind::fold:
            return "#d9541e";
        case PointKind::pitchfork:
            return "#8a4fb5";
        case PointKind::transcritical:
            return "#2a9445";
        case PointKind::hopf:
        case PointKind::hamiltonian_hopf:
            return "#c2338a";
        case PointKind::touching:
        case PointKind::family:
            break;
    }
    return "#5b5b5b";
}

struct Panel {
    const Branches& found;
    std::size_t coordinate;
    double y0;                  ///< the height of its upper edge
    UnitOfName p_unit, q_unit;  ///< of the numbers at the ticks
    Range p = {}, q = {};

    double shown(double value) const {
        return found.is_angle[coordinate] ? std::remainder(value, 2 * M_PI) : value;
    }
    double x(double parameter) const { return left + p.part(parameter) * (width - left - right); }
    double y(double value) const { return y0 + (1 - q.part(value)) * panel; }

    void measure() {
        for (const Branch& branch : found.branches)
            for (const BranchPoint& point : branch.points) q.take(shown(point.q[coordinate]));
        if (found.is_angle[coordinate] && q.to - q.from > 4.5) q = {-M_PI, M_PI};
        q.widen();
        p = {std::min(found.from, found.to), std::max(found.from, found.to)};
    }

    void frame(std::string& svg, bool last) const {
        const double p_tick = p.tick(p_unit.size), q_tick = q.tick(q_unit.size);
        for (double at = std::ceil(p.from / p_tick) * p_tick; at <= p.to * (1 + 1e-12); at += p_tick) {
            put(svg, "<path d='M{0:.1f} {1}V{2}' stroke='#e4e4e4'/>", x(at), y0, y0 + panel);
            if (last)
                put(svg, "<text x='{:.1f}' y='{}' text-anchor='middle'>{:.6g}</text>\n", x(at), y0 + panel + 18,
                    at / p_unit.size + 0.0);
        }
        for (double at = std::ceil(q.from / q_tick) * q_tick; at <= q.to; at += q_tick)
            put(svg,
                "<path d='M{0} {1:.1f}H{2}' stroke='#e4e4e4'/><text x='{3}' y='{4:.1f}' "
                "text-anchor='end'>{5:.6g}</text>\n",
                left, y(at), width - right, left - 7, y(at) + 4,
                std::abs(at) < 1e-9 * q_tick ? 0.0 : at / q_unit.size);
        put(svg, "<rect x='{}' y='{}' width='{}' height='{}' fill='none' stroke='#888'/>\n", left, y0,
            width - left - right, panel);
        put(svg, "<text transform='translate(18 {}) rotate(-90)' text-anchor='middle'>{}{}</text>\n",
            y0 + panel / 2, escaped(found.mechanism.q[coordinate].get_name()),
            q_unit.unit.empty() ? "" : ", " + escaped(q_unit.unit));
    }

    /// Draws a line for each stretch of equal stability. An angle that leaves at one edge comes back at the other.
    void curve(std::string& svg, const Branch& branch) const {
        std::string path;
        const auto flush = [&](Stable stable) {
            if (path.find('L') != std::string::npos)
                put(svg, "<path d='{}' fill='none' stroke='#1f6fb4' stroke-width='1.8'{}/>\n", path,
                    dash_of(stable));
            path.clear();
        };
        Stable now = Stable::undecided;
        for (std::size_t k = 0; k < branch.points.size(); ++k) {
            const BranchPoint& point = branch.points[k];
            const double value = shown(point.q[coordinate]);
            const bool jumps = k > 0 && std::abs(value - shown(branch.points[k - 1].q[coordinate])) > M_PI &&
                               found.is_angle[coordinate];
            const Stable stable =
                point.kind && k + 1 < branch.points.size() ? branch.points[k + 1].stable : point.stable;
            const std::string here = fmt::format("{:.2f} {:.2f}", x(point.parameter), y(value));
            if (!jumps && !path.empty()) path += "L" + here;
            if (jumps || stable != now || path.empty()) {
                flush(now);
                path = "M" + here;
                now = stable;
            }
        }
        flush(now);
    }
};

void add_legend(std::string& svg, const Branches& found) {
    double row = top + 12;
    const double at = width - right + 16;
    const auto line = [&](const std::string& words, Stable stable) {
        put(svg,
            "<path d='M{0} {1}h34' stroke='#1f6fb4' stroke-width='1.8'{2}/><text x='{3}' y='{4}'>{5}</text>\n", at,
            row, dash_of(stable), at + 42, row + 4, words);
        row += 20;
    };
    line(say("stable"), Stable::yes);
    line(say("unstable"), Stable::no);
    line(say("undecided"), Stable::undecided);
    std::vector<PointKind> kinds;
    for (const SpecialPoint& point : found.points)
        if (std::find(kinds.begin(), kinds.end(), point.kind) == kinds.end()) kinds.push_back(point.kind);
    for (const PointKind kind : kinds) {
        put(svg, "<circle cx='{}' cy='{}' r='4' fill='{}'/><text x='{}' y='{}'>{}</text>\n", at + 17, row,
            colour_of(kind), at + 42, row + 4, translated(name_of(kind)));
        row += 20;
    }
}

}  // namespace

std::string as_svg(const Branches& found) {
    std::vector<std::size_t> coordinates;
    for (std::size_t i = 0; i < found.essential.size() && coordinates.size() < most_panels; ++i)
        if (found.essential[i]) coordinates.push_back(i);
    const double count = static_cast<double>(std::max<std::size_t>(coordinates.size(), 1));
    const double height = top + count * panel + (count - 1) * gap + bottom;
    const std::string title = found.mechanism.title.empty() ? found.mechanism.name : found.mechanism.title;
    std::string svg = fmt::format(
        "<svg xmlns='http://www.w3.org/2000/svg' viewBox='0 0 {0} {1}' width='{0}' height='{1}' "
        "font-family='sans-serif' font-size='12'>\n<rect width='{0}' height='{1}' fill='white'/>\n<text x='{2}' "
        "y='24' font-size='15' font-weight='bold'>{3}</text>\n",
        width, height, left, escaped(title));
    const UnitOfName parameter = unit_of_name(found.scene, found.parameter);
    double y0 = top;
    for (const std::size_t coordinate : coordinates) {
        Panel one{.found = found,
                  .coordinate = coordinate,
                  .y0 = y0,
                  .p_unit = parameter,
                  .q_unit = unit_of_name(found.scene, found.mechanism.q[coordinate].get_name())};
        one.measure();
        one.frame(svg, coordinate == coordinates.back());
        for (const Branch& branch : found.branches) one.curve(svg, branch);
        for (const SpecialPoint& point : found.points)
            put(svg, "<circle cx='{:.2f}' cy='{:.2f}' r='4' fill='{}'/>\n", one.x(point.parameter),
                one.y(one.shown(point.q[coordinate])), colour_of(point.kind));
        y0 += panel + gap;
    }
    put(svg, "<text x='{}' y='{}' text-anchor='middle'>{}</text>\n", (left + width - right) / 2, height - 14,
        escaped(parameter.label(found.parameter)));
    add_legend(svg, found);
    return svg + "</svg>\n";
}

}  // namespace alembert
