// SPDX-License-Identifier: GPL-2.0-or-later
#include "model/joints.hpp"

#include <algorithm>

#include "scene/joint_moves.hpp"

namespace alembert {

using GiNaC::ex;

namespace {

/// A turn about an axis, or by a quaternion.
struct JointTurn {
    Vector3 axis;
    ex angle = 0;
    std::optional<std::array<ex, 4>> quaternion = {};
};

Vector3 unit(int k) {
    Vector3 e{0, 0, 0};
    e[static_cast<std::size_t>(k)] = 1;
    return e;
}

/// The motion of a joint: turns about axes that the turns before carry along, and shifts along its axes in the
/// parent.
struct Motion {
    std::vector<JointTurn> turns = {};
    Vector3 shift{0, 0, 0};
};

/// The x, y or z axis of the joint, or the axis that the scene gives.
Vector3 direction_of(const Move& move, const Joint& joint, Places& places) {
    return move.along == 'a' ? places.unit_axis(joint.axis) : unit(move.along - 'x');
}

Motion motion_of(const Joint& joint, Places& places) {
    std::vector<ex> q;
    for (const Name& name : joint.coordinates) q.push_back(places.value(name));
    Intermediates& z = places.z();
    Motion motion;
    std::size_t next = 0;
    for (const Move& move : moves_of(joint.type).moves) {
        if (move.kind == Move::Kind::turn_in_space) {
            if (joint.angles.empty())
                motion.turns.push_back(
                    {.axis = {}, .quaternion = std::array<ex, 4>{q[next], q[next + 1], q[next + 2], q[next + 3]}});
            for (const char letter : joint.angles) motion.turns.push_back({unit(letter - 'x'), q[next++]});
            continue;
        }
        const Vector3 a = direction_of(move, joint, places);
        if (move.kind == Move::Kind::turn)
            motion.turns.push_back({a, q[next++]});
        else if (move.kind == Move::Kind::screw)
            motion.shift =
                add(motion.shift, scale(places.value(joint.pitch) * motion.turns.back().angle, a, z), z);
        else
            motion.shift = add(motion.shift, scale(q[next++], a, z), z);
    }
    return motion;
}

std::vector<JointTurn> turns_of(const std::vector<Rotation>& rotations, Places& places) {
    std::vector<JointTurn> turns;
    for (const Rotation& r : rotations) turns.push_back({places.unit_axis(r), places.value(r.angle)});
    return turns;
}

std::vector<JointTurn> backwards(std::vector<JointTurn> turns) {
    std::reverse(turns.begin(), turns.end());
    for (JointTurn& turn : turns) {
        turn.angle = -turn.angle;
        for (std::size_t k = 1; turn.quaternion && k < 4; ++k) (*turn.quaternion)[k] = -(*turn.quaternion)[k];
    }
    return turns;
}

Orientation turned(Orientation o, const std::vector<JointTurn>& turns, Places& places) {
    for (const JointTurn& turn : turns)
        o = turn.quaternion ? places.turned(o, *turn.quaternion) : places.turned(o, turn.axis, turn.angle);
    return o;
}

Vector3 minus(const Vector3& a, const Vector3& b, Intermediates& z) {
    return add(a, scale(-1, b, z), z);
}

/// The joint's point of the body.
Vector3 point_of(const Joint::Side& side, Places& places) {
    const Vector3 offset = places.vector(side.point);
    return add(places.position_of_body(side.body.text),
               places.orientation(side.body.text).to_inertial(offset, places.z()), places.z());
}

/// The joint's axes in the body.
Orientation axes_of(const Joint::Side& side, Places& places) {
    return turned(places.orientation(side.body.text), turns_of(side.rotate, places), places);
}

/// Two directions perpendicular to the axis, near those two of x, y, z from which it is farthest, and the
/// remaining letter.
struct Across {
    std::array<Vector3, 3> e;  ///< element `along` is the axis itself
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
    const std::vector<JointTurn> turns = motion_of(joint, places).turns;
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
                 .type = moves_of(joint.type).name,
                 .role = !joint.places_child   ? JointArc::Role::closes_loop
                         : *joint.places_child ? JointArc::Role::places_child
                                               : JointArc::Role::places_parent};
    if (arc.role == JointArc::Role::closes_loop) return arc;
    const bool forwards = *joint.places_child;
    const Motion motion = motion_of(joint, places);
    const Orientation inner = axes_of(forwards ? joint.parent : joint.child, places),
                      parent = axes_of(joint.parent, places),
                      relative = turned(Orientation(), forwards ? motion.turns : backwards(motion.turns), places);
    arc.shift = motion.shift;
    arc.turning = relative.to_inertial(relative.angular_velocity(), z);
    // Not computed as differences of positions, which lose digits far from O.
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
    const auto body_point = [&](const std::string& body) { return places.point(places.centre_of(body)); };
    int point = places.step(body_point(from.body.text), places.orientation(from.body.text).frame,
                            places.vector(from.point));
    const Vector3 shift = scale(forwards ? 1 : -1, motion_of(joint, places).shift, places.z());
    point = places.step(point, axes_of(joint.parent, places).frame, shift);
    return places.step(point, places.orientation(to.body.text).frame,
                       scale(-1, places.vector(to.point), places.z()));
}

std::vector<ClosingRow> closing_rows(const Joint& joint, Places& places) {
    Intermediates& z = places.z();
    const Orientation J = axes_of(joint.parent, places), K = axes_of(joint.child, places);
    const Vector3 here = point_of(joint.child, places), there = point_of(joint.parent, places);
    const Vector3 d = minus(here, there, z);
    std::vector<ex> lengths(here.begin(), here.end());
    lengths.insert(lengths.end(), there.begin(), there.end());
    const auto in_J = [&](const Vector3& v) { return J.to_inertial(v, z); };
    std::vector<ClosingRow> rows;
    const auto shift = [&](const Vector3& e) { rows.push_back({true, dot(d, in_J(e), z), lengths}); };
    const auto turn = [&](const Vector3& e, const Vector3& a) {
        rows.push_back({true, dot(K.to_inertial(a, z), in_J(cross(e, a, z)), z)});
    };
    const auto turns_across = [&](const Across& directions) {
        for (int k = 0; k < 3; ++k)
            if (k != directions.along) turn(directions.e[k], directions.e[directions.along]);
    };
    const JointMoves& type = moves_of(joint.type);
    if (type.has(Move::Kind::turn_in_space)) {
        if (type.before_turn_in_space() == 0)
            for (int k = 0; k < 3; ++k) shift(unit(k));
        return rows;
    }
    // Translations are along the joint's x, y, z; if it slides along its own axis, they are along that axis and
    // two directions perpendicular to it.
    Across directions{.e = {unit(0), unit(1), unit(2)}, .along = 2};
    std::array<const Move*, 3> slides{};
    std::vector<const Move*> turns;
    for (const Move& move : type.moves) {
        if (move.kind == Move::Kind::turn) {
            turns.push_back(&move);
            continue;
        }
        if (move.along == 'a') directions = across(places.unit_axis(joint.axis), places);
        slides[static_cast<std::size_t>(move.along == 'a' ? directions.along : move.along - 'x')] = &move;
    }
    for (int k = 0; k < 3; ++k) {
        if (slides[k] == nullptr) {
            shift(directions.e[k]);
        } else if (slides[k]->kind == Move::Kind::screw) {
            const Vector3 a = in_J(directions.e[k]);
            const Vector3 turning =
                minus(K.to_inertial(K.angular_velocity(), z), J.to_inertial(J.angular_velocity(), z), z);
            rows.push_back(
                {false, z.name(places.rate(dot(d, a, z)) - places.value(joint.pitch) * dot(turning, a, z))});
        }
    }
    // Rotations are locked about all three axes, or about the two perpendicular to the axis of the one free turn;
    // with two free turns, the row keeps their axes perpendicular.
    if (turns.empty())
        for (int k = 0; k < 3; ++k) turn(unit(k), unit((k + 2) % 3));
    if (turns.size() == 1)
        turns_across(turns[0]->along == 'a'
                         ? across(places.unit_axis(joint.axis), places)
                         : Across{.e = {unit(0), unit(1), unit(2)}, .along = turns[0]->along - 'x'});
    if (turns.size() == 2)
        rows.push_back({true, z.name(-dot(J.axis(turns[0]->along - 'x'), K.axis(turns[1]->along - 'x'), z))});
    return rows;
}

std::vector<ex> coinciding_axes(const Joint& joint, Places& places) {
    const JointMoves& type = moves_of(joint.type);
    std::vector<Vector3> axes;
    const Move* turn = nullptr;
    for (const Move& move : type.moves) {
        if (move.kind == Move::Kind::turn_in_space || (move.kind == Move::Kind::turn && turn != nullptr))
            return {};
        if (move.kind == Move::Kind::turn) turn = &move;
    }
    if (turn != nullptr)
        axes.push_back(direction_of(*turn, joint, places));
    else
        axes = {unit(0), unit(1), unit(2)};
    const Orientation J = axes_of(joint.parent, places), K = axes_of(joint.child, places);
    // Not named: the equations have no use for these products, and their intermediate symbols keep their numbers.
    const auto component = [](const Orientation& frame, const Vector3& a, std::size_t i) {
        return a[0] * frame.axis(0)[i] + a[1] * frame.axis(1)[i] + a[2] * frame.axis(2)[i];
    };
    std::vector<ex> result;
    for (const Vector3& a : axes) {
        ex product = 0;
        for (std::size_t i = 0; i < 3; ++i) product += component(J, a, i) * component(K, a, i);
        if (!product.is_equal(1)) result.push_back(product);
    }
    return result;
}

}  // namespace alembert
