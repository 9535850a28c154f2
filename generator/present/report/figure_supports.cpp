// SPDX-License-Identifier: GPL-2.0-or-later
#include "present/report/figure_supports.hpp"

#include <algorithm>

namespace alembert {

void add_support(StrokeBoard& board, const FigureElement& e) {
    const int p = e.points[0];
    // The label is on the side away from the elements that are attached there.
    double below = 0;
    for (const FigureElement& other : board.drawing.elements)
        if (other.kind == FigureElement::Kind::rod || other.kind == FigureElement::Kind::bar ||
            other.kind == FigureElement::Kind::tie || other.kind == FigureElement::Kind::string ||
            other.kind == FigureElement::Kind::spring)
            for (std::size_t k = 0; k < 2; ++k)
                if (other.points[k] == p)
                    below += board.screen(board.first()[other.points[1 - k]] - board.first()[p])[1];
    const double side = below > 1e-9 * board.shapes.scale ? -1 : 1;
    board
        .put(FigureShape::Kind::path, "ground",
             {vertex_at(p, 0, 0, true), vertex_at(p, -9, 14 * side), vertex_at(p, 9, 14 * side)})
        .closed = true;
    board.put(FigureShape::Kind::path, "ground",
              {vertex_at(p, -19, 14 * side, true), vertex_at(p, 19, 14 * side)});
    FigureVertex from = vertex_at(p, -17, 14 * side), to = vertex_at(p, 19, 14 * side);
    board.hatch(from, to, side, 5);
    board.put(FigureShape::Kind::circle, "pin", {vertex_at(p)}).size = 3.6;
}

void add_guide(StrokeBoard& board, const FigureElement& e) {
    const auto [low, high] = board.reach(e.points[0], e.points[1], e.points[2]);
    const Eigen::Vector2d way = board.screen(board.first()[e.points[1]] - board.first()[e.points[0]]);
    const Eigen::Vector2d normal(-way[1], way[0]);
    const double side = normal[1] >= 0 ? 1 : -1;  // below
    const double below = (board.half_height_of_block(e.points[2]) + 1) * side;
    const FigureVertex from = vertex_between(e.points[0], e.points[1], low, below, -34, true),
                       to = vertex_between(e.points[0], e.points[1], high, below, 34);
    board.put(FigureShape::Kind::path, "ground", {from, to});
    board.hatch(from, to, side,
                std::clamp(static_cast<int>(((high - low) * board.shapes.scale + 68) / 12), 4, 48));
}

void add_floor(StrokeBoard& board, const FigureElement& e) {
    const std::vector<int>& p = e.points;
    auto [low, high] = board.reach(p[0], p[1], p[3]);
    if (p.size() > 4) {
        const double half = (board.first()[p[4]] - board.first()[p[0]]).norm();
        low = std::min(low, -half);
        high = std::max(high, half);
    }
    const Eigen::Vector2d way = board.screen(board.first()[p[1]] - board.first()[p[0]]),
                          out = board.screen(board.first()[p[2]] - board.first()[p[0]]);
    const double side = -way[1] * out[0] + way[0] * out[1] > 0 ? -1 : 1;
    const FigureVertex from = vertex_between(p[0], p[1], low, 0, -70, true),
                       to = vertex_between(p[0], p[1], high, 0, 70);
    board.put(FigureShape::Kind::path, "ground", {from, to});
    board.hatch(from, to, side,
                std::clamp(static_cast<int>(((high - low) * board.shapes.scale + 140) / 12), 4, 60));
}

void add_ground(StrokeBoard& board, const FigureElement& e) {
    const int a = e.points[0], b = e.points[1];
    board.put(FigureShape::Kind::path, "ground", {vertex_between(a, b, 0, 0, 0, true), vertex_between(a, b, 1)});
    const double length = board.screen(board.first()[b] - board.first()[a]).norm();
    board.hatch(vertex_between(a, b, 0, 0, 4, true), vertex_between(a, b, 1), 1,
                std::clamp(static_cast<int>(length / 12), 2, 60));
}

void add_wall(StrokeBoard& board, const FigureElement& e) {
    const int p = e.points[0], away = e.points[1];
    std::vector<FigureVertex> wall{vertex_between(p, away, 0, -26, 0, true), vertex_between(p, away, 0, 26)};
    for (int k = 0; k <= 4; ++k) {
        wall.push_back(vertex_between(p, away, 0, -26.0 + 13 * k, 0, true));
        wall.push_back(vertex_between(p, away, 0, -19.0 + 13 * k, -8));
    }
    board.put(FigureShape::Kind::path, "hatch", wall);
}

}  // namespace alembert
