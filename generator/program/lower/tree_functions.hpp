// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// Functions of a tree of joints, by the recursions of model/formalism/tree_recursions.hpp along the axes that
/// take the fewest operations (link_frames.hpp).
///
///     const TreeFunctions tree(program, joints, LinkAxes::still, z, lowering);
///     tree.loads(TreeFunctions::Terms::inverse);      // n nodes: M q'' + C q' + g

#include <functional>

#include "model/formalism/joint_tree.hpp"
#include "program/lower/joint_change.hpp"
#include "program/symbolic_scalar.hpp"

namespace alembert {

class TreeFunctions {
public:
    /// `lowering` gives the node of an expression. The arguments must outlive the object.
    TreeFunctions(Program& program, const JointTree& joints, LinkAxes axes, Intermediates& z,
                  const std::function<int(const GiNaC::ex&)>& lowering);

    /// M q'' + C q' + g, C q' + g, or g, along the coordinates. The tree's own forces are not among them.
    enum class Terms { inverse, bias, gravity };
    std::vector<int> loads(Terms terms) const;
    /// The lower triangle of M.
    std::vector<int> mass() const;

private:
    std::vector<int> along_coordinates(const std::vector<Symbolic>& loads) const;

    Program& p_;
    JointChange change_;
    std::vector<std::vector<GiNaC::numeric>> rows_;  // S
    BodyTree<Symbolic> tree_;
};

}  // namespace alembert
