// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// Partial derivatives on the graph of a program, by elimination of vertices.
///
///     const std::vector<Partial> J = *partials(program, {f}, {x, y}, EliminationOrder::least_fill);
///     J[0].node;                                        // ∂f/∂x, a node of the same program
///
/// There is an edge to each node from each of its arguments, labelled with the partial derivative. A vertex v is
/// eliminated by
///
///     c_ij ← c_ij + c_iv c_vj    for all j → v → i,
///
/// until only edges from inputs to outputs remain; their labels are the Jacobian. To eliminate from the inputs is
/// the forward mode, from the outputs the reverse mode; to eliminate the vertex with the fewest pairs (j, i) first
/// is mostly cheaper than both (Griewank & Walther, Evaluating Derivatives, 2nd ed. 2008, §9.2 and §10.2;
/// Markowitz 1957). Labels are nodes of the hash-consed program: equal labels are one node, labels 0 and ±1 cost
/// nothing, and labels that depend on parameters only are computed once in a run.
///
/// An input may be any node; the nodes before it count as constant. The derivatives of |x|, sign, min and max are
/// right on either side of the kink, and the mean of both on it.

#include <map>
#include <optional>
#include <span>

#include "program/program.hpp"

namespace alembert {

enum class EliminationOrder { forward, reverse, least_fill };

struct Partial {
    int output, input;  ///< positions in the lists of outputs and inputs
    int node;
};

/// All partial derivatives that are not identically zero, row by row. Nothing if more than `budget` products of
/// labels would be made. `stages`, one for each node of the program, or for the first of them: the nodes of a
/// lower stage are eliminated before those of a higher one, by least fill.
std::optional<std::vector<Partial>> partials(Program& program, std::span<const int> outputs,
                                             std::span<const int> inputs, EliminationOrder order,
                                             long budget = 400000, std::span<const int> stages = {});

/// The derivatives of the outputs along one direction, Σ ∂output/∂x ẋ over the nodes x of `direction`, which maps
/// each to the node of its ẋ. This is the forward mode with one direction, with as many operations as a few
/// evaluations of the outputs, however many x there are (Griewank & Walther, §3.1).
std::vector<int> tangents(Program& program, std::span<const int> outputs, const std::map<int, int>& direction);

}  // namespace alembert
