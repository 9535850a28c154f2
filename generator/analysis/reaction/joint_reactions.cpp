// SPDX-License-Identifier: GPL-2.0-or-later
// A released joint K between the parent's side and the joint itself: M₀ is the moment about the joint's point of
// the parent, so that the moment about the point of the child, at the distance d, is M = M₀ − d × F.
#include "analysis/reaction/joint_reactions.hpp"

#include <algorithm>
#include <functional>
#include <utility>

#include "analysis/reaction/rolling_release.hpp"
#include "analysis/state/redundancy.hpp"
#include "base/language/say.hpp"
#include "model/formalism/elements.hpp"
#include "model/geometry.hpp"
#include "model/multipliers.hpp"
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

/// The scene with its joints and its rolling contacts cut open.
struct Cut {
    Scene scene;
    std::vector<ReleasedRolling> rollings;
};

Cut cut_open(const Scene& scene, int coordinates) {
    Cut cut{.scene = released(scene), .rollings = {}};
    for (std::size_t r = 0; r < scene.rolling.size(); ++r) {
        if (!is_releasable(scene, scene.rolling[r])) continue;
        cut.rollings.push_back({.rolling = static_cast<int>(r),
                                .scene = &scene,
                                .coordinates = coordinates,
                                .first = static_cast<int>(cut.scene.coordinates.size()),
                                .contact = static_cast<int>(cut.scene.particles.size())});
        cut.scene = with_rolling_released(std::move(cut.scene), scene.rolling[r]);
    }
    cut.scene.on_warning = [](const Warning&) {};  // they were told for the scene itself
    return cut;
}

/// The names of all multipliers of a mechanism, sorted.
std::vector<std::string> names_of_multipliers(const Mechanism& mechanism) {
    std::vector<std::string> names;
    for (const GiNaC::symbol& multiplier : multipliers_of(mechanism)) names.push_back(multiplier.get_name());
    std::sort(names.begin(), names.end());
    names.erase(std::unique(names.begin(), names.end()), names.end());
    return names;
}

/// The loads R that hold the cuts closed, as nodes of a program.
class CutLoads {
public:
    /// `cut` is the mechanism of the scene that is cut open, whose first coordinates are those of `given`.
    CutLoads(const Mechanism& given, const Mechanism& cut, const std::vector<ReleasedRolling>& rollings,
             const std::vector<std::string>& multipliers)
        : given_(given),
          m_(cut),
          rollings_(rollings),
          multipliers_(multipliers),
          program_(begun(given)),
          held_(held()),
          terms_(static_cast<std::size_t>(cut.size())) {
        add_loads();
        lowering_ = lowering_into(program_, m_, held_);
        for (const Mechanism::Constraint& c : m_.constraints) take_off(c);
        for (const Mechanism::Unilateral& contact : m_.unilateral) take_off(contact.gap);
    }

    /// Adds force and moment of each joint.
    void add_joints() {
        int first = given_.size();
        for (const JointArc& arc : given_.joints) {
            const int sign = arc.role == JointArc::Role::places_parent ? -1 : 1;  // the sign for the child
            std::array<int, 6> R;
            for (std::size_t k = 0; k < 6; ++k) {
                std::vector<Program::Term>& terms = terms_[static_cast<std::size_t>(first) + k];
                for (Program::Term& term : terms) term.first = sign * term.first;
                R[k] = program_.sum(0, terms);
            }
            first += 6;
            add_joint(arc, R);
        }
    }

    /// Adds the force of a rolling contact along its normal.
    void add_normal(const ReleasedRolling& rolling, const Vector3& normal, const std::string& name) {
        std::vector<Program::Term> along;
        for (std::size_t k = 0; k < 3; ++k) {
            if (normal[k].is_zero()) continue;
            const int direction = lowering_(normal[k]);
            const int force = program_.sum(0, terms_[static_cast<std::size_t>(rolling.first) + k]);
            along.emplace_back(1, program_.product(1, {{direction, 1}, {force, 1}}));
        }
        program_.roots.push_back({Group::force, name, program_.sum(0, along)});
    }

    Program program() const { return program_.canonical(); }

private:
    /// The shifts and turns of the cuts, which are 0.
    std::vector<std::pair<GiNaC::symbol, int>> held() {
        std::vector<std::pair<GiNaC::symbol, int>> result;
        for (int i = given_.size(); i < m_.size(); ++i)
            for (const GiNaC::symbol& symbol : {m_.q[i], m_.qdot[i], m_.qddot[i]})
                result.emplace_back(symbol, program_.number(0));
        return result;
    }

    /// ∂T-terms(c) − Q(c).
    void add_loads() {
        const bool known = masses_are_known(m_);
        const std::vector<int> loads =
            known ? held_loads(program_, m_, given_.size(), held_) : inverse_loads(program_, m_, held_);
        const std::size_t first = known ? static_cast<std::size_t>(given_.size()) : 0;
        for (std::size_t k = 0; k < loads.size(); ++k) terms_[first + k].emplace_back(1, loads[k]);
    }

    /// −A_cᵀλ of one constraint.
    void take_off(const Mechanism::Constraint& c) {
        const auto found = std::lower_bound(multipliers_.begin(), multipliers_.end(), c.multiplier.get_name());
        if (found == multipliers_.end() || *found != c.multiplier.get_name()) return;
        const int lambda =
            program_.variable({Variable::Kind::unknown, static_cast<int>(found - multipliers_.begin())});
        for (int i = given_.size(); i < m_.size(); ++i)
            if (!c.row[i].is_zero() && !is_of_own_contact(c, i, rollings_))
                terms_[i].emplace_back(-1, program_.product(1, {{lowering_(c.row[i]), 1}, {lambda, 1}}));
    }

    const JointArc& arc_named(const std::string& name) const {
        return *std::find_if(m_.joints.begin(), m_.joints.end(),
                             [&](const JointArc& arc) { return arc.name == name; });
    }

    /// The way from the joint's point of the parent to that of the child, along the axes of the joint.
    Vector3 way_of(const JointArc& arc) const {
        Vector3 way = arc.role == JointArc::Role::places_parent ? Vector3{0, 0, 0} : arc_named(arc.name).shift;
        if (arc.role != JointArc::Role::closes_loop) return way;
        const JointArc& release = arc_named(arc.name + ".release");
        const Vector3 from = m_.masses[release.child].position,
                      to = m_.masses[arc_named(arc.name + ".mark").child].position;
        for (std::size_t k = 0; k < 3; ++k)
            way[k] = dot(release.slide_axes[k], add(to, scale(-1, from, *m_.z), *m_.z), *m_.z);
        return way;
    }

    void add_joint(const JointArc& arc, const std::array<int, 6>& R) {
        const Vector3 way = way_of(arc);
        std::array<int, 3> d;
        for (std::size_t k = 0; k < 3; ++k) d[k] = lowering_(way[k]);
        for (std::size_t k = 0; k < 3; ++k) program_.roots.push_back({Group::force, arc.name, R[k]});
        for (std::size_t k = 0; k < 3; ++k) {
            const std::size_t a = (k + 1) % 3, b = (k + 2) % 3;
            program_.roots.push_back({Group::moment, arc.name,
                                      program_.sum(0, {{1, R[3 + k]},
                                                       {-1, program_.product(1, {{d[a], 1}, {R[b], 1}})},
                                                       {1, program_.product(1, {{d[b], 1}, {R[a], 1}})}})});
        }
    }

    const Mechanism& given_;
    const Mechanism& m_;
    const std::vector<ReleasedRolling>& rollings_;
    const std::vector<std::string>& multipliers_;
    Program program_;
    const std::vector<std::pair<GiNaC::symbol, int>> held_;
    std::vector<std::vector<Program::Term>> terms_;  ///< of R, by coordinate of the cut mechanism
    std::function<int(const GiNaC::ex&)> lowering_;
};

}  // namespace

bool has_reactions(const Mechanism& mechanism) {
    return !mechanism.joints.empty() || (!mechanism.rollings.empty() && !mechanism.given_lagrangian);
}

JointReactions joint_reactions(const Scene& scene, const Mechanism& mechanism) {
    if (mechanism.given_lagrangian)
        throw ModelError(say(
            "reactions of joints need masses and loads; a given Lagrangian does not say which body bears what"));
    const Cut cut = cut_open(scene, mechanism.size());
    Mechanism m = build(cut.scene);
    std::vector<std::optional<Vector3>> normals;
    for (const ReleasedRolling& rolling : cut.rollings) normals.push_back(normal_of(mechanism, m, rolling));
    for (std::size_t r = 0; r < mechanism.rollings.size(); ++r)
        if (mechanism.rollings[r].is_along) m = along_axes(std::move(m), static_cast<int>(r));

    JointReactions result;
    result.multipliers = names_of_multipliers(mechanism);
    CutLoads loads(mechanism, m, cut.rollings, result.multipliers);
    for (const JointArc& arc : mechanism.joints) result.joints.push_back(arc.name);
    loads.add_joints();
    for (std::size_t r = 0; r < cut.rollings.size(); ++r) {
        if (!normals[r]) continue;
        const RollingRule& rule = scene.rolling[static_cast<std::size_t>(cut.rollings[r].rolling)];
        result.rollings.push_back(rule.name.text);
        result.normals.push_back(normal_reaction_of(rule));
        loads.add_normal(cut.rollings[r], *normals[r], result.normals.back());
    }
    result.program = loads.program();
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
        const std::vector<Real> states(whole.qdot.end() - solved.states, whole.qdot.end());
        whole.qdot = group(Group::rate);
        whole.qdot.insert(whole.qdot.end(), states.begin(), states.end());
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
