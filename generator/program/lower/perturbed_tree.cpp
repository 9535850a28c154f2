// SPDX-License-Identifier: GPL-2.0-or-later
#include "program/lower/perturbed_tree.hpp"

#include <algorithm>
#include <stdexcept>

#include "model/formalism/articulated_tree.hpp"
#include "model/formalism/recursive.hpp"
#include "program/lower/joint_change.hpp"
#include "program/lower/link_frames.hpp"
#include "program/lower/lower.hpp"
#include "program/symbolic_scalar.hpp"

namespace alembert {

namespace {

using Arrow = Triple<Symbolic>;
using Link = TreeLink<Symbolic>;

class Perturbation {
public:
    Perturbation(const Program& program, const JointTree& joints, LinkAxes axes, Intermediates& z,
                 const std::function<std::function<int(const GiNaC::ex&)>(Program&)>& begin)
        : result_{.program = program, .outputs = {}, .held = {}, .stages = {}},
          p_(result_.program),
          change_(p_, joints, axes, begin(p_)) {
        for (int id = 0; id < p_.size(); ++id)
            if (p_[id].op == Op::variable && p_[id].variable.kind == Variable::Kind::unknown)
                next_unknown_ = std::max(next_unknown_, p_[id].variable.index + 1);
        const auto lowering = begin(p_);
        const std::function<Symbolic(const GiNaC::ex&)> value = [&](const GiNaC::ex& e) {
            return Symbolic(p_, lowering(e));
        };
        tree_ = regrouped(reframed(p_, dressed<Symbolic>(joints, axes, z, value)));
        if (!change_.determines()) return;
        std::vector<int> forces;
        for (const GiNaC::ex& force : joints.forces) forces.push_back(lowering(force));
        for (const int node : change_.loads(forces)) loads_.emplace_back(p_, node);
    }

    std::optional<Perturbed> made() && {
        if (!change_.determines()) return std::nullopt;
        solve();
        hold_all();
        const std::vector<Wrench<Symbolic>> own = outwards();
        const std::vector<Symbolic> pushes = inwards(own);
        std::vector<int> changes;
        for (const Symbolic& x : accelerations(pushes)) changes.push_back(x.node(p_));
        std::vector<int> constant;
        for (const Symbolic& x : rates_) constant.push_back(x.node(p_));
        result_.outputs = change_.changed_accelerations(
            constant, changes, [&](int node) { return held(Symbolic(p_, node)).node(p_); });
        result_.stages.resize(static_cast<std::size_t>(p_.size()), 0);
        return std::move(result_);
    }

private:
    /// The motion itself: articulated inertias, accelerations, and the wrenches that the joints transmit.
    void solve() {
        bodies_.emplace(tree_, Bias<Symbolic>(tree_).wrenches, loads_);
        BodyTree<Symbolic> moving = tree_;
        const std::vector<Symbolic> rates = bodies_->accelerations();
        for (std::size_t j = 0; j < rates.size(); ++j) {
            moving.links[j].bias = moving.links[j].bias + rates[j];
            rates_.push_back(held(rates[j]));
            tree_.links[j].bias = tree_.links[j].bias + rates_[j];
        }
        const Bias<Symbolic> motion(moving);
        for (const LinkMotion<Symbolic>& m : motion.motions) motions_.push_back({m.w, held(m.e), held(m.a)});
        for (const Wrench<Symbolic>& w : carried_wrenches(moving, motion.wrenches))
            wrenches_.push_back({held(w.n), held(w.f)});
    }

    void hold_all() {
        still_ = tree_;
        for (Link& l : still_.links) {
            for (Arrow& row : l.R) row = held(row);
            l.p = held(l.p);
            l.slide = held(l.slide);
            l.cosine = held(l.cosine);
            l.sine = held(l.sine);
            l.shift = held(l.shift);
            l.way = held(l.way);
        }
        for (std::size_t j = 0; j < still_.links.size(); ++j) {
            Articulated<Symbolic>& I = bodies_->I[j];
            for (Symbolic& s : I.A) s = held(s);
            for (Symbolic& s : I.C) s = held(s);
            for (Arrow& row : I.B) row = held(row);
            bodies_->U[j] = {held(bodies_->U[j].n), held(bodies_->U[j].f)};
            bodies_->inverses[j] = held(bodies_->inverses[j]);
        }
    }

    /// What stands for a value while it counts as constant.
    Symbolic held(const Symbolic& s) {
        const int id = s.node(p_);
        if (p_[id].is_number()) return s;
        if (p_[id].is_scaled()) {
            const Rational factor = p_[id].coefficients[0];  // a copy: new nodes move the old ones
            const int inner = held({p_, p_[id].args[0]}).node(p_);
            return {p_, p_.sum(0, {{factor, inner}})};
        }
        const auto [known, is_new] = stand_ins_.try_emplace(id, -1);
        if (is_new) {
            known->second = p_.variable({Variable::Kind::unknown, next_unknown_++});
            result_.held.emplace(known->second, id);
        }
        return {p_, known->second};
    }
    Arrow held(const Arrow& v) { return {held(v[0]), held(v[1]), held(v[2])}; }

    /// Nodes that first become needed here are eliminated at the turn of link j.
    void at_turn_of(int j, const std::vector<Arrow>& values) {
        std::vector<int> nodes;
        for (const Arrow& v : values)
            for (const Symbolic& s : v) nodes.push_back(s.node(p_));
        result_.stages.resize(static_cast<std::size_t>(p_.size()), 0);
        for (const int id : p_.needed(nodes))
            if (int& stage = result_.stages[static_cast<std::size_t>(id)]; stage == 0) stage = tree_.size() - j;
    }

    /// ω and β of each link, at held accelerations of its parent, and what its body needs at held ones of its own.
    std::vector<Wrench<Symbolic>> outwards() {
        std::vector<Wrench<Symbolic>> own;
        std::vector<Matrix<Symbolic>> turning;
        for (int j = 0; j < tree_.size(); ++j) {
            const Link& link = tree_.links[j];
            const bool rooted = link.parent < 0;
            const LinkMotion<Symbolic> m = motion_of(tree_, link, rooted ? nullptr : &motions_[link.parent],
                                                     rooted ? nullptr : &turning[link.parent]);
            motions_[j].w = m.w;
            beta_.push_back({m.e, m.a});
            turning.push_back(motions_[j].turning());
            own.push_back(needed_wrench(tree_.body(link), turning[j], motions_[j].a));
            at_turn_of(j, {m.w, m.e, m.a, own[j].n, own[j].f});
        }
        return own;
    }

    /// (Q − s·p)/D of each joint.
    std::vector<Symbolic> inwards(std::vector<Wrench<Symbolic>> p) {
        std::vector<Symbolic> pushes(p.size(), 0);
        for (int j = tree_.size() - 1; j >= 0; --j) {
            const Link &link = tree_.links[j], &still = still_.links[j];
            Symbolic u = loads_[j] - along_joint(still_, still, p[j]);
            if (link.slides) u = u - along_joint(tree_, link, wrenches_[j]);
            if (link.has_rotor) u = u - link.rotor * rates_[static_cast<std::size_t>(j)];
            pushes[j] = bodies_->inverses[j] * u;
            at_turn_of(j, {{pushes[j], u, 0}});
            if (link.parent < 0) continue;
            const Articulated<Symbolic>& I = bodies_->I[j];
            const auto& [e, a] = beta_[j];
            Wrench<Symbolic> t{p[j].n + I.A * e + I.B * a + u * bodies_->U[j].n,
                               p[j].f + transposed(I.B) * e + I.C * a + u * bodies_->U[j].f};
            if (!link.slides && !link.has_rotor) t.n[2] = loads_[j];
            const Wrench<Symbolic> turned = passed(tree_, link, wrenches_[j]), on = passed(still_, still, t);
            Wrench<Symbolic>& parent = p[link.parent];
            parent = {parent.n + turned.n + on.n, parent.f + turned.f + on.f};
            at_turn_of(j, {turned.n, turned.f, on.n, on.f});
        }
        return pushes;
    }

    std::vector<Symbolic> accelerations(const std::vector<Symbolic>& pushes) {
        std::vector<std::pair<Arrow, Arrow>> E;
        std::vector<Symbolic> result;
        for (int j = 0; j < tree_.size(); ++j) {
            const Link& link = still_.links[j];
            auto [e, a] = beta_[j];
            Symbolic before = e[2];  // of ε_z without the joint's own w'
            if (link.parent >= 0) {
                const auto& [parent_e, parent_a] = E[link.parent];
                e = e + still_.from_parent(link, parent_e);
                a = a + still_.from_parent(link, parent_a + cross(parent_e, still_.arm(link)));
                if (!link.absolute) before = e[2];
            }
            const Wrench<Symbolic>& U = bodies_->U[j];
            if (link.slides || link.has_rotor) {
                result.push_back(pushes[j] - (dot(U.n, e) + dot(U.f, a)));
                if (link.slides)
                    a = a + result[j] * still_.direction(link);
                else
                    e[2] = e[2] + result[j];
            } else {  // U_z/D = 1, so that this is the whole of ε_z
                e[2] = pushes[j] - (U.n[0] * e[0] + U.n[1] * e[1] + dot(U.f, a));
                result.push_back(e[2] - before);
            }
            E.emplace_back(e, a);
            at_turn_of(j, {e, a, {result[j], 0, 0}});
        }
        return result;
    }

    Perturbed result_;
    Program& p_;
    JointChange change_;
    BodyTree<Symbolic> tree_, still_;  // with live and with held values
    std::vector<Symbolic> loads_;
    std::optional<ArticulatedBodies<Symbolic>> bodies_;
    std::vector<LinkMotion<Symbolic>> motions_;  // ω live, accelerations held
    std::vector<Wrench<Symbolic>> wrenches_;     // held
    std::vector<std::pair<Arrow, Arrow>> beta_;
    std::vector<Symbolic> rates_;  // w', held
    std::map<int, int> stand_ins_;
    int next_unknown_ = 0;
};

}  // namespace

std::vector<Perturbed> perturbed_tree(const Program& program, const Mechanism& mechanism,
                                      const Equations& equations, bool fold) {
    std::vector<Perturbed> list;
    if (!equations.speeds_are_rates() || !mechanism.states.empty()) return list;
    const Mechanism m = in_terms_of(equations, mechanism);
    const Possible<JointTree> found = loaded_tree(m);
    if (!found.exists() || !norms_alone(found.value(), m)) return list;
    const auto begin = [&](Program& p) {
        std::vector<std::pair<GiNaC::symbol, int>> given;
        for (const Mechanism::Unilateral& contact : m.unilateral)
            given.emplace_back(contact.gap.multiplier, p.number(0));
        return lowering_into(p, m, given, fold);
    };
    for (const LinkAxes axes : {LinkAxes::own, LinkAxes::still}) {
        if (axes == LinkAxes::still && !has_parallel_axes(found.value())) continue;
        try {
            if (auto made = Perturbation(program, found.value(), axes, *m.z, begin).made())
                list.push_back(*std::move(made));
        } catch (const std::domain_error&) {
            // A joint without inertia: the recursion would divide by zero.
        }
    }
    return list;
}

}  // namespace alembert
