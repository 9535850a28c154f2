// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// The order in which conditions can be solved one after the other, each for a variable that no earlier one
/// contains.
///
///     const SolvingOrder order = solving_order(program, conditions);
///     order.left.empty();         // true if all conditions have a place
///
/// It is found from the last step to the first: a variable that no other condition contains can be found when
/// everything else is known. Multipliers are preferred, then coordinates, then parameters. If no condition has
/// such a variable, two conditions that are the only ones with two certain variables are solved together.

#include <set>
#include <vector>

#include "analysis/exact/own_branch.hpp"
#include "analysis/exact/solving_step.hpp"

namespace alembert {

struct SolvingOrder {
    std::vector<SolvingStep> steps;  ///< in the order of solving
    std::vector<int> left;           ///< conditions that have no place in the order
};

/// `conditions`: nodes of the program that are to be zero. Those that hold parameters alone are left, as a
/// parameter is not chosen to be zero, but for `irreducible` ones: these have no parameter as a factor. A
/// condition is solved only for a variable that it determines on the scene's own branch, if the `slopes` there are
/// given.
SolvingOrder solving_order(const Program& program, std::vector<int> conditions,
                           const std::set<int>& irreducible = {}, const OwnSlopes* slopes = nullptr,
                           const std::set<std::pair<Variable::Kind, int>>& fixed = {});

/// Does the condition hold parameters and nothing else?
bool holds_parameters_alone(const Program& program, int condition);

/// Whether the unknown's variable occurs in the node.
bool holds(const Program& program, int node, const SolvedUnknown& unknown);

}  // namespace alembert
