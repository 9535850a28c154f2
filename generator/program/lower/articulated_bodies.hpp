// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// The recursions of model/formalism/tree_recursions.hpp, carried out with nodes of a program.
///
///     const RecursionForm form{LinkAxes::still, RecursionForm::Solve::articulated};
///     const RecursionNodes nodes = recursion(program, tree, z, form, lowering);

#include <functional>
#include <optional>

#include "model/formalism/joint_tree.hpp"
#include "program/lower/recursion_form.hpp"
#include "program/program.hpp"

namespace alembert {

struct RecursionNodes {
    std::vector<int> mass, forcing;  ///< in terms of the coordinates; mass is the lower triangle by rows; both are
                                     ///< empty if not wanted
    std::optional<std::vector<int>> acceleration =
        {};  ///< q''; nothing if the joints' rates do not determine those of the coordinates, or if the form does
             ///< not apply to this tree
    std::vector<int> multipliers = {};  ///< for q'', λ of e·e = 1 of each ball joint of the tree
};

/// `lowering` gives the node of an expression. The sources of nodes are not set. Without `with_matrix` the form
/// must be one that needs no matrix.
RecursionNodes recursion(Program& program, const JointTree& tree, Intermediates& z, const RecursionForm& form,
                         bool with_matrix, const std::function<int(const GiNaC::ex&)>& lowering);

/// The loads along the coordinates that accelerations q'' need in addition to those of the tree, by the recursive
/// Newton-Euler algorithm, outwards and inwards at these accelerations; M is never computed. `qddot` are the
/// symbols of q''.
std::vector<int> inverse_recursion(Program& program, const JointTree& tree, Intermediates& z,
                                   const std::vector<GiNaC::symbol>& qddot,
                                   const std::function<int(const GiNaC::ex&)>& lowering);

/// Adds J q'' of the tree's rotors to the loads along the coordinates.
void add_rotors(Program& program, const JointTree& tree, Intermediates& z, const std::vector<GiNaC::symbol>& qddot,
                const std::function<int(const GiNaC::ex&)>& lowering, std::vector<int>& loads);

}  // namespace alembert
