// SPDX-License-Identifier: GPL-2.0-or-later
/// What the scene asks to be drawn beside its bodies.
#include <algorithm>
#include <cmath>

#include "present/figure/parts.hpp"

namespace alembert {

namespace {

using Eigen::Vector3d;
using GiNaC::ex;
using Kind = FigureElement::Kind;

constexpr int parts_of_curve = 64;

/// Quarter turn of a vector in the plane perpendicular to `normal`, counterclockwise in the plane's axes.
Vector3 quarter(const Vector3& v, int normal) {
    const std::size_t x = normal == 0 ? 1 : 0, y = normal == 2 ? 1 : 2;
    Vector3 turned{0, 0, 0};
    turned[x] = -v[y];
    turned[y] = v[x];
    return turned;
}

Vector3 difference(const Vector3& a, const Vector3& b) {
    return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}
Vector3 plus(const Vector3& a, const ex& k, const Vector3& b) {
    return {a[0] + k * b[0], a[1] + k * b[1], a[2] + k * b[2]};
}
ex square(const Vector3& a) {
    return a[0] * a[0] + a[1] * a[1] + a[2] * a[2];
}

/// A place that a rope passes: a point, or the rim of a pulley at its left (side 1) or right (−1), seen from the
/// pulley along the way.
struct Bend {
    Vector3 centre;
    ex radius = 0;
    double size = 0;
    int side = 0;
    Vector3d here;
};

/// Where a straight piece of rope leaves `a` and reaches `b`. It is perpendicular to the unit vector n with
/// n·(b − a) = σ_a r_a − σ_b r_b, and touches at centre + σ r n.
std::pair<Vector3, Vector3> tangent(const Bend& a, const Bend& b, int normal) {
    const Vector3 way = difference(b.centre, a.centre);
    const ex off = a.side * a.radius - b.side * b.radius, whole = square(way);
    const bool is_nowhere = whole.expand().is_zero();  // a rope that ends in the centre of its pulley
    if (is_nowhere || (off.is_zero() && a.side == 0)) return {a.centre, b.centre};
    const ex along = -off / whole, across = GiNaC::sqrt(whole - off * off) / whole;
    Vector3 n{0, 0, 0};
    n = plus(n, -along, way);
    n = plus(n, across, quarter(way, normal));
    return {plus(a.centre, a.side * a.radius, n), plus(b.centre, b.side * b.radius, n)};
}

}  // namespace

LooksOfScene::LooksOfScene(Sketch& sketch) : s_(sketch), looks_(looks_of(sketch.scene)) {
    for (const Scenery& one : looks_.scenery) {
        std::vector<int> tracks;
        if (one.kind != Scenery::Kind::curve)
            for (const Scenery::Spot& spot : one.spots) tracks.push_back(s_.track(place_of(spot)));
        s_.also.insert(s_.also.end(), tracks.begin(), tracks.end());
        const bool is_place = one.kind == Scenery::Kind::dot || one.kind == Scenery::Kind::solid;
        if (s_.m.masses.empty() && is_place) s_.add_site(tracks[0]);
        const bool is_round = one.kind == Scenery::Kind::circle || one.kind == Scenery::Kind::pulley;
        radii_.push_back(is_round ? s_.scalar(size(one.shape, 0)) : -1);
        tracks_.push_back(std::move(tracks));
    }
}

Vector3 LooksOfScene::place_of(const Scenery::Spot& spot) {
    if (!spot.name) return s_.formulas.places().vector(spot.position);
    for (const Scenery& one : looks_.scenery)
        if (one.kind == Scenery::Kind::pulley && one.name && one.name->text == spot.name->text)
            return place_of(one.spots[0]);
    return s_.formulas.places().position(spot.name->text);
}

bool LooksOfScene::has_circle(int middle, int through) const {
    const std::optional<double> apart = s_.distance(middle, through);
    for (std::size_t k = 0; k < looks_.scenery.size() && apart; ++k)
        if (looks_.scenery[k].kind == Scenery::Kind::circle && s_.same(tracks_[k][0], middle) &&
            std::abs(s_.at(0, radii_[k])[0] - *apart) <= 1e-6 * *apart)
            return true;
    return false;
}

void LooksOfScene::add_scenery() {
    for (std::size_t k = 0; k < looks_.scenery.size(); ++k) {
        const Scenery& one = looks_.scenery[k];
        if (one.kind == Scenery::Kind::rope)
            add_rope(one);
        else if (one.kind == Scenery::Kind::curve || one.from)
            add_curve(one);
        else
            add_one(one, tracks_[k]);
        if (!one.label.empty() && !tracks_[k].empty() && one.kind != Scenery::Kind::spring &&
            one.kind != Scenery::Kind::damper && one.kind != Scenery::Kind::dot)
            s_.add({.kind = Kind::mark,
                    .points = {s_.spot(tracks_[k][0])},
                    .label = one.label,
                    .size = one.kind == Scenery::Kind::solid ? 1.0 : 0.0});
    }
}

void LooksOfScene::add_one(const Scenery& one, const std::vector<int>& tracks) {
    std::vector<int> points;
    for (const int track : tracks) points.push_back(s_.spot(track));
    const auto add = [&](Kind kind) { s_.add({.kind = kind, .points = points, .label = one.label}); };
    switch (one.kind) {
        case Scenery::Kind::line:
            return s_.add({.kind = Kind::line, .points = points});
        case Scenery::Kind::wall:
        case Scenery::Kind::floor:
            return s_.add({.kind = Kind::ground, .points = points});
        case Scenery::Kind::spring:
            return add(Kind::spring);
        case Scenery::Kind::damper:
            return add(Kind::damper);
        case Scenery::Kind::support:
            return s_.add({.kind = Kind::support, .points = points});
        case Scenery::Kind::dot:
            return add(Kind::disc);
        case Scenery::Kind::circle:
        case Scenery::Kind::pulley: {
            const ex radius = size(one.shape, 0);
            const Axes axes = axes_of(one.shape, place_of(one.spots[0]), "N");
            return add_round(one.kind == Scenery::Kind::circle ? Kind::hoop : Kind::pulley, radius, one.shape.axis,
                             axes, -1);
        }
        default:
            return add_solid(one.shape, axes_of(one.shape, place_of(one.spots[0]), "N"), -1);
    }
}

/// Straight pieces between the points and rims of a rope. At a pulley it runs on the side that is away from its
/// neighbours.
void LooksOfScene::add_rope(const Scenery& rope) {
    std::vector<Bend> bends;
    for (const Scenery::Spot& spot : rope.spots) {
        Bend bend{.centre = place_of(spot), .here = {}};
        bend.here = s_.numbers(bend.centre);
        for (const Scenery& one : looks_.scenery)
            if (spot.name && one.kind == Scenery::Kind::pulley && one.name && one.name->text == spot.name->text) {
                bend.radius = size(one.shape, 0);
                bend.size = s_.number(bend.radius);
            }
        bends.push_back(std::move(bend));
    }
    for (Bend* const end : {&bends.front(), &bends.back()}) end->size = 0;
    for (std::size_t k = 0; k < bends.size(); ++k) {
        Bend& bend = bends[k];
        if (!(bend.size > 0) || !s_.is_plane) {
            bend.radius = 0;
            continue;
        }
        const std::size_t x = s_.normal == 0 ? 1 : 0, y = s_.normal == 2 ? 1 : 2;
        const Vector3d in = bend.here - bends[k - 1].here, out = bends[k + 1].here - bend.here;
        // The rope that turns to the right has the pulley to its right.
        bend.side = in[x] * out[y] - in[y] * out[x] >= 0 ? -1 : 1;
    }
    for (std::size_t k = 0; k + 1 < bends.size(); ++k) {
        const auto [from, to] = tangent(bends[k], bends[k + 1], s_.normal);
        s_.add({.kind = Kind::rope, .points = {spot(from), spot(to)}});
    }
}

/// A curve on which one coordinate leads, or a part of a circle.
void LooksOfScene::add_curve(const Scenery& curve) {
    const ex low = s_.formulas.value(curve.from), high = s_.formulas.value(curve.to);
    std::vector<int> points;
    const bool is_circle = curve.kind == Scenery::Kind::circle;
    const Axes axes = is_circle ? axes_of(curve.shape, place_of(curve.spots[0]), "N") : Axes{};
    const std::array<int, 3> k = order(curve.shape.axis);
    for (int i = 0; i <= parts_of_curve; ++i) {
        const ex value = low + (high - low) * i / parts_of_curve;
        if (is_circle) {
            const ex r = size(curve.shape, 0);
            points.push_back(
                spot(plus(plus(axes.middle, r * GiNaC::cos(value), axes.axis[static_cast<std::size_t>(k[0])]),
                          r * GiNaC::sin(value), axes.axis[static_cast<std::size_t>(k[1])])));
            continue;
        }
        Vector3 place = s_.formulas.places().vector(curve.spots[0].position);
        for (std::size_t q = 0; q < s_.m.q.size(); ++q)
            if (s_.m.q[q].get_name() == curve.over->text)
                for (ex& component : place) component = s_.m.z->expand(component).subs(s_.m.q[q] == value);
        points.push_back(spot(place));
    }
    s_.add({.kind = Kind::curve, .points = points});
}

}  // namespace alembert
