// SPDX-License-Identifier: GPL-2.0-or-later
#include "present/report/figure_annotations.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace alembert {

namespace {

/// The head of an arrow whose tip is at `part` = 1 and `along` = 0.
std::vector<FigureVertex> arrow_head(int a, int b) {
    return {vertex_between(a, b, 1, -4.5, -11, true), vertex_between(a, b, 1), vertex_between(a, b, 1, 4.5, -11)};
}

}  // namespace

void add_arrow(StrokeBoard& board, const FigureElement& e) {
    const int a = e.points[0], d = e.points[1];
    const std::string style = e.kind == FigureElement::Kind::force     ? "force"
                              : e.kind == FigureElement::Kind::waiting ? "waiting"
                                                                       : "impulse";
    std::vector<FigureVertex> arrow{vertex_between(a, d, 0, 0, 0, true), vertex_between(a, d, 1)};
    const std::vector<FigureVertex> tip = arrow_head(a, d);
    arrow.insert(arrow.end(), tip.begin(), tip.end());
    FigureShape& shape = board.put(FigureShape::Kind::path, style, arrow);
    shape.vector = d;
    shape.full = e.kind == FigureElement::Kind::force ? board.largest_size(d) : 0;
    if (e.label.empty()) return;
    FigureShape& name = board.put(FigureShape::Kind::text, style + "-name", {vertex_between(a, d, 1, 12, 6)});
    name.text = e.label;
    name.vector = d;
    name.full = e.kind == FigureElement::Kind::force ? board.largest_size(d) : 0;
}

void add_torque(StrokeBoard& board, const FigureElement& e) {
    std::vector<FigureVertex> bow;
    constexpr int steps = 24;
    // Several torques at one place are drawn around each other.
    double r = 24;
    for (const FigureElement& other : board.drawing.elements) {
        if (&other == &e) break;
        if (other.kind == e.kind && other.points[0] == e.points[0]) r += 12;
    }
    for (int k = 0; k <= steps; ++k) {
        const double angle = -0.3 - 1.5 * std::numbers::pi * k / steps;
        bow.push_back(vertex_at(e.points[0], r * std::cos(angle), r * std::sin(angle), k == 0));
    }
    const double end = -0.3 - 1.5 * std::numbers::pi;
    const Eigen::Vector2d tip(r * std::cos(end), r * std::sin(end)), along(std::sin(end), -std::cos(end)),
        out(std::cos(end), std::sin(end));
    for (const double side : {-4.5, 4.5}) {
        const Eigen::Vector2d barb = tip - 10 * along + side * out;
        bow.push_back(vertex_at(e.points[0], barb[0], barb[1], true));
        bow.push_back(vertex_at(e.points[0], tip[0], tip[1]));
    }
    board.put(FigureShape::Kind::path, "force", bow);
    board.text("force-name", vertex_at(e.points[0], r + 6, 8 - r), e.label);
}

void add_gravity(StrokeBoard& board, const FigureElement& e) {
    std::vector<FigureVertex> arrow{vertex_between(-1, e.points[0], 0, 0, 0, true),
                                    vertex_between(-1, e.points[0], 1)};
    const std::vector<FigureVertex> tip = arrow_head(-1, e.points[0]);
    arrow.insert(arrow.end(), tip.begin(), tip.end());
    board.put(FigureShape::Kind::path, "gravity", arrow).vector = e.points[0];
    FigureShape& name =
        board.put(FigureShape::Kind::text, "gravity-name", {vertex_between(-1, e.points[0], 0.5, 11)});
    name.text = e.label;
    name.vector = e.points[0];
}

void add_axes(StrokeBoard& board, const FigureElement& e) {
    const std::vector<int>& p = e.points;
    for (int k = 0; k < 3; ++k) {
        if (board.shapes.is_plane && k == board.drawing.normal) continue;
        const double length = 40;
        board
            .put(FigureShape::Kind::path, "axis",
                 {vertex_between(p[0], p[k + 1], 0, 0, 0, true), vertex_between(p[0], p[k + 1], 0, 0, length),
                  vertex_between(p[0], p[k + 1], 0, -3, length - 7, true),
                  vertex_between(p[0], p[k + 1], 0, 0, length), vertex_between(p[0], p[k + 1], 0, 3, length - 7)})
            .inside = 2;
        FigureShape& name = board.put(FigureShape::Kind::text, "axis-name",
                                      {vertex_between(p[0], p[k + 1], 0, 0, length + 9), vertex_at(p[0])});
        name.text = std::string(1, static_cast<char>('x' + k));
        name.inside = 9;
    }
}

void add_angle(StrokeBoard& board, const FigureElement& e) {
    const std::vector<int>& p = e.points;
    const double arm = board.screen(board.first()[p[2]] - board.first()[p[0]]).norm();
    const double radius = std::min(34.0 + 7 * (board.angles++ % 3), std::max(0.7 * arm, 14.0));
    board.put(FigureShape::Kind::path, "reference",
              {vertex_between(p[0], p[1], 0, 0, 0, true), vertex_between(p[0], p[1], 0, 0, radius + 18)});
    if (e.size > 0)
        board.put(FigureShape::Kind::path, "reference",
                  {vertex_between(p[0], p[2], 0, 0, 0, true), vertex_between(p[0], p[2], 0, 0, radius + 18)});
    double turn = 1;
    for (std::size_t k = 0; k < board.poses.size(); ++k) {
        const Eigen::Vector2d from = board.screen(board.poses[k][p[1]] - board.poses[k][p[0]]),
                              to = board.screen(board.poses[k][p[2]] - board.poses[k][p[0]]);
        const double side = from[0] * to[1] - from[1] * to[0];
        const double size = std::remainder(board.q[k][e.coordinate], 2 * std::numbers::pi);
        if (std::abs(side) < 1e-6 * from.norm() * to.norm() || std::abs(size) < 1e-6) continue;
        turn = (side > 0) == (size > 0) ? 1 : -1;
        break;
    }
    for (const FigureShape::Kind kind : {FigureShape::Kind::arc, FigureShape::Kind::angle_text}) {
        FigureShape& arc = board.put(kind, kind == FigureShape::Kind::arc ? "angle" : "angle-name",
                                     {vertex_at(p[0]), vertex_at(p[1]), vertex_at(p[2])});
        arc.size = radius;
        arc.turn = turn;
        arc.coordinate = board.shapes.is_plane ? e.coordinate : -1;
        arc.text = kind == FigureShape::Kind::arc ? "" : e.label;
    }
}

void add_length(StrokeBoard& board, const FigureElement& e) {
    const int a = e.points[0], b = e.points[1];
    const double off = 26 + 9 * (board.lengths++ % 3);
    constexpr double shortest = 16;
    const std::size_t first_shape = board.shapes.shapes.size();
    board.put(FigureShape::Kind::path, "reference",
              {vertex_between(a, b, 0, 0, 0, true), vertex_between(a, b, 0, off + 4),
               vertex_between(a, b, 1, 0, 0, true), vertex_between(a, b, 1, off + 4)});
    board.put(FigureShape::Kind::path, "dimension",
              {vertex_between(a, b, 0, off, 0, true), vertex_between(a, b, 1, off),
               vertex_between(a, b, 1, off - 3, -7, true), vertex_between(a, b, 1, off),
               vertex_between(a, b, 1, off + 3, -7), vertex_between(a, b, 0, off - 3, 7, true),
               vertex_between(a, b, 0, off), vertex_between(a, b, 0, off + 3, 7)});
    board.text("dimension-name", vertex_between(a, b, 0.5, off + 11), e.label);
    for (std::size_t k = first_shape; k < board.shapes.shapes.size(); ++k) {
        board.shapes.shapes[k].least = shortest;
        board.shapes.shapes[k].from = a;
        board.shapes.shapes[k].to = b;
    }
    if (board.shapes.follows)  // a dimension line may reach out of a picture that moves with the masses
        for (std::size_t k = first_shape; k < board.shapes.shapes.size(); ++k) board.shapes.shapes[k].inside = 7;
    if (e.points.size() < 3) return;
    const std::size_t arrow = board.shapes.shapes.size();
    const int c = e.points[2];
    board.put(FigureShape::Kind::path, "dimension",
              {vertex_between(b, c, 0, off, 0, true), vertex_between(b, c, 0, off, 24),
               vertex_between(b, c, 0, off - 3, 17, true), vertex_between(b, c, 0, off, 24),
               vertex_between(b, c, 0, off + 3, 17), vertex_between(b, c, 0, off - 5, 0, true),
               vertex_between(b, c, 0, off + 5, 0)});
    board.text("dimension-name", vertex_between(b, c, 0, off, 34), e.label);
    for (std::size_t k = arrow; k < board.shapes.shapes.size(); ++k) {
        board.shapes.shapes[k].most = shortest;
        board.shapes.shapes[k].from = a;
        board.shapes.shapes[k].to = b;
    }
}

}  // namespace alembert
