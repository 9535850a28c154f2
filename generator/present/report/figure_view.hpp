// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// The direction from which a drawing is seen, and its scale.
///
///     const FigureView view = figure_view(drawing, poses);
///     // on the screen: x = (p − centre)·right·scale, y = −(p − centre)·up·scale, from the middle
///
/// A plane mechanism is seen along the normal of its plane, with gravity downwards; a mechanism in space is seen
/// obliquely from above.

#include "present/figure/drawing.hpp"

namespace alembert {

struct FigureView {
    double width = 480, height = 360, scale = 1;
    Eigen::Vector3d centre{0, 0, 0};
    Eigen::Vector3d right{1, 0, 0}, up{0, 1, 0}, toward{0, 0, 1};  ///< directions of the screen
    bool is_plane = true;
    bool follows = false;  ///< whether the view moves with the masses
    std::vector<int> followed = {};
};

/// The view is scaled so that all poses fit. `poses` must not be empty.
FigureView figure_view(const Drawing& drawing, const std::vector<Pose>& poses);

}  // namespace alembert
