// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// A mechanism as a figure: the elements to draw, and their positions at a state.
///
///     const Drawing figure = draw(scene, mechanism);
///     const Pose pose = pose_at(figure, start_of(mechanism).state());
///     pose[figure.elements[0].points[1]];          // x, y, z along N, in the scene's unit of length
///
/// An element has a kind and the points to which it is attached; the points are functions of the state. The look
/// of an element is decided where it is drawn.

#include <Eigen/Core>
#include <string>
#include <vector>

#include "model/mechanism.hpp"
#include "program/interpret.hpp"

namespace alembert {

/// One element to draw. `points` are indices into a Pose; points called a direction are vectors, not positions.
struct FigureElement {
    enum class Kind {
        disc,     ///< centre: a particle, or a body of unknown size; `size` is its mass
        block,    ///< centre, and a point at distance one along its guide: a particle that slides
        curve,    ///< points: the way on which a particle is led
        rod,      ///< two ends: a constant distance, without mass
        bar,      ///< two ends: a body along a line
        plate,    ///< corners: a body through several points
        ring,     ///< centre, and two points of its rim in perpendicular directions: a wheel or a disc
        ball,     ///< centre, then points of its surface in perpendicular directions; with the label "cage" it is
                  ///< transparent
        pin,      ///< point: a hinge
        support,  ///< point: a hinge on the ground
        guide,    ///< the place of the block at the start, a point at distance one along its path, and the block
        floor,    ///< a point of it, points at distance one along it and out of the ground, and the point that
                  ///< touches it; perhaps the end of what stands there; `size` is 1 if that always touches it
        wall,     ///< point, direction away from it: the fixed end of a spring
        spring,   ///< two ends
        coil,     ///< point: a spring along an angle
        damper,   ///< two ends
        rope,     ///< two ends: a distance that is a coordinate
        tie,      ///< two ends: a distance that a constraint keeps
        string,   ///< two ends: a distance that a unilateral constraint bounds
        force,    ///< point, direction
        waiting,  ///< point, direction: a force that is zero, where it acts at another time
        torque,   ///< point, direction
        impulse,  ///< point, direction
        gravity,  ///< direction
        axes,     ///< origin, three directions of unit length
        angle,    ///< vertex, the side at which the coordinate is zero, and the present side
        length,   ///< foot, end, and the end if the length were larger by one; the last only for a fixed direction
        mark,     ///< a point with only a name; in its middle if `size` is 1
        hoop,     ///< centre, and two points of its rim in perpendicular directions: a ring without a face
        pulley,   ///< the same, for a wheel over which a rope runs
        ground,   ///< two ends of a line; the ground is to the right of who walks from the first to the second
        line,     ///< points of a line that the scene asks for
        ellipsoid,     ///< centre, and the ends of its three half axes
        ground_plane,  ///< four corners of the ground in space, then what stands on it; `size` is how far it
                       ///< reaches beyond that
        solid,         ///< points, and in `faces` those of each face, counterclockwise from outside; convex
    };
    Kind kind;
    std::vector<int> points;
    std::string label = {};  ///< a name of the scene or an expression in such names; may be empty
    double size = 0;
    int coordinate = -1;  ///< for angles and lengths, the position in Mechanism::q
    int owner = -1;       ///< the body or particle to which it belongs, as a position in Mechanism::masses
    std::vector<std::vector<int>> faces = {};  ///< of solids
};

/// The position of each point of a drawing.
using Pose = std::vector<Eigen::Vector3d>;

struct Drawing {
    std::vector<FigureElement> elements = {};
    std::string obstacle = {};            ///< the reason why there is nothing to draw; empty if there is something
    std::vector<std::string> notes = {};  ///< sentences about what the figure does not show
    bool is_plane = false;
    int normal = 2;                 ///< for a plane figure, the axis of N perpendicular to it
    Eigen::Vector3d down{0, 0, 0};  ///< along gravity at the start; zero without gravity
    /// The points of masses whose paths are drawn, in the order of Mechanism::masses.
    std::vector<int> traced = {};
    std::vector<std::string> traced_names = {};

    /// The position of a point: the values of three roots of `program` at the state, perhaps with a coordinate set
    /// to zero, plus a constant.
    struct Spot {
        int root = 0;
        int zeroed = -1;  ///< the coordinate that is set to zero
        Eigen::Vector3d shift{0, 0, 0};
    };
    std::vector<Spot> spots = {};
    Program program = {};
};

/// The positions of all points. q and q' in the state are in the order of the scene.
Pose pose_at(const Drawing& drawing, const State<double>& state);

/// Lets each ground in space reach as far as what stands on it goes in these poses, which are changed with the
/// drawing.
void stretch_grounds(Drawing& drawing, std::vector<Pose>& poses);

/// Makes the drawing from the geometry of a scene. A scene without geometry gives a drawing with an `obstacle`.
Drawing draw(const Scene& scene, const Mechanism& mechanism);

}  // namespace alembert
