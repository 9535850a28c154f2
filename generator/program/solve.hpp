// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// M x = f, unrolled into a program on the sparsity of M.

#include <optional>

#include "program/program.hpp"

namespace alembert {

/// Solves the symmetric n×n system whose lower triangle is `lower` (row-major, row i has i + 1 entries) by LDLᵀ
/// in an order that keeps the factor sparse (minimum degree: George & Liu, Computer Solution of Large Sparse
/// Positive Definite Systems (1981), chapter 5). Where no diagonal entry can be a pivot (an indefinite matrix from
/// a given Lagrangian) the rest is eliminated with row exchanges. Nothing if the matrix is structurally singular.
/// Pivots that vanish at some state only show there, as infinities.
/// The first `preferred` unknowns are eliminated before the others where they can be: with constraints these are
/// the coordinates, whose pivots are positive at every state, so that what is left is A M⁻¹Aᵀ.
std::optional<std::vector<int>> solve_symmetric(Program& program, const std::vector<int>& lower,
                                                const std::vector<int>& f, int preferred = 0);

/// The same for several right-hand sides, one at least, with one factorization; a solution for each.
std::optional<std::vector<std::vector<int>>> solve_for_sides(Program& program, const std::vector<int>& lower,
                                                             const std::vector<std::vector<int>>& sides,
                                                             int preferred);

/// What the same elimination divides by for the unknowns that are not preferred, in their order; for [M Aᵀ; A 0]
/// with the sign changed the pivots of A M⁻¹Aᵀ, of which some vanish where rows of A depend on each other. Empty
/// where rows had to be exchanged.
std::vector<int> later_pivots(Program& program, const std::vector<int>& lower, int size, int preferred);

}  // namespace alembert
