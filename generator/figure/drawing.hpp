// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// A mechanism as a figure: what is to be drawn, and where it stands at a state.
///
///     const Drawing figure = draw(scene, mechanism);
///     const Pose pose = pose_at(figure, start_of(mechanism).state());
///     pose[figure.elements[0].points[1]];          // x, y, z along N, in the scene's unit of length
///
/// An element names what it is and the points to which it is attached; the points are functions of the state. How
/// an element looks is the business of the one who draws it.

#include <Eigen/Core>
#include <string>
#include <vector>

#include "model/mechanism.hpp"
#include "program/interpret.hpp"

namespace alembert {

/// One thing to draw. `points` are indices into a Pose; those called a direction are vectors, not places.
struct FigureElement {
    enum class Kind {
        disc,     ///< centre: a particle, or a body of which no size is known; `size` is its mass
        block,    ///< centre, a point at the distance one along its guide: a particle that slides
        rod,      ///< two ends: a constant distance without a mass of its own
        bar,      ///< two ends: a body along a line
        plate,    ///< corners: a body through several points
        ring,     ///< centre, two points of its rim at right angles: a wheel or a disc
        ball,     ///< centre, then points of its surface in directions at right angles; label "cage": seen through
        box,      ///< centre, the middles of three faces: a body of which only the inertia is known
        pin,      ///< point: a hinge
        support,  ///< point: a hinge on the ground
        guide,    ///< where the block is at the start, a point at the distance one along the way, the block
        floor,    ///< a point of it, others at the distance one along it and out of the ground, what touches it;
                  ///< `size` is 1 where that always touches it
        wall,     ///< point, direction away from it: the end of a spring that is held
        spring,   ///< two ends
        coil,     ///< point: a spring along an angle
        damper,   ///< two ends
        rope,     ///< two ends: a distance that is a coordinate
        tie,      ///< two ends: a distance that a constraint keeps
        string,   ///< two ends: a distance that a unilateral constraint bounds
        force,    ///< point, direction
        torque,   ///< point, direction
        impulse,  ///< point, direction
        gravity,  ///< direction
        axes,     ///< origin, three directions of unit length
        angle,    ///< vertex, the side where the coordinate is zero, the side where it is now
        length,   ///< foot, end, and where it ends if it is longer by one; the last only for a fixed direction
        mark,     ///< a point with a name alone
    };
    Kind kind;
    std::vector<int> points;
    std::string label = {};  ///< a name of the scene or an expression in such names; may be empty
    double size = 0;
    int coordinate = -1;  ///< of angles and lengths: the position in Mechanism::q
    int owner = -1;       ///< the body or particle that it belongs to: its position in Mechanism::masses
};

/// Of each point of a drawing.
using Pose = std::vector<Eigen::Vector3d>;

struct Drawing {
    std::vector<FigureElement> elements = {};
    std::string obstacle = {};            ///< why there is nothing to draw; empty where there is
    std::vector<std::string> notes = {};  ///< what the figure does not show, in words
    bool is_plane = false;
    int normal = 2;                 ///< of a plane figure: the axis of N across it
    Eigen::Vector3d down{0, 0, 0};  ///< along gravity at the start; zero without gravity
    std::vector<int> traced = {};   ///< points of masses, in the order of Mechanism::masses
    std::vector<std::string> traced_names = {};

    /// Where a point is: the value of three roots of `program`, at the state with some coordinates set to zero,
    /// moved by a constant.
    struct Spot {
        int root = 0;
        int zeroed = -1;  ///< this coordinate is taken as zero
        Eigen::Vector3d shift{0, 0, 0};
    };
    std::vector<Spot> spots = {};
    Program program = {};
};

/// Where all points are. The state counts q and q' as the scene does.
Pose pose_at(const Drawing& drawing, const State<double>& state);

/// From the geometry of a scene. A scene that has none gives a drawing with an `obstacle`.
Drawing draw(const Scene& scene, const Mechanism& mechanism);

}  // namespace alembert
