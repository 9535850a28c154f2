// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// A drawing as strokes: the lines with which each element is drawn, in the style of a textbook.
///
///     const FigureShapes shapes = shapes_of(drawing, poses);
///     as_svg(shapes, poses[0], "Double pendulum");
///
/// The vertices of strokes are given relative to points of a pose, so that the strokes of one drawing serve all
/// its poses: in this program for a picture, and in the page's script, which does the same arithmetic, for the
/// animation.

#include "present/report/figure_view.hpp"
#include "present/report/json.hpp"

namespace alembert {

/// A vertex on the screen, where A and B are the projections of the points a and b, e is the direction from A to B
/// (to the right if there is no b) and n its normal (downwards in that case): A + part (B − A) + along e + across
/// n.
struct FigureVertex {
    int a = -1, b = -1;  ///< a = −1: the place of the gravity arrow
    double part = 0, along = 0, across = 0;
    bool begins = false;  ///< whether a new line begins here
};

struct FigureShape {
    enum class Kind {
        path,        ///< through the vertices
        circle,      ///< about the first vertex
        ring,        ///< about vertex 0, through vertices 1 and 2
        arc,         ///< about vertex 0, from the side of vertex 1 to that of vertex 2, with radius `size`
        text,        ///< at the first vertex
        angle_text,  ///< text in the middle of such an arc
        hull,        ///< the outline of an ellipsoid about vertex 0 with the ends of its half axes
        face,  ///< of a solid, counterclockwise from outside: seen from there, and darker where it turns away
    };
    Kind kind = Kind::path;
    std::string style;  ///< the name of its style class
    std::vector<FigureVertex> vertices;
    bool closed = false;
    double size = 0;  ///< the radius of circles and arcs on the screen; for `in_scene` circles, in the scene
    bool in_scene = false;
    std::string text = {};
    int vector = -1;  ///< the direction to whose tip the vertices reach; its length on the screen shows its size
    double full = 0;  ///< the largest size of that direction; 0 if it always has the same length
    double turn = 1;  ///< for arcs in the plane, the sense in which the coordinate counts on the screen
    int coordinate = -1;          ///< for arcs in the plane, the coordinate that gives the angle
    int from = -1, to = -1;       ///< the stroke is hidden if these points are
    double least = 0;             ///< nearer to each other on the screen than this,
    double most = 0;              ///< or not nearer than this; 0 means no bound
    int element = -1;             ///< position of its element in Drawing::elements
    double inside = 0;            ///< if not 0: hidden if a vertex is nearer than this to the edge of the picture
    Eigen::Vector2d nudge{0, 0};  ///< shifts a text on the screen
};

struct FigureShapes : FigureView {
    std::vector<FigureShape> shapes = {};
};

/// The strokes, scaled so that all poses fit. `q` are the coordinates at each pose, which arcs need. There must be
/// at least one pose.
FigureShapes shapes_of(const Drawing& drawing, const std::vector<Pose>& poses,
                       const std::vector<std::vector<double>>& q);

/// One <svg> element. With `for_page`, colours come from the page's style sheet; otherwise the picture has its
/// own.
std::string as_svg(const FigureShapes& figure, const Pose& pose, const std::vector<double>& q,
                   const std::string& title, const std::string& description, bool for_page);

/// The data that the page's script needs to draw other poses.
Json as_json(const FigureShapes& figure);

/// A name or a short expression in SVG, as letters with indices.
std::string svg_letters(const std::string& expression);

}  // namespace alembert
