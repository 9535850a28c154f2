// SPDX-License-Identifier: GPL-2.0-or-later
/// The shapes that a scene gives to its bodies and particles.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "present/figure/parts.hpp"

namespace alembert {

namespace {

using Eigen::Vector3d;
using Kind = FigureElement::Kind;
using GiNaC::ex;

constexpr int sides = 24;  // of a cylinder or a cone

Vector3 sum(const Vector3& a, const ex& k, const Vector3& b) {
    return {a[0] + k * b[0], a[1] + k * b[1], a[2] + k * b[2]};
}

ex cosine(int k) {
    return exactly(std::cos(2 * std::numbers::pi * k / sides));
}
ex sine(int k) {
    return exactly(std::sin(2 * std::numbers::pi * k / sides));
}

}  // namespace

std::vector<std::vector<int>> faces_of_box() {
    return {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}};
}

/// The axes of the shape in an order in which that letter is the last: the first two span its face. Without a
/// letter it is the normal of a plane figure, and z in space.
std::array<int, 3> LooksOfScene::order(char axis) const {
    const int last = axis != 0 ? axis - 'x' : s_.is_plane ? s_.normal : 2;
    if (axis == 0 && s_.is_plane) return {s_.normal == 0 ? 1 : 0, s_.normal == 2 ? 1 : 2, last};
    return {(last + 1) % 3, (last + 2) % 3, last};
}

LooksOfScene::Axes LooksOfScene::axes_of(const Shape& shape, const Vector3& place, const std::string& frame) {
    Axes result{place, {}};
    const std::string& name = shape.axes ? shape.axes->text : frame;
    const Orientation& o = s_.formulas.places().orientation(name);
    for (int k = 0; k < 3; ++k) result.axis[static_cast<std::size_t>(k)] = o.axis(k);
    for (int k = 0; k < 3; ++k)
        result.middle = sum(result.middle, s_.formulas.value(shape.middle.component[static_cast<std::size_t>(k)]),
                            result.axis[static_cast<std::size_t>(k)]);
    if (!shape.turn) return result;
    const ex angle = s_.formulas.value(shape.turn), c = GiNaC::cos(angle), n = GiNaC::sin(angle);
    const Vector3 none{0, 0, 0}, x = result.axis[0], y = result.axis[1];
    result.axis[0] = sum(sum(none, c, x), n, y);
    result.axis[1] = sum(sum(none, c, y), -n, x);
    return result;
}

LooksOfScene::Axes LooksOfScene::axes_of_mass(const std::string& name, const Shape& shape) {
    const bool is_body = std::any_of(s_.scene.bodies.begin(), s_.scene.bodies.end(),
                                     [&](const Body& body) { return body.name.text == name; });
    Places& places = s_.formulas.places();
    return axes_of(shape, places.position(places.centre_of(name)), is_body ? name : "N");
}

Vector3 LooksOfScene::in(const Axes& axes, const ex& x, const ex& y, const ex& z) {
    return sum(sum(sum(axes.middle, x, axes.axis[0]), y, axes.axis[1]), z, axes.axis[2]);
}

int LooksOfScene::add_shape(const std::string& name, int owner) {
    const Shape& shape = *looks_.shape_of(name);
    const Axes axes = axes_of_mass(name, shape);
    add_solid(shape, axes, owner);
    const int middle = s_.track(axes.middle);
    const bool is_elsewhere = std::any_of(shape.middle.component.begin(), shape.middle.component.end(),
                                          [](const Expression& e) { return e.text != "0"; });
    if (is_elsewhere) s_.middles.emplace_back(s_.place(name), middle);
    return s_.spot(middle);
}

void LooksOfScene::add_solid(const Shape& shape, const Axes& axes, int owner) {
    switch (shape.kind) {
        case Shape::Kind::disc:
            return add_round(Kind::ring, size(shape, 0), shape.axis, axes, owner);
        case Shape::Kind::ring:
            return add_round(Kind::hoop, size(shape, 0), shape.axis, axes, owner);
        case Shape::Kind::ball: {
            const ex r = size(shape, 0);
            if (s_.is_plane) return add_round(Kind::ring, r, 0, axes, owner);
            const int centre = s_.track(axes.middle);
            s_.add({.kind = Kind::ball,
                    .points = {s_.spot(centre), spot(in(axes, r, 0, 0)), spot(in(axes, 0, r, 0)),
                               spot(in(axes, 0, 0, r))},
                    .size = s_.number(r),
                    .owner = owner});
            return;
        }
        case Shape::Kind::ellipsoid:
            return add_ellipsoid(shape, axes, owner);
        case Shape::Kind::rod: {
            Axes ends = axes;
            const int axis = shape.axis != 0 ? shape.axis - 'x' : s_.is_plane && s_.normal == 0 ? 1 : 0;
            const Vector3 way = axes.axis[static_cast<std::size_t>(axis)];
            const ex half = size(shape, 0) / 2;
            s_.add({.kind = Kind::bar,
                    .points = {spot(sum(axes.middle, -half, way)), spot(sum(axes.middle, half, way))},
                    .owner = owner});
            return;
        }
        case Shape::Kind::box:
            return add_box(shape, axes, owner);
        case Shape::Kind::polygon:
            return add_flat(shape, axes, owner);
        case Shape::Kind::cylinder:
        case Shape::Kind::cone:
            return add_turned(shape, axes, owner);
    }
}

void LooksOfScene::add_round(Kind kind, const ex& radius, char axis, const Axes& axes, int owner) {
    const std::array<int, 3> k = order(axis);
    s_.add(
        {.kind = kind,
         .points = {spot(axes.middle), spot(sum(axes.middle, radius, axes.axis[static_cast<std::size_t>(k[0])])),
                    spot(sum(axes.middle, radius, axes.axis[static_cast<std::size_t>(k[1])]))},
         .size = s_.number(radius),
         .owner = owner});
}

void LooksOfScene::add_ellipsoid(const Shape& shape, const Axes& axes, int owner) {
    const std::array<int, 3> k = order(s_.is_plane ? 0 : 'z');
    FigureElement body{
        .kind = s_.is_plane ? Kind::ring : Kind::ellipsoid, .points = {spot(axes.middle)}, .owner = owner};
    for (std::size_t i = 0; i < (s_.is_plane ? 2 : 3); ++i)
        body.points.push_back(spot(sum(axes.middle, size(shape, static_cast<std::size_t>(k[i])),
                                       axes.axis[static_cast<std::size_t>(k[i])])));
    s_.add(std::move(body));
}

/// The corners of a polygon, in the plane of the figure or of x and y.
void LooksOfScene::add_flat(const Shape& shape, const Axes& axes, int owner) {
    const std::array<int, 3> k = order(s_.is_plane ? 0 : 'z');
    std::vector<int> corners;
    for (std::size_t i = 0; i + 1 < shape.sizes.size(); i += 2)
        corners.push_back(spot(sum(sum(axes.middle, size(shape, i), axes.axis[static_cast<std::size_t>(k[0])]),
                                   size(shape, i + 1), axes.axis[static_cast<std::size_t>(k[1])])));
    s_.add({.kind = Kind::plate, .points = corners, .owner = owner});
}

void LooksOfScene::add_box(const Shape& shape, const Axes& axes, int owner) {
    std::array<ex, 3> half{size(shape, 0) / 2, size(shape, 1) / 2, 0};
    if (shape.sizes.size() > 2) half[2] = size(shape, 2) / 2;
    if (s_.is_plane || shape.sizes.size() == 2) {
        std::array<int, 3> k = order(s_.is_plane ? 0 : 'z');
        std::array<ex, 2> edge{half[0], half[1]};
        if (shape.sizes.size() > 2)
            edge = {half[static_cast<std::size_t>(k[0])], half[static_cast<std::size_t>(k[1])]};
        std::vector<int> corners;
        for (const auto& [x, y] : {std::pair(-1, -1), std::pair(1, -1), std::pair(1, 1), std::pair(-1, 1)})
            corners.push_back(spot(sum(sum(axes.middle, x * edge[0], axes.axis[static_cast<std::size_t>(k[0])]),
                                       y * edge[1], axes.axis[static_cast<std::size_t>(k[1])])));
        s_.add({.kind = Kind::plate, .points = corners, .owner = owner});
        return;
    }
    FigureElement box{.kind = Kind::solid, .points = {}, .owner = owner};
    for (int corner = 0; corner < 8; ++corner) {
        const auto sign = [&](int bit) { return (corner >> bit & 1) != 0 ? 1 : -1; };
        box.points.push_back(spot(in(axes, sign(0) * half[0], sign(1) * half[1], sign(2) * half[2])));
    }
    box.faces = faces_of_box();
    s_.add(std::move(box));
}

/// A cylinder about its middle, or a cone about its centroid, which is a quarter of its height above the base.
void LooksOfScene::add_turned(const Shape& shape, const Axes& axes, int owner) {
    const bool is_cone = shape.kind == Shape::Kind::cone;
    const ex r = size(shape, 0), h = size(shape, 1);
    const std::array<int, 3> k = order(shape.axis);
    const auto at = [&](const ex& x, const ex& y, const ex& z) {
        return spot(sum(sum(sum(axes.middle, x, axes.axis[static_cast<std::size_t>(k[0])]), y,
                            axes.axis[static_cast<std::size_t>(k[1])]),
                        z, axes.axis[static_cast<std::size_t>(k[2])]));
    };
    if (s_.is_plane) {
        // Seen along its axis it is a disc, and from its side a rectangle or a triangle.
        if (k[2] == s_.normal) return add_round(Kind::ring, r, shape.axis, axes, owner);
        const int across = k[0] == s_.normal ? 1 : 0;
        const auto side = [&](const ex& x, const ex& z) { return across == 0 ? at(x, 0, z) : at(0, x, z); };
        std::vector<int> corners =
            is_cone ? std::vector{side(-r, -h / 4), side(r, -h / 4), side(0, 3 * h / 4)}
                    : std::vector{side(-r, -h / 2), side(r, -h / 2), side(r, h / 2), side(-r, h / 2)};
        s_.add({.kind = Kind::plate, .points = corners, .owner = owner});
        return;
    }
    FigureElement solid{.kind = Kind::solid, .points = {}, .owner = owner};
    const ex low = is_cone ? -h / 4 : -h / 2, high = is_cone ? ex(3 * h / 4) : ex(h / 2);
    for (int i = 0; i < sides; ++i) solid.points.push_back(at(r * cosine(i), r * sine(i), low));
    if (is_cone) solid.points.push_back(at(0, 0, high));
    for (int i = 0; i < sides && !is_cone; ++i) solid.points.push_back(at(r * cosine(i), r * sine(i), high));
    std::vector<int> base, top;
    for (int i = 0; i < sides; ++i) {
        const int next = (i + 1) % sides;
        base.push_back(sides - 1 - i);
        top.push_back(sides + i);
        solid.faces.push_back(is_cone ? std::vector{i, next, sides}
                                      : std::vector{i, next, sides + next, sides + i});
    }
    solid.faces.push_back(base);
    if (!is_cone) solid.faces.push_back(top);
    if (s_.number(h) < 0)  // it points the other way
        for (std::vector<int>& face : solid.faces) std::reverse(face.begin(), face.end());
    s_.add(std::move(solid));
}

double LooksOfScene::reach(const std::string& name, const Vector3d& direction) {
    const Shape& shape = *looks_.shape_of(name);
    const Axes axes = axes_of_mass(name, shape);
    Places& places = s_.formulas.places();
    const Vector3d middle = s_.numbers(axes.middle) - s_.numbers(places.position(places.centre_of(name)));
    double far = middle.dot(direction);
    if (shape.kind == Shape::Kind::box || shape.kind == Shape::Kind::polygon) {
        const std::array<int, 3> k = order(s_.is_plane ? 0 : 'z');
        const bool is_box = shape.kind == Shape::Kind::box;
        const Vector3d u = s_.numbers(axes.axis[static_cast<std::size_t>(k[0])]),
                       v = s_.numbers(axes.axis[static_cast<std::size_t>(k[1])]);
        if (is_box)
            return far + (std::abs(u.dot(direction)) * s_.number(size(shape, 0)) +
                          std::abs(v.dot(direction)) * s_.number(size(shape, 1))) /
                             2;
        double most = -1e300;
        for (std::size_t i = 0; i + 1 < shape.sizes.size(); i += 2)
            most =
                std::max(most, (s_.number(size(shape, i)) * u + s_.number(size(shape, i + 1)) * v).dot(direction));
        return far + most;
    }
    if (shape.kind == Shape::Kind::ellipsoid) {
        double square = 0;
        for (std::size_t k = 0; k < 3; ++k)
            square += std::pow(s_.numbers(axes.axis[k]).dot(direction) * s_.number(size(shape, k)), 2);
        return far + std::sqrt(square);
    }
    return far + (shape.kind == Shape::Kind::rod ? 0 : s_.number(size(shape, 0)));
}

}  // namespace alembert
