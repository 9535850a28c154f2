// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// Constraints that follow from the others: found by the rank of A at states that obey them all.
///
///     const std::vector<int> extra = redundant_constraints(mechanism);

#include <vector>

#include "model/mechanism.hpp"
#include "program/interpret.hpp"

namespace alembert {

/// Positions (in Mechanism::constraints) of those whose row of A is a combination of earlier rows, all holonomic
/// ones coming first, at the initial state and at eight further states of the constraint variety, sampled near it
/// with a fixed seed. A sampled answer, in floating point: a row counts as dependent if less than 1e-9 of it is
/// left beside the others. Nothing where the initial state cannot be assembled.
std::vector<int> redundant_constraints(const Mechanism& mechanism);

/// The constraints, none of them redundant, whose rows row k is made of at any of these states.
std::vector<int> follows_from(const Mechanism& mechanism, int k, const std::vector<int>& redundant,
                              const std::vector<State<double>>& states);

/// The mechanism without these; their multipliers are no unknowns of its equations.
Mechanism without_constraints(Mechanism mechanism, const std::vector<int>& positions);

/// Of constraints whose rows follow from the others: does what they ask of the rates follow too? Throws ModelError
/// where it does not, as for x' = y*z' beside x' = y*z' + z: together they ask for z = 0, which is a constraint of
/// its own.
void check_implied(const Mechanism& mechanism, const std::vector<int>& redundant);

}  // namespace alembert
