// SPDX-License-Identifier: GPL-2.0-or-later
// The recursive Newton-Euler algorithm (Luh, Walker & Paul, J. Dynamic Systems, Measurement and Control 102 (1980)
// 69) and composite bodies (Walker & Orin 1982) on a tree with base parameters (Gautier & Khalil 1990).
#include "program/lower/tree_functions.hpp"

#include <algorithm>
#include <array>

#include "model/formalism/inverse_partials.hpp"
#include "model/formalism/tree_recursions.hpp"
#include "program/lower/link_frames.hpp"

namespace alembert {

namespace {

constexpr double least_gain = 0.995;  // the share of operations that a step to another common link must leave

BodyTree<Symbolic> lean_tree(Program& program, const JointTree& joints, LinkAxes axes, Intermediates& z,
                             const std::function<int(const GiNaC::ex&)>& lowering) {
    const std::function<Symbolic(const GiNaC::ex&)> value = [&](const GiNaC::ex& e) {
        return Symbolic(program, lowering(e));
    };
    return regrouped(reframed(program, dressed<Symbolic>(joints, axes, z, value)));
}

}  // namespace

TreeFunctions::TreeFunctions(Program& program, const JointTree& joints, LinkAxes axes, Intermediates& z,
                             const std::function<int(const GiNaC::ex&)>& lowering)
    : p_(program),
      change_(program, joints, axes, lowering),
      rows_(rate_rows(joints, axes)),
      has_balls_(!joints.balls.empty()),
      tree_(lean_tree(program, joints, axes, z, lowering)) {}

std::vector<int> TreeFunctions::along_coordinates(const std::vector<Symbolic>& loads) const {
    std::vector<int> nodes;
    for (const Symbolic& load : loads) nodes.push_back(load.node(p_));
    return change_.forces(nodes);
}

/// The tree whose joints have w' of q'' in place of w' at q'' = 0.
BodyTree<Symbolic> TreeFunctions::accelerated() const {
    BodyTree<Symbolic> tree = tree_;
    for (std::size_t j = 0; j < rows_.size(); ++j) {
        std::vector<Program::Term> sum{{1, tree.links[j].bias.node(p_)}};
        for (std::size_t a = 0; a < rows_[j].size(); ++a)
            if (!rows_[j][a].is_zero())
                sum.emplace_back(cln::the<cln::cl_RA>(rows_[j][a].to_cl_N()),
                                 p_.variable({Variable::Kind::acceleration, static_cast<int>(a)}));
        tree.links[j].bias = Symbolic(p_, p_.sum(0, sum));
    }
    std::vector<int> second;
    for (int a = 0; a < change_.coordinates(); ++a)
        second.push_back(p_.variable({Variable::Kind::acceleration, a}));
    for (const auto& [j, added] : change_.ball_accelerations(second))
        tree.links[j].bias = tree.links[j].bias + Symbolic(p_, added);
    return tree;
}

std::vector<int> TreeFunctions::loads(Terms terms) const {
    if (terms == Terms::gravity) return along_coordinates(gravity_loads(tree_));
    const BodyTree<Symbolic> tree = terms == Terms::inverse ? accelerated() : tree_;
    return along_coordinates(joint_loads(tree, Bias<Symbolic>(tree).wrenches));
}

std::vector<int> TreeFunctions::mass() const {
    const std::vector<std::vector<Symbolic>> M = composite_bodies(tree_);
    std::vector<std::vector<int>> full(M.size(), std::vector<int>(M.size(), p_.number(0)));
    for (std::size_t j = 0; j < M.size(); ++j)
        for (std::size_t i = 0; i <= j; ++i) full[j][i] = full[i][j] = M[j][i].node(p_);
    return change_.mass(full);
}

/// Do the joints move the links, and does nothing else that depends on the state?
bool TreeFunctions::has_closed_partials() const {
    if (has_balls_) return false;
    const auto is_constant = [&](const auto& values) {
        return std::all_of(values.begin(), values.end(), [&](const Symbolic& s) {
            constexpr unsigned state = 1U << static_cast<unsigned>(Variable::Kind::coordinate) |
                                       1U << static_cast<unsigned>(Variable::Kind::rate);
            return (p_[s.node(p_)].depends & state) == 0;
        });
    };
    const auto is_zero = [](const Symbolic& s) { return s.is_zero(); };
    return std::all_of(tree_.links.begin(), tree_.links.end(),
                       [&](const TreeLink<Symbolic>& l) {
                           return !l.still && !l.absolute && !l.of_ball &&
                                  std::all_of(l.way.begin(), l.way.end(), is_zero) &&
                                  std::all_of(l.bend.begin(), l.bend.end(), is_zero) && is_constant(l.slide) &&
                                  is_constant(l.p) && std::all_of(l.R.begin(), l.R.end(), is_constant) &&
                                  is_constant(l.body.first) && is_constant(l.body.second) &&
                                  is_constant(std::array{l.body.mass, l.bias});
                       }) &&
           is_constant(tree_.gravity);
}

std::vector<int> TreeFunctions::inverse_partials(const BodyTree<Symbolic>& tree, int common) const {
    const InversePartials<Symbolic> by(tree, common);
    const auto n = static_cast<std::size_t>(change_.coordinates());
    std::vector<int> values(n * 2 * n);
    for (std::size_t kind = 0; kind < 2; ++kind) {
        std::vector<std::vector<int>> columns(n);  // by the coordinates; along the joints
        for (const std::vector<Symbolic>& row : kind == 0 ? by.position : by.rate) {
            std::vector<int> nodes;
            for (const Symbolic& s : row) nodes.push_back(s.node(p_));
            nodes = change_.forces(nodes);  // Sᵀ: a value along a joint by each coordinate
            for (std::size_t a = 0; a < n; ++a) columns[a].push_back(nodes[a]);
        }
        for (std::size_t a = 0; a < n; ++a) {
            const std::vector<int> loads = change_.forces(columns[a]);
            for (std::size_t b = 0; b < n; ++b) values[b * 2 * n + kind * n + a] = loads[b];
        }
    }
    return values;
}

std::optional<std::vector<int>> TreeFunctions::inverse_partials() const {
    if (!has_closed_partials()) return std::nullopt;
    const BodyTree<Symbolic> tree = accelerated();
    const auto cost = [&](const std::vector<int>& values) { return p_.count(values).total(); };
    int common = -1;
    std::vector<int> best = inverse_partials(tree, common);
    for (bool walks = true; walks;) {
        walks = false;
        const int from = common;
        for (int j = 0; j < tree.size(); ++j) {
            if (tree.links[j].parent != from) continue;
            std::vector<int> values = inverse_partials(tree, j);
            if (cost(values) > least_gain * cost(best)) continue;
            best = std::move(values);
            common = j;
            walks = true;
        }
    }
    return best;
}

}  // namespace alembert
