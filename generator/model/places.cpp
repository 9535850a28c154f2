// SPDX-License-Identifier: GPL-2.0-or-later
#include "model/places.hpp"

#include <algorithm>

#include "base/language/say.hpp"
#include "model/joints.hpp"
#include "model/parameter_values.hpp"
#include "scene/body_points.hpp"

namespace alembert {

using GiNaC::ex;

std::size_t coordinate_index(const std::string& name, const Mechanism& m) {
    for (std::size_t i = 0; i < m.q.size(); ++i)
        if (m.q[i].get_name() == name) return i;
    throw std::out_of_range("coordinate '" + name + "'");
}

namespace {

constexpr std::size_t longest_recursion = 100;

/// The names that `base` leads to from this one and that are not known yet, the last first, where they are many:
/// each can be found from the one before, without a recursion through a long chain.
template <typename Base, typename Known>
std::vector<std::string> unknown_bases(const std::string& name, const Base& base, const Known& known) {
    std::vector<std::string> chain;
    for (std::string next = base(name); !next.empty() && !known.contains(next); next = base(next))
        chain.push_back(next);
    if (chain.size() < longest_recursion) return {};
    std::reverse(chain.begin(), chain.end());
    return chain;
}

const Name& body_before(const Joint& joint) {
    return *joint.places_child ? joint.parent.body : joint.child.body;
}

}  // namespace

std::string Places::base_of_frame(const std::string& name) const {
    for (const Frame& frame : scene_.frames)
        if (frame.name.text == name) return frame.parent.text == "N" ? "" : frame.parent.text;
    for (const Body& body : scene_.bodies) {
        if (body.name.text != name) continue;
        const std::string& base = body.joint ? body_before(scene_.joints[*body.joint]).text : body.frame.text;
        return base == "N" ? "" : base;
    }
    return {};
}

const Orientation& Places::orientation(const std::string& name) {
    if (const auto found = orientations_.find(name); found != orientations_.end()) return found->second;
    const auto base = [this](const std::string& frame) { return base_of_frame(frame); };
    for (const std::string& one : unknown_bases(name, base, orientations_)) orientation(one);
    if (name == "N") return orientations_["N"];
    for (const Frame& frame : scene_.frames)
        if (frame.name.text == name) return orientations_[name] = turn(frame);
    for (const Body& body : scene_.bodies)
        if (body.name.text == name) {
            if (!body.joint) return orientation(body.frame.text);
            const Joint& joint = scene_.joints[*body.joint];
            SourceScope source(*m_.z, "joint " + joint.name.text);
            return orientations_[name] = orientation_by(joint, *this);
        }
    throw std::out_of_range("frame '" + name + "'");
}

Orientation Places::turn(const Frame& frame) {
    SourceScope source(*m_.z, "frame " + frame.name.text);
    Orientation o = orientation(frame.parent.text);
    if (!frame.quaternion.empty()) {
        std::array<ex, 4> e;
        for (std::size_t k = 0; k < 4; ++k) e[k] = value(frame.quaternion[k]);
        return turned(o, e);
    }
    for (const Rotation& r : frame.rotations) o = turned(o, unit_axis(r), value(r.angle));
    return o;
}

Orientation Places::turned(const Orientation& o, const Vector3& axis, const ex& angle) {
    Orientation result = o.turned(axis, angle, rate(angle), *m_.z);
    turn_step({.parent = o.frame, .axis = axis, .angle = angle}, result);
    return result;
}

void Places::turn_step(Skeleton::Turn turn, Orientation& to) {
    to.frame = static_cast<int>(skeleton_.frames.size());
    skeleton_.frames.push_back(std::move(turn));
    attitudes_.push_back({{to.axis(0), to.axis(1), to.axis(2)}, to.angular_velocity()});
}

int Places::step(int from, int frame, const Vector3& offset) {
    if (offset[0].is_zero() && offset[1].is_zero() && offset[2].is_zero()) return from;
    skeleton_.points.push_back({from, frame, offset});
    return static_cast<int>(skeleton_.points.size()) - 1;
}

Orientation Places::turned(const Orientation& o, const std::array<ex, 4>& e) {
    Orientation result = o.turned(e, {rate(e[0]), rate(e[1]), rate(e[2]), rate(e[3])}, *m_.z);
    turn_step({.parent = o.frame, .by_quaternion = true, .quaternion = e}, result);
    return result;
}

ex Places::value(const Name& name) {
    const Tree self{.kind = Tree::Kind::name, .text = name.text};
    return value(Expression{name.text, {name.place}, std::make_shared<Tree>(self)});
}

double Places::number(const ex& e) const {
    return ParameterValues(m_).number(m_.z->expand(e));
}

std::vector<double> Places::numbers_at_start(const std::vector<ex>& values) const {
    ParameterValues at_start(m_);
    at_start.add_start(m_);
    std::vector<double> numbers;
    for (const ex& value : values) numbers.push_back(at_start.number(value));
    return numbers;
}

const Joint* Places::joint_of(const std::string& name) const {
    const Body* const body = body_at(scene_, name);
    return body != nullptr && body->joint ? &scene_.joints[*body->joint] : nullptr;
}

std::string Places::centre_of(const std::string& body) const {
    return alembert::centre_of(scene_, body);
}

Vector3 Places::unit_axis(const Rotation& r) {
    if (r.letter == 'x') return {1, 0, 0};
    if (r.letter == 'y') return {0, 1, 0};
    if (r.letter == 'z') return {0, 0, 1};
    const Vector3 a = vector(r.axis);
    const ex square = m_.z->expand(a[0] * a[0] + a[1] * a[1] + a[2] * a[2]);
    if (ParameterValues(m_).number(square) == 0.0)
        throw SceneMistake{{r.axis.place, say("this axis is the zero vector; expected a direction")}};
    return scale(1 / sqrt(square), a, *m_.z);
}

Vector3 Places::vector(const Vector& v) {
    return {m_.z->name(translator_.scalar(v.component[0])), m_.z->name(translator_.scalar(v.component[1])),
            m_.z->name(translator_.scalar(v.component[2]))};
}

Vector3 Places::along(const Vector& v, const Name& axes) {
    const Vector3 components = vector(v);
    return axes.text == "N" ? components : orientation(axes.text).to_inertial(components, *m_.z);
}

const Position* Places::find(const std::string& name) const {
    for (const Point& p : scene_.points)
        if (p.name.text == name) return &p.position;
    for (const Particle& p : scene_.particles)
        if (p.name.text == name) return &p.position;
    const Body* const body = body_at(scene_, name);
    return body != nullptr ? &body->position : nullptr;
}

std::string Places::base_of_point(const std::string& name) const {
    const Joint* const joint = joint_of(name);
    const Position* const where = joint == nullptr ? find(name) : nullptr;
    const std::string base = joint != nullptr   ? centre_of(body_before(*joint).text)
                             : where != nullptr ? where->from.text
                                                : "";
    return base == "N" || base == "O" ? "" : base;
}

Vector3 Places::position(const std::string& name) {
    if (name == "O") return {0, 0, 0};
    if (const auto found = positions_.find(name); found != positions_.end()) return found->second;
    const auto base = [this](const std::string& point) { return base_of_point(point); };
    for (const std::string& one : unknown_bases(name, base, positions_)) position(one);
    if (const Joint* joint = joint_of(name)) {
        SourceScope source(*m_.z, "joint " + joint->name.text);
        points_[name] = point_by(*joint, *this);
        return positions_[name] = position_by(*joint, *this);
    }
    const Position* where = find(name);
    if (where == nullptr) throw std::out_of_range("point '" + name + "'");
    SourceScope source(*m_.z, "point " + name);
    points_[name] = step(point(where->from.text), orientation(where->axes.text).frame, vector(where->offset));
    return positions_[name] = add(position(where->from.text), along(where->offset, where->axes), *m_.z);
}

std::string Places::frame_of(const std::string& name) const {
    if (name == "O") return "N";
    if (const Body* const body = body_at(scene_, name); body != nullptr && body->joint) return body->name.text;
    const Position& place = *find(name);
    const bool is_there = std::all_of(place.offset.component.begin(), place.offset.component.end(),
                                      [](const Expression& e) { return e.text == "0"; });
    return is_there ? frame_of(place.from.text) : place.axes.text;
}

Vector3 Places::velocity(const std::string& name) {
    if (const auto found = velocities_.find(name); found != velocities_.end()) return found->second;
    const Vector3 r = position(name);
    SourceScope source(*m_.z, "point " + name);
    const std::vector<ex> v = m_.time_derivative({r[0], r[1], r[2]});
    return velocities_[name] = {v[0], v[1], v[2]};
}

}  // namespace alembert
