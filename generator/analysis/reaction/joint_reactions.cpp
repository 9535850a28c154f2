// SPDX-License-Identifier: GPL-2.0-or-later
// A released joint K between the parent's side and the joint itself: M₀ is the moment about the joint's point of
// the parent, so that the moment about the point of the child, at the distance d, is M = M₀ − d × F.
#include "analysis/reaction/joint_reactions.hpp"

#include <algorithm>
#include <utility>

#include "analysis/reaction/rolling_release.hpp"
#include "analysis/state/redundancy.hpp"
#include "base/language/say.hpp"
#include "model/formalism/elements.hpp"
#include "model/geometry.hpp"
#include "program/lower/held_loads.hpp"
#include "program/lower/inverse.hpp"
#include "program/lower/lower.hpp"
#include "program/without_rounding.hpp"

namespace alembert {

namespace {

constexpr const char* directions[] = {"fx", "fy", "fz", "mx", "my", "mz"};

Expression nothing() {
    std::vector<Diagnostic> none;
    return parse_expression("0", {}, none);
}

Vector no_shift() {
    return {.component = {nothing(), nothing(), nothing()}, .place = {}};
}

/// Adds a massless body that a joint places.
void add_link(Scene& scene, Joint joint) {
    scene.bodies.push_back({.name = joint.child.body,
                            .mass = nothing(),
                            .position = {.offset = no_shift()},
                            .inertia = {},
                            .about = {},
                            .has_position = false,
                            .joint = scene.joints.size()});
    scene.joints.push_back(std::move(joint));
}

/// A name with a dot, which no name of a scene has.
std::string named(const Joint& joint, const std::string& what) {
    return joint.name.text + "." + what;
}

/// The scene with all joints released; their coordinates come after the scene's own.
Scene released(Scene scene) {
    const std::size_t count = scene.joints.size();
    scene.speeds.clear();
    scene.outputs.clear();
    scene.events.clear();
    for (Body& body : scene.bodies) {
        // A planar body that no motion turns out of its plane.
        if (!body.inertia || !body.inertia->planar) continue;
        for (Expression& element : body.inertia->tensor) element = nothing();
        body.inertia->tensor[2] = *std::exchange(body.inertia->planar, {});
    }
    for (std::size_t k = 0; k < count; ++k) {
        const Joint joint = scene.joints[k];
        const bool places_parent = joint.places_child && !*joint.places_child;
        const auto at_rest_on = [&](const char* body) {
            return Joint::Side{.body = {named(joint, body), joint.name.place}, .point = no_shift(), .rotate = {}};
        };
        Joint release{.name = {named(joint, "release"), joint.name.place},
                      .type = Joint::Type::free,
                      .parent = places_parent ? joint.child : joint.parent,
                      .child = at_rest_on("link"),
                      .axis = {.letter = 'z', .axis = {}, .angle = {}},
                      .pitch = {},
                      .angles = "xyz",
                      .coordinates = {},
                      .is_whole = true,
                      .places_child = true,
                      .closes_loop = false};
        for (const char* direction : directions) {
            release.coordinates.push_back({named(joint, direction), joint.name.place});
            scene.coordinates.push_back({.name = release.coordinates.back(),
                                         .initial = nothing(),
                                         .rate = nothing(),
                                         .unit = {},
                                         .about = {}});
        }
        if (joint.closes_loop) {  // the position of its point of the child
            Joint mark = release;
            mark.name.text = named(joint, "mark");
            mark.type = Joint::Type::fixed;
            mark.parent = {.body = joint.child.body, .point = joint.child.point, .rotate = {}};
            mark.child = at_rest_on("point");
            mark.coordinates.clear();
            add_link(scene, std::move(mark));
        }
        (places_parent ? scene.joints[k].child : scene.joints[k].parent) = release.child;
        add_link(scene, std::move(release));
    }
    return scene;
}

/// Whether a row is one of the contact that the shift i cuts.
bool is_of_own_contact(const Mechanism::Constraint& c, int i, const std::vector<ReleasedRolling>& rollings) {
    return std::any_of(rollings.begin(), rollings.end(), [&](const ReleasedRolling& r) {
        return c.rolling == r.rolling && i >= r.first && i < r.first + 3;
    });
}

std::array<double, 3> three(const std::vector<double>& value, const std::vector<int>& nodes, std::size_t k) {
    return {value[nodes[3 * k]], value[nodes[3 * k + 1]], value[nodes[3 * k + 2]]};
}

}  // namespace

bool has_reactions(const Mechanism& mechanism) {
    return !mechanism.joints.empty() || (!mechanism.rollings.empty() && !mechanism.given_lagrangian);
}

JointReactions joint_reactions(const Scene& scene, const Mechanism& mechanism) {
    if (mechanism.given_lagrangian)
        throw ModelError(say(
            "reactions of joints need masses and loads; a given Lagrangian does not say which body bears what"));
    Scene cut = released(scene);
    std::vector<ReleasedRolling> rollings;
    for (std::size_t r = 0; r < scene.rolling.size(); ++r) {
        if (!is_releasable(scene, scene.rolling[r])) continue;
        rollings.push_back({.rolling = static_cast<int>(r),
                            .scene = &scene,
                            .coordinates = mechanism.size(),
                            .first = static_cast<int>(cut.coordinates.size()),
                            .contact = static_cast<int>(cut.particles.size())});
        cut = with_rolling_released(std::move(cut), scene.rolling[r]);
    }
    cut.on_warning = [](const Warning&) {};  // they were told for the scene itself
    Mechanism m = build(cut);
    std::vector<std::optional<Vector3>> normals;
    for (const ReleasedRolling& rolling : rollings) normals.push_back(normal_of(mechanism, m, rolling));
    for (std::size_t r = 0; r < mechanism.rollings.size(); ++r)
        if (mechanism.rollings[r].is_along) m = along_axes(std::move(m), static_cast<int>(r));
    const int n = mechanism.size();
    JointReactions result;
    const auto add_multiplier = [&](const Mechanism::Constraint& c) {
        result.multipliers.push_back(c.multiplier.get_name());
    };
    for (const auto* list : {&mechanism.constraints, &mechanism.redundant})
        for (const Mechanism::Constraint& c : *list) add_multiplier(c);
    for (const Mechanism::Unilateral& contact : mechanism.unilateral) add_multiplier(contact.gap);
    std::sort(result.multipliers.begin(), result.multipliers.end());
    result.multipliers.erase(std::unique(result.multipliers.begin(), result.multipliers.end()),
                             result.multipliers.end());

    Program program = begun(mechanism);
    std::vector<std::pair<GiNaC::symbol, int>> held;
    for (int i = n; i < m.size(); ++i)
        for (const GiNaC::symbol& symbol : {m.q[i], m.qdot[i], m.qddot[i]})
            held.emplace_back(symbol, program.number(0));
    std::vector<std::vector<Program::Term>> terms(static_cast<std::size_t>(m.size()));
    if (masses_are_known(m)) {
        const std::vector<int> loads = held_loads(program, m, n, held);
        for (std::size_t k = 0; k < loads.size(); ++k) terms[n + k].emplace_back(1, loads[k]);
    } else {
        const std::vector<int> loads = inverse_loads(program, m, held);
        for (std::size_t k = 0; k < loads.size(); ++k) terms[k].emplace_back(1, loads[k]);
    }
    const auto lowering = lowering_into(program, m, held);
    const auto take_off = [&](const Mechanism::Constraint& c) {
        const auto found =
            std::lower_bound(result.multipliers.begin(), result.multipliers.end(), c.multiplier.get_name());
        if (found == result.multipliers.end() || *found != c.multiplier.get_name()) return;
        const int lambda =
            program.variable({Variable::Kind::unknown, static_cast<int>(found - result.multipliers.begin())});
        for (int i = n; i < m.size(); ++i)
            if (!c.row[i].is_zero() && !is_of_own_contact(c, i, rollings))
                terms[i].emplace_back(-1, program.product(1, {{lowering(c.row[i]), 1}, {lambda, 1}}));
    };
    for (const Mechanism::Constraint& c : m.constraints) take_off(c);
    for (const Mechanism::Unilateral& contact : m.unilateral) take_off(contact.gap);

    const auto arc_named = [&](const std::string& name) -> const JointArc& {
        return *std::find_if(m.joints.begin(), m.joints.end(),
                             [&](const JointArc& arc) { return arc.name == name; });
    };
    int i = n;
    for (const JointArc& arc : mechanism.joints) {
        result.joints.push_back(arc.name);
        const int sign = arc.role == JointArc::Role::places_parent ? -1 : 1;  // the sign for the child
        std::array<int, 6> R;
        for (int k = 0; k < 6; ++k, ++i) {
            for (Program::Term& term : terms[i]) term.first = sign * term.first;
            R[static_cast<std::size_t>(k)] = program.sum(0, terms[i]);
        }
        Vector3 way = sign > 0 ? arc_named(arc.name).shift : Vector3{0, 0, 0};
        if (arc.role == JointArc::Role::closes_loop) {
            const JointArc& release = arc_named(arc.name + ".release");
            const Vector3 from = m.masses[release.child].position,
                          to = m.masses[arc_named(arc.name + ".mark").child].position;
            for (std::size_t k = 0; k < 3; ++k)
                way[k] = dot(release.slide_axes[k], add(to, scale(-1, from, *m.z), *m.z), *m.z);
        }
        std::array<int, 3> d;
        for (std::size_t k = 0; k < 3; ++k) d[k] = lowering(way[k]);
        for (std::size_t k = 0; k < 3; ++k) program.roots.push_back({Group::force, arc.name, R[k]});
        for (std::size_t k = 0; k < 3; ++k) {
            const std::size_t a = (k + 1) % 3, b = (k + 2) % 3;
            program.roots.push_back({Group::moment, arc.name,
                                     program.sum(0, {{1, R[3 + k]},
                                                     {-1, program.product(1, {{d[a], 1}, {R[b], 1}})},
                                                     {1, program.product(1, {{d[b], 1}, {R[a], 1}})}})});
        }
    }
    for (std::size_t r = 0; r < rollings.size(); ++r) {
        const ReleasedRolling& rolling = rollings[r];
        const std::optional<Vector3>& normal = normals[r];
        if (!normal) continue;
        std::vector<Program::Term> along;
        for (std::size_t k = 0; k < 3; ++k)
            if (!(*normal)[k].is_zero())
                along.emplace_back(
                    1,
                    program.product(1, {{lowering((*normal)[k]), 1},
                                        {program.sum(0, terms[static_cast<std::size_t>(rolling.first) + k]), 1}}));
        const RollingRule& rule = scene.rolling[static_cast<std::size_t>(rolling.rolling)];
        result.rollings.push_back(rule.name.text);
        result.normals.push_back(normal_reaction_of(rule));
        program.roots.push_back({Group::force, result.normals.back(), program.sum(0, along)});
    }
    result.program = program.canonical();
    return result;
}

namespace {

/// The values of the program of reactions at a state, with the q'' and multipliers from `solved`.
template <typename Real>
std::vector<Real> values_at(const JointReactions& r, const Program& solved, State<Real> whole) {
    std::vector<Real> value = interpret(solved, whole);
    const auto group = [&](Group name) {
        std::vector<Real> numbers;
        for (const int id : solved.nodes_of(name)) numbers.push_back(value[id]);
        return numbers;
    };
    whole.qddot = group(Group::acceleration);
    if (!solved.speeds.empty()) {
        value = interpret(solved, whole);
        whole.qdot = group(Group::rate);
        whole.qddot = group(Group::second_rate);
    }
    whole.unknown.assign(r.multipliers.size(), 0);
    for (const Root& root : solved.roots) {
        if (root.group != Group::multiplier) continue;
        const auto found = std::lower_bound(r.multipliers.begin(), r.multipliers.end(), root.name);
        if (found != r.multipliers.end() && *found == root.name)
            whole.unknown[static_cast<std::size_t>(found - r.multipliers.begin())] = value[root.node];
    }
    return interpret(r.program, whole);
}

std::vector<JointLoad> loads_of(const JointReactions& r, const std::vector<double>& value) {
    const std::vector<int> force = r.program.nodes_of(Group::force), moment = r.program.nodes_of(Group::moment);
    std::vector<JointLoad> result;
    for (std::size_t k = 0; k < r.joints.size(); ++k)
        result.push_back({r.joints[k], three(value, force, k), three(value, moment, k)});
    return result;
}

std::vector<double> normals_of(const JointReactions& r, const std::vector<double>& value) {
    const std::vector<int> force = r.program.nodes_of(Group::force);
    std::vector<double> result;
    for (std::size_t k = 0; k < r.normals.size(); ++k) result.push_back(value[force[3 * r.joints.size() + k]]);
    return result;
}

}  // namespace

std::vector<double> JointReactions::normals_at(const Program& solved, const State<double>& state) const {
    return normals_of(*this, values_at(*this, solved, state));
}

std::vector<double> JointReactions::normals_without_rounding(const Program& solved,
                                                             const State<double>& state) const {
    return normals_of(*this, alembert::without_rounding(values_at(*this, solved, state),
                                                        values_at(*this, solved, in_long_double(state))));
}

std::vector<JointLoad> JointReactions::at(const Program& solved, const State<double>& state) const {
    return loads_of(*this, values_at(*this, solved, state));
}

std::vector<JointLoad> JointReactions::without_rounding(const Program& solved, const State<double>& state) const {
    return loads_of(*this, alembert::without_rounding(values_at(*this, solved, state),
                                                      values_at(*this, solved, in_long_double(state))));
}

}  // namespace alembert
