// SPDX-License-Identifier: GPL-2.0-or-later
#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "base/language/say.hpp"
#include "model/building.hpp"
#include "model/energy.hpp"
#include "model/joints.hpp"

namespace alembert {

using GiNaC::ex;

using Kind = Origin::Kind;

namespace {

// Adds ½ m v², and −m g·r.
void add_translation(Building& here, const Origin& origin, const std::string& point, const ex& mass) {
    const Vector3 v = here.places.velocity(point);
    here.m.kinetic.push_back({origin, here.m.z->name(mass / 2 * (v[0] * v[0] + v[1] * v[1] + v[2] * v[2]))});
    here.m.masses.push_back({.origin = origin,
                             .mass = mass,
                             .position = here.places.position(point),
                             .velocity = v,
                             .point = here.places.point(point)});
    if (!here.scene.gravity) return;
    const Vector3 g = here.places.vector(*here.scene.gravity), r = here.places.position(point);
    here.m.gravity = g;
    const ex weight = here.m.z->name(-mass * (g[0] * r[0] + g[1] * r[1] + g[2] * r[2]));
    if (!weight.is_zero()) here.m.potential.push_back({gravity_on(origin), weight});
}

// Adds ½ ω·I ω with I about the mass centre. If I is about P, subtracts ½ m (v − v_P)², the part due to the
// distance between the two points.
void add_rotation(Building& here, const Body& b, const ex& mass, int index) {
    if (!b.inertia) return;
    const Orientation& orientation = here.places.orientation(b.frame.text);
    const Vector3 w = orientation.angular_velocity();
    MassElement::Rotation rotation{
        .axes = {orientation.axis(0), orientation.axis(1), orientation.axis(2)}, .w_NB_B = w, .inertia = {}};
    ex energy;
    if (b.inertia->planar) {
        if (!w[0].is_zero() || !w[1].is_zero())
            throw SceneMistake{
                {b.inertia->place, say("body '{}' turns in space and has one moment of inertia; expected "
                                       "three, [Ixx, Iyy, Izz], or a tensor",
                                       b.name.text)}};
        rotation.inertia[2] = here.translator.scalar(*b.inertia->planar);
        energy = rotation.inertia[2] * w[2] * w[2] / 2;
    } else {
        std::array<ex, 6>& I = rotation.inertia;
        for (int k = 0; k < 6; ++k) I[k] = here.translator.scalar(b.inertia->tensor[k]);
        energy = (I[0] * w[0] * w[0] + I[1] * w[1] * w[1] + I[2] * w[2] * w[2]) / 2 + I[3] * w[0] * w[1] +
                 I[4] * w[1] * w[2] + I[5] * w[2] * w[0];
    }
    if (b.about) {
        const auto from_about = [&](const Vector3& centre, const Vector3& about) {
            return add(centre, scale(-1, about, *here.m.z), *here.m.z);
        };
        const std::string& centre = b.point().text;
        const Vector3 r = from_about(here.places.position(centre), here.places.position(b.about->text));
        const Vector3 d = from_about(here.places.velocity(centre), here.places.velocity(b.about->text));
        const Vector3 turning = cross(orientation.to_inertial(w, *here.m.z), r, *here.m.z);
        for (int k = 0; k < 3; ++k)
            if (vanishes(d[k] - turning[k], here.m) == false)
                throw SceneMistake{
                    {b.about->place, say("point '{}' is not fixed in body '{}'; its moments of inertia can "
                                         "only be given about a point that moves with it",
                                         b.about->text, b.name.text)}};
        energy -= mass / 2 * (d[0] * d[0] + d[1] * d[1] + d[2] * d[2]);
        rotation.about = r;
    }
    here.m.masses.back().rotation = rotation;
    here.m.masses.back().frame = orientation.frame;
    if (b.about) here.m.masses.back().about = here.places.point(b.about->text);
    here.m.kinetic.push_back({{Kind::rotation, index, b.name.text}, here.m.z->name(energy)});
}

// Of what leaves a particle, or joins it, with the velocity u relative to it: m a = F + m' u (Meshchersky). The
// momentum changes by m' v besides, so that the load is m' (v + u).
void add_thrust(Building& here, const Particle& p, const Origin& origin) {
    Intermediates& z = *here.m.z;
    MassElement& element = here.m.masses.back();
    if (z.depends(element.mass, here.m.q))
        throw SceneMistake{
            {p.mass.place(), say("the mass of particle '{}' depends on a coordinate; expected the time, "
                                 "inputs, states and parameters",
                                 p.name.text)}};
    element.mass_rate = z.name(here.m.explicit_time_derivative({element.mass})[0]);
    if (element.mass_rate.is_zero())
        throw SceneMistake{
            {p.leaves->place, say("something leaves particle '{}', and its mass does not change; expected "
                                  "a mass such as \"m0 - k*t\", or a state",
                                  p.name.text)}};
    const Vector3 u = here.places.along(*p.leaves, p.along);
    Load load{.origin = {Kind::thrust, origin.index, p.name.text}, .pairs = {}};
    for (std::size_t k = 0; k < 3; ++k)
        if (!element.velocity[k].is_zero())
            load.pairs.push_back({element.velocity[k], z.name(element.mass_rate * (element.velocity[k] + u[k])),
                                  element.position[k]});
    here.m.loads.push_back(std::move(load));
}

void add_particle(Building& here, const Particle& p, const Origin& origin) {
    add_translation(here, origin, p.name.text, here.translator.scalar(p.mass));
    if (p.leaves) add_thrust(here, p, origin);
}

void add_body(Building& here, const Body& b, const Origin& origin) {
    const ex mass = here.translator.scalar(b.mass);
    add_translation(here, origin, b.point().text, mass);
    add_rotation(here, b, mass, origin.index);
}

/// Adds the system graph.
void add_joints(Building& here) {
    const auto index = [&](const std::string& body) {
        const auto found = std::find_if(here.m.masses.begin(), here.m.masses.end(), [&](const MassElement& e) {
            return e.origin.kind == Kind::body && e.origin.name == body;
        });
        return found == here.m.masses.end() ? -1 : static_cast<int>(found - here.m.masses.begin());
    };
    for (const Joint& joint : here.scene.joints)
        here.attempt([&] {
            SourceScope source(*here.m.z, "joint " + joint.name.text);
            here.m.joints.push_back(arc_of(joint, here.places));
            here.m.joints.back().parent = index(joint.parent.body.text);
            here.m.joints.back().child = index(joint.child.body.text);
        });
}

/// The vector from one point to another.
Vector3 between(Building& here, const std::string& from, const std::string& to) {
    return add(here.places.position(to), scale(-1, here.places.position(from), *here.m.z), *here.m.z);
}

/// The vector from the first point of a spring or damper to the second.
Vector3 across(Building& here, const Link& link) {
    return between(here, link.between->first.text, link.between->second.text);
}

/// The length of a link, or the expression along which it acts.
ex length_of(Building& here, const Link& link) {
    return link.between ? here.translator.length(across(here, link))
                        : here.m.z->name(here.translator.scalar(link.along));
}

/// The component of a vector that has one alone, along the axes of N.
std::optional<ex> only_component(const Vector3& v) {
    const auto is_there = [](const ex& x) { return !x.is_zero(); };
    if (std::count_if(v.begin(), v.end(), is_there) != 1) return {};
    return *std::find_if(v.begin(), v.end(), is_there);
}

// V = ½ k (d − d₀)²
void add_spring(Building& here, const Link& s, const Origin& origin) {
    const ex k = here.translator.scalar(s.constant), free_length = here.translator.scalar(s.length);
    SpringElement spring{.origin = origin, .stiffness = k, .free_length = free_length};
    ex square;
    if (s.between && free_length.is_zero()) {
        const Vector3 d = across(here, s);
        square = dot(d, d, *here.m.z);
        spring.extension = only_component(d);
    } else {
        spring.extension = length_of(here, s) - free_length;
        square = pow(*spring.extension, 2);
    }
    here.m.potential.push_back({origin, here.m.z->name(k / 2 * square)});
    if (s.between)
        spring.between = {here.places.position(s.between->first.text),
                          here.places.position(s.between->second.text)};
    else
        spring.along = length_of(here, s);
    here.m.springs.push_back(std::move(spring));
}

// The force −c d' along d.
/// Along a line d is ±e, and −c d' along d is −c e' along e, which is also known where the ends meet.
void add_damper(Building& here, const Link& damper, const Origin& origin) {
    const std::optional<ex> along_line = damper.between ? only_component(across(here, damper)) : std::nullopt;
    const ex length = along_line ? *along_line : length_of(here, damper);
    const ex rate = here.m.time_derivative({length})[0];
    const ex force = here.m.z->name(-here.translator.scalar(damper.constant) * rate);
    here.m.loads.push_back({origin, true, {{rate, force, length}}});
}

void add_pairs(Load& load, const Vector3& velocity, const Vector3& force, int sign,
               const std::optional<Vector3>& position = {}) {
    for (int k = 0; k < 3; ++k)
        if (!force[k].is_zero() && !velocity[k].is_zero())
            load.pairs.push_back(
                {velocity[k], sign * force[k], position ? std::optional((*position)[k]) : std::nullopt});
}

/// A point that is fixed in the body or frame. A frame alone has no place; that of the force is given from a point
/// of it.
std::string point_of(Building& here, const Force& f) {
    for (const Body& body : here.scene.bodies)
        if (body.name.text == f.on->text) return body.point().text;
    for (const Point& point : here.scene.points)
        if (point.name.text == f.at.text && point.position.from.text != "O") return point.position.from.text;
    throw SceneMistake{
        {f.on->place, say("frame '{}' has no place of its own; expected a body, or a point '{}' whose 'from' is a "
                          "point fixed in the frame",
                          f.on->text, f.at.text)}};
}

/// v_B + ω × (r_P − r_B): the velocity of the body's point that is at the place now.
Vector3 velocity_of_body_at(Building& here, const Force& f) {
    const std::string fixed = point_of(here, f);
    const Orientation& o = here.places.orientation(f.on->text);
    const Vector3 omega = o.to_inertial(o.angular_velocity(), *here.m.z);
    return add(here.places.velocity(fixed), cross(omega, between(here, fixed, f.at.text), *here.m.z), *here.m.z);
}

/// Whether the point is reached from the origin, a particle or a body by steps of constant length along the axes
/// of one frame, which may be written in several frames that are fixed in each other. Of a body this is its own.
bool is_fixed_by_construction(Building& here, const std::string& point) {
    std::vector<GiNaC::symbol> moving = here.m.moving();
    moving.insert(moving.end(), here.m.qdot.begin(), here.m.qdot.end());
    for (const Mechanism::Speed& speed : here.m.speeds) moving.push_back(speed.u);
    int at = here.places.point(point);
    std::vector<int> ends{0};
    for (const Particle& p : here.scene.particles) ends.push_back(here.places.point(p.name.text));
    for (const Body& b : here.scene.bodies) ends.push_back(here.places.point(b.point().text));
    const Skeleton& steps = here.places.skeleton();
    const auto is_constant = [&](const ex& e) { return !here.m.z->depends(e, moving); };
    const auto rigid = [&](int frame) {  // the first of the frames in which this one is fixed
        for (; frame != 0; frame = steps.frames[static_cast<std::size_t>(frame)].parent) {
            const Skeleton::Turn& turn = steps.frames[static_cast<std::size_t>(frame)];
            if (turn.by_quaternion || !is_constant(turn.angle) ||
                !std::all_of(turn.axis.begin(), turn.axis.end(), is_constant))
                break;
        }
        return frame;
    };
    std::optional<int> frame;
    while (std::find(ends.begin(), ends.end(), at) == ends.end()) {
        const Skeleton::Step& step = steps.points[static_cast<std::size_t>(at)];
        if (!std::all_of(step.offset.begin(), step.offset.end(), is_constant)) return false;
        if (frame.value_or(rigid(step.frame)) != rigid(step.frame)) return false;
        frame = rigid(step.frame);
        at = step.from;
    }
    if (!frame) return true;
    bool is_body = false;
    for (const Body& b : here.scene.bodies) {
        if (here.places.point(b.point().text) != at) continue;
        if (rigid(here.places.orientation(b.frame.text).frame) == *frame) return true;
        is_body = true;
    }
    return !is_body;
}

/// Whether the point keeps its place in some body, or in the axes of some frame beside a particle or the origin.
/// Beside a body, its own axes count alone: a point at a constant distance along others runs through the body.
bool is_fixed_in_a_body(Building& here, const std::string& point) {
    if (is_fixed_by_construction(here, point)) return true;
    const Scene& scene = here.scene;
    std::vector<std::string> axes;
    const Point* own = nullptr;
    for (const Point& p : scene.points)
        if (p.name.text == point) own = &p;
    if (own) axes.push_back(own->position.axes.text);  // nearly always it keeps its place in these
    for (const Frame& f : scene.frames) axes.push_back(f.name.text);
    for (const Body& b : scene.bodies) axes.push_back(b.frame.text);
    const auto keeps = [&](const std::string& place, const std::vector<std::string>& frames) {
        const Vector3 away = between(here, place, point);
        return std::any_of(frames.begin(), frames.end(), [&](const std::string& frame) {
            const Orientation& o = here.places.orientation(frame);
            std::vector<ex> components;
            for (int k = 0; k < 3; ++k) components.push_back(dot(away, o.axis(k), *here.m.z));
            const std::vector<ex> rates = here.m.time_derivative(components);
            return std::all_of(rates.begin(), rates.end(),
                               [&](const ex& rate) { return vanishes(rate, here.m) != false; });
        });
    };
    const std::string from = own ? own->position.from.text : "O";
    if (std::any_of(scene.points.begin(), scene.points.end(),
                    [&](const Point& p) { return p.name.text == from; }) &&
        keeps(from, axes))
        return true;
    axes.insert(axes.begin() + (own ? 1 : 0), "N");
    if (keeps("O", axes)) return true;
    return std::any_of(scene.particles.begin(), scene.particles.end(),
                       [&](const Particle& p) { return keeps(p.name.text, axes); }) ||
           std::any_of(scene.bodies.begin(), scene.bodies.end(),
                       [&](const Body& b) { return keeps(b.point().text, {b.frame.text}); });
}

void add_force(Building& here, const Force& f, const Origin& origin) {
    Load load{.origin = origin, .pairs = {}};
    const Vector3 F = here.places.along(f.vector, f.axes);
    if (f.on) {
        add_pairs(load, velocity_of_body_at(here, f), F, 1);
    } else {
        add_pairs(load, here.places.velocity(f.at.text), F, 1, here.places.position(f.at.text));
        const bool has_frames = !here.scene.frames.empty() || !here.scene.bodies.empty();
        const bool is_point = std::any_of(here.scene.points.begin(), here.scene.points.end(),
                                          [&](const Point& p) { return p.name.text == f.at.text; });
        load.at_moving_place = has_frames && is_point && !is_fixed_in_a_body(here, f.at.text);
    }
    if (f.reaction)
        add_pairs(load, here.places.velocity(f.reaction->text), F, -1, here.places.position(f.reaction->text));
    here.m.loads.push_back(std::move(load));
}

void add_torque(Building& here, const Torque& tau, const Origin& origin) {
    Load load{.origin = origin, .pairs = {}};
    const Vector3 M = here.places.along(tau.vector, tau.axes);
    const auto spin = [&](const std::string& frame) {
        const Orientation& o = here.places.orientation(frame);
        return o.to_inertial(o.angular_velocity(), *here.m.z);
    };
    add_pairs(load, spin(tau.on.text), M, 1);
    if (tau.reaction) add_pairs(load, spin(tau.reaction->text), M, -1);
    here.m.loads.push_back(std::move(load));
}

void add_impulse(Building& here, const Impulse& impulse, const Origin& origin) {
    Load load{.origin = origin, .pairs = {}};
    const Vector3 S = here.places.along(impulse.vector, impulse.axes);
    add_pairs(load, here.places.velocity(impulse.at.text), S, 1);
    here.m.impulses.push_back(std::move(load));
}

/// Adds a force or impulse along a coordinate to `loads` or `impulses`.
void add_generalized(Building& here, std::vector<Load>& to, const GeneralizedForce& f, const Origin& origin) {
    for (int i = 0; i < here.m.size(); ++i)
        if (here.m.q[i].get_name() == f.coordinate.text)
            to.push_back(
                {origin, false, {{here.m.qdot[i], here.m.z->name(here.translator.scalar(f.value)), here.m.q[i]}}});
}

// T = ½ J q'²
void add_rotor(Building& here, const Armature& armature, const Origin& origin) {
    const ex J = here.m.z->name(here.translator.scalar(armature.inertia));
    for (int i = 0; i < here.m.size(); ++i) {
        if (here.m.q[i].get_name() != armature.coordinate.text) continue;
        here.m.kinetic.push_back({origin, here.m.z->name(J / 2 * pow(here.m.qdot[i], 2))});
        here.m.rotors.push_back({origin, i, J});
    }
}

void add_rayleigh(Building& here, const Expression& function, const Origin& origin) {
    const ex R = here.m.z->name(here.translator.scalar(function));
    const std::vector<ex> gradient = here.m.z->pull_back({{R, 1}}, here.m.qdot);
    Load load{.origin = origin, .dissipative = true, .pairs = {}};
    for (int i = 0; i < here.m.size(); ++i)
        if (!gradient[i].is_zero()) load.pairs.push_back({here.m.qdot[i], -gradient[i], here.m.q[i]});
    here.m.loads.push_back(std::move(load));
}

/// Calls `add` for each entry of a table of the scene; intermediate symbols that are made meanwhile have the
/// entry's label as their source.
template <typename Entry, typename Name, typename Add>
void each(Building& here, Kind kind, const std::vector<Entry>& table, const Name& name, const Add& add) {
    for (std::size_t i = 0; i < table.size(); ++i)
        here.attempt([&] {
            const Origin origin{kind, static_cast<int>(i), name(table[i])};
            SourceScope source(*here.m.z, label(origin));
            add(here, table[i], origin);
        });
}

/// The same for an expression that the scene may give.
template <typename Add>
void one(Building& here, Kind kind, const Expression& expression, const Add& add) {
    here.attempt([&] {
        const Origin origin{kind};
        SourceScope source(*here.m.z, label(origin));
        if (expression) add(expression, origin);
    });
}

void add_energies(Building& here) {
    const auto part_of = [&](std::vector<Part>& parts) {
        return [&](const Expression& e, const Origin& origin) {
            parts.push_back({origin, here.m.z->name(here.translator.scalar(e))});
        };
    };
    one(here, Kind::given_kinetic, here.scene.kinetic, part_of(here.m.kinetic));
    one(here, Kind::given_potential, here.scene.potential, part_of(here.m.potential));
    one(here, Kind::given_lagrangian, here.scene.lagrangian, [&](const Expression& e, const Origin&) {
        here.m.given_lagrangian = here.m.z->name(here.translator.scalar(e));
    });
    one(here, Kind::rayleigh, here.scene.rayleigh,
        [&](const Expression& e, const Origin& origin) { add_rayleigh(here, e, origin); });
}

}  // namespace

// There is one row for each table of the scene.
void add_loads(Building& here) {
    const Scene& s = here.scene;
    const auto name = [](const auto& entry) { return entry.name.text; };
    const auto at = [](const auto& entry) { return entry.at.text; };
    const auto coordinate = [](const auto& entry) { return entry.coordinate.text; };
    const auto none = [](const auto&) { return std::string(); };
    const auto generalized = [](std::vector<Load>& to) {
        return [&to](Building& b, const GeneralizedForce& f, const Origin& origin) {
            add_generalized(b, to, f, origin);
        };
    };
    each(here, Kind::particle, s.particles, name, add_particle);
    each(here, Kind::body, s.bodies, name, add_body);
    each(here, Kind::armature, s.armatures, coordinate, add_rotor);
    add_joints(here);
    each(here, Kind::spring, s.springs, none, add_spring);
    each(here, Kind::damper, s.dampers, none, add_damper);
    each(here, Kind::force, s.forces, at, add_force);
    each(
        here, Kind::torque, s.torques, [](const Torque& tau) { return tau.on.text; }, add_torque);
    each(here, Kind::impulse, s.impulses, at, add_impulse);
    each(here, Kind::generalized_impulse, s.generalized_impulses, coordinate, generalized(here.m.impulses));
    add_energies(here);
    each(here, Kind::generalized_force, s.generalized_forces, coordinate, generalized(here.m.loads));
}

}  // namespace alembert
