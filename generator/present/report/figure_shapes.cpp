// SPDX-License-Identifier: GPL-2.0-or-later
#include "present/report/figure_shapes.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "present/report/figure_annotations.hpp"
#include "present/report/figure_screen.hpp"
#include "present/report/figure_supports.hpp"

namespace alembert {

namespace {

using Eigen::Vector2d;
using Element = FigureElement::Kind;
using Kind = FigureShape::Kind;

/// What has a higher number is drawn over what has a lower one.
int layer_of(Element kind) {
    switch (kind) {
        case Element::floor:
        case Element::guide:
        case Element::curve:
        case Element::wall:
        case Element::ground:
        case Element::line:
        case Element::hoop:
        case Element::axes:
        case Element::gravity:
        case Element::support:
        case Element::ground_plane:
            return 0;
        case Element::pin:
        case Element::disc:
            return 2;
        case Element::mark:
        case Element::angle:
        case Element::length:
        case Element::force:
        case Element::waiting:
        case Element::torque:
        case Element::impulse:
            return 3;
        default:
            return 1;
    }
}

/// `largest`: the largest mass of the drawing.
void add_disc(StrokeBoard& board, const FigureElement& e, double largest) {
    const double r = largest > 0 ? 4.5 + 5 * std::cbrt(e.size / largest) : 6;
    board.put(Kind::circle, "mass", {vertex_at(e.points[0])}).size = r;
    const Vector2d side = board.free_side(e.points[0]) * (r + 12);
    const double longer = 3.5 * std::max(0.0, static_cast<double>(e.label.size()) - 2);
    board.text("name", vertex_at(e.points[0], side[0] + (side[0] < 0 ? -longer : longer), side[1] + 5), e.label);
}

void add_spring(StrokeBoard& board, const FigureElement& e) {
    const int a = e.points[0], b = e.points[1];
    std::vector<FigureVertex> zigzag{vertex_between(a, b, 0, 0, 0, true), vertex_between(a, b, 0.16)};
    constexpr int teeth = 10;
    for (int k = 0; k < teeth; ++k)
        zigzag.push_back(vertex_between(a, b, 0.16 + 0.68 * (k + 0.5) / teeth, k % 2 == 0 ? 7 : -7));
    zigzag.push_back(vertex_between(a, b, 0.84));
    zigzag.push_back(vertex_between(a, b, 1));
    if (board.is_doubled_on_blocks(a, b))
        for (FigureVertex& v : zigzag) v.across -= 10;
    board.put(Kind::path, "spring", zigzag);
    board.text("name", vertex_between(a, b, 0.5, 1.7 * board.label_side(a, b)), e.label);
}

void add_coil(StrokeBoard& board, const FigureElement& e) {
    std::vector<FigureVertex> spiral;
    constexpr int steps = 40;
    for (int k = 0; k <= steps; ++k) {
        const double angle = 4.5 * std::numbers::pi * k / steps, r = 5 + 10.0 * k / steps;
        spiral.push_back(vertex_at(e.points[0], r * std::cos(angle), r * std::sin(angle), k == 0));
    }
    board.put(Kind::path, "spring", spiral);
    board.text("name", vertex_at(e.points[0], -24, 4), e.label);
}

void add_damper(StrokeBoard& board, const FigureElement& e) {
    const int a = e.points[0], b = e.points[1];
    // The damper is drawn beside a spring between the same points.
    const double off = std::any_of(board.drawing.elements.begin(), board.drawing.elements.end(),
                                   [&](const FigureElement& other) {
                                       return other.kind == Element::spring && other.points == e.points;
                                   })
                           ? board.is_doubled_on_blocks(a, b) ? 10 : 22
                           : 0;
    const double end = off == 10 ? off : 0;
    board.put(
        Kind::path, "damper",
        {vertex_between(a, b, 0, end, 0, true), vertex_between(a, b, 0, off), vertex_between(a, b, 0.38, off),  //
         vertex_between(a, b, 0.62, off - 7, 0, true), vertex_between(a, b, 0.38, off - 7),
         vertex_between(a, b, 0.38, off + 7), vertex_between(a, b, 0.62, off + 7),  //
         vertex_between(a, b, 0.52, off - 6, 0, true), vertex_between(a, b, 0.52, off + 6),
         vertex_between(a, b, 0.52, off, 0, true), vertex_between(a, b, 1, off), vertex_between(a, b, 1, end)});
    board.text("name", vertex_between(a, b, 0.5, off > 0 ? off + 17 : 1.7 * board.label_side(a, b)), e.label);
}

void add_block(StrokeBoard& board, const FigureElement& e) {
    const int a = e.points[0], b = e.points[1];
    const double half = board.half_height_of_block(a);
    board
        .put(Kind::path, "body",
             {vertex_between(a, b, 0, -half, -18, true), vertex_between(a, b, 0, -half, 18),
              vertex_between(a, b, 0, half, 18), vertex_between(a, b, 0, half, -18)})
        .closed = true;
    board.text("name", vertex_at(a), e.label);
}

/// A rod or a bar, with its name beside its middle.
void add_beam(StrokeBoard& board, const FigureElement& e) {
    const int a = e.points[0], b = e.points[1];
    const bool is_bar = e.kind == Element::bar;
    if (is_bar) board.line("bar-edge", a, b);
    board.line(is_bar ? "bar" : "rod", a, b);
    board.text("name", vertex_between(a, b, 0.5, (is_bar ? 1.4 : 1) * board.label_side(a, b)), e.label);
}

void add_ring(StrokeBoard& board, const FigureElement& e) {
    const std::vector<int>& p = e.points;
    board.put(Kind::ring, "ring", {vertex_at(p[0]), vertex_at(p[1]), vertex_at(p[2])});
    board.line("spoke", p[0], p[1]);
    board.put(Kind::circle, "dot", {vertex_at(p[0])}).size = 2;
}

/// A circle, and on it the great circles that show how the ball has turned.
void add_ball(StrokeBoard& board, const FigureElement& e) {
    const std::vector<int>& p = e.points;
    FigureShape& circle = board.put(Kind::circle, e.label == "cage" ? "cage" : "ring", {vertex_at(p[0])});
    circle.size = e.size;
    circle.in_scene = true;
    board.put(Kind::ring, "great", {vertex_at(p[0]), vertex_at(p[1]), vertex_at(p[2])});
    if (p.size() < 4) return;
    board.put(Kind::ring, "great", {vertex_at(p[0]), vertex_at(p[2]), vertex_at(p[3])});
    board.put(Kind::ring, "great", {vertex_at(p[0]), vertex_at(p[3]), vertex_at(p[1])});
}

void add_ellipsoid(StrokeBoard& board, const FigureElement& e) {
    const std::vector<int>& p = e.points;
    board.put(Kind::hull, "ring", {vertex_at(p[0]), vertex_at(p[1]), vertex_at(p[2]), vertex_at(p[3])});
    for (const auto& [a, b] : {std::pair(1, 2), std::pair(2, 3), std::pair(3, 1)})
        board.put(Kind::ring, "great",
                  {vertex_at(p[0]), vertex_at(p[static_cast<std::size_t>(a)]),
                   vertex_at(p[static_cast<std::size_t>(b)])});
}

void add_ground_plane(StrokeBoard& board, const FigureElement& e) {
    std::vector<FigureVertex> corners;
    for (std::size_t k = 0; k < 4; ++k) corners.push_back(vertex_at(e.points[k], 0, 0, k == 0));
    board.put(Kind::path, "ground-plane", corners).closed = true;
}

/// The line through all points of an element.
FigureShape& add_path(StrokeBoard& board, const char* style, const FigureElement& e) {
    std::vector<FigureVertex> way;
    for (const int k : e.points) way.push_back(vertex_at(k, 0, 0, way.empty()));
    return board.put(Kind::path, style, way);
}

void add_faces(StrokeBoard& board, const FigureElement& e) {
    for (const std::vector<int>& face : e.faces) {
        std::vector<FigureVertex> corners;
        for (const int k : face) corners.push_back(vertex_at(e.points[static_cast<std::size_t>(k)]));
        FigureShape& shape =
            board.put(Kind::face, face.size() == 4 && e.faces.size() > 8 ? "facet" : "face", corners);
        if (face.size() == 3) shape.style = "facet";
        shape.closed = true;
    }
}

void add(StrokeBoard& board, const FigureElement& e, double largest) {
    const std::vector<int>& p = e.points;
    switch (e.kind) {
        case Element::disc:
            return add_disc(board, e, largest);
        case Element::block:
            return add_block(board, e);
        case Element::rod:
        case Element::bar:
            return add_beam(board, e);
        case Element::plate:
            add_path(board, "plate", e).closed = true;
            return;
        case Element::ring:
            return add_ring(board, e);
        case Element::ball:
            return add_ball(board, e);
        case Element::ellipsoid:
            return add_ellipsoid(board, e);
        case Element::ground_plane:
            return add_ground_plane(board, e);
        case Element::pin:
            board.put(Kind::circle, "pin", {vertex_at(p[0])}).size = 3.6;
            return;
        case Element::support:
            return add_support(board, e);
        case Element::guide:
            return add_guide(board, e);
        case Element::floor:
            return add_floor(board, e);
        case Element::wall:
            return add_wall(board, e);
        case Element::spring:
            return add_spring(board, e);
        case Element::coil:
            return add_coil(board, e);
        case Element::damper:
            return add_damper(board, e);
        case Element::rope:
        case Element::string:
            board.line("string", p[0], p[1]);
            return;
        case Element::tie:
            board.line("tie", p[0], p[1]);
            return;
        case Element::curve:
            add_path(board, "curve", e);
            return;
        case Element::force:
        case Element::waiting:
        case Element::impulse:
            return add_arrow(board, e);
        case Element::torque:
            return add_torque(board, e);
        case Element::gravity:
            return add_gravity(board, e);
        case Element::axes:
            return add_axes(board, e);
        case Element::angle:
            return add_angle(board, e);
        case Element::length:
            return add_length(board, e);
        case Element::mark:
            return board.text("name", e.size > 0 ? vertex_at(p[0]) : vertex_at(p[0], 8, -8), e.label);
        case Element::hoop:
            board.put(Kind::ring, "rod", {vertex_at(p[0]), vertex_at(p[1]), vertex_at(p[2])});
            return;
        case Element::pulley:
            board.put(Kind::ring, "ring", {vertex_at(p[0]), vertex_at(p[1]), vertex_at(p[2])});
            board.put(Kind::circle, "pin", {vertex_at(p[0])}).size = 2.5;
            return;
        case Element::ground:
            return add_ground(board, e);
        case Element::line:
            add_path(board, "string", e);
            return;
        case Element::solid:
            return add_faces(board, e);
    }
}

/// The elements of a layer; in space, what is farther away comes first.
std::vector<const FigureElement*> from_back(const StrokeBoard& board, int layer) {
    std::vector<std::pair<double, const FigureElement*>> found;
    for (const FigureElement& e : board.drawing.elements) {
        if (layer_of(e.kind) != layer) continue;
        double depth = 0;
        if (!board.drawing.is_plane && layer == 1)
            for (const int k : e.points)
                depth += board.first()[k].dot(board.shapes.toward) / static_cast<double>(e.points.size());
        found.emplace_back(depth, &e);
    }
    std::stable_sort(found.begin(), found.end(),
                     [](const auto& a, const auto& b) { return a.first < b.first - 1e-9; });
    std::vector<const FigureElement*> elements;
    for (const auto& [depth, e] : found) elements.push_back(e);
    return elements;
}

}  // namespace

FigureShapes shapes_of(const Drawing& drawing, const std::vector<Pose>& poses,
                       const std::vector<std::vector<double>>& q) {
    StrokeBoard board(drawing, poses, q);
    double largest = 0;
    for (const FigureElement& e : drawing.elements)
        largest = std::max(largest, e.kind == Element::disc || e.kind == Element::block ? e.size : 0.0);
    for (const int layer : {0, 1, 2, 3})
        for (const FigureElement* e : from_back(board, layer)) {
            const std::size_t before = board.shapes.shapes.size();
            add(board, *e, largest);
            for (std::size_t k = before; k < board.shapes.shapes.size(); ++k)
                board.shapes.shapes[k].element = static_cast<int>(e - drawing.elements.data());
        }
    place_letters(board.shapes, poses.front(), q.front());
    return std::move(board.shapes);
}

}  // namespace alembert
