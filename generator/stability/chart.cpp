// SPDX-License-Identifier: GPL-2.0-or-later
#include "stability/chart.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include "alembert/base/argument.hpp"
#include "alembert/base/error.hpp"
#include "base/language/say.hpp"

namespace alembert {

namespace {

constexpr double close_enough = 0.01;  // pixels
constexpr int deepest = 7;             // times that a piece is halved

void check_axis(const Axis& axis) {
    if (!(std::isfinite(axis.from) && std::isfinite(axis.to)) || axis.from == axis.to || axis.count < 2)
        throw ModelError(say("{}: expected a range of two different numbers, and at least two values", axis.name));
}

/// Work in pixels; kinds of the corners of cells.
class Charting {
public:
    Charting(StabilityChart& chart, const Spectra& spectra, const ChartOptions& options)
        : chart_(chart), spectra_(spectra), options_(options) {}

    void go() {
        for (std::size_t i = 0; i < chart_.x.count; ++i) {
            if (options_.progress)
                options_.progress(say("the grid"),
                                  0.5 * static_cast<double>(i) / static_cast<double>(chart_.x.count));
            for (std::size_t j = 0; j < chart_.y.count; ++j) {
                const auto roots = roots_at(node(i, j));
                chart_.kinds.push_back(roots ? kind_of(*roots, chart_.of) : SpectrumKind::none);
                chart_.beyond.push_back(roots ? beyond(*roots, chart_.of) : std::nan(""));
            }
        }
        for (std::size_t i = 0; i + 1 < chart_.x.count; ++i) {
            if (options_.progress)
                options_.progress(say("the boundary"),
                                  0.5 + 0.5 * static_cast<double>(i) / static_cast<double>(chart_.x.count));
            for (std::size_t j = 0; j + 1 < chart_.y.count; ++j) look_at_cell(i, j);
        }
        join();
    }

private:
    using Pixel = ChartPoint;
    /// A side of a cell: its lower or left node, and whether it goes up.
    using Side = std::array<std::size_t, 3>;
    struct Segment {
        Side from, to;
        std::vector<Pixel> points;  ///< both ends included
    };

    double part(const Axis& axis, std::size_t k) const {
        return static_cast<double>(k) / static_cast<double>(axis.count - 1);
    }
    Pixel node(std::size_t i, std::size_t j) const {
        return {part(chart_.x, i) * chart_width, part(chart_.y, j) * chart_height};
    }
    ChartPoint values(const Pixel& p) const {
        return {chart_.x.from + (chart_.x.to - chart_.x.from) * p.x / chart_width,
                chart_.y.from + (chart_.y.to - chart_.y.from) * p.y / chart_height};
    }
    std::optional<Spectra::Roots> roots_at(const Pixel& p) {
        ++chart_.evaluations;
        const ChartPoint v = values(p);
        return spectra_.at({v.x, v.y});
    }
    bool unstable(const Pixel& p) {
        const auto roots = roots_at(p);
        return roots && is_unstable(kind_of(*roots, chart_.of));
    }

    /// Between two pixels of which `a` alone is unstable, or `b` alone.
    Pixel between(Pixel a, Pixel b, bool a_unstable) {
        while (std::hypot(a.x - b.x, a.y - b.y) > close_enough / 2) {
            const Pixel middle{(a.x + b.x) / 2, (a.y + b.y) / 2};
            (unstable(middle) == a_unstable ? a : b) = middle;
        }
        return {(a.x + b.x) / 2, (a.y + b.y) / 2};
    }

    /// Points between two of the boundary.
    void divide(const Pixel& a, const Pixel& b, int depth, std::vector<Pixel>& into) {
        const double length = std::hypot(b.x - a.x, b.y - a.y);
        if (depth > deepest || length < 2 * close_enough) return;
        const Pixel middle{(a.x + b.x) / 2, (a.y + b.y) / 2};
        const double nx = -(b.y - a.y) / length, ny = (b.x - a.x) / length;
        const auto beside = [&](double by) { return Pixel{middle.x + by * nx, middle.y + by * ny}; };
        if (unstable(beside(close_enough)) != unstable(beside(-close_enough))) return;
        const bool here = unstable(middle);
        for (double reach = 4 * close_enough; reach <= length; reach *= 3)
            for (const double side : {reach, -reach}) {
                if (unstable(beside(side)) == here) continue;
                const Pixel found = between(middle, beside(side), here);
                divide(a, found, depth + 1, into);
                into.push_back(found);
                divide(found, b, depth + 1, into);
                return;
            }
    }

    const Pixel& crossing(const Side& side) {
        const auto known = crossings_.find(side);
        if (known != crossings_.end()) return known->second;
        const auto [i, j, up] = side;
        const std::size_t i2 = up ? i : i + 1, j2 = up ? j + 1 : j;
        return crossings_[side] = between(node(i, j), node(i2, j2), is_unstable(chart_.kind(i, j)));
    }

    void look_at_cell(std::size_t i, std::size_t j) {
        // Corners counter-clockwise from the lower left; side k from corner k to the next.
        const std::array<std::array<std::size_t, 2>, 4> corner{{{i, j}, {i + 1, j}, {i + 1, j + 1}, {i, j + 1}}};
        const std::array<Side, 4> side{{{i, j, 0}, {i + 1, j, 1}, {i, j + 1, 0}, {i, j, 1}}};
        std::array<bool, 4> bad{};
        SpectrumKind kind = SpectrumKind::flutter;
        for (std::size_t k = 0; k < 4; ++k) {
            const SpectrumKind own = chart_.kind(corner[k][0], corner[k][1]);
            if (own == SpectrumKind::none) return;
            bad[k] = is_unstable(own);
            if (bad[k]) kind = own;
        }
        std::vector<std::size_t> crossed;
        for (std::size_t k = 0; k < 4; ++k)
            if (bad[k] != bad[(k + 1) % 4]) crossed.push_back(k);
        if (crossed.empty()) return;
        if (crossed.size() == 4) {  // a saddle: the middle says which corners belong together
            const Pixel a = node(i, j), b = node(i + 1, j + 1);
            const bool middle = unstable({(a.x + b.x) / 2, (a.y + b.y) / 2});
            if (middle == bad[0])
                crossed = {0, 1, 2, 3};  // corners 1 and 3 are cut off
            else
                crossed = {3, 0, 1, 2};
        }
        std::vector<Segment> own;
        for (std::size_t k = 0; k + 1 < crossed.size(); k += 2) {
            Segment s{side[crossed[k]], side[crossed[k + 1]], {}};
            s.points.push_back(crossing(s.from));
            const Pixel a = crossing(s.from), b = crossing(s.to);
            divide(a, b, 0, s.points);
            s.points.push_back(b);
            own.push_back(s);
            segments_.push_back(s);
        }
        if (crossed.size() == 2)
            add_piece(kind, corner, bad, crossed, own[0]);
        else
            add_saddle(kind, corner, bad, crossed, own);
    }

    /// The unstable corners of a cell that one piece of the boundary crosses.
    void add_piece(SpectrumKind kind, const std::array<std::array<std::size_t, 2>, 4>& corner,
                   const std::array<bool, 4>& bad, const std::vector<std::size_t>& crossed, const Segment& cut) {
        StabilityChart::Piece piece{kind, {}};
        for (const Pixel& p : cut.points) piece.polygon.push_back(values(p));
        // From the end of the cut around the cell on its unstable side.
        const bool forward = bad[(crossed[1] + 1) % 4];
        for (std::size_t step = 0; step < 4; ++step) {
            const std::size_t k = forward ? (crossed[1] + 1 + step) % 4 : (crossed[1] + 4 - step) % 4;
            if (!bad[k]) break;
            piece.polygon.push_back(values(node(corner[k][0], corner[k][1])));
        }
        chart_.pieces.push_back(std::move(piece));
    }

    void add_saddle(SpectrumKind kind, const std::array<std::array<std::size_t, 2>, 4>& corner,
                    const std::array<bool, 4>& bad, const std::vector<std::size_t>& crossed,
                    const std::vector<Segment>& cuts) {
        const std::size_t cut_off = crossed[1];  // the corner between the two sides of the first cut
        if (bad[cut_off]) {
            for (std::size_t c = 0; c < 2; ++c) {
                StabilityChart::Piece piece{kind, {}};
                for (const Pixel& p : cuts[c].points) piece.polygon.push_back(values(p));
                const auto& at = corner[(cut_off + 2 * c) % 4];
                piece.polygon.push_back(values(node(at[0], at[1])));
                chart_.pieces.push_back(std::move(piece));
            }
            return;
        }
        StabilityChart::Piece piece{kind, {}};
        for (std::size_t c = 0; c < 2; ++c) {
            for (const Pixel& p : cuts[c].points) piece.polygon.push_back(values(p));
            const auto& at = corner[(cut_off + 1 + 2 * c) % 4];
            piece.polygon.push_back(values(node(at[0], at[1])));
        }
        chart_.pieces.push_back(std::move(piece));
    }

    /// Pieces that share a side of a cell become one line.
    void join() {
        std::multimap<Side, std::size_t> at;
        for (std::size_t k = 0; k < segments_.size(); ++k) {
            at.emplace(segments_[k].from, k);
            at.emplace(segments_[k].to, k);
        }
        std::vector<bool> used(segments_.size(), false);
        const auto next = [&](const Side& side) -> std::optional<std::size_t> {
            const auto [begin, end] = at.equal_range(side);
            for (auto it = begin; it != end; ++it)
                if (!used[it->second]) return it->second;
            return {};
        };
        for (std::size_t k = 0; k < segments_.size(); ++k) {
            if (used[k]) continue;
            used[k] = true;
            std::vector<Pixel> line = segments_[k].points;
            for (const bool forward : {true, false}) {
                Side end = forward ? segments_[k].to : segments_[k].from;
                for (auto more = next(end); more; more = next(end)) {
                    used[*more] = true;
                    const Segment& s = segments_[*more];
                    std::vector<Pixel> points = s.points;
                    if (s.from != end) std::reverse(points.begin(), points.end());
                    end = s.from == end ? s.to : s.from;
                    line.insert(line.end(), points.begin() + 1, points.end());
                }
                std::reverse(line.begin(), line.end());
            }
            std::vector<ChartPoint> curve;
            for (const Pixel& p : line) curve.push_back(values(p));
            chart_.boundaries.push_back(std::move(curve));
        }
    }

    StabilityChart& chart_;
    const Spectra& spectra_;
    const ChartOptions& options_;
    std::map<Side, Pixel> crossings_;
    std::vector<Segment> segments_;
};

}  // namespace

StabilityChart stability_chart(Scene scene, const Axis& x, const Axis& y, const ChartOptions& options) {
    argument::need_positive_if_given("period", options.stability.period);
    check_axis(x);
    check_axis(y);
    if (x.name == y.name) throw ModelError(say("{} is varied twice; expected two parameters", x.name));
    const UnitOfName x_unit = unit_of_name(scene, x.name), y_unit = unit_of_name(scene, y.name);
    const Spectra spectra(std::move(scene), options.stability, {x.name, y.name},
                          {x.from + 0.47 * (x.to - x.from), y.from + 0.53 * (y.to - y.from)});
    StabilityChart chart{
        .title = spectra.title(), .of = spectra.of(), .x = x, .y = y, .x_unit = x_unit, .y_unit = y_unit};
    Charting(chart, spectra, options).go();
    return chart;
}

}  // namespace alembert
