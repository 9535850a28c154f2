// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// The parts of a figure; each function adds one of them to the sketch. Only draw.cpp uses these functions, in
/// this order, because later parts depend on the elements of earlier ones.

#include <algorithm>

#include "present/figure/sketch.hpp"
#include "scene/looks.hpp"

namespace alembert {

/// The tracks of loads, springs and constraints that are requested before the sketch is sampled.
struct Asked {
    std::vector<int> spring_along,
        damper_along;  ///< scalars; -1 if two points are given, -2 if it is drawn already
    std::vector<int> forces, torques, impulses;  ///< vectors along N
    std::vector<int> constraints;                ///< scalars for holonomic constraints, -1 for others
    std::vector<std::vector<int>> rows;  ///< rows of velocity constraints of small plane scenes, by coordinate
    std::vector<int> gaps;               ///< scalars
    std::vector<int> contacts;           ///< vectors of rolling conditions
};
Asked asked(Sketch& sketch);

/// The faces of a box whose corner k has its i-th coordinate positive if bit i of k is set.
std::vector<std::vector<int>> faces_of_box();

/// What the scene says of its looks, as expressions; made before the sketch is sampled.
class LooksOfScene {
public:
    explicit LooksOfScene(Sketch& sketch);
    /// Whether the scene says what this body or particle looks like.
    bool has_shape(const std::string& name) const { return looks_.shape_of(name) != nullptr; }
    /// Adds the shape that the scene gives a body or particle; its middle as a spot.
    int add_shape(const std::string& name, int owner);
    /// How far the shape reaches from its place in a direction, at the start.
    double reach(const std::string& name, const Eigen::Vector3d& direction);
    bool has_shapes() const { return !looks_.shapes.empty(); }
    bool has(Scenery::Kind kind) const {
        return std::any_of(looks_.scenery.begin(), looks_.scenery.end(),
                           [&](const Scenery& one) { return one.kind == kind; });
    }
    bool has_scenery() const { return !looks_.scenery.empty(); }
    /// Does the scene draw something at rest on which bodies may stand?
    bool has_grounds() const {
        for (std::size_t k = 0; k < looks_.scenery.size(); ++k) {
            const Scenery::Kind kind = looks_.scenery[k].kind;
            if (kind == Scenery::Kind::floor || kind == Scenery::Kind::wall) return true;
            if ((kind == Scenery::Kind::solid || kind == Scenery::Kind::circle) && s_.is_fixed(tracks_[k][0]))
                return true;
        }
        return false;
    }
    void add_scenery();
    /// Is there a circle about that track through the other?
    bool has_circle(int middle, int through) const;

private:
    struct Axes {
        Vector3 middle;
        std::array<Vector3, 3> axis;
    };
    Axes axes_of(const Shape& shape, const Vector3& place, const std::string& frame);
    Axes axes_of_mass(const std::string& name, const Shape& shape);
    Vector3 place_of(const Scenery::Spot& spot);
    Vector3 in(const Axes& axes, const GiNaC::ex& x, const GiNaC::ex& y, const GiNaC::ex& z);
    int spot(const Vector3& place) { return s_.spot(s_.track(place)); }
    void add_solid(const Shape& shape, const Axes& axes, int owner);
    void add_flat(const Shape& shape, const Axes& axes, int owner);
    void add_round(FigureElement::Kind kind, const GiNaC::ex& radius, char axis, const Axes& axes, int owner);
    void add_ellipsoid(const Shape& shape, const Axes& axes, int owner);
    void add_box(const Shape& shape, const Axes& axes, int owner);
    void add_turned(const Shape& shape, const Axes& axes, int owner);
    void add_rope(const Scenery& rope);
    void add_curve(const Scenery& curve);
    void add_one(const Scenery& scenery, const std::vector<int>& tracks);
    std::array<int, 3> order(char axis) const;
    GiNaC::ex size(const Shape& shape, std::size_t k) { return s_.formulas.value(shape.sizes[k]); }

    Sketch& s_;
    Looks looks_;
    std::vector<std::vector<int>> tracks_;  ///< of the places of each piece of scenery
    std::vector<int> radii_;                ///< scalars, of circles and pulleys; else -1
};

/// Masses that move on one line would cover each other: they are drawn apart, with the springs between them and
/// the walls. For other scenes it does nothing. Springs and dampers that it has drawn are marked in `asked`.
void spread(Sketch& sketch, Asked& asked);

/// Adds the points about which particles turn as sites, where the scene has no name for them.
void find_centres(Sketch& sketch);

/// The direction in which a point moves, if it is always the same.
std::optional<Eigen::Vector3d> straight_way(const Sketch& sketch, int track);
/// A block on a guide along that way.
void add_slider(Sketch& sketch, int track, int mass, const std::string& label, const Eigen::Vector3d& way);
/// A mass that slides or rolls on an inclined side of another one.
struct Slope {
    int wedge, rider;     ///< positions in Mechanism::masses
    Eigen::Vector3d way;  ///< downhill
};
/// Only of scenes that say no shapes. What slopes draw is marked as shown.
std::vector<Slope> find_slopes(Sketch& sketch, const LooksOfScene& looks);
/// After the wheels that roll on them.
void add_slopes(Sketch& sketch, const std::vector<Slope>& slopes, const LooksOfScene& looks);
/// Ropes over pulleys, between masses whose ways along lines add up.
void add_ropes(Sketch& sketch, const Asked& asked);
void add_bodies(Sketch& sketch, const Asked& asked, LooksOfScene& looks);
void add_particles(Sketch& sketch, LooksOfScene& looks);
/// The circle on which a wheel rolls, if the wheel's centre `wheel` keeps its distance from the fixed point
/// `middle` and the radius of that circle is a parameter, also where the wheel's radius is `changed` because all
/// parameters are. Returns whether it was added.
bool add_round_ground(Sketch& sketch, int middle, int wheel, std::optional<double> changed = {});
/// The ground in a figure in space, below what touches it. Gaps that it shows are −1 in `asked` then.
void add_grounds(Sketch& sketch, Asked& asked);
void add_constraints(Sketch& sketch, const Asked& asked);
/// Floors and walls that an end of a bar touches, by a contact or a constraint that is its height over them.
void add_rests(Sketch& sketch, const Asked& asked);
void add_springs(Sketch& sketch, const Asked& asked, const LooksOfScene& looks);
void add_hinges(Sketch& sketch);
void add_coordinates(Sketch& sketch);
void add_loads(Sketch& sketch, const Asked& asked);

}  // namespace alembert
