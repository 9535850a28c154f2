// SPDX-License-Identifier: GPL-2.0-or-later
#include <algorithm>

#include "present/figure/parts.hpp"

#include "algebra/symbolic/unspecified.hpp"
#include "base/language/say.hpp"

namespace alembert {

namespace {

// The most coordinates of a scene whose velocity constraints are searched for wheels.
constexpr std::size_t small = 12;

/// Whether the scene has geometry; if it gives only energies, no mass has a position.
bool has_geometry(const Mechanism& m) {
    return !m.masses.empty() && !m.given_lagrangian;
}

void add_axes(Sketch& sketch) {
    const int origin = sketch.place("O");
    const int at = sketch.spot(origin);
    std::vector<int> points{at};
    for (int k = 0; k < 3; ++k) points.push_back(sketch.spot(origin, -1, Eigen::Vector3d::Unit(k)));
    sketch.add({.kind = FigureElement::Kind::axes, .points = points, .label = "N"});
}

/// Whether an expression has a value: nothing in it is a function that the scene leaves open.
bool has_value(const Mechanism& m, const GiNaC::ex& e) {
    constexpr double longest = 1e5;
    if (m.z->tree_size(e) > longest) return true;
    const GiNaC::ex whole = m.z->expand(e);
    for (auto part = whole.preorder_begin(); part != whole.preorder_end(); ++part)
        if (const auto call = unspecified_call(*part); call && m.table_of(call->function) == nullptr) return false;
    return true;
}

}  // namespace

Asked asked(Sketch& sketch) {
    Asked result;
    const Mechanism& m = sketch.m;
    Formulas& formulas = sketch.formulas;
    const auto along = [&](const Link& link) {
        return link.between ? -1 : sketch.scalar(formulas.value(link.along));
    };
    for (const Link& spring : sketch.scene.springs) result.spring_along.push_back(along(spring));
    for (const Link& damper : sketch.scene.dampers) result.damper_along.push_back(along(damper));
    const auto vector = [&](const Vector& v, const Name& axes) {
        return sketch.track(formulas.places().along(v, axes));
    };
    for (const Force& f : sketch.scene.forces) result.forces.push_back(vector(f.vector, f.axes));
    for (const Torque& t : sketch.scene.torques) result.torques.push_back(vector(t.vector, t.axes));
    for (const Impulse& s : sketch.scene.impulses) result.impulses.push_back(vector(s.vector, s.axes));
    for (const RollingRule& r : sketch.scene.rolling) result.contacts.push_back(vector(r.contact, r.axes));
    const bool has_functions = !m.open_functions().empty();
    for (const Mechanism::Constraint& c : m.constraints) {
        const bool is_open = has_functions && std::any_of(c.row.begin(), c.row.end(),
                                                          [&](const GiNaC::ex& e) { return !has_value(m, e); });
        result.constraints.push_back(c.position && !is_open ? sketch.scalar(*c.position) : -1);
        result.rows.emplace_back();
        if (m.q.size() > small || is_open) continue;
        for (const GiNaC::ex& entry : c.row) result.rows.back().push_back(sketch.scalar(entry));
    }
    for (const Mechanism::Unilateral& u : m.unilateral)
        result.gaps.push_back(has_functions && !has_value(m, *u.gap.position) ? -1
                                                                              : sketch.scalar(*u.gap.position));
    return result;
}

Drawing draw(const Scene& scene, const Mechanism& mechanism) {
    Sketch sketch(scene, mechanism);
    LooksOfScene looks(sketch);
    if (!has_geometry(mechanism) && !looks.has_scenery())
        return {.obstacle = say("The scene gives energies and no geometry, so there is no figure of it.")};
    Asked tracks = asked(sketch);
    sketch.sample();
    if (!looks.has_shapes()) spread(sketch, tracks);
    find_centres(sketch);
    const std::vector<Slope> slopes = find_slopes(sketch, looks);
    add_bodies(sketch, tracks, looks);
    add_slopes(sketch, slopes, looks);
    if (!looks.has_scenery()) add_ropes(sketch, tracks);  // below the blocks that hang on them
    add_particles(sketch, looks);
    looks.add_scenery();
    if (!looks.has_grounds()) add_grounds(sketch, tracks);
    add_constraints(sketch, tracks);
    if (!looks.has_scenery()) add_rests(sketch, tracks);
    add_springs(sketch, tracks, looks);
    add_hinges(sketch);
    add_coordinates(sketch);
    add_loads(sketch, tracks);
    add_axes(sketch);
    if (sketch.down.norm() > 0)
        sketch.add(
            {.kind = FigureElement::Kind::gravity, .points = {sketch.spot(sketch.gravity())}, .label = "g"});
    return sketch.finished();
}

}  // namespace alembert
