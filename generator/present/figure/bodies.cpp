// SPDX-License-Identifier: GPL-2.0-or-later
/// Bodies are drawn with shapes that follow from their points and moments of inertia. For a homogeneous
///   rod of length 2h:        J/m = h²/3 about its centre,
///   disc of radius r:        J/m = r²/2 about its axis, r²/4 about a diameter,
///   ball of radius r:        J/m = 2r²/5,
///   cuboid of edges 2a 2b 2c: (Iyy + Izz − Ixx)/m = 2a²/3 and so on
/// (Zhang & Qin, chapter 3).
#include <algorithm>
#include <cmath>

#include "present/figure/parts.hpp"

namespace alembert {

namespace {

using Eigen::Vector3d;
using Kind = FigureElement::Kind;

bool nearly(double a, double b, double part) {
    return std::abs(a - b) <= part * std::max(std::abs(a), std::abs(b));
}

class BodyShapes {
public:
    BodyShapes(Sketch& sketch, const Asked& asked, LooksOfScene& looks)
        : s_(sketch), asked_(asked), looks_(looks) {}

    void add(const Sketch::Frame3& body) {
        body_ = &body;
        if (looks_.has_shape(body.name)) {
            looks_.add_shape(body.name, body.mass);
            const std::optional<double> radius = wheel_radius();
            if (radius && s_.is_plane && nearly(*radius, s_.elements.back().size, 1e-6)) {
                if (!looks_.has(Scenery::Kind::floor)) add_ground(*radius);
                add_track({});
            }
            return;
        }
        const std::vector<int> held = held_places();
        if (held.empty() && add_if_slides()) return;
        if (const std::optional<double> radius = wheel_radius()) {
            add_wheel(*radius);
            return;
        }
        if (s_.is_plane)
            add_in_plane(held);
        else
            add_in_space(held);
    }

private:
    /// Points of the scene that move with the body, except its mass centre.
    std::vector<int> held_places() const {
        std::vector<int> held;
        for (const Sketch::Site& site : s_.sites)
            if (&s_.canonical(site.track) == &site && !s_.same(site.track, body_->centre) &&
                s_.is_fixed_in(body_->axes, body_->centre, site.track) && is_own(site))
                held.push_back(site.track);
        return held;
    }

    /// A body with joints carries the points of these joints and points that are given relative to it. Other
    /// points may lie on the axis about which it turns and move with it by chance.
    bool is_own(const Sketch::Site& place) const {
        bool has_joints = false;
        for (const Sketch::Site& site : s_.sites) {
            if (site.of != Sketch::Site::Of::joint || site.from != body_->name) continue;
            has_joints = true;
            if (s_.same(site.track, place.track)) return true;
        }
        return !has_joints || place.from == body_->name;
    }

    Vector3d arm(int place) const { return s_.at(0, place) - s_.at(0, body_->centre); }

    /// The point of the body at `own`, given along its axes.
    int spot_at(const Vector3d& own) {
        const MassElement& mass = s_.m.masses[body_->mass];
        Vector3 place = mass.position;
        for (int k = 0; k < 3; ++k)
            for (int i = 0; i < 3; ++i)
                if (own[i] != 0) place[k] += mass_axis(i)[k] * exactly(own[i]);
        return s_.spot(s_.track(place));
    }
    Vector3 mass_axis(int i) const { return s_.formulas.places().orientation(body_->name).axis(i); }
    Vector3d own(const Vector3d& along_N) const {
        return {along_N.dot(s_.at(0, body_->axes[0])), along_N.dot(s_.at(0, body_->axes[1])),
                along_N.dot(s_.at(0, body_->axes[2]))};
    }
    int centre() { return s_.spot(body_->centre); }

    void element(Kind kind, std::vector<int> points, double size = 0, const std::string& label = "") {
        s_.add({.kind = kind, .points = std::move(points), .label = label, .size = size, .owner = body_->mass});
    }

    /// The radius from the scene's rolling condition or, in the plane, from a constraint between a displacement of
    /// the centre and a rotation.
    std::optional<double> wheel_radius() const {
        for (std::size_t k = 0; k < s_.scene.rolling.size(); ++k)
            if (s_.scene.rolling[k].body.text == body_->name) {
                const double radius = s_.at(0, asked_.contacts[k]).norm();
                for (int state = 1; state < Sketch::states; ++state)
                    if (!nearly(s_.at(state, asked_.contacts[k]).norm(), radius, 1e-6)) return {};
                return radius;
            }
        if (!s_.is_plane) return {};
        for (const std::vector<int>& row : asked_.rows) {
            const std::optional<double> radius = radius_by(row, 0);
            bool is_constant = radius.has_value();
            for (int state = 1; state < Sketch::at_one_time && is_constant; ++state) {
                const std::optional<double> other = radius_by(row, state);
                is_constant = other && nearly(*other, *radius, 1e-5);
            }
            if (is_constant) return radius;
        }
        return {};
    }

    /// The radius from a row a_x x' + a_phi phi' in which only x moves the centre and only phi turns the body.
    std::optional<double> radius_by(const std::vector<int>& row, int state) const {
        double way = 0, turn = 0;
        for (std::size_t k = 0; k < row.size(); ++k) {
            const double a = s_.at(state, row[k])[0];
            if (a == 0) continue;
            const double step = 1e-3, q = s_.coordinate(state, static_cast<int>(k));
            const auto change = [&](int track) {
                return (s_.with(state, track, static_cast<int>(k), q + step) - s_.at(state, track)).norm() / step;
            };
            const double v = change(body_->centre), w = change(body_->axes[s_.normal == 0 ? 1 : 0]);
            if (v > 1e-9 && w < 1e-9 && way == 0)
                way = std::abs(a) / v;
            else if (std::abs(w - 1) < 1e-3 && v < 1e-9 && turn == 0)
                turn = std::abs(a);
            else
                return {};
        }
        if (way == 0 || turn == 0) return {};
        return turn / way;
    }

    /// p, if the moment of inertia about the normal of the plane is mass·p²·c with a parameter p and the c of a
    /// disc, a ball or a hoop. Nothing says more about the body's shape.
    struct Radius {
        double here, changed;  ///< at the initial state, and with other parameters
    };
    std::optional<Radius> round_radius() const {
        const MassElement& mass = s_.m.masses[body_->mass];
        if (!mass.rotation || !(body_->weight > 0)) return {};
        const GiNaC::ex inertia = mass.rotation->inertia[static_cast<std::size_t>(s_.normal)];
        if (s_.m.z->tree_size(inertia) > 100 || s_.m.z->tree_size(mass.mass) > 100) return {};
        const GiNaC::ex square = s_.m.z->expand(inertia) / s_.m.z->expand(mass.mass);
        std::size_t next = 0;
        for (const Mechanism::Parameter& p : s_.m.parameters) {
            if (!p.independent) continue;
            const std::size_t k = next++;
            const GiNaC::ex part = (square / GiNaC::pow(p.symbol, 2)).normal();
            for (const GiNaC::numeric& round : {GiNaC::numeric(1, 2), GiNaC::numeric(2, 5), GiNaC::numeric(1)})
                if (part.is_equal(round)) return Radius{s_.parameter(0, k), s_.parameter(Sketch::states, k)};
        }
        return {};
    }

    /// Does coordinate k turn the body and leave its centre at rest?
    bool turns_only(int state, int k) const {
        const double step = 1e-3, q = s_.coordinate(state, k);
        const auto change = [&](int track) {
            return (s_.with(state, track, k, q + step) - s_.at(state, track)).norm() / step;
        };
        return change(body_->centre) < 1e-9 && std::abs(change(body_->axes[s_.normal == 0 ? 1 : 0]) - 1) < 1e-3;
    }

    /// The radii of a drum or pulley: what a turn of it moves by a rope or a belt, as r·theta in a constraint
    /// beside the way of a mass, or in the length of a spring beside another coordinate.
    std::vector<double> rope_radii() const {
        std::vector<double> radii;
        const auto add = [&](double radius) {
            if (radius > 0 && std::none_of(radii.begin(), radii.end(),
                                           [&](double known) { return nearly(known, radius, 1e-6); }))
                radii.push_back(radius);
        };
        const auto slope = [&](int track, int k) {
            const double step = 1e-3, q = s_.coordinate(0, k);
            return std::abs(s_.with(0, track, k, q + step)[0] - s_.at(0, track)[0]) / step;
        };
        const auto way_of_masses = [&](int k) {
            double way = 0;
            for (const int mass : s_.free_track)
                way = std::max(way,
                               (s_.with(0, mass, k, s_.coordinate(0, k) + 1e-3) - s_.at(0, mass)).norm() / 1e-3);
            return way;
        };
        const int n = s_.m.size();
        for (int k = 0; k < n; ++k) {
            if (!turns_only(0, k)) continue;
            for (const std::vector<int>& row : asked_.rows) {
                if (static_cast<int>(row.size()) != n || s_.at(0, row[k])[0] == 0) continue;
                for (int other = 0; other < n; ++other)
                    if (const double a = std::abs(s_.at(0, row[other])[0]);
                        other != k && a > 0 && way_of_masses(other) > 0)
                        add(std::abs(s_.at(0, row[k])[0]) / a * way_of_masses(other));
            }
            for (const int along : asked_.spring_along) {
                if (along < 0 || !(slope(along, k) > 1e-9)) continue;
                for (int other = 0; other < n; ++other)
                    if (other != k && slope(along, other) > 1e-9) add(slope(along, k));
            }
        }
        return radii;
    }

    /// The axis of symmetry of a body, about which the inertia is the same in all perpendicular directions; -1 if
    /// there is none.
    int axis_of_symmetry() const {
        if (s_.is_plane) return s_.normal;
        const Vector3d& I = body_->inertia;
        if (nearly(I[0], I[1], 1e-6) && nearly(I[0], I[2], 1e-6)) return -1;
        for (int k = 0; k < 3; ++k)
            if (nearly(I[(k + 1) % 3], I[(k + 2) % 3], 1e-6)) return k;
        return -1;
    }

    void add_ring(int axis, double radius) {
        Vector3d u = Vector3d::Zero(), v = Vector3d::Zero();
        u[(axis + 1) % 3] = radius;
        v[(axis + 2) % 3] = radius;
        element(Kind::ring, {centre(), spot_at(u), spot_at(v)}, radius);
    }

    /// In the plane the ground lies below the wheel, at a fixed position.
    void add_ground(double radius) {
        std::optional<Vector3d> along;
        for (int state = 1; state < Sketch::at_one_time; ++state) {
            const Vector3d way = s_.at(state, body_->centre) - s_.at(0, body_->centre);
            if (way.norm() < 1e-9 * s_.scale) continue;
            if (along && along->cross(way).norm() > 1e-9 * way.norm()) return;
            along = way.normalized();
        }
        if (!along) return;
        Vector3d below = along->cross(Vector3d::Unit(s_.normal));
        const Vector3d down = s_.down.norm() > 0 ? s_.down : Vector3d(-Vector3d::Unit(s_.normal == 2 ? 1 : 2));
        if (below.dot(down) < 0) below = -below;
        const int origin = s_.place("O");
        const Vector3d contact = s_.at(0, body_->centre) - s_.at(0, origin) + radius * below;
        s_.add({.kind = Kind::floor,
                .points = {s_.spot(origin, -1, contact), s_.spot(origin, -1, contact + *along),
                           s_.spot(origin, -1, contact - below), centre()},
                .size = 1});
    }

    void add_wheel(double radius) {
        if (s_.is_plane) add_ground(radius);
        if (const int axis = axis_of_symmetry(); axis >= 0)
            add_ring(axis, radius);
        else
            element(Kind::ball,
                    {centre(), spot_at({radius, 0, 0}), spot_at({0, radius, 0}), spot_at({0, 0, radius})}, radius);
        add_track({});
    }

    /// A body that moves along a line and never turns.
    bool add_if_slides() {
        const std::optional<Vector3d> way = straight_way(s_, body_->centre);
        if (!s_.is_plane || !way || !s_.is_fixed(body_->axes[s_.normal == 0 ? 1 : 0])) return false;
        const bool has_joint =
            std::any_of(s_.scene.joints.begin(), s_.scene.joints.end(),
                        [&](const Joint& joint) { return joint.child.body.text == body_->name; });
        if (!has_joint && std::abs(way->dot(s_.down)) > 0.99) return false;
        const std::string& symbol = s_.scene.bodies[s_.m.masses[body_->mass].origin.index].mass.text;
        add_slider(s_, body_->centre, body_->mass, symbol.size() <= 6 ? symbol : body_->name, *way);
        return true;
    }

    /// The circle on which a wheel rolls whose centre turns about a fixed point.
    void add_track(std::optional<double> changed_radius) {
        for (const Sketch::Site& site : s_.sites)
            if (s_.is_finite(site.track) && s_.distance(site.track, body_->centre) &&
                add_round_ground(s_, site.track, body_->centre, changed_radius))
                return;
    }

    void add_in_plane(const std::vector<int>& held) {
        const double square = body_->inertia[s_.normal];
        if (held.empty()) {
            if (const std::optional<Radius> radius = round_radius()) {
                add_ring(s_.normal, radius->here);
                add_track(radius->changed);
                return;
            }
            if (s_.is_fixed(body_->centre)) {
                std::vector<double> radii = rope_radii();
                if (radii.empty() && body_->weight == 0) radii.push_back(0.12 * s_.scale);
                for (const double radius : radii) add_ring(s_.normal, radius);
                if (!radii.empty()) return;
            }
            const double half = square > 0 ? std::sqrt(3 * square) : 0.12 * s_.scale;
            if (body_->weight > 0 && square == 0) {
                element(Kind::disc, {centre()}, body_->weight);
                return;
            }
            Vector3d end = Vector3d::Zero();
            // An axle is perpendicular to the direction of its wheels.
            const int x = s_.normal == 0 ? 1 : 0, y = s_.normal == 2 ? 1 : 2;
            end[body_->weight > 0 ? x : y] = half;
            element(Kind::bar, {spot_at(-end), spot_at(end)});
            return;
        }
        if (!are_in_line(held)) {
            add_plate(held);
            return;
        }
        add_line(held, square);
    }

    bool are_in_line(const std::vector<int>& held) const {
        const Vector3d first = arm(held[0]).normalized();
        return std::all_of(held.begin(), held.end(),
                           [&](int place) { return arm(place).cross(first).norm() <= 1e-6 * s_.scale; });
    }

    /// A rod through points on a line with the mass centre.
    void add_line(const std::vector<int>& held, double square) {
        const Vector3d along = arm(held[0]).normalized();
        const auto less = [&](int a, int b) { return arm(a).dot(along) < arm(b).dot(along); };
        const auto [first, last] = std::minmax_element(held.begin(), held.end(), less);
        int from = s_.spot(*first), to = s_.spot(*last);
        const double low = arm(*first).dot(along), high = arm(*last).dot(along);
        if (low > 0 || high < 0) {
            const double reach = low > 0 ? high : low;
            const bool is_rod = nearly(square, reach * reach / 3, 0.05);
            const int other = is_rod                       ? spot_at(own(-reach * along))
                              : s_.is_fixed(body_->centre) ? s_.spot(s_.canonical(body_->centre).track)
                                                           : centre();
            from = s_.spot(low > 0 ? *last : *first);
            to = other;
            if (square == 0 && !s_.is_fixed(body_->centre)) {
                element(Kind::rod, {from, to}, 0, s_.name_of_length(low > 0 ? *last : *first, body_->centre));
                element(Kind::disc, {centre()}, body_->weight);
                return;
            }
            element(Kind::bar, {from, to}, 0,
                    is_rod ? "" : s_.name_of_length(low > 0 ? *last : *first, body_->centre));
            return;
        }
        element(Kind::bar, {from, to}, 0, s_.name_of_length(*first, *last));
    }

    void add_plate(const std::vector<int>& held) {
        // The convex hull of the points and the mass centre, by gift wrapping in the plane.
        std::vector<int> places = held;
        places.push_back(body_->centre);
        const int x = s_.normal == 0 ? 1 : 0, y = s_.normal == 2 ? 1 : 2;
        const auto cross = [&](int o, int a, int b) {
            const Vector3d p = s_.at(0, a) - s_.at(0, o), q = s_.at(0, b) - s_.at(0, o);
            return p[x] * q[y] - p[y] * q[x];
        };
        int start = places[0];
        for (const int p : places)
            if (s_.at(0, p)[x] < s_.at(0, start)[x]) start = p;
        std::vector<int> corners;
        int here = start;
        do {
            corners.push_back(s_.spot(here));
            int next = places[0] == here ? places[1] : places[0];
            for (const int p : places) {
                const double side = cross(here, next, p);
                if (side < -1e-12 || (std::abs(side) <= 1e-12 && (s_.at(0, p) - s_.at(0, here)).norm() >
                                                                     (s_.at(0, next) - s_.at(0, here)).norm()))
                    next = p;
            }
            here = next;
        } while (here != start && corners.size() <= places.size());
        element(Kind::plate, corners);
    }

    void add_in_space(const std::vector<int>& held) {
        const Vector3d& I = body_->inertia;
        const int axis = axis_of_symmetry();
        const bool is_flat = axis >= 0 && nearly(I[axis], 2 * I[(axis + 1) % 3], 0.02) && I[axis] > 0;
        const bool carries = std::any_of(held.begin(), held.end(), [&](int p) { return arm(p).norm() > 0; });
        if (is_flat) {
            add_ring(axis, std::sqrt(2 * I[axis]));
            if (!carries) return;
        }
        if (carries) {
            if (are_in_line(held))
                add_line(held, I.maxCoeff());
            else
                for (const int place : held) element(Kind::bar, {centre(), s_.spot(place)});
            if (is_flat || held.size() != 1 || !(I.norm() > 0)) return;
            const Vector3d stem = own(arm(held[0]).normalized()).cwiseAbs();
            for (int k = 0; k < 3; ++k)
                if (stem[k] > 0.999 && nearly(I[(k + 1) % 3], I[(k + 2) % 3], 1e-6) && I[k] > 0 &&
                    2 * I[k] > std::pow(0.2 * arm(held[0]).norm(), 2))
                    add_ring(k, std::min(std::sqrt(2 * I[k]), 0.4 * arm(held[0]).norm()));
            return;
        }
        if (is_flat) return;
        add_by_inertia();
    }

    void add_by_inertia() {
        const Vector3d& I = body_->inertia;
        if (I.norm() == 0) {
            element(Kind::disc, {centre()}, body_->weight);
            return;
        }
        if (nearly(I[0], I[1], 1e-6) && nearly(I[0], I[2], 1e-6)) {
            const double r = std::sqrt(2.5 * I[0]);
            element(Kind::ball, {centre(), spot_at({r, 0, 0}), spot_at({0, r, 0}), spot_at({0, 0, r})}, r,
                    s_.scene.joints.empty() ? "" : "cage");
            return;
        }
        const double all = I.sum();
        Vector3d half;
        for (int k = 0; k < 3; ++k) half[k] = std::sqrt(std::max(1.5 * (all - 2 * I[k]), 1e-4 * all));
        FigureElement box{.kind = Kind::solid, .points = {}, .owner = body_->mass, .faces = faces_of_box()};
        for (int corner = 0; corner < 8; ++corner) {
            Vector3d place = half;
            for (int k = 0; k < 3; ++k)
                if ((corner >> k & 1) == 0) place[k] = -half[k];
            box.points.push_back(spot_at(place));
        }
        s_.add(std::move(box));
    }

    Sketch& s_;
    const Asked& asked_;
    LooksOfScene& looks_;
    const Sketch::Frame3* body_ = nullptr;
};

}  // namespace

void add_bodies(Sketch& sketch, const Asked& asked, LooksOfScene& looks) {
    BodyShapes shapes(sketch, asked, looks);
    for (const Sketch::Frame3& body : sketch.bodies)
        if (!sketch.shown.contains(body.mass)) shapes.add(body);
}

}  // namespace alembert
