// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// What a scene says of its looks: the shapes of bodies and particles, and what is drawn beside them.
///
///     const Looks looks = looks_of(scene);
///     if (const Shape* shape = looks.shape_of("block")) shape->kind;
///
/// This is kept apart from the scene, so that nothing that is derived or simulated can depend on it.

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "scene/scene.hpp"

namespace alembert {

/// A solid about its middle, with its edges and axis along its own axes.
struct Shape {
    enum class Kind { box, disc, ring, rod, ball, ellipsoid, cylinder, cone, polygon };
    Kind kind = Kind::box;
    /// The edges of a box; a radius; a length; radius and height; the half axes of an ellipsoid; of a polygon x, y
    /// of each corner in turn.
    std::vector<Expression> sizes = {};
    char axis = 0;                  ///< of discs, rings, rods, cylinders, cones; 0 if the scene does not say it
    Vector middle = {};             ///< from the place of the body or particle
    std::optional<Name> axes = {};  ///< a frame; when missing, that of the body, or N
    Expression turn = {};           ///< of these axes, about z; null if missing
    Place place = {};
};

/// Something that is drawn and is no body.
struct Scenery {
    enum class Kind { line, wall, floor, rope, spring, damper, support, dot, circle, curve, pulley, solid };
    /// A point, particle, body or pulley; or a position from O along N, which may depend on coordinates.
    struct Spot {
        std::optional<Name> name = {};
        Vector position = {};
    };
    Kind kind = Kind::line;
    std::optional<Name> name = {};
    std::string label = {};
    std::vector<Spot> spots = {};   ///< of lines, ropes, springs …; of others, where they are
    Shape shape = {};               ///< of solids; its first size is the radius of circles and pulleys
    Expression from = {}, to = {};  ///< of curves and circles; null if missing
    std::optional<Name> over = {};  ///< of curves, the coordinate that runs from `from` to `to`
};

struct Looks {
    std::vector<std::pair<Name, Shape>> shapes;  ///< of bodies and particles
    std::vector<Scenery> scenery;

    const Shape* shape_of(const std::string& name) const;
};

/// Of a scene that has been read already.
Looks looks_of(const Scene& scene);

}  // namespace alembert
