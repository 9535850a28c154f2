// SPDX-License-Identifier: GPL-2.0-or-later
// Arc a turns its outer body relative to its inner one with Ω_a = Σ p_aj q'_j about the pivot P_a and shifts it
// with σ_a = Σ k_aj q'_j. The outer bodies of a are those i with T_ai ≠ 0, so that
//   ω_i = Σ_a |T_ai| Ω_a,   J_R,ij = Σ_a |T_ai| p_aj,   J_T,ij = Σ_a |T_ai| (p_aj × (r_i − P_a) + k_aj)
// (Wittenburg, Dynamics of Multibody Systems (2008), chapter 5: ω = −(p T)ᵀ q', with signs from the direction of
// the arcs). Accelerations at q'' = 0 are computed outwards along the paths: with (·)° the derivative in the body
// where an arc's axes are fixed, and ρ = r_o − P,
//   α_o = α_i + Ω° + ω_i × Ω,   a_P = a_i + α_i × (P − r_i) + ω_i × (P − r_i)' + σ° + ω_i × σ,
//   a_o = a_P + α_o × ρ + ω_o × ρ'
// if the arc points outwards. If it points to the ground, −σ is given along axes fixed in the outer body and is
// added beyond the pivot.
#include "model/formalism/roberson_wittenburg.hpp"

#include <fmt/format.h>

#include <cstdlib>

#include "base/language/say.hpp"
#include "model/formalism/elements.hpp"
#include "model/geometry.hpp"

namespace alembert {

using GiNaC::ex;

namespace {

std::string name_of(const Mechanism& m, int body) {
    return body < 0 ? "N" : m.masses[body].origin.name;
}

/// The motion that one coordinate gives to all bodies beyond an arc.
struct Mode {
    int coordinate;
    Vector3 turn, shift;  ///< p, k along N
};

/// Motion of a body at q'' = 0, along N.
struct State {
    Vector3 v, a, w, alpha;
};

class Paths {
public:
    Paths(const Mechanism& m, const SystemGraph& graph)
        : m_(m),
          z_(*m.z),
          states_(m.masses.size()),
          modes_(graph.arcs.size()),
          arms_(m.masses.size()),
          paths_(m.masses.size()) {
        for (std::size_t a = 0; a < graph.arcs.size(); ++a) {
            const SystemGraph::Arc& arc = graph.arcs[a];
            if (arc.joint < 0)
                start(a, arc.to);
            else
                step(a, m.joints[arc.joint]);
        }
    }

    std::vector<BodyMotion> motions() const {
        std::vector<BodyMotion> result;
        for (std::size_t i = 0; i < states_.size(); ++i) {
            SourceScope source(z_, label(m_.masses[i].origin));
            const std::optional<MassElement::Rotation>& rotation = m_.masses[i].rotation;
            const State& state = states_[i];
            const Vector3 zero{0, 0, 0};
            BodyMotion motion{.J_T = {m_.q.size(), zero},
                              .J_R = {m_.q.size(), zero},
                              .a_bar = state.a,
                              .w = zero,
                              .alpha_bar = zero};
            if (rotation) {
                motion.w = along(rotation->axes, state.w);
                motion.alpha_bar = along(rotation->axes, state.alpha);
            }
            for (std::size_t k = 0; k < paths_[i].size(); ++k) {
                const Vector3& arm = arms_[i][k];
                for (const Mode& mode : modes_[paths_[i][k]]) {
                    Vector3 &J_T = motion.J_T[mode.coordinate], &J_R = motion.J_R[mode.coordinate];
                    J_T = plus(J_T, plus(cross(mode.turn, arm, z_), mode.shift));
                    if (rotation) J_R = plus(J_R, along(rotation->axes, mode.turn));
                }
            }
            result.push_back(std::move(motion));
        }
        return result;
    }

private:
    Vector3 plus(const Vector3& a, const Vector3& b) const { return add(a, b, z_); }
    Vector3 minus(const Vector3& a, const Vector3& b) const { return add(a, scale(-1, b, z_), z_); }
    /// The components along N of a vector with components `v` along `axes`.
    Vector3 to_N(const std::array<Vector3, 3>& axes, const Vector3& v) const {
        return plus(plus(scale(v[0], axes[0], z_), scale(v[1], axes[1], z_)), scale(v[2], axes[2], z_));
    }
    /// Components along `axes`.
    Vector3 along(const std::array<Vector3, 3>& axes, const Vector3& v) const {
        return {dot(axes[0], v, z_), dot(axes[1], v, z_), dot(axes[2], v, z_)};
    }
    Vector3 derivative(const Vector3& v) const {
        const std::vector<ex> rate = m_.time_derivative_without_acceleration({v[0], v[1], v[2]});
        return {rate[0], rate[1], rate[2]};
    }
    std::vector<Mode> modes_of(const Vector3& turning, const Vector3& sliding) const {
        std::vector<Mode> modes;
        const std::vector<ex> both{turning[0], turning[1], turning[2], sliding[0], sliding[1], sliding[2]};
        for (int j = 0; j < m_.size(); ++j) {
            const std::vector<ex> by = z_.push_forward(both, {{m_.qdot[j], 1}});
            Mode mode{j, {by[0], by[1], by[2]}, {by[3], by[4], by[5]}};
            bool moves = false;
            for (const ex& component : by) moves = moves || !component.is_zero();
            if (moves) modes.push_back(std::move(mode));
        }
        return modes;
    }

    /// A body without a joint, given by its position and frame.
    void start(std::size_t a, int body) {
        const MassElement& element = m_.masses[body];
        SourceScope source(z_, label(element.origin));
        State& state = states_[body];
        state = {element.velocity, derivative(element.velocity), {0, 0, 0}, {0, 0, 0}};
        if (element.rotation) {
            state.w = to_N(element.rotation->axes, element.rotation->w_NB_B);
            state.alpha = to_N(element.rotation->axes, derivative(element.rotation->w_NB_B));
        }
        paths_[body] = {static_cast<int>(a)};
        arms_[body] = {{0, 0, 0}};
        modes_[a] = modes_of(state.w, state.v);
    }

    void step(std::size_t a, const JointArc& joint) {
        SourceScope source(z_, "joint " + joint.name);
        const Vector3 zero{0, 0, 0};
        const State inner = joint.inner() < 0 ? State{zero, zero, zero, zero} : states_[joint.inner()];
        State& outer = states_[joint.outer()];
        const bool forwards = joint.role == JointArc::Role::places_child;
        const Vector3 turning = to_N(joint.axes, joint.turning);
        outer.w = plus(inner.w, turning);
        outer.alpha =
            plus(inner.alpha, plus(to_N(joint.axes, derivative(joint.turning)), cross(inner.w, turning, z_)));

        // The child's point slides along axes that are fixed in the parent: this is the inner body, or the outer
        // one if the arc points to the ground.
        const Vector3 slide = scale(forwards ? 1 : -1, to_N(joint.slide_axes, joint.sliding), z_),
                      slide_rate =
                          plus(scale(forwards ? 1 : -1, to_N(joint.slide_axes, derivative(joint.sliding)), z_),
                               cross(forwards ? inner.w : outer.w, slide, z_));
        Vector3 v = plus(inner.v, cross(inner.w, joint.to_pivot, z_));
        if (forwards) v = plus(v, slide);
        const Vector3 a_pivot =
            plus(inner.a, plus(cross(inner.alpha, joint.to_pivot, z_), cross(inner.w, minus(v, inner.v), z_)));
        outer.v = plus(v, cross(outer.w, joint.from_pivot, z_));
        if (!forwards) outer.v = plus(outer.v, slide);
        outer.a = plus(plus(a_pivot, slide_rate),
                       plus(cross(outer.alpha, joint.from_pivot, z_), cross(outer.w, minus(outer.v, v), z_)));

        if (joint.inner() >= 0) {
            paths_[joint.outer()] = paths_[joint.inner()];
            const Vector3 further = plus(joint.to_pivot, joint.from_pivot);
            for (const Vector3& arm : arms_[joint.inner()]) arms_[joint.outer()].push_back(plus(arm, further));
        }
        paths_[joint.outer()].push_back(static_cast<int>(a));
        arms_[joint.outer()].push_back(joint.from_pivot);
        for (Mode& mode : modes_of(joint.turning, joint.sliding)) {
            mode.turn = to_N(joint.axes, mode.turn);
            mode.shift = scale(forwards ? 1 : -1, to_N(joint.slide_axes, mode.shift), z_);
            modes_[a].push_back(std::move(mode));
        }
    }

    const Mechanism& m_;
    Intermediates& z_;
    std::vector<State> states_;             // by body
    std::vector<std::vector<Mode>> modes_;  // by arc
    std::vector<std::vector<Vector3>>
        arms_;  // by body, along its path from the ground: from each arc's pivot to the mass centre
    std::vector<std::vector<int>> paths_;  // by body: the arcs
};

}  // namespace

SystemGraph system_graph(const Mechanism& m) {
    SystemGraph graph;
    const std::size_t count = m.masses.size();
    std::vector<int> placing(count, -1);  // the joint that places the body
    for (std::size_t j = 0; j < m.joints.size(); ++j) {
        const JointArc& joint = m.joints[j];
        if (joint.role != JointArc::Role::closes_loop)
            placing[joint.outer()] = static_cast<int>(j);
        else
            graph.chords.push_back(
                fmt::format("{}: {} -> {}", joint.name, name_of(m, joint.parent), name_of(m, joint.child)));
    }
    std::vector<int> arc_of(count, -1);
    const auto place = [&](auto&& self, int body) -> void {
        if (arc_of[body] >= 0) return;
        SystemGraph::Arc arc{.name = name_of(m, body), .from = -1, .to = body, .outwards = true};
        if (placing[body] >= 0) {
            const JointArc& joint = m.joints[placing[body]];
            if (joint.inner() >= 0) self(self, joint.inner());
            arc = {joint.name, joint.parent, joint.child, joint.role == JointArc::Role::places_child,
                   placing[body]};
        }
        arc_of[body] = static_cast<int>(graph.arcs.size());
        graph.arcs.push_back(std::move(arc));
    };
    for (std::size_t i = 0; i < count; ++i) {
        graph.bodies.push_back(name_of(m, static_cast<int>(i)));
        place(place, static_cast<int>(i));
    }
    graph.S_0.assign(count, 0);
    graph.S.assign(count, std::vector<int>(count, 0));
    graph.T.assign(count, std::vector<int>(count, 0));
    for (std::size_t a = 0; a < count; ++a) {
        const SystemGraph::Arc& arc = graph.arcs[a];
        (arc.from < 0 ? graph.S_0[a] : graph.S[arc.from][a]) = 1;
        (arc.to < 0 ? graph.S_0[a] : graph.S[arc.to][a]) = -1;
    }
    for (std::size_t i = 0; i < count; ++i)
        for (int body = static_cast<int>(i); body >= 0;) {
            const SystemGraph::Arc& arc = graph.arcs[arc_of[body]];
            graph.T[arc_of[body]][i] = arc.outwards ? -1 : 1;
            body = arc.outwards ? arc.from : arc.to;
        }
    return graph;
}

std::optional<std::string> obstacle_to_roberson_wittenburg(const Mechanism& m) {
    if (auto unknown = masses_unknown(m, say("Roberson and Wittenburg's equations"))) return unknown;
    if (!m.joints.empty()) return std::nullopt;
    return say(
        "Roberson and Wittenburg's equations are written on a graph of bodies and joints, and the scene has no "
        "[[joint]]; use the formalism 'schiehlen', or let joints hold the bodies");
}

Equations roberson_wittenburg(const Mechanism& mechanism) {
    const Mechanism m = with_own_intermediates(mechanism);
    need_none(obstacle_to_roberson_wittenburg(m));
    return projected("roberson-wittenburg", m, Paths(m, system_graph(m)).motions());
}

std::vector<Section> outline_of_roberson_wittenburg(const Mechanism& m) {
    const SystemGraph g = system_graph(m);
    std::string arcs, bodies, chords;
    for (const SystemGraph::Arc& arc : g.arcs) {
        const auto name = [&](int body) { return body < 0 ? std::string("N") : g.bodies[body]; };
        arcs += fmt::format("{}{}: {} -> {}", arcs.empty() ? "" : ", ", arc.name, name(arc.from), name(arc.to));
    }
    for (const std::string& body : g.bodies) bodies += (bodies.empty() ? "" : ", ") + body;
    for (const std::string& chord : g.chords)
        chords += (chords.empty() ? say(" Chords, which close loops: ") : ", ") + chord;
    if (!chords.empty()) chords += ".";
    const auto row = [](const std::string& letter, const std::string& of, const std::vector<int>& entries) {
        std::vector<Phrase> phrases;
        for (const int entry : entries) phrases.push_back(phrases::number(entry));
        return Statement{Statement::Kind::energy, letter, of, {}, phrases::tuple(std::move(phrases))};
    };
    Section S{.words =
                  say("The system graph, each arc from parent to child: {}.{} Incidence matrix S, a row for each "
                      "body, a column for each arc (1 where it begins, -1 where it ends):",
                      arcs, chords)};
    S.statements.push_back(row("S", "N", g.S_0));
    for (std::size_t i = 0; i < g.bodies.size(); ++i) S.statements.push_back(row("S", g.bodies[i], g.S[i]));
    Section T{
        .words =
            say("Path matrix T, a row for each arc, a column for each body: {} (1 where the arc is on the body's "
                "path and points to the ground, -1 where it points away):",
                bodies)};
    for (std::size_t a = 0; a < g.arcs.size(); ++a) T.statements.push_back(row("T", g.arcs[a].name, g.T[a]));
    return {std::move(S), std::move(T)};
}

}  // namespace alembert
