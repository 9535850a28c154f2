// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// Continua of equilibria and steady motions, such as the places at which a ball may lie on a level table.
///
///     if (const auto family = family_of(problem, is_angle, root, rates))
///         family->dimension, family->free       // 2, {x, y}: near the root there is one for each x and y
///     leads_to(problem, is_angle, root, other, rates)   // whether both belong to one of them
///
/// A singular derivative alone makes no continuum: x³ = 0 has one. So there must be roots beside the given one,
/// and the dimension is the least of what the derivative leaves free at these. (Where it has one rank at a root
/// and all those near it, they are a manifold whose tangent is the kernel, by the theorem of constant rank.) Only
/// directions count in which a coordinate changes on which something depends.

#include <optional>
#include <vector>

#include "stability/linear/steady.hpp"

namespace alembert {

struct SteadyFamily {
    int dimension = 0;
    std::vector<int> free;  ///< as many coordinates, whose values choose a member near the root
};

/// Nothing if no other roots were found beside this one.
std::optional<SteadyFamily> family_of(const SteadyProblem& problem, const std::vector<bool>& is_angle,
                                      const SteadyRoot& root, Rates rates);

/// Whether a way from one root to the other was found on which each state is a root. That none was found is no
/// proof that there is none.
bool leads_to(const SteadyProblem& problem, const std::vector<bool>& is_angle, const SteadyRoot& from,
              const SteadyRoot& to, Rates rates);

}  // namespace alembert
