// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// Recursive equations: composite bodies for M, Newton-Euler for what is left (Featherstone 2008, chapters 5 and
/// 6).
///
/// `Equations::tree` comes with them: lowering may take it to make the same accelerations by articulated bodies,
/// or along axes that do not turn. Constraints, closed loops among them, have their multipliers as in Routh's
/// equations.

#include "formalism/equations.hpp"
#include "formalism/joint_tree.hpp"

namespace alembert {

/// Throws ModelError with the obstacle where there is one.
Equations recursive(const Mechanism& mechanism);
/// What is missing in a scene that is no tree of links with joints (see joint_tree.hpp).
std::optional<std::string> obstacle_to_recursive(const Mechanism& mechanism);

/// The tree alone, for what is made by articulated bodies or from both ends of a chain: M, and with it all that
/// has as many elements, is left out (Equations::M has no rows). For trees of hundreds of joints without
/// constraints.
Equations recursive_without_matrix(const Mechanism& mechanism);

/// The tree with all forces but gravity's along its coordinates: what is needed where M is not.
Possible<JointTree> loaded_tree(const Mechanism& mechanism);

}  // namespace alembert
