// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// The board on which the strokes of a drawing are put: places on the screen at the first pose, and strokes that
/// all elements share.
///
///     StrokeBoard board(drawing, poses, q);
///     board.line("rod", a, b);
///     board.text("name", vertex_between(a, b, 0.5, board.label_side(a, b)), "AB");

#include <string>
#include <utility>
#include <vector>

#include "present/report/figure_shapes.hpp"

namespace alembert {

/// A vertex at a single point, shifted on the screen.
inline FigureVertex vertex_at(int a, double right = 0, double down = 0, bool begins = false) {
    return {.a = a, .along = right, .across = down, .begins = begins};
}
inline FigureVertex vertex_between(int a, int b, double part, double across = 0, double along = 0,
                                   bool begins = false) {
    return {.a = a, .b = b, .part = part, .along = along, .across = across, .begins = begins};
}

struct StrokeBoard {
    StrokeBoard(const Drawing& drawing, const std::vector<Pose>& poses, const std::vector<std::vector<double>>& q);

    Eigen::Vector2d screen(const Eigen::Vector3d& p) const;
    const Pose& first() const { return poses.front(); }

    FigureShape& put(FigureShape::Kind kind, const std::string& style, std::vector<FigureVertex> vertices);
    /// Nothing if there are no words.
    void text(const std::string& style, const FigureVertex& vertex, const std::string& words);
    FigureShape& line(const std::string& style, int a, int b);
    /// The slanting marks along the edge of a solid.
    void hatch(const FigureVertex& from, const FigureVertex& to, double side, int ticks);

    /// The side of a point at which a label is farthest from the elements that end there, at the first pose.
    Eigen::Vector2d free_side(int point) const;
    /// The side of a label: left of a rod that points down, above one that points right, where nothing else is.
    double label_side(int a, int b) const;
    /// Are there a spring and a damper between these points, which are those of blocks or of a block and a wall?
    /// Then they are side by side, and the blocks higher.
    bool is_doubled_on_blocks(int a, int b) const;
    double half_height_of_block(int point) const;
    /// Signed lengths along a line that the points of all poses reach.
    std::pair<double, double> reach(int origin, int end, int point) const;
    /// The largest size of a direction in all poses; 0 where there is one pose.
    double largest_size(int direction) const;

    const Drawing& drawing;
    const std::vector<Pose>& poses;
    const std::vector<std::vector<double>>& q;  ///< the coordinates at each pose
    FigureShapes shapes;
    int angles = 0, lengths = 0;  ///< how many are drawn already; neighbours are drawn at different distances
};

}  // namespace alembert
