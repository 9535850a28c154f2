// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// The strokes of a figure at one pose, as points of the screen. templates/page_script.js does the same
/// arithmetic.
///
///     const FigureScreen screen(shapes, pose, q);
///     screen.outline(shapes.shapes[0]);        // the points of its lines
///     place_letters(shapes, pose, q);          // moves letters that cover each other or strokes

#include <optional>
#include <utility>

#include "present/report/figure_shapes.hpp"

namespace alembert {

class FigureScreen {
public:
    /// The arguments must live as long as this.
    FigureScreen(const FigureShapes& figure, const Pose& pose, const std::vector<double>& q);

    struct Place {
        bool begins;  ///< whether a new line begins here
        Eigen::Vector2d at;
    };

    Eigen::Vector2d place(const FigureVertex& vertex, const FigureShape& shape) const;
    /// The points of a path, ring, arc or face; nothing for circles and texts. Rings and closed paths are to
    /// be closed.
    std::vector<Place> outline(const FigureShape& shape) const;
    /// The middle of a text, without its `nudge`.
    Eigen::Vector2d middle_of_text(const FigureShape& shape) const;
    double radius_of(const FigureShape& circle) const;
    bool is_hidden(const FigureShape& shape) const;
    /// How much of the light a face returns: 1 where it looks to the light, which comes from above the viewer.
    /// Nothing if the face is turned away.
    std::optional<double> brightness(const FigureShape& face) const;

private:
    Eigen::Vector2d direction(const Eigen::Vector3d& v) const;
    Eigen::Vector2d place(int point) const;
    Eigen::Vector2d arrow(const FigureShape& shape) const;
    std::pair<double, double> arc(const FigureShape& shape) const;

    const FigureShapes& f_;
    const Pose& pose_;
    const std::vector<double>& q_;
    Eigen::Vector3d origin_;
};

bool is_text(const FigureShape& shape);
bool is_ring(const FigureShape& shape);  ///< a closed line through no vertices

/// Gives letters that would cover each other, a stroke or the edge of the picture at this pose a `nudge` to the
/// nearest free place.
void place_letters(FigureShapes& figure, const Pose& pose, const std::vector<double>& q);

}  // namespace alembert
