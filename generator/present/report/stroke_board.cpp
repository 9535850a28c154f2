// SPDX-License-Identifier: GPL-2.0-or-later
#include "present/report/stroke_board.hpp"

#include <algorithm>
#include <cmath>

namespace alembert {

namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;
using Element = FigureElement::Kind;
using Kind = FigureShape::Kind;

Vector3d unit_of(const Vector3d& v) {
    return v.norm() > 0 ? Vector3d(v.normalized()) : v;
}

}  // namespace

StrokeBoard::StrokeBoard(const Drawing& drawn, const std::vector<Pose>& at_poses,
                         const std::vector<std::vector<double>>& coordinates)
    : drawing(drawn), poses(at_poses), q(coordinates) {
    static_cast<FigureView&>(shapes) = figure_view(drawing, poses);
}

Vector2d StrokeBoard::screen(const Vector3d& p) const {
    return {p.dot(shapes.right) * shapes.scale, -p.dot(shapes.up) * shapes.scale};
}
FigureShape& StrokeBoard::put(Kind kind, const std::string& style, std::vector<FigureVertex> vertices) {
    shapes.shapes.push_back({.kind = kind, .style = style, .vertices = std::move(vertices)});
    return shapes.shapes.back();
}
void StrokeBoard::text(const std::string& style, const FigureVertex& vertex, const std::string& words) {
    if (!words.empty()) put(Kind::text, style, {vertex}).text = words;
}
FigureShape& StrokeBoard::line(const std::string& style, int a, int b) {
    return put(Kind::path, style, {vertex_between(a, b, 0, 0, 0, true), vertex_between(a, b, 1)});
}

Vector2d StrokeBoard::free_side(int point) const {
    Vector2d taken(0, 0);
    for (const FigureElement& e : drawing.elements) {
        if (e.kind != Element::rod && e.kind != Element::bar && e.kind != Element::spring &&
            e.kind != Element::tie && e.kind != Element::force && e.kind != Element::rope)
            continue;
        for (std::size_t k = 0; k < 2; ++k) {
            if (e.points[k] != point && !(first()[e.points[k]] - first()[point]).isZero(1e-9)) continue;
            const Vector3d way = e.kind == Element::force ? first()[e.points[1]]
                                                          : Vector3d(first()[e.points[1 - k]] - first()[point]);
            const Vector2d on_screen = screen(way);
            if (on_screen.norm() > 0) taken += on_screen.normalized();
            if (e.kind == Element::force) break;
        }
    }
    return taken.norm() > 0.2 ? Vector2d(-taken.normalized()) : Vector2d(0.8, -0.6);
}

void StrokeBoard::hatch(const FigureVertex& from, const FigureVertex& to, double side, int ticks) {
    std::vector<FigureVertex> marks;
    for (int k = 0; k <= ticks; ++k) {
        FigureVertex v = from;
        const double part = static_cast<double>(k) / ticks;
        v.part += part * (to.part - from.part);
        v.along += part * (to.along - from.along);
        v.begins = true;
        FigureVertex end = v;
        end.begins = false;
        end.across += 8 * side;
        end.along -= 7;
        marks.push_back(v);
        marks.push_back(end);
    }
    put(Kind::path, "hatch", marks);
}

double StrokeBoard::label_side(int a, int b) const {
    const Vector2d way = screen(first()[b] - first()[a]);
    const double sign = std::abs(way[0]) >= std::abs(way[1]) ? (way[0] > 0 ? -1 : 1) : (way[1] > 0 ? -1 : 1);
    return 14 * sign;
}

bool StrokeBoard::is_doubled_on_blocks(int a, int b) const {
    const auto joins = [&](Element kind) {
        return std::any_of(drawing.elements.begin(), drawing.elements.end(), [&](const FigureElement& e) {
            return e.kind == kind && e.points[0] == a && e.points[1] == b;
        });
    };
    const auto ends = [&](int point, bool also_wall) {
        return std::any_of(drawing.elements.begin(), drawing.elements.end(), [&](const FigureElement& e) {
            return e.points[0] == point && (e.kind == Element::block || (also_wall && e.kind == Element::wall));
        });
    };
    return joins(Element::spring) && joins(Element::damper) &&
           ((ends(a, true) && ends(b, false)) || (ends(a, false) && ends(b, true)));
}

double StrokeBoard::half_height_of_block(int point) const {
    constexpr double usual = 11, high = 20;
    for (const FigureElement& e : drawing.elements)
        if (e.kind == Element::damper && (e.points[0] == point || e.points[1] == point) &&
            is_doubled_on_blocks(e.points[0], e.points[1]))
            return high;
    return usual;
}

std::pair<double, double> StrokeBoard::reach(int origin, int end, int point) const {
    double low = 0, high = 0;
    for (const Pose& pose : poses) {
        const double x = (pose[point] - pose[origin]).dot(unit_of(pose[end] - pose[origin]));
        low = std::min(low, x);
        high = std::max(high, x);
    }
    return {low, high};
}

double StrokeBoard::largest_size(int direction) const {
    double size = 0;
    for (const Pose& pose : poses) size = std::max(size, pose[direction].norm());
    return poses.size() > 1 && std::isfinite(size) ? size : 0;
}

}  // namespace alembert
