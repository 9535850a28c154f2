// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// Functions of a tree of joints, by the recursions of model/formalism/tree_recursions.hpp along the axes that
/// take the fewest operations (link_frames.hpp).
///
///     const TreeFunctions tree(program, joints, LinkAxes::still, z, lowering);
///     tree.loads(TreeFunctions::Terms::inverse);      // n nodes: M q'' + C q' + g

#include <functional>
#include <optional>

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
    /// The derivatives of `inverse` by q and q', n × 2n, in closed form (inverse_partials.hpp), with the axes of
    /// that link for all joints that takes the fewest operations, as far as a walk from the ground finds it. None
    /// for ball joints, and for links on curves or along axes that do not turn.
    std::optional<std::vector<int>> inverse_partials() const;

private:
    BodyTree<Symbolic> accelerated() const;
    bool has_closed_partials() const;
    std::vector<int> inverse_partials(const BodyTree<Symbolic>& tree, int common) const;
    std::vector<int> along_coordinates(const std::vector<Symbolic>& loads) const;

    Program& p_;
    JointChange change_;
    std::vector<std::vector<GiNaC::numeric>> rows_;  // S
    bool has_balls_;
    BodyTree<Symbolic> tree_;
};

}  // namespace alembert
