// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// The recursions of formalism/recursion.hpp, instantiated with nodes of a program.
///
///     const RecursionForm form{LinkAxes::still, RecursionForm::Solve::articulated};
///     const RecursionNodes nodes = recursion(program, tree, z, form, lowering);

#include <functional>
#include <optional>

#include "formalism/joint_tree.hpp"
#include "lower/recursion_form.hpp"
#include "program/program.hpp"

namespace alembert {

struct RecursionNodes {
    std::vector<int> mass, forcing;  ///< in coordinates; mass: lower triangle by rows; both empty if not wanted
    std::optional<std::vector<int>> acceleration =
        {};  ///< q''; nothing where the joints' rates do not
             ///< determine the coordinates', or the form is not one of this tree
};

/// `lowering` gives the node of an expression. Sources of nodes are left as they are.
/// Without `with_matrix` the form is one that needs none.
RecursionNodes recursion(Program& program, const JointTree& tree, Intermediates& z, const RecursionForm& form,
                         bool with_matrix, const std::function<int(const GiNaC::ex&)>& lowering);

/// The loads along the coordinates that accelerations q'' need beside those of the tree: Newton-Euler outwards at
/// these accelerations, and inwards; M is never made. `qddot`: the symbols of q''.
std::vector<int> inverse_recursion(Program& program, const JointTree& tree, Intermediates& z,
                                   const std::vector<GiNaC::symbol>& qddot,
                                   const std::function<int(const GiNaC::ex&)>& lowering);

}  // namespace alembert
