// SPDX-License-Identifier: GPL-2.0-or-later
#include "model/joints.hpp"

#include <algorithm>

#include "scene/placing.hpp"

namespace alembert {

using GiNaC::ex;
using Type = Joint::Type;

namespace {

/// About an axis, or by a quaternion.
struct Turn {
    Vector3 axis;
    ex angle = 0;
    std::optional<std::array<ex, 4>> quaternion = {};
};

Vector3 unit(int k) {
    Vector3 e{0, 0, 0};
    e[static_cast<std::size_t>(k)] = 1;
    return e;
}

/// Of the joint: turns about axes that each takes along, and shifts along its axes in the parent.
struct Motion {
    std::vector<Turn> turns = {};
    Vector3 shift{0, 0, 0};
};

Motion motion_of(const Joint& joint, Places& places) {
    std::vector<ex> q;
    for (const Name& name : joint.coordinates) q.push_back(places.value(name));
    Intermediates& z = places.z();
    const auto turns_in_space = [&](std::size_t first) {
        Motion motion;
        if (joint.angles.empty()) {
            motion.turns.push_back({.axis = {}, .quaternion = std::array<ex, 4>{q[first], q[first + 1], q[first + 2], q[first + 3]}});
            return motion;
        }
        for (std::size_t k = 0; k < 3; ++k) motion.turns.push_back({unit(joint.angles.at(k) - 'x'), q[first + k]});
        return motion;
    };
    switch (joint.type) {
        case Type::fixed: return {};
        case Type::revolute: return {.turns = {{places.unit_axis(joint.axis), q[0]}}};
        case Type::prismatic: return {.shift = scale(q[0], places.unit_axis(joint.axis), z)};
        case Type::cylindrical: {
            const Vector3 a = places.unit_axis(joint.axis);
            return {.turns = {{a, q[0]}}, .shift = scale(q[1], a, z)};
        }
        case Type::screw: {
            const Vector3 a = places.unit_axis(joint.axis);
            return {.turns = {{a, q[0]}}, .shift = scale(places.value(joint.pitch) * q[0], a, z)};
        }
        case Type::universal: return {.turns = {{unit(0), q[0]}, {unit(1), q[1]}}};
        case Type::planar: return {.turns = {{unit(2), q[2]}}, .shift = {q[0], q[1], 0}};
        case Type::spherical: return turns_in_space(0);
        case Type::free: {
            Motion motion = turns_in_space(3);
            motion.shift = {q[0], q[1], q[2]};
            return motion;
        }
    }
    return {};
}

std::vector<Turn> turns_of(const std::vector<Rotation>& rotations, Places& places) {
    std::vector<Turn> turns;
    for (const Rotation& r : rotations) turns.push_back({places.unit_axis(r), places.value(r.angle)});
    return turns;
}

std::vector<Turn> backwards(std::vector<Turn> turns) {
    std::reverse(turns.begin(), turns.end());
    for (Turn& turn : turns) {
        turn.angle = -turn.angle;
        for (std::size_t k = 1; turn.quaternion && k < 4; ++k) (*turn.quaternion)[k] = -(*turn.quaternion)[k];
    }
    return turns;
}

Orientation turned(Orientation o, const std::vector<Turn>& turns, Places& places) {
    for (const Turn& turn : turns) o = turn.quaternion ? places.turned(o, *turn.quaternion) : places.turned(o, turn.axis, turn.angle);
    return o;
}

Vector3 minus(const Vector3& a, const Vector3& b, Intermediates& z) { return add(a, scale(-1, b, z), z); }

/// The joint's point of the body.
Vector3 point_of(const Joint::Side& side, Places& places) {
    const Vector3 offset = places.vector(side.point);
    return add(places.position_of_body(side.body.text), places.orientation(side.body.text).to_inertial(offset, places.z()), places.z());
}

/// The joint's axes in the body.
Orientation axes_of(const Joint::Side& side, Places& places) {
    return turned(places.orientation(side.body.text), turns_of(side.rotate, places), places);
}

/// Two directions across the axis, near to those of the letters that it is farthest from, and which letter is left.
struct Across {
    std::array<Vector3, 3> e;  ///< at `along` the axis itself
    int along;
};

Across across(const Vector3& a, Places& places) {
    Intermediates& z = places.z();
    int along = 2;
    for (const int k : {1, 0})
        if (std::abs(places.number(a[k])) > std::abs(places.number(a[along])) + 1e-12) along = k;
    const int i = along == 0 ? 1 : 0, j = along == 2 ? 1 : 2;
    Across result{.e = {}, .along = along};
    const Vector3 e = minus(unit(i), scale(a[i], a, z), z);
    result.e[along] = a;
    result.e[i] = scale(1 / norm(e, z), e, z);
    result.e[j] = cross(a, result.e[i], z);
    if (places.number(result.e[j][j]) < 0) result.e[j] = scale(-1, result.e[j], z);
    return result;
}

}  // namespace

Orientation orientation_by(const Joint& joint, Places& places) {
    const std::vector<Turn> turns = motion_of(joint, places).turns;
    const bool forwards = *joint.places_child;
    const Joint::Side &from = forwards ? joint.parent : joint.child, &to = forwards ? joint.child : joint.parent;
    return turned(turned(axes_of(from, places), forwards ? turns : backwards(turns), places),
                  backwards(turns_of(to.rotate, places)), places);
}

Vector3 position_by(const Joint& joint, Places& places) {
    Intermediates& z = places.z();
    const bool forwards = *joint.places_child;
    const Joint::Side &from = forwards ? joint.parent : joint.child, &to = forwards ? joint.child : joint.parent;
    const Vector3 shift = axes_of(joint.parent, places).to_inertial(motion_of(joint, places).shift, z);
    const Vector3 point = add(point_of(from, places), scale(forwards ? 1 : -1, shift, z), z);
    return minus(point, places.orientation(to.body.text).to_inertial(places.vector(to.point), z), z);
}

JointArc arc_of(const Joint& joint, Places& places) {
    Intermediates& z = places.z();
    JointArc arc{.name = joint.name.text,
                 .type = joint_types()[static_cast<std::size_t>(joint.type)],
                 .role = !joint.places_child    ? JointArc::Role::closes_loop
                         : *joint.places_child ? JointArc::Role::places_child
                                               : JointArc::Role::places_parent};
    if (arc.role == JointArc::Role::closes_loop) return arc;
    const bool forwards = *joint.places_child;
    const Motion motion = motion_of(joint, places);
    const Orientation inner = axes_of(forwards ? joint.parent : joint.child, places), parent = axes_of(joint.parent, places),
                      relative = turned(Orientation(), forwards ? motion.turns : backwards(motion.turns), places);
    arc.shift = motion.shift;
    arc.turning = relative.to_inertial(relative.angular_velocity(), z);
    // Not as differences of positions, which lose digits far from O.
    const auto arm = [&](const Joint::Side& side) {
        return places.orientation(side.body.text).to_inertial(places.vector(side.point), z);
    };
    const Vector3 there = add(arm(joint.parent), parent.to_inertial(motion.shift, z), z), back = arm(joint.child);
    arc.to_pivot = forwards ? there : back;
    arc.from_pivot = scale(-1, forwards ? back : there, z);
    for (int k = 0; k < 3; ++k) {
        arc.axes[k] = inner.axis(k);
        arc.slide_axes[k] = parent.axis(k);
        arc.sliding[k] = places.rate(motion.shift[k]);
    }
    return arc;
}

int point_by(const Joint& joint, Places& places) {
    const bool forwards = *joint.places_child;
    const Joint::Side &from = forwards ? joint.parent : joint.child, &to = forwards ? joint.child : joint.parent;
    const auto body_point = [&](const std::string& body) { return body == "N" ? 0 : places.point(body); };
    int point = places.step(body_point(from.body.text), places.orientation(from.body.text).frame, places.vector(from.point));
    const Vector3 shift = scale(forwards ? 1 : -1, motion_of(joint, places).shift, places.z());
    point = places.step(point, axes_of(joint.parent, places).frame, shift);
    return places.step(point, places.orientation(to.body.text).frame, scale(-1, places.vector(to.point), places.z()));
}

std::vector<ClosingRow> closing_rows(const Joint& joint, Places& places) {
    Intermediates& z = places.z();
    const Orientation J = axes_of(joint.parent, places), K = axes_of(joint.child, places);
    const Vector3 d = minus(point_of(joint.child, places), point_of(joint.parent, places), z);
    const auto in_J = [&](const Vector3& v) { return J.to_inertial(v, z); };
    std::vector<ClosingRow> rows;
    const auto shift = [&](const Vector3& e) { rows.push_back({true, dot(d, in_J(e), z)}); };
    const auto turn = [&](const Vector3& e, const Vector3& a) {
        rows.push_back({true, dot(K.to_inertial(a, z), in_J(cross(e, a, z)), z)});
    };
    const auto turns_across = [&](const Across& directions) {
        for (int k = 0; k < 3; ++k)
            if (k != directions.along) turn(directions.e[k], directions.e[directions.along]);
    };
    const auto no_turns = [&] {
        for (int k = 0; k < 3; ++k) turn(unit(k), unit((k + 2) % 3));
    };
    switch (joint.type) {
        case Type::fixed:
            for (int k = 0; k < 3; ++k) shift(unit(k));
            no_turns();
            break;
        case Type::spherical:
            for (int k = 0; k < 3; ++k) shift(unit(k));
            break;
        case Type::universal:
            for (int k = 0; k < 3; ++k) shift(unit(k));
            rows.push_back({true, z.name(-dot(J.axis(0), K.axis(1), z))});
            break;
        case Type::planar:
            shift(unit(2));
            turns_across({.e = {unit(0), unit(1), unit(2)}, .along = 2});
            break;
        case Type::free: break;
        default: {
            const Across directions = across(places.unit_axis(joint.axis), places);
            for (int k = 0; k < 3; ++k) {
                if (joint.type == Type::revolute || k != directions.along) {
                    shift(joint.type == Type::revolute ? unit(k) : directions.e[k]);
                } else if (joint.type == Type::screw) {
                    const Vector3 a = in_J(directions.e[k]);
                    const Vector3 turning = minus(K.to_inertial(K.angular_velocity(), z), J.to_inertial(J.angular_velocity(), z), z);
                    rows.push_back({false, z.name(places.rate(dot(d, a, z)) - places.value(joint.pitch) * dot(turning, a, z))});
                }
            }
            if (joint.type == Type::prismatic)
                no_turns();
            else
                turns_across(directions);
        }
    }
    return rows;
}

}  // namespace alembert
