// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// Partial derivatives on the graph of a program, by elimination of vertices.
///
///     const std::vector<Partial> J = *partials(program, {f}, {x, y}, EliminationOrder::least_fill);
///     J[0].node;                                        // ∂f/∂x, a node of the same program
///
/// Each node is an edge from each of its arguments, with its partial derivative for a label; a vertex v goes by
///
///     c_ij ← c_ij + c_iv c_vj    for all j → v → i,
///
/// until edges from inputs to outputs are left: these are the Jacobian. Inputs first is the forward mode, outputs
/// first the reverse mode, and the vertex with the fewest pairs (j, i) first is mostly cheaper than both (Griewank
/// & Walther, Evaluating Derivatives, 2nd ed. 2008, §9.2 and §10.2; Markowitz 1957). Labels are nodes of the
/// hash-consed program: equal ones are one, those that are 0 or ±1 cost nothing, and what depends on parameters
/// alone is computed once a run.
///
/// An input may be any node: what lies before it counts as held. |x|, sign, min and max get a derivative that is
/// right on either side of the kink, and the mean of both on it.

#include <optional>
#include <span>

#include "program/program.hpp"

namespace alembert {

enum class EliminationOrder { forward, reverse, least_fill };

struct Partial {
    int output, input;  ///< positions in the lists that were asked for
    int node;
};

/// All partial derivatives that are not identically zero, row by row. Nothing where more than `budget` products of
/// labels would be made.
std::optional<std::vector<Partial>> partials(Program& program, std::span<const int> outputs,
                                             std::span<const int> inputs, EliminationOrder order,
                                             long budget = 400000);

}  // namespace alembert
