// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// Solves M x = f by unrolled elimination in a program, using the sparsity of M.

#include <optional>

#include "program/interpret.hpp"
#include "program/program.hpp"

namespace alembert {

/// A state at which no pivot may vanish. Where coordinates have no mass, pivots follow from the constraints and
/// may vanish at all states that obey them (a massless pin in the middle of a straight coupler, if the two halves
/// of the coupler are taken first); the state has to obey them too. Without a state pivots are judged by their
/// structure alone.
class Witness {
public:
    Witness() = default;
    explicit Witness(State<double> state) : state_(std::move(state)) {}

    bool has_state() const { return state_.has_value(); }

    /// The values of all nodes of a program, always the same one, which may have grown since the last call: each
    /// node is computed once. Empty without a state, or if a function is left open.
    const std::vector<double>& values(const Program& program) const;

private:
    std::optional<State<double>> state_;
    mutable std::vector<double> values_;
};

/// Solves the symmetric n×n system whose lower triangle is `lower` (row-major, row i has i + 1 entries) by LDLᵀ in
/// an order that keeps the factor sparse (minimum degree: George & Liu, Computer Solution of Large Sparse Positive
/// Definite Systems (1981), chapter 5). If no diagonal entry can be a pivot (an indefinite matrix from a given
/// Lagrangian), the rest is eliminated with row exchanges. The result is empty if the matrix is structurally
/// singular. Pivots that vanish only at some states give infinities there; with a witness, none that vanishes
/// there (below 1e-7 of its column) is taken if there is another. The first `preferred` unknowns are eliminated
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
/// other. Where rows had to be exchanged, it is the square of the determinant of the rows that did, for each
/// unknown among them. With a witness, as M then is singular in some poses, the preferred pivots that depend on
/// the state are multiplied into them, one by one in turn: where the product vanishes, the elimination divides by
/// next to nothing. Empty if the matrix is structurally singular.
std::vector<int> later_pivots(Program& program, const std::vector<int>& lower, int size, int preferred,
                              const Witness& witness = {});

}  // namespace alembert
