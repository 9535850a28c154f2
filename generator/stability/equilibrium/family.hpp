// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// Continua of equilibria and steady motions, such as the places at which a ball may lie on a level table.
///
///     if (const auto family = family_of(problem, is_angle, root, rates))
///         family->dimension, family->free       // 2, {x, y}: near the root there is one for each x and y
///     leads_to({problem, borders, is_angle, rates}, root, other)       // whether both belong to one of them
///
/// A singular derivative alone makes no continuum: x³ = 0 has one. So there must be roots beside the given one,
/// and the dimension is the least of what the derivative leaves free at these. (Where it has one rank at a root
/// and all those near it, they are a manifold whose tangent is the kernel, by the theorem of constant rank.) Only
/// directions count in which a coordinate changes on which something depends, or a first-order state with a rate.

#include <optional>
#include <vector>

#include "stability/linear/borders.hpp"
#include "stability/linear/steady.hpp"

namespace alembert {

struct SteadyFamily {
    int dimension = 0;
    /// As many coordinates and, counted behind all of them, states of the scene, whose values choose a member near
    /// the root.
    std::vector<int> free;
    /// Of dimension 1: the ends of the way along which each state is a member, by the value of what is free.
    /// Nothing where no end was found on that side.
    std::optional<long double> from = {}, to = {};
    /// How far the way was followed to a side on which no end was found, by the value of what is free; nothing
    /// where there is an end, and where the way leads on, round a circle or back.
    std::optional<long double> seen_from = {}, seen_to = {};
};

/// Nothing if no other roots were found beside this one.
std::optional<SteadyFamily> family_of(const SteadyProblem& problem, const std::vector<bool>& is_angle,
                                      const SteadyRoot& root, Rates rates);

/// Where continua are followed.
struct FamilyWays {
    const SteadyProblem& problem;
    const Borders& borders;  ///< of its equations: no step passes a whole piece
    const std::vector<bool>& is_angle;
    Rates rates;
};

/// Whether a way from one root to the other was found on which each state is a root. That none was found is no
/// proof that there is none.
bool leads_to(const FamilyWays& ways, const SteadyRoot& from, const SteadyRoot& to);

/// Of a family of dimension 1 along an angle, or with corners: whether it leads to the other root the long way
/// round, or past these.
bool leads_round(const FamilyWays& ways, const SteadyFamily& family, const SteadyRoot& from, const SteadyRoot& to);

/// Follows a family of dimension 1 to both sides of the root, as far as what is free rises or falls on the way.
void find_ends(const FamilyWays& ways, SteadyFamily& family, const SteadyRoot& root);

}  // namespace alembert
