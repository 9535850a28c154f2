// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// Recursive equations: M by composite bodies, the other terms by the recursive Newton-Euler algorithm
/// (Featherstone 2008, chapters 5 and 6).
///
/// `Equations::tree` is set, so that lowering can compute the same accelerations by articulated bodies, or along
/// axes that do not turn. Constraints, including those of closed loops, have multipliers as in Routh's equations.

#include "model/formalism/equations.hpp"
#include "model/formalism/joint_tree.hpp"

namespace alembert {

/// Throws ModelError with the obstacle if there is one.
Equations recursive(const Mechanism& mechanism);
/// Why the formalism does not apply: what is missing in a scene that is no tree of links with joints
/// (joint_tree.hpp).
std::optional<std::string> obstacle_to_recursive(const Mechanism& mechanism);

/// The equations with the tree only, for solution by articulated bodies or from both ends of a chain. M and
/// everything else with as many elements is left out (Equations::M has no rows). This is meant for trees of
/// hundreds of joints, without constraints except those of their quaternions.
Equations recursive_without_matrix(const Mechanism& mechanism);

/// f of M q'' = f of equations with a tree, which those without a matrix leave out too; the mechanism is in their
/// terms (`in_terms_of`).
std::vector<GiNaC::ex> forcing_of_tree(const Equations& equations, const Mechanism& mechanism);

/// The generalized forces of springs, other potentials, dampers and applied loads; of everything but gravity.
std::vector<GiNaC::ex> forces_besides_gravity(const Mechanism& mechanism);

/// The tree with all generalized forces except gravity's, which is all that is needed without M.
Possible<JointTree> loaded_tree(const Mechanism& mechanism);

}  // namespace alembert
