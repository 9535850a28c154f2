// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// Solves M x = f by unrolled elimination in a program, using the sparsity of M.

#include <functional>
#include <optional>

#include "program/program.hpp"

namespace alembert {

/// The values of all nodes at a state at which no pivot may vanish. Where coordinates have no mass, pivots follow
/// from the constraints and may vanish at all states that obey them (a massless pin in the middle of a straight
/// coupler, if the two halves of the coupler are taken first). Empty: pivots are judged by their structure alone.
using Witness = std::function<std::vector<double>(const Program&)>;

/// Solves the symmetric n×n system whose lower triangle is `lower` (row-major, row i has i + 1 entries) by LDLᵀ in
/// an order that keeps the factor sparse (minimum degree: George & Liu, Computer Solution of Large Sparse Positive
/// Definite Systems (1981), chapter 5). If no diagonal entry can be a pivot (an indefinite matrix from a given
/// Lagrangian), the rest is eliminated with row exchanges. The result is empty if the matrix is structurally
/// singular. Pivots that vanish only at some states give infinities there; with a witness, none that vanishes
/// there (below 1e-9 of its column) is taken if there is another. The first `preferred` unknowns are eliminated
/// before the others if possible: with constraints these are the coordinates, whose pivots are positive at every
/// state, so that A M⁻¹Aᵀ remains.
std::optional<std::vector<int>> solve_symmetric(Program& program, const std::vector<int>& lower,
                                                const std::vector<int>& f, int preferred = 0,
                                                const Witness& witness = {});

/// The same for several right-hand sides, at least one, with one factorization. Returns a solution for each.
std::optional<std::vector<std::vector<int>>> solve_for_sides(Program& program, const std::vector<int>& lower,
                                                             const std::vector<std::vector<int>>& sides,
                                                             int preferred, const Witness& witness = {});

/// The pivots of the same elimination for the unknowns that are not preferred, in their order. For [M Aᵀ; A 0]
/// they are, with the opposite sign, the pivots of A M⁻¹Aᵀ, some of which vanish where rows of A depend on each
/// other. Empty if rows had to be exchanged.
std::vector<int> later_pivots(Program& program, const std::vector<int>& lower, int size, int preferred,
                              const Witness& witness = {});

}  // namespace alembert
