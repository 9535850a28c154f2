// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// A drawing as strokes: what is drawn with which lines, in the style of a textbook.
///
///     const FigureShapes shapes = shapes_of(drawing, poses);
///     as_svg(shapes, poses[0], "Double pendulum");
///
/// A stroke's vertices hang on points of a pose, so that the strokes of one drawing serve all its poses: in this
/// program for a picture, and in the page's script for the animation, which does the same arithmetic.

#include "report/figure_view.hpp"
#include "report/json.hpp"

namespace alembert {

/// On the screen, with A and B where the points a and b are projected, e the direction from A to B (to the right
/// where there is no b) and n its normal (downwards there):   A + part (B − A) + along e + across n.
struct FigureVertex {
    int a = -1, b = -1;  ///< a = −1: the place of the gravity arrow
    double part = 0, along = 0, across = 0;
    bool begins = false;  ///< a new line begins here
};

struct FigureShape {
    enum class Kind {
        path,        ///< through the vertices
        circle,      ///< about the first vertex
        ring,        ///< about vertex 0, through vertices 1 and 2
        arc,         ///< about vertex 0, from the side of vertex 1 to that of vertex 2, of radius `size`
        box,         ///< about vertex 0, with half the edges to vertices 1, 2, 3
        text,        ///< at the first vertex
        angle_text,  ///< in the middle of such an arc
    };
    Kind kind = Kind::path;
    std::string style;  ///< the name of its class
    std::vector<FigureVertex> vertices;
    bool closed = false;
    double size = 0;  ///< of circles and arcs, on the screen; of `in_scene` circles in the scene
    bool in_scene = false;
    std::string text = {};
    int vector = -1;  ///< vertices reach to the tip of this direction, whose length on the screen shows its size
    double full = 0;  ///< the largest size of that direction; 0: it always has the same length
    double turn = 1;  ///< of arcs in the plane: which way the coordinate counts, on the screen
    int coordinate = -1;     ///< of arcs in the plane: how far
    int from = -1, to = -1;  ///< hidden where these points are
    double least = 0;        ///< nearer to each other on the screen than this,
    double most = 0;         ///< or not nearer than this; 0: no bound
};

struct FigureShapes : FigureView {
    std::vector<FigureShape> shapes = {};
};

/// Scaled so that all poses fit. `q`: the coordinates at each pose, which arcs follow. There is one pose at least.
FigureShapes shapes_of(const Drawing& drawing, const std::vector<Pose>& poses,
                       const std::vector<std::vector<double>>& q);

/// One <svg> element. `for_page`: colours come from the page's style sheet; otherwise the picture has its own.
std::string as_svg(const FigureShapes& figure, const Pose& pose, const std::vector<double>& q,
                   const std::string& title, const std::string& description, bool for_page);

/// What the page's script needs to draw other poses.
Json as_json(const FigureShapes& figure);

/// A name or a short expression as letters with indices, in SVG.
std::string svg_letters(const std::string& expression);

}  // namespace alembert
