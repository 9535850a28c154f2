// SPDX-License-Identifier: GPL-2.0-or-later
#include <fmt/format.h>

#include <algorithm>

#include "model/building.hpp"
#include "model/energy.hpp"
#include "model/joints.hpp"

namespace alembert {

using GiNaC::ex;

namespace {

// ½ m v², and −m g·r
void add_translation(Building& here, const std::string& label, const std::string& point, const ex& mass) {
    const Vector3 v = here.places.velocity(point);
    here.m.kinetic.push_back({label, here.m.z->name(mass / 2 * (v[0] * v[0] + v[1] * v[1] + v[2] * v[2]))});
    here.m.masses.push_back({.label = label,
                             .mass = mass,
                             .position = here.places.position(point),
                             .velocity = v,
                             .point = here.places.point(point)});
    if (!here.scene.gravity) return;
    const Vector3 g = here.places.vector(*here.scene.gravity), r = here.places.position(point);
    here.m.gravity = g;
    const ex weight = here.m.z->name(-mass * (g[0] * r[0] + g[1] * r[1] + g[2] * r[2]));
    if (!weight.is_zero()) here.m.potential.push_back({"gravity on " + label, weight});
}

// ½ ω·I ω with I about the mass centre; if I is about P, less ½ m (v − v_P)², what the transport adds.
void add_rotation(Building& here, const Body& b, const ex& mass) {
    if (!b.inertia) return;
    const Orientation& orientation = here.places.orientation(b.frame.text);
    const Vector3 w = orientation.angular_velocity();
    MassElement::Rotation rotation{
        .axes = {orientation.axis(0), orientation.axis(1), orientation.axis(2)}, .w_NB_B = w, .inertia = {}};
    ex energy;
    if (b.inertia->planar) {
        if (!w[0].is_zero() || !w[1].is_zero())
            throw SceneMistake{
                {b.inertia->place, fmt::format("body '{}' turns in space and has one moment of inertia; expected "
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
        const Vector3 r = from_about(here.places.position(b.name.text), here.places.position(b.about->text));
        const Vector3 d = from_about(here.places.velocity(b.name.text), here.places.velocity(b.about->text));
        const Vector3 turning = cross(orientation.to_inertial(w, *here.m.z), r, *here.m.z);
        for (int k = 0; k < 3; ++k)
            if (vanishes(d[k] - turning[k], here.m) == false)
                throw SceneMistake{{b.about->place,
                                    fmt::format("point '{}' is not fixed in body '{}'; its moments of inertia can "
                                                "only be given about a point that moves with it",
                                                b.about->text, b.name.text)}};
        energy -= mass / 2 * (d[0] * d[0] + d[1] * d[1] + d[2] * d[2]);
        rotation.about = r;
    }
    here.m.masses.back().rotation = rotation;
    here.m.masses.back().frame = orientation.frame;
    if (b.about) here.m.masses.back().about = here.places.point(b.about->text);
    here.m.kinetic.push_back({"rotation of body " + b.name.text, here.m.z->name(energy)});
}

// T, V and the loads

void add_masses(Building& here) {
    for (const Particle& p : here.scene.particles)
        here.attempt([&] {
            SourceScope source(*here.m.z, "particle " + p.name.text);
            add_translation(here, "particle " + p.name.text, p.name.text, here.translator.scalar(p.mass));
        });
    for (const Body& b : here.scene.bodies)
        here.attempt([&] {
            SourceScope source(*here.m.z, "body " + b.name.text);
            const ex mass = here.translator.scalar(b.mass);
            add_translation(here, "body " + b.name.text, b.name.text, mass);
            add_rotation(here, b, mass);
        });
}

/// The system graph.
void add_joints(Building& here) {
    const auto index = [&](const std::string& body) {
        const auto found = std::find_if(here.m.masses.begin(), here.m.masses.end(),
                                        [&](const MassElement& e) { return e.label == "body " + body; });
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

/// The length of a spring or damper, or the expression along which it acts.
ex length_of(Building& here, const Link& link) {
    if (!link.between) return here.m.z->name(here.translator.scalar(link.along));
    return norm(add(here.places.position(link.between->second.text),
                    scale(-1, here.places.position(link.between->first.text), *here.m.z), *here.m.z),
                *here.m.z);
}

// Spring: V = ½ k (d − d₀)². Damper: −c d' along d.
void add_links(Building& here) {
    for (std::size_t i = 0; i < here.scene.springs.size(); ++i)
        here.attempt([&] {
            const Link& s = here.scene.springs[i];
            const std::string label = fmt::format("spring {}", i + 1);
            SourceScope source(*here.m.z, label);
            const ex k = here.translator.scalar(s.constant), free_length = here.translator.scalar(s.length);
            ex square;
            if (s.between && free_length.is_zero()) {
                const Vector3 d =
                    add(here.places.position(s.between->second.text),
                        scale(-1, here.places.position(s.between->first.text), *here.m.z), *here.m.z);
                square = dot(d, d, *here.m.z);
            } else {
                square = pow(length_of(here, s) - free_length, 2);
            }
            here.m.potential.push_back({label, here.m.z->name(k / 2 * square)});
            SpringElement spring{.label = label, .stiffness = k, .free_length = free_length};
            if (s.between)
                spring.between = {here.places.position(s.between->first.text),
                                  here.places.position(s.between->second.text)};
            else
                spring.along = length_of(here, s);
            here.m.springs.push_back(std::move(spring));
        });
    for (std::size_t i = 0; i < here.scene.dampers.size(); ++i)
        here.attempt([&] {
            const std::string label = fmt::format("damper {}", i + 1);
            SourceScope source(*here.m.z, label);
            const ex length = length_of(here, here.scene.dampers[i]);
            const ex rate = here.m.time_derivative({length})[0];
            const ex force = here.m.z->name(-here.translator.scalar(here.scene.dampers[i].constant) * rate);
            here.m.loads.push_back({label, true, {{rate, force, length}}});
        });
}

void add_forces(Building& here) {
    const auto add_pairs = [](Load& load, const Vector3& velocity, const Vector3& force, int sign,
                              const std::optional<Vector3>& position = {}) {
        for (int k = 0; k < 3; ++k)
            if (!force[k].is_zero() && !velocity[k].is_zero())
                load.pairs.push_back(
                    {velocity[k], sign * force[k], position ? std::optional((*position)[k]) : std::nullopt});
    };
    for (std::size_t i = 0; i < here.scene.forces.size(); ++i)
        here.attempt([&] {
            const Force& f = here.scene.forces[i];
            Load load{.label = fmt::format("force {} at {}", i + 1, f.at.text), .pairs = {}};
            SourceScope source(*here.m.z, load.label);
            const Vector3 F = here.places.along(f.vector, f.axes);
            add_pairs(load, here.places.velocity(f.at.text), F, 1, here.places.position(f.at.text));
            if (f.reaction)
                add_pairs(load, here.places.velocity(f.reaction->text), F, -1,
                          here.places.position(f.reaction->text));
            here.m.loads.push_back(std::move(load));
        });
    for (std::size_t i = 0; i < here.scene.torques.size(); ++i)
        here.attempt([&] {
            const Torque& tau = here.scene.torques[i];
            Load load{.label = fmt::format("torque {} on {}", i + 1, tau.on.text), .pairs = {}};
            SourceScope source(*here.m.z, load.label);
            const Vector3 M = here.places.along(tau.vector, tau.axes);
            const auto spin = [&](const std::string& frame) {
                const Orientation& o = here.places.orientation(frame);
                return o.to_inertial(o.angular_velocity(), *here.m.z);
            };
            add_pairs(load, spin(tau.on.text), M, 1);
            if (tau.reaction) add_pairs(load, spin(tau.reaction->text), M, -1);
            here.m.loads.push_back(std::move(load));
        });
}

void add_impulses(Building& here) {
    for (std::size_t i = 0; i < here.scene.impulses.size(); ++i)
        here.attempt([&] {
            const Impulse& impulse = here.scene.impulses[i];
            Load load{.label = fmt::format("impulse {} at {}", i + 1, impulse.at.text), .pairs = {}};
            SourceScope source(*here.m.z, load.label);
            const Vector3 S = here.places.along(impulse.vector, impulse.axes),
                          velocity = here.places.velocity(impulse.at.text);
            for (int k = 0; k < 3; ++k)
                if (!S[k].is_zero() && !velocity[k].is_zero()) load.pairs.push_back({velocity[k], S[k]});
            here.m.impulses.push_back(std::move(load));
        });
    for (const GeneralizedForce& f : here.scene.generalized_impulses)
        here.attempt([&] {
            const std::string label = "impulse on " + f.coordinate.text;
            SourceScope source(*here.m.z, label);
            for (int i = 0; i < here.m.size(); ++i)
                if (here.m.q[i].get_name() == f.coordinate.text)
                    here.m.impulses.push_back(
                        {label,
                         false,
                         {{here.m.qdot[i], here.m.z->name(here.translator.scalar(f.value)), here.m.q[i]}}});
        });
}

void add_energy(Building& here) {
    here.attempt([&] {
        SourceScope source(*here.m.z, "[energy] kinetic");
        if (here.scene.kinetic)
            here.m.kinetic.push_back(
                {"[energy] kinetic", here.m.z->name(here.translator.scalar(here.scene.kinetic))});
    });
    here.attempt([&] {
        SourceScope source(*here.m.z, "[energy] potential");
        if (here.scene.potential)
            here.m.potential.push_back(
                {"[energy] potential", here.m.z->name(here.translator.scalar(here.scene.potential))});
    });
    here.attempt([&] {
        SourceScope source(*here.m.z, "[energy] lagrangian");
        if (here.scene.lagrangian)
            here.m.given_lagrangian = here.m.z->name(here.translator.scalar(here.scene.lagrangian));
    });
    here.attempt([&] {
        if (!here.scene.rayleigh) return;
        SourceScope source(*here.m.z, "[dissipation]");
        const ex R = here.m.z->name(here.translator.scalar(here.scene.rayleigh));
        const std::vector<ex> gradient = here.m.z->pull_back({{R, 1}}, here.m.qdot);
        Load load{.label = "[dissipation]", .dissipative = true, .pairs = {}};
        for (int i = 0; i < here.m.size(); ++i)
            if (!gradient[i].is_zero()) load.pairs.push_back({here.m.qdot[i], -gradient[i], here.m.q[i]});
        here.m.loads.push_back(std::move(load));
    });
    for (const GeneralizedForce& f : here.scene.generalized_forces)
        here.attempt([&] {
            const std::string label = "force on " + f.coordinate.text;
            SourceScope source(*here.m.z, label);
            for (int i = 0; i < here.m.size(); ++i)
                if (here.m.q[i].get_name() == f.coordinate.text)
                    here.m.loads.push_back(
                        {label,
                         false,
                         {{here.m.qdot[i], here.m.z->name(here.translator.scalar(f.value)), here.m.q[i]}}});
        });
}

}  // namespace

void add_loads(Building& here) {
    add_masses(here);
    add_joints(here);
    add_links(here);
    add_forces(here);
    add_impulses(here);
    add_energy(here);
}

}  // namespace alembert
