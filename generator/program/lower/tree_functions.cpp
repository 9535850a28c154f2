// SPDX-License-Identifier: GPL-2.0-or-later
// The recursive Newton-Euler algorithm (Luh, Walker & Paul, J. Dynamic Systems, Measurement and Control 102 (1980)
// 69) and composite bodies (Walker & Orin 1982) on a tree with base parameters (Gautier & Khalil 1990).
#include "program/lower/tree_functions.hpp"

#include "model/formalism/tree_recursions.hpp"
#include "program/lower/link_frames.hpp"

namespace alembert {

namespace {

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
      tree_(lean_tree(program, joints, axes, z, lowering)) {}

std::vector<int> TreeFunctions::along_coordinates(const std::vector<Symbolic>& loads) const {
    std::vector<int> nodes;
    for (const Symbolic& load : loads) nodes.push_back(load.node(p_));
    return change_.forces(nodes);
}

std::vector<int> TreeFunctions::loads(Terms terms) const {
    if (terms == Terms::gravity) return along_coordinates(gravity_loads(tree_));
    BodyTree<Symbolic> tree = tree_;
    for (std::size_t j = 0; terms == Terms::inverse && j < rows_.size(); ++j) {
        std::vector<Program::Term> sum{{1, tree.links[j].drift.node(p_)}};
        for (std::size_t a = 0; a < rows_[j].size(); ++a)
            if (!rows_[j][a].is_zero())
                sum.emplace_back(cln::the<cln::cl_RA>(rows_[j][a].to_cl_N()),
                                 p_.variable({Variable::Kind::acceleration, static_cast<int>(a)}));
        tree.links[j].drift = Symbolic(p_, p_.sum(0, sum));
    }
    if (terms == Terms::inverse) {
        std::vector<int> second;
        for (int a = 0; a < change_.coordinates(); ++a)
            second.push_back(p_.variable({Variable::Kind::acceleration, a}));
        for (const auto& [j, added] : change_.ball_accelerations(second))
            tree.links[j].drift = tree.links[j].drift + Symbolic(p_, added);
    }
    return along_coordinates(joint_loads(tree, Bias<Symbolic>(tree).wrenches));
}

std::vector<int> TreeFunctions::mass() const {
    const std::vector<std::vector<Symbolic>> M = composite_bodies(tree_);
    std::vector<std::vector<int>> full(M.size(), std::vector<int>(M.size(), p_.number(0)));
    for (std::size_t j = 0; j < M.size(); ++j)
        for (std::size_t i = 0; i <= j; ++i) full[j][i] = full[i][j] = M[j][i].node(p_);
    return change_.mass(full);
}

}  // namespace alembert
